// SPDX-License-Identifier: BSD-3-Clause
#include "node_main.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <csignal>
#include <exception>

#include "master_watch.hpp"

namespace cca {
namespace {

std::atomic<bool> asked_to_end{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

void onSignal(int) { asked_to_end = true; }

/// `rosnode kill` and a second node of this name.
void onShutdownRequest(XmlRpc::XmlRpcValue& /*request*/, XmlRpc::XmlRpcValue& response) {
  asked_to_end = true;
  response = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace

int runNode(int argc, char** argv, const std::string& name, const std::function<void()>& body) {
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  const auto& requests = ros::XMLRPCManager::instance();
  requests->unbind("shutdown");
  requests->bind("shutdown", onShutdownRequest);
  const ros::NodeHandle keeps_console_alive;  // with the last handle the console goes, too
  int status = 0;
  try {
    const MasterWatch watch;
    body();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    status = 2;
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
