// SPDX-License-Identifier: BSD-3-Clause
#include "truth_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/files/text.hpp"

namespace cca {
namespace {

struct TruthRow {
  double key;  ///< s, or the number of the scan
  Pose2 pose;
};

std::vector<TruthRow> readRows(const std::string& path) {
  std::vector<TruthRow> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream values(line);
    TruthRow row{};
    if (values >> row.key >> row.pose.x >> row.pose.y >> row.pose.theta) rows.push_back(row);
  }
  return rows;
}

bool countsScans(const std::vector<TruthRow>& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].key != static_cast<double>(k)) return false;
  }
  return true;
}

class LogWithTruth : public LogReader {
 public:
  LogWithTruth(std::unique_ptr<LogReader> log, const std::string& truth_path)
      : log_(std::move(log)), path_(truth_path), rows_(readRows(truth_path)) {
    by_number_ = countsScans(rows_);
    readable_ = !rows_.empty() &&
                std::is_sorted(rows_.begin(), rows_.end(),
                               [](const TruthRow& a, const TruthRow& b) { return a.key < b.key; });
  }

  std::optional<LogRecord> next() override {
    auto record = log_->next();
    if (record && readable_ && !record->truth) {
      if (by_number_ || record->has_time) record->truth = at(by_number_ ? number_ : record->time);
    }
    number_ += 1.0;
    return record;
  }

  std::string warnings() const override {
    std::string text = log_->warnings();
    if (!readable_) appendWarning(path_ + " holds no true poses in order of time", text);
    return text;
  }

  double progress() const override { return log_->progress(); }

 private:
  std::optional<Pose2> at(double key) const {
    const auto after = std::lower_bound(rows_.begin(), rows_.end(), key,
                                        [](const TruthRow& row, double k) { return row.key < k; });
    if (after == rows_.end()) return std::nullopt;
    if (after->key == key) return after->pose;
    if (after == rows_.begin()) return std::nullopt;
    const TruthRow &a = *std::prev(after), &b = *after;
    const double t = (key - a.key) / (b.key - a.key);
    return poseBetween(a.pose, b.pose, t);
  }

  std::unique_ptr<LogReader> log_;
  std::string path_;
  std::vector<TruthRow> rows_;
  bool by_number_ = false, readable_ = false;
  double number_ = 0.0;
};

}  // namespace

std::optional<std::string> findTruthFile(const std::string& log_path) {
  const std::filesystem::path log(log_path);
  const auto beside = (log.parent_path() / log.stem()).string() + "_GT.txt";
  for (const std::string& candidate : {log_path + ".GT.txt", beside}) {
    if (std::filesystem::is_regular_file(candidate)) return candidate;
  }
  return std::nullopt;
}

std::unique_ptr<LogReader> withTruth(std::unique_ptr<LogReader> log,
                                     const std::string& truth_path) {
  return std::make_unique<LogWithTruth>(std::move(log), truth_path);
}

}  // namespace cca
