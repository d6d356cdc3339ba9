// SPDX-License-Identifier: BSD-3-Clause
#include "node_main.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>

#include "cca_mrpt/io/parameters.hpp"
#include "master_watch.hpp"

namespace cca {
namespace {

constexpr int kUsage = 2;

std::atomic<bool> asked_to_end{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

void onSignal(int) { asked_to_end = true; }

/// `rosnode kill` and a second node of this name.
void onShutdownRequest(XmlRpc::XmlRpcValue& /*request*/, XmlRpc::XmlRpcValue& response) {
  asked_to_end = true;
  response = ros::xmlrpc::responseInt(1, "", 0);
}

void printHelp(const NodeDescription& node) {
  std::printf("%s: %s\n\n", node.name.c_str(), node.about.c_str());
  std::printf("of the program, as _section/name:=value [default]\n");
  Parameters defaults;
  for (const auto& field : listParameters(defaults)) {
    const auto& sections = node.sections;
    if (std::find(sections.begin(), sections.end(), field.section) == sections.end()) continue;
    std::printf("  %s/%s [%s] %s; %s\n", field.section.c_str(), field.name.c_str(),
                field.get().c_str(), field.meaning.c_str(), field.allowed.c_str());
  }
}

}  // namespace

int runNode(int argc, char** argv, const NodeDescription& node, const std::function<void()>& body) {
  const auto asks_for_help = [](const std::string& word) {
    return word == "--help" || word == "-h";
  };
  if (std::any_of(argv + 1, argv + argc, asks_for_help)) {
    printHelp(node);
    return 0;
  }
  const std::string& name = node.name;
  try {
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  } catch (const ros::Exception& error) {
    std::fprintf(
        stderr, "%s: %s\nother names of topics are given as old:=new, parameters as _name:=value\n",
        name.c_str(), error.what());
    return kUsage;
  }
  if (argc > 1) {  // ROS has taken its own out
    std::fprintf(stderr, "%s: '%s' is not expected; parameters are given as _name:=value\n",
                 name.c_str(), argv[1]);
    return kUsage;
  }
  const auto& requests = ros::XMLRPCManager::instance();
  requests->unbind("shutdown");
  requests->bind("shutdown", onShutdownRequest);
  // Waits for the master, which a signal ends as it ends any program: there is nothing to save yet.
  // It also keeps the console alive, which goes with the last handle.
  const ros::NodeHandle first_handle;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const bool ignored = std::signal(signal, onSignal) == SIG_IGN;
    if (ignored && signal == SIGHUP) std::signal(signal, SIG_IGN);  // nohup
  }
  int status = 0;
  try {
    const MasterWatch watch;
    body();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    status = kUsage;
  }
  ros::shutdown();
  return status;
}

bool keepRunning(double seconds) {
  if (!asked_to_end && ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(seconds));
  }
  return !asked_to_end && ros::ok();
}

}  // namespace cca
