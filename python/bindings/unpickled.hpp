// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace cca::python {

/// Lets pickle say why a class cannot be pickled, and what can be instead.
/// @param why  lives as long as the program.
template <class Class>
void refusePickle(Class&& type, const char* why) {
  type.def(
      "__getstate__", [why](nanobind::handle) { throw nanobind::type_error(why); },
      nanobind::sig("def __getstate__(self) -> typing.NoReturn"));
}

}  // namespace cca::python
