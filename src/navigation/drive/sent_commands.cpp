// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/drive/sent_commands.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

double towards(double from, double to, double speeds_up, double brakes, double dt) {
  const bool falls = from * (to - from) < 0.0;
  const double most = (falls ? brakes : speeds_up) * dt;
  const double next = from + std::clamp(to - from, -most, most);
  return falls && next * from < 0.0 && to * from < 0.0 ? 0.0 : next;
}

}  // namespace

void SentCommands::add(const Velocity& command, double time) {
  if (!std::isfinite(command.linear + command.angular + time)) return;
  const bool is_alone =
      !sent_.empty() && !(time >= sent_.back().time && time <= sent_.back().time + kKept);
  if (is_alone) sent_.clear();
  if (!sent_.empty() && sent_.back().time == time) sent_.pop_back();
  sent_.push_back({time, command});
  while (sent_.size() > 1 && sent_[1].time < time - kKept) sent_.pop_front();
}

std::optional<Velocity> SentCommands::at(double time) const {
  const auto later = std::upper_bound(sent_.begin(), sent_.end(), time,
                                      [](double t, const Sent& sent) { return t < sent.time; });
  if (later == sent_.begin()) return std::nullopt;
  return std::prev(later)->command;
}

Velocity obey(const Velocity& velocity, const Velocity& command, const Velocity& speeds_up,
              const Velocity& brakes, double dt) {
  return {towards(velocity.linear, command.linear, speeds_up.linear, brakes.linear, dt),
          towards(velocity.angular, command.angular, speeds_up.angular, brakes.angular, dt)};
}

}  // namespace cca
