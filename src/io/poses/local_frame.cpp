// SPDX-License-Identifier: BSD-3-Clause
#include "io/poses/local_frame.hpp"

#include <cmath>
#include <utility>

#include "geometry/median.hpp"

namespace cca {
namespace {

constexpr double kRaster = 1000.0;        // m
constexpr std::size_t kScansAhead = 100;  // enough for a median, little enough to keep

}  // namespace

Eigen::Vector2d localOrigin(const Eigen::Vector2d& p_map) {
  if (!p_map.allFinite()) return Eigen::Vector2d::Zero();
  return {kRaster * std::round(p_map.x() / kRaster), kRaster * std::round(p_map.y() / kRaster)};
}

Eigen::Vector2d medianPlace(const std::vector<Eigen::Vector2d>& places) {
  std::vector<double> x, y;
  for (const auto& place : places) {
    if (!place.allFinite()) continue;
    x.push_back(place.x());
    y.push_back(place.y());
  }
  if (x.empty()) return Eigen::Vector2d::Zero();
  return {median(std::move(x)), median(std::move(y))};
}

LocalLog::LocalLog(std::unique_ptr<LogReader> log) : log_(std::move(log)) {
  std::vector<Eigen::Vector2d> places;
  while (ahead_.size() < kScansAhead) {
    auto record = log_->next();
    if (!record) break;
    places.push_back(record->scan.T_map_sensor.position());
    ahead_.push_back(std::move(*record));
  }
  const Eigen::Vector2d begin = medianPlace(places);
  origin_ = localOrigin(begin);
  start_ = begin - origin_;
}

void LocalLog::moveTo(const Eigen::Vector2d& origin) {
  start_ += origin_ - origin;
  origin_ = origin;
}

std::optional<LogRecord> LocalLog::next() {
  std::optional<LogRecord> record;
  if (ahead_.empty()) {
    record = log_->next();
  } else {
    record = std::move(ahead_.front());
    ahead_.pop_front();
  }
  if (!record) return record;
  record->scan.T_map_sensor = seenFrom(origin_, record->scan.T_map_sensor);
  if (record->corrected) record->corrected = seenFrom(origin_, *record->corrected);
  if (record->truth) record->truth = seenFrom(origin_, *record->truth);
  return record;
}

}  // namespace cca
