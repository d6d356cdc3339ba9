// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt line_mapper: `scan` and tf in, `lines` and `line_markers` out. For a bag, or a
// robot that something else drives.
#include <ros/callback_queue.h>

#include <stdexcept>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "cca_mrpt/ros/line_messages.hpp"
#include "line_publisher.hpp"
#include "map_record.hpp"
#include "map_saver.hpp"
#include "node_diagnostics.hpp"
#include "node_main.hpp"
#include "outer_localisation.hpp"
#include "private_parameters.hpp"
#include "scan_feed.hpp"
#include "slam_localisation.hpp"
#include "way_publisher.hpp"

namespace cca {
namespace {

const ros::WallDuration kWayPeriod(1.0);

struct LineMapperParameters {
  FrameNames frames;
  std::vector<std::string> scans{"scan"};
  std::string pose = "tf";
  std::string resume;           ///< folder of an earlier map, see SlamLocalisation
  bool corrections = false;     ///< of the past where tf's map -> odom leaps
  std::string out = "cca_map";  ///< directory, relative to where the node runs
  bool save_at_end = false;
  Parameters program;
};

LineMapperParameters readParameters(const ros::NodeHandle& private_node) {
  LineMapperParameters p;
  PrivateParameters parameters(private_node);
  parameters.names("scans", p.scans);
  parameters.choice("pose", p.pose, {"tf", "slam"});
  parameters.text("map_frame", p.frames.map);
  parameters.text("resume", p.resume);
  if (p.pose != "slam" && !p.resume.empty()) {
    throw std::runtime_error("parameter ~resume needs _pose:=slam");
  }
  parameters.flag("corrections", p.corrections);
  if (p.pose == "slam" || p.corrections) {
    parameters.text("odom_frame", p.frames.odom);
    parameters.text("base_frame", p.frames.base);
  } else {
    for (const char* slams : {"odom_frame", "base_frame"}) parameters.withoutEffect(slams);
  }
  parameters.text("out", p.out);
  parameters.flag("save_at_end", p.save_at_end);
  parameters.program(p.program, {"mapping"});
  parameters.refuseUnknown();
  return p;
}

class LineMapper {
 public:
  LineMapper() : LineMapper(ros::NodeHandle(), ros::NodeHandle("~")) {}
  LineMapper(ros::NodeHandle node, ros::NodeHandle private_node)
      : parameters_(readParameters(private_node)),
        line_map_(parameters_.program.mapping),
        publisher_(node, parameters_.frames.map),
        way_(node, parameters_.frames.map),
        scans_(node, scanSettings(), [this](const PlacedScan& scan) { insert(scan); }),
        diagnostics_(
            node, private_node, [this]() -> const auto& { return scans_.dropped(); }),
        scan_lines_(node.advertise<cca_mrpt::LineMap>("scan_lines", 10)),
        reset_(private_node.advertiseService("reset", &LineMapper::onReset, this)),
        saver_(private_node, parameters_.out, [this] { return products(); }) {
    if (parameters_.pose == "slam") {
      slam_.emplace(node, parameters_.frames, parameters_.resume);
      saver_.saveMemory([this] { return slam_->memory(); });
    }
    if (parameters_.pose == "tf" && parameters_.corrections) {
      outer_.emplace(node, parameters_.program.mapping);
    }
  }

  void end() {
    ros::getGlobalCallbackQueue()->callAvailable();  // scans that have come belong to the map
    if (!parameters_.save_at_end) return;
    if (slam_) {
      const std::lock_guard<std::mutex> lock(saver_.mutex());
      slam_->finish();
      correct(slam_->past(), slam_->way(), slam_->remembered());
    }
    saver_.saveOrTell();
  }

 private:
  ScanFeed::Settings scanSettings() const {
    const FrameNames& frames = parameters_.frames;
    if (parameters_.pose == "slam") return {parameters_.scans, frames.odom, frames.base};
    if (parameters_.corrections)
      return {parameters_.scans, frames.map, frames.base, 0.0, frames.odom};
    return {parameters_.scans, frames.map};
  }

