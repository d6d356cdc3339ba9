// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "evidence/tuning_design.hpp"

namespace cca::evidence {

/// A shard's results as a file that only grows, a whole row at a time. Opened again after the
/// program was killed it knows what has been done: a row that was cut short is taken off.
class TuningRows {
 public:
  /// Opens or creates. @throws std::runtime_error naming the file, where it cannot be written or
  /// belongs to another design.
  TuningRows(const std::string& path, const TuningDesign& design);
  ~TuningRows();
  TuningRows(const TuningRows&) = delete;
  TuningRows& operator=(const TuningRows&) = delete;

  bool has(std::size_t job) const { return done_.count(job) > 0; }
  std::size_t size() const { return done_.size(); }
  /// Writes a row in one piece and flushes it. @throws std::runtime_error (full disk).
  void append(const TuningJob& job, const TuningRow& row);

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
  std::set<std::size_t> done_;
};

/// The rows of several shards' files, by job; of a job that stands in two files the first is taken.
/// @throws std::runtime_error naming the file that cannot be read or belongs to another design.
std::vector<TuningRow> readTuningRows(const std::vector<std::string>& paths,
                                      const TuningDesign& design);

/// The table that `benchmarks/scripts/tuning_report.py` analyses, CSV: two lines that begin with
/// '#', the design's signature and `combinations=N scenes=N shipped` with the defaults of the three
/// parameters; then the columns' names and a row a run, by job. The same runs give the same bytes.
std::string tuningTable(const TuningDesign& design, const std::vector<TuningRow>& rows);

}  // namespace cca::evidence
