// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt line_mapper: `scan` and tf in, `lines` and `line_markers` out. For a bag, or a
// robot that something else drives.
#include <ros/callback_queue.h>

#include <stdexcept>

#include "cca_mrpt/session/earlier_drive.hpp"
#include "io/files/memory_file.hpp"
#include "io/maps/grid_recorder.hpp"
#include "node_diagnostics.hpp"
#include "node_localisation.hpp"
#include "node_main.hpp"
#include "ros/bags/topic_recorder.hpp"
#include "ros/input/scan_feed.hpp"
#include "ros/messages/map_messages.hpp"
#include "ros/output/line_publisher.hpp"
#include "ros/output/map_saver.hpp"
#include "ros/output/plan_server.hpp"
#include "ros/output/run_page.hpp"
#include "ros/output/slam_publisher.hpp"
#include "ros/output/way_publisher.hpp"
#include "ros/parameters/private_parameters.hpp"

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
  std::string record;  ///< bag to write
  std::string labels;  ///< CSV with names of rooms; empty: none
  RunPage::Settings page;
  Parameters program;
};

LineMapperParameters readParameters(const ros::NodeHandle& private_node) {
  LineMapperParameters p;
  PrivateParameters parameters(private_node);
  parameters.names("scans", p.scans);
  parameters.choice("pose", p.pose, {"tf", "slam"});
  parameters.text("resume", p.resume);
  if (p.pose != "slam" && !p.resume.empty()) {
    throw std::runtime_error("parameter ~resume needs _pose:=slam");
  }
  parameters.flag("corrections", p.corrections);
  parameters.frame("odom_frame", p.frames.odom);
  parameters.frame("map_frame", p.frames.map, p.pose == "slam" ? p.frames.odom : "");
  if (p.pose == "slam" || p.corrections) {
    parameters.frame("base_frame", p.frames.base);
  } else {
    parameters.withoutEffect("base_frame");
  }
  parameters.path("out", p.out, "a folder");
  parameters.flag("save_at_end", p.save_at_end);
  parameters.text("record", p.record);
  parameters.text("labels", p.labels);
  p.page.title = "line_mapper";
  p.page.read(parameters);
  parameters.program(p.program, {"mapping"});
  parameters.refuseUnknown();
  return p;
}

class LineMapper {
 public:
  explicit LineMapper(ros::NodeHandle node = {},
                      ros::NodeHandle private_node = ros::NodeHandle("~"))
      : parameters_(readParameters(private_node)),
        node_(node),
        recorder_(node, parameters_.record, topicsOfRobot(parameters_.scans)),
        publisher_(node, parameters_.frames.map),
        way_(node, parameters_.frames.map),
        page_(private_node, parameters_.page, [this](const RunCommand& command) { heed(command); }),
        scans_(node, scanSettings(), [this](const PlacedScan& scan) { insert(scan); }),
        diagnostics_(node, private_node, scans_.dropped()),
        scan_lines_(node.advertise<cca_mrpt::LineMap>("scan_lines", 10)),
        reset_(private_node.advertiseService("reset", &LineMapper::onReset, this)),
        saver_(private_node, parameters_.out, [this] { return products(); }),
        plan_(node, private_node, parameters_.frames.map, parameters_.labels, saver_) {
    begin();
    if (slam_) {
      slam_publisher_.emplace(node, parameters_.frames);
      saver_.saveMemory([this]() -> const Slam& { return slam_->slam(); });
    }
  }

  void end() {
    ros::getGlobalCallbackQueue()->callAvailable();  // scans that have come belong to the map
    scans_.finish();
    if (parameters_.save_at_end) {
      const std::lock_guard<std::mutex> lock(saver_.mutex());
      session_->finish();
    }
    page_.finish(session_->lineMap().lines(), "the node ends");
    if (parameters_.save_at_end) saver_.saveOrTell();
  }

 private:
  ScanFeed::Settings scanSettings() const {
    const FrameNames& frames = parameters_.frames;
    const bool is_slam = parameters_.pose == "slam", corrects = parameters_.corrections;
    return {parameters_.scans,
            {is_slam ? frames.odom : frames.map, is_slam || corrects ? frames.base : "",
             corrects ? frames.odom : "", std::nullopt, frames.odom}};
  }

  /// There is nobody to be sent anywhere: while it is paused, scans are left out.
  void heed(const RunCommand& command) {
    is_paused_ = command.kind != RunCommand::Kind::kStart;
    page_.setPaused(is_paused_);
  }

  /// An empty map.
  void begin() {
    path_.shutdown();
    auto localiser =
        makeLocaliser(parameters_.pose, parameters_.corrections, parameters_.program.mapping);
    slam_ = dynamic_cast<SlamLocaliser*>(localiser.get());
    external_ = dynamic_cast<ExternalCorrections*>(localiser.get());
    if (external_) path_ = hearCorrectedPath(node_, *external_);
    grid_.restart();
    session_ = std::make_unique<MappingSession>(
        std::move(localiser), MappingSession::Settings{parameters_.program.mapping}, &grid_);
    if (!parameters_.resume.empty()) {
      rememberDrive(seenFrom({0.0, 0.0}, loadMemory(parameters_.resume)), *slam_, *session_);
    }
  }

