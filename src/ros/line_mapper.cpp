// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt line_mapper: `scan` and tf in, `lines` and `line_markers` out. For a bag, or a
// robot that something else drives.
#include "cca_mrpt/mapping/line_map.hpp"
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
        saver_(private_node, parameters_.out, [this] { return products(); }) {}

  void end() {
    if (parameters_.save_at_end) saver_.saveOrTell();
  }

 private:
  void insert(const PlacedScan& scan) {
    const ros::WallTime begin = ros::WallTime::now();
    const std::lock_guard<std::mutex> lock(saver_.mutex());
    line_map_.insert(scan.scan);
    publisher_.publish(line_map_.lines(), scan.stamp);
    record_.add(scan.scan, scan.T_map_robot);  // after the lines: somebody may wait for them
    diagnostics_.scanUsed((ros::WallTime::now() - begin).toSec());
  }

  MapProducts products() {
    line_map_.finishBatch();
    return record_.products("line_mapper", line_map_);
  }

  LineMapperParameters parameters_;
  LineMap line_map_;
  MapRecord record_;
  LinePublisher publisher_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
  MapSaver saver_;
};

}  // namespace
}  // namespace cca

int main(int argc, char** argv) {
  return cca::runNode(argc, argv, "line_mapper", [] {
    cca::LineMapper mapper;
    while (cca::keepRunning(0.1)) {
    }
    mapper.end();
  });
}
