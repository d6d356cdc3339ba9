// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <memory>

namespace cca::python {

namespace nb = nanobind;

/// Numbers that nobody else holds as an array of rows x columns, without a copy.
/// @param numbers  at least as many, and one even of none: an address to give away.
template <typename Number>
nb::object ownedArray(std::unique_ptr<Number[]> numbers, std::size_t rows, std::size_t columns) {
  Number* raw = numbers.release();
  const nb::capsule owner(raw, [](void* p) noexcept { delete[] static_cast<Number*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, Number, nb::ndim<2>>(raw, {rows, columns}, owner));
}

}  // namespace cca::python
