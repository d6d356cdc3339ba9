// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt line_mapper: `scan` and tf in, `lines` and `line_markers` out. For a bag, or a
// robot that something else drives.
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "cca_mrpt/ros/line_messages.hpp"
#include "line_publisher.hpp"
#include "map_record.hpp"
#include "map_saver.hpp"
#include "node_diagnostics.hpp"
#include "node_main.hpp"
#include "private_parameters.hpp"
#include "scan_feed.hpp"

namespace cca {
namespace {

struct LineMapperParameters {
  std::string map_frame = "map";
  std::string out = "cca_map";  ///< directory, relative to where the node runs
  bool save_at_end = false;
  Parameters program;
};

LineMapperParameters readParameters(const ros::NodeHandle& private_node) {
  LineMapperParameters p;
  PrivateParameters parameters(private_node);
  parameters.text("map_frame", p.map_frame);
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
        publisher_(node, parameters_.map_frame),
        scans_(node, {parameters_.map_frame, ""}, 0.0,
               [this](const PlacedScan& scan) { insert(scan); }),
        diagnostics_(
            node, private_node, [this]() -> const auto& { return scans_.dropped(); }),
        saver_(private_node, parameters_.out, [this] { return products(); }),
        scan_lines_(node.advertise<cca_mrpt::LineMap>("scan_lines", 10)),
        reset_(private_node.advertiseService("reset", &LineMapper::onReset, this)) {}

  void end() {
    if (parameters_.save_at_end) saver_.saveOrTell();
  }

 private:
  void insert(const PlacedScan& scan) {
    const ros::WallTime begin = ros::WallTime::now();
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    agreement_.add(compareWithMap(scan.scan, line_map_.walls()));
    std::vector<LineSegment> lines = extractLines(scan.scan, parameters_.program.mapping);
    if (scan_lines_.getNumSubscribers() > 0) showLinesOf(scan, lines);
    line_map_.insert(scan.scan, std::move(lines));
    publisher_.publish(line_map_.lines(), scan.stamp);
    record_.add(scan.scan, scan.T_map_robot);  // after the lines: somebody may wait for them
    diagnostics_.scanUsed((ros::WallTime::now() - begin).toSec(), agreement_);
    if (agreement_.recent() < kPoorAgreement) {
      ROS_WARN_THROTTLE(5.0, "scans contradict the map: %.1f %% of their returns agree with it",
                        100.0 * agreement_.recent());
    }
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
    publisher_.publish({}, ros::Time::now());
    response.success = true;
    response.message = "the map is empty";
    return true;
  }

  MapProducts products() {
    line_map_.finishBatch();
    MapProducts products = record_.products("line_mapper", line_map_);
    products.summary["agreement"] = agreement_.overall();
    return products;
  }

  LineMapperParameters parameters_;
  LineMap line_map_;
  ScanAgreement agreement_;
  MapRecord record_;
  LinePublisher publisher_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  MapSaver saver_;
  ros::Publisher scan_lines_;
  ros::ServiceServer reset_;
};

const NodeDescription kNode{"line_mapper",
                            "a line map from scan and tf; drives nothing\n\n"
                            "_name:=value [default]\n"
                            "  map_frame [map] the fixed frame\n"
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
