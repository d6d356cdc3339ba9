// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace cca {

/// What a node is called, and what --help tells of it.
struct NodeDescription {
  std::string name;
  std::string about;                  ///< what it does, and its own parameters, a line each
  std::vector<std::string> sections;  ///< of the program's parameters that it uses, too
};

/// The main() of every node: init, body, and one place for errors.
///
/// Ctrl-C, SIGTERM, SIGHUP and `rosnode kill` do not tear the node down where it stands:
/// keepRunning() turns false, and the body may still save its map and stop the robot over live
/// connections. While it waits for a master, a signal ends it at once.
/// @return  0; 2 after a fatal message where the body threw, and for arguments that are not ROS's.
///          --help is answered without a master.
int runNode(int argc, char** argv, const NodeDescription& node, const std::function<void()>& body);

/// Serves callbacks as they come, for at most this long in wall time.
/// @return  false as soon as the node has been asked to end.
bool keepRunning(double seconds);

}  // namespace cca
