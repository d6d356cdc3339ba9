// SPDX-License-Identifier: BSD-3-Clause
#include "run_page.hpp"

#include <utility>

namespace cca {
namespace {

const ros::WallDuration kHeedPeriod(0.05), kSilence(1.0);
/// m; a robot that stands, and whose pose trembles, is not driving.
constexpr double kTremble = 0.05;

}  // namespace

void RunPage::Settings::read(PrivateParameters& parameters) {
  parameters.flag("serve", serve);
  for (const char* name : {"serve_port", "serve_address"}) {
    if (!serve) parameters.withoutEffect(name);
  }
  if (!serve) return;
  port = kPort;
  parameters.number("serve_port", port, 0, 65535, "");
  parameters.text("serve_address", address);
}

RunPage::RunPage(const ros::NodeHandle& node, const Settings& settings,
                 std::function<void(const RunCommand&)> heed)
    : heed_(std::move(heed)) {
  if (!settings.serve) return;
  page_ = openLivePage(settings);
  timer_ = node.createWallTimer(kHeedPeriod, [this](const ros::WallTimerEvent&) {
    while (const std::optional<RunCommand> command = page_->nextCommand()) heed_(*command);
  });
  ROS_INFO("the run can be seen at %s", page_->url().c_str());
}

void RunPage::show(ReplayMoment moment, const Scan& scan, const LineMap& map,
                   const ros::Time& stamp) {
  if (!isDue()) return;
  const Eigen::Vector2d here = moment.T_map_robot.position();
  const double step = counted_ ? (here - *counted_).norm() : 0.0;
  if (!counted_ || step >= kTremble) {
    distance_ += step;
    counted_ = here;
  }
  if (!begin_) begin_ = stamp;
  moment.time = (stamp - *begin_).toSec();
  moment.distance = distance_;
  moment_ = std::move(moment);
  scan_ = scan;
  page_->show({moment_, scan_, map, {}, {}});
  shown_ = ros::WallTime::now();
}

void RunPage::repeat(const std::string& reason, const LineMap& map) {
  if (!begin_ || !isDue() || ros::WallTime::now() - shown_ < kSilence) return;
  moment_.reason = reason;
  page_->show({moment_, scan_, map, {}, {}});
  shown_ = ros::WallTime::now();
}

void RunPage::restart() {
  if (!page_) return;
  begin_.reset();
  counted_.reset();
  distance_ = 0.0;
  page_->restart();
}

void RunPage::setPaused(bool is_paused) {
  if (page_) page_->setPaused(is_paused);
}

void RunPage::finish(const std::vector<MapLine>& lines, const std::string& reason) {
  if (page_) page_->finish(lines, reason);
}

}  // namespace cca
