// SPDX-License-Identifier: BSD-3-Clause
#include "line_log.hpp"

#include <cmath>
#include <utility>

#include "cca_mrpt/sensing/missing_returns.hpp"
#include "io/files/gzip_lines.hpp"
#include "io/files/text.hpp"

namespace cca {
namespace {

/// Beams at both ends of a full turn may coincide, and files round their angles.
constexpr double kWidestTurn = 2.0 * M_PI + 0.02;  // rad

class LineLog : public LogReader {
 public:
  LineLog(const std::string& path, std::unique_ptr<LineFormat> format)
      : format_(std::move(format)), lines_(path) {
    try {
      ahead_ = read();
    } catch (const MalformedLine& error) {
      throw std::runtime_error(path + ":" + std::to_string(number_) + ": " + error.what());
    }
    if (!ahead_) {
      const std::string why = warnings();
      throw std::runtime_error(path + ": holds no scan" + (why.empty() ? "" : " (" + why + ")"));
    }
  }

  std::optional<LogRecord> next() override {
    std::optional<LogRecord> record = std::exchange(ahead_, std::nullopt);
    while (!record && !has_ended_) {
      try {
        record = read();
      } catch (const MalformedLine& error) {
        if (malformed_++ == 0) first_ = std::to_string(number_) + ": " + error.what();
      }
    }
    return record;
  }

  std::string warnings() const override {
    std::string text;
    if (lines_.damaged()) text = "the compressed file is damaged or ends early";
    if (malformed_ > 0) {
      appendWarning(std::to_string(malformed_) + " line(s) left out, the first is line " + first_,
                    text);
    }
    return text;
  }

  double progress() const override { return lines_.progress(); }

 private:
  /// The next scan; nothing at the end. @throws MalformedLine
  std::optional<LogRecord> read() {
    while (auto line = lines_.next()) {
      if (++number_ == 1) *line = withoutMark(*line);
      if (auto record = format_->parse(*line)) {
        missing_.judge(record->scan);
        return record;
      }
    }
    has_ended_ = true;
    return std::nullopt;
  }

  std::unique_ptr<LineFormat> format_;
  GzipLines lines_;
  MissingReturns missing_;
  std::size_t number_ = 0, malformed_ = 0;  ///< of the last line, from 1; lines left out
  std::string first_;                       ///< of these, and what is wrong with it
  bool has_ended_ = false;
  std::optional<LogRecord> ahead_;
};

}  // namespace

std::unique_ptr<LogReader> openLineLog(const std::string& path,
                                       std::unique_ptr<LineFormat> format) {
  return std::make_unique<LineLog>(path, std::move(format));
}

void requireOneTurn(const Scan& scan) {
  const double covered = scan.angle_increment * static_cast<double>(scan.size() - 1);
  if (std::abs(covered) <= kWidestTurn && std::abs(scan.angle_min) <= kWidestTurn &&
      covered != 0.0) {
    return;
  }
  throw MalformedLine(
      formatted("angles: %zu beams must lie apart within one turn, not from %g to %g rad",
                scan.size(), scan.angle_min, scan.angle_min + covered));
}

}  // namespace cca
