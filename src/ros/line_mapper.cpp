// SPDX-License-Identifier: BSD-3-Clause
//
// rosrun cca_mrpt line_mapper: `scan` and tf in, `lines` and `line_markers` out. For a bag, or a
// robot that something else drives.
#include "cca_mrpt/mapping/line_map.hpp"
#include "line_publisher.hpp"
#include "node_diagnostics.hpp"
#include "node_main.hpp"
#include "private_parameters.hpp"
#include "save_map.hpp"
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
  parameters.program(p.program);
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
            node, private_node, [this]() -> const auto& { return scans_.dropped(); }) {
    save_service_ = private_node.advertiseService("save", &LineMapper::onSave, this);
  }

  void end() {
    if (parameters_.save_at_end) saveOrTell([this] { save(); });
  }

 private:
  void insert(const PlacedScan& scan) {
    const ros::WallTime begin = ros::WallTime::now();
    line_map_.insert(scan.scan);
    record_.add(scan.scan, scan.T_map_robot);
    publisher_.publish(line_map_.lines(), scan.stamp);
    diagnostics_.scanUsed((ros::WallTime::now() - begin).toSec());
  }

  void save() {
    line_map_.finishBatch();
    saveMap(parameters_.out, "line_mapper", line_map_, record_, {});
  }

  bool onSave(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
    answer(response, parameters_.out, [this] { save(); });
    return true;
  }

  LineMapperParameters parameters_;
  LineMap line_map_;
  MapRecord record_;
  ros::ServiceServer save_service_;
  LinePublisher publisher_;
  ScanFeed scans_;
  NodeDiagnostics diagnostics_;
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
