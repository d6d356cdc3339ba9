// SPDX-License-Identifier: BSD-3-Clause
#include "master_watch.hpp"

#include <ros/connection_manager.h>
#include <ros/network.h>
#include <ros/publication.h>
#include <ros/ros.h>
#include <ros/service_manager.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>

#include <chrono>
#include <string>

namespace cca {
namespace {

/// A call of the ROS Master API, without waiting for a master that is not there.
bool call(const std::string& method, const XmlRpc::XmlRpcValue& request,
          XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcValue response;
  return ros::master::execute(method, request, response, answer, false);
}

XmlRpc::XmlRpcValue request(const std::string& name, const std::string& detail) {
  XmlRpc::XmlRpcValue r;
  r[0] = ros::this_node::getName();
  r[1] = name;
  r[2] = detail;
  r[3] = ros::XMLRPCManager::instance()->getServerURI();
  return r;
}

/// Another process is another master. 0: none answers.
int masterProcess() {
  XmlRpc::XmlRpcValue me, pid;
  me[0] = ros::this_node::getName();
  if (!call("getPid", me, pid) || pid.getType() != XmlRpc::XmlRpcValue::TypeInt) return 0;
  return pid;
}

/// Tells this node, as the master would, who publishes a topic.
void takePublishers(const std::string& topic, const XmlRpc::XmlRpcValue& publishers) {
  XmlRpc::XmlRpcValue update, result;
  update[0] = "/master";
  update[1] = topic;
  update[2] = publishers;
  XmlRpc::XmlRpcClient self(ros::network::getHost().c_str(),
                            ros::XMLRPCManager::instance()->getServerPort(), "/");
  self.execute("publisherUpdate", update, result);
}

void registerAgain() {
  ros::V_string topics;
  XmlRpc::XmlRpcValue answer;
  ros::TopicManager::instance()->getAdvertisedTopics(topics);
  for (const auto& topic : topics) {
    const auto publication = ros::TopicManager::instance()->lookupPublication(topic);
    if (publication) call("registerPublisher", request(topic, publication->getDataType()), answer);
  }
  topics.clear();
  ros::TopicManager::instance()->getSubscribedTopics(topics);
  for (const auto& topic : topics) {
    // An empty list would cut the connections with those who have not registered again.
    if (call("registerSubscriber", request(topic, "*"), answer) && answer.size() > 0) {
      takePublishers(topic, answer);
    }
  }
  // roscpp keeps no list that could be asked for: all that any of the nodes has.
  for (const char* name :
       {"~start", "~stop", "~pause", "~home", "~save", "~reset", "~room_at", "~drive_to_room",
        "~set_parameters", "~get_loggers", "~set_logger_level", "static_map", "dynamic_map"}) {
    const std::string service = ros::names::resolve(name);
    if (!ros::ServiceManager::instance()->lookupServicePublication(service)) continue;
    const std::string uri = "rosrpc://" + ros::network::getHost() + ":" +
                            std::to_string(ros::ConnectionManager::instance()->getTCPPort());
    call("registerService", request(service, uri), answer);
  }
}

}  // namespace

MasterWatch::MasterWatch() : thread_([this] { watch(); }) {}

MasterWatch::~MasterWatch() {
  ending_.set_value();
  thread_.join();
}

void MasterWatch::watch() {
  int known = masterProcess();
  const std::future<void> ended = ending_.get_future();
  while (ended.wait_for(std::chrono::seconds(1)) == std::future_status::timeout) {
    const int present = masterProcess();
    if (present == 0 || present == known) continue;
    if (known != 0) {
      ROS_WARN("the master was restarted: registering with it again");
      registerAgain();
    }
    known = present;
  }
}

}  // namespace cca