  void insert(PlacedScan scan) {
    const ros::WallTime begin = ros::WallTime::now();
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    const bool is_first_laser = scan.topic == 0;
    if (slam_ && !is_first_laser && !slam_->placeBeside(scan)) return;
    if (slam_ && is_first_laser && slam_->place(scan)) {
      correct(slam_->past(), slam_->way(), slam_->remembered());
    }
    if (outer_ && outer_->take(scan)) correct(outer_->past(), outer_->way());
    agreement_.add(compareWithMap(scan.scan, line_map_.walls()));
    std::vector<LineSegment> lines = extractLines(scan.scan, parameters_.program.mapping);
    if (scan_lines_.getNumSubscribers() > 0) showLinesOf(scan, lines);
    line_map_.insert(scan.scan, std::move(lines));
    publisher_.publish(line_map_.lines(), scan.stamp);
    // After the lines: somebody may wait for them.
    if (is_first_laser) {
      record_.add(scan.scan, scan.T_fixed_robot);
      way_.add(scan.T_fixed_robot, scan.stamp);
      showWay(scan.stamp);
    } else {
      record_.addBeside(scan.scan);
    }
    if (slam_) slam_->tell(diagnostics_);
    diagnostics_.scanUsed((ros::WallTime::now() - begin).toSec(), agreement_);
    if (agreement_.recent() < kPoorAgreement) {
      ROS_WARN_THROTTLE(5.0, "scans contradict the map: %.1f %% of their returns agree with it",
                        100.0 * agreement_.recent());
    }
  }

  void correct(const PastScans& past, const std::vector<StampedPose>& way,
               std::size_t remembered = 0) {
    line_map_ = LineMap(parameters_.program.mapping);
    for (const auto& kept : past.kept()) line_map_.insert(kept.scan);
    record_.correct(past, remembered);
    way_.replace(way);
  }

  void showWay(const ros::Time& stamp) {
    const ros::WallTime now = ros::WallTime::now();
    if (now - way_shown_ < kWayPeriod) return;
    way_.publish(stamp);
    way_shown_ = now;
  }

  void showLinesOf(const PlacedScan& scan, const std::vector<LineSegment>& lines) {
    std::vector<MapLine> numbered;
    for (const LineSegment& line : lines) {
      numbered.push_back({numbered.size(), line, line.moments.weight});
    }
    std_msgs::Header header;
    header.stamp = scan.stamp;
    header.frame_id = scan.frame;
    scan_lines_.publish(lineMapMessage(numbered, header));
  }

  bool onReset(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    line_map_ = LineMap(parameters_.program.mapping);
    agreement_ = ScanAgreement();
    record_ = MapRecord();
    way_.replace({});
    if (slam_) slam_->reset();
    if (outer_) outer_->reset();
    publisher_.publish({}, ros::Time::now());
    response.success = true;
    response.message = "the map is empty";
    return true;
  }

  MapProducts products() const {
    MapProducts products = record_.products("line_mapper", line_map_);
    products.summary["scans"] = record_.way.size();
    products.summary["agreement"] = agreement_.overall();
    if (slam_) products.summary["loops"] = slam_->loops();
    if (slam_ && slam_->remembered() > 0) {
      products.summary["found_in_memory"] = slam_->isInMemory();
    }
    return products;
  }

  LineMapperParameters parameters_;
  LineMap line_map_;
  ScanAgreement agreement_;
  MapRecord record_;
  LinePublisher publisher_;
  WayPublisher way_;
  ros::WallTime way_shown_;
  std::optional<SlamLocalisation> slam_;
  std::optional<OuterLocalisation> outer_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  ros::Publisher scan_lines_;
  ros::ServiceServer reset_;
  MapSaver saver_;  // last: it may still be saving, by products(), when all this ends
};

const NodeDescription kNode{
    "line_mapper",
    "a line map from scan and tf; drives nothing\n\n"
    "_name:=value [default]\n"
    "  scans [[scan]] topics of its lasers; slam goes by the first\n"
    "  pose [tf] slam: line SLAM gives map -> odom\n"
    "  corrections [false] the past is placed anew where map -> odom leaps,\n"
    "    or by corrected_path\n"
    "  map_frame [map] the fixed frame\n"
    "  odom_frame [odom], base_frame [base_link] for slam and corrections\n"
    "  config [] .ini file, read first\n"
    "  out [cca_map] folder for the map\n"
    "  save_at_end [false]",
    {"mapping"}};

}  // namespace
}  // namespace cca

int main(int argc, char** argv) {
  return cca::runNode(argc, argv, cca::kNode, [] {
    cca::LineMapper mapper;
    while (cca::keepRunning(0.1)) {
    }
    mapper.end();
  });
}
