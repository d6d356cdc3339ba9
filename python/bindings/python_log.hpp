// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "io/logs/sound_log.hpp"

namespace cca::python {

namespace nb = nanobind;

/// Judges a scan by those of its laser before it, once: what a reader gives is judged already.
inline void judgeOnce(MissingReturns& missing_returns, LogRecord& record) {
  if (!std::exchange(record.is_judged, true)) missing_returns.judge(record.scan);
}

/// The records of any Python iterator, for what reads logs.
class PythonLog : public LogReader {
 public:
  /// @param iterator  outlives this, which may be destroyed without the interpreter's lock.
  explicit PythonLog(nb::handle iterator) : iterator_(iterator) {}

  std::optional<LogRecord> next() override {
    const nb::gil_scoped_acquire turn;
    if (ended_) return std::nullopt;
    // What reads logs is no Python code: nobody else asks whether Ctrl-C was pressed meanwhile.
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    const nb::object record = nb::steal(PyIter_Next(iterator_.ptr()));
    if (record.is_valid()) {
      const LogRecord* taken = nullptr;
      if (!nb::try_cast<const LogRecord*>(record, taken) || !taken)
        throw nb::value_error("records: an iterable of LogRecord is needed");
      LogRecord judged = *taken;
      judgeOnce(missing_returns_, judged);
      return judged;
    }
    ended_ = true;
    if (PyErr_Occurred()) throw nb::python_error();
    return std::nullopt;
  }
  std::string warnings() const override { return {}; }
  double progress() const override { return ended_ ? 1.0 : 0.0; }

 private:
  nb::handle iterator_;
  MissingReturns missing_returns_;  ///< of a laser whose records somebody made
  bool ended_ = false;
};

/// Records that are gone through more than once.
class RepeatedLog {
 public:
  /// @param records  an iterable, not an iterator; outlives this.
  explicit RepeatedLog(nb::handle records) : records_(records) {}

  /// From the beginning on, until it is opened anew. Without the interpreter's lock.
  std::unique_ptr<LogReader> open() {
    const nb::gil_scoped_acquire turn;
    iterator_ = nb::iter(records_);
    return soundScansOf(std::make_unique<PythonLog>(iterator_));
  }

 private:
  nb::handle records_;
  nb::object iterator_;
};

}  // namespace cca::python
