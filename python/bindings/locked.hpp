// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <mutex>
#include <utility>

namespace cca::python {

/// A value that Python's threads take turns at: calls run without the interpreter's lock.
template <class Value>
class Locked {
 public:
  explicit Locked(Value value) : value_(std::move(value)) {}

  template <class Call>
  auto with(Call&& call) {
    const nanobind::gil_scoped_release others_may_run;
    const std::lock_guard<std::mutex> turn(mutex_);
    return call(value_);
  }

 private:
  Value value_;
  std::mutex mutex_;
};

}  // namespace cca::python