  void insert(const PlacedScan& scan) {
    if (is_paused_) return;
    const ros::WallTime start = ros::WallTime::now();
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    Measurement measurement = measurementOf(scan, slam_ != nullptr);
    if (scan.topic != 0) {
      session_->addSecondary(measurement, scan.topic);
    } else {
      if (session_->times().empty() && slam_) measurement.T_map_robot = T_map_start_;
      show(session_->add(measurement), measurement, scan);
      showPage(scan.stamp);
    }
    if (scan_lines_.getNumSubscribers() > 0) showLinesOf(scan);
    publisher_.publish(session_->lineMap().lines(), scan.stamp);
    diagnostics_.scanUsed((ros::WallTime::now() - start).toSec(), session_->agreement());
    if (session_->agreement().recent() < kPoorAgreement) {
      ROS_WARN_THROTTLE(5.0, "scans contradict the map: %.1f %% of their returns agree with it",
                        100.0 * session_->agreement().recent());
    }
  }

  void show(const Estimate& estimate, const Measurement& measurement, const PlacedScan& scan) {
    estimate_ = estimate;
    if (estimate.was_corrected) {
      if (external_) logCorrection(*external_);
      way_.replace(session_->times(), session_->trajectory());
    }
    if (slam_) {
      slam_publisher_->publish(estimate, *measurement.T_odom_robot, *slam_, scan.stamp,
                               diagnostics_);
    }
    way_.add(estimate.T_map_robot, scan.stamp);
    const ros::WallTime now = ros::WallTime::now();
    if (now - way_shown_ < kWayPeriod) return;
    way_.publish(scan.stamp);
    way_shown_ = now;
  }

  void showPage(const ros::Time& stamp) {
    if (!estimate_.is_known || !page_.isDue()) return;
    ReplayMoment moment;
    moment.T_map_robot = estimate_.T_map_robot;
    page_.show(moment, session_->scan(), session_->lineMap(), stamp);
  }

  /// Of the session's last scan.
  void showLinesOf(const PlacedScan& scan) {
    std::vector<MapLine> numbered;
    for (const LineSegment& line : session_->scanLines()) {
      numbered.push_back({numbered.size(), line, line.moments.weight});
    }
    scan_lines_.publish(lineMapMessage(numbered, headerMessage(scan.frame, scan.stamp)));
  }

  bool onReset(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    if (!session_->times().empty()) T_map_start_ = estimate_.T_map_robot;
    parameters_.resume.clear();
    begin();
    page_.restart();
    way_.replace({}, {});
    publisher_.publish({}, ros::Time::now());
    response.success = true;
    response.message = "the map is empty";
    return true;
  }

  MapProducts products() const {
    if (session_->times().empty()) throw std::runtime_error("there is no map yet");
    MapProducts products = mapProducts(parameters_.page.title, *session_);
    products.grid = grid_.grid().raster();
    products.summary["scans"] = session_->times().size();
    products.summary["agreement"] = session_->agreement().overall();
    if (slam_) products.summary["loops"] = slam_->slam().loopsClosed();
    if (slam_ && slam_->remembered() > 0) {
      products.summary["found_in_memory"] = slam_->slam().isInMemory();
    }
    return products;
  }

  LineMapperParameters parameters_;
  ros::NodeHandle node_;
  TopicRecorder recorder_;
  GridRecorder grid_;
  SlamLocaliser* slam_ = nullptr;  ///< the session's, with line SLAM
  std::unique_ptr<MappingSession> session_;
  ExternalCorrections* external_ = nullptr;  ///< the same, with corrections of tf's
  ros::Subscriber path_;
  Estimate estimate_;  ///< the last one
  Pose2 T_map_start_;  ///< where SLAM's map begins: at the last ~reset
  std::optional<SlamPublisher> slam_publisher_;
  LinePublisher publisher_;
  WayPublisher way_;
  ros::WallTime way_shown_;
  RunPage page_;
  bool is_paused_ = false;  ///< by the page's viewers
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  ros::Publisher scan_lines_;
  ros::ServiceServer reset_;
  // Last: they may still be at work, by products(), when all this ends.
  MapSaver saver_;
  PlanServer plan_;
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
    "  save_at_end [false]\n"
    "  resume [] slam: folder of an earlier map to go on with\n"
    "  labels [] CSV of x, y and name: names of rooms\n"
    "  record [] bag to write of scans, tf, odom, cmd_vel and corrected_path\n"
    "  serve [false] shows the map in browsers as it grows; serve_port [8048] 0: any free;\n"
    "    serve_address [127.0.0.1] others: who asks must know a random token",
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
