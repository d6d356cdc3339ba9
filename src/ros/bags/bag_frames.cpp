// SPDX-License-Identifier: BSD-3-Clause
#include "bag_frames.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace cca {
namespace {

/// How a frame hangs on another one.
struct Joint {
  std::string parent;
  geometry_msgs::Transform first;
  bool moves = false;
};
using Joints = std::map<std::string, Joint>;  // by the frame that hangs

Joints jointsOf(const std::vector<Transforms::Message>& messages) {
  Joints joints;
  for (const auto& message : messages) {
    for (const auto& transform : message.transforms.transforms) {
      const std::string parent = frameName(transform.header.frame_id);
      Joint& joint = joints[frameName(transform.child_frame_id)];
      if (joint.parent.empty()) joint.first = transform.transform;
      joint.moves = joint.moves || joint.first != transform.transform;
      joint.parent = parent;
    }
  }
  return joints;
}

/// The frame itself and those that it hangs on, up to the root.
std::vector<std::string> chainOf(const Joints& joints, const std::string& frame) {
  std::vector<std::string> chain{frame};
  for (auto at = joints.find(frame); at != joints.end(); at = joints.find(chain.back())) {
    const std::string& parent = at->second.parent;
    if (std::find(chain.begin(), chain.end(), parent) != chain.end()) break;
    chain.push_back(parent);
  }
  return chain;
}

/// Without prefix: 'base_link' of 'robot1/base_link'.
std::string lastWord(const std::string& frame) { return frame.substr(frame.rfind('/') + 1); }

bool isOdom(const std::string& frame) { return lastWord(frame).find("odom") != std::string::npos; }

std::string called(const std::vector<std::string>& frames, const std::string& name) {
  const auto found = std::find_if(frames.begin(), frames.end(),
                                  [&](const auto& frame) { return lastWord(frame) == name; });
  return found == frames.end() ? "" : *found;
}

/// Of those frames, the one that hangs on a moving one, or on `odom`; empty where none does.
std::string carried(const Joints& joints, const std::vector<std::string>& chain) {
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    if (isOdom(chain[k + 1])) return chain[k];
  }
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    if (joints.at(chain[k]).moves) return chain[k];
  }
  return {};
}

std::string baseInChain(const Joints& joints, const std::vector<std::string>& chain,
                        const OdometryFrames& odometry) {
  const std::string link = called(chain, "base_link");
  if (!link.empty()) return link;
  const bool has_odometrys = std::find(chain.begin(), chain.end(), odometry.base) != chain.end();
  if (has_odometrys) return odometry.base;
  const std::string footprint = called(chain, "base_footprint");
  return footprint.empty() ? carried(joints, chain) : footprint;
}

/// A base that the laser does not hang on; empty where it is not clear which.
std::string baseElsewhere(const std::vector<std::string>& frames, const OdometryFrames& odometry) {
  if (!odometry.base.empty()) return odometry.base;
  for (const char* name : {"base_link", "base_footprint"}) {
    std::vector<std::string> bases;
    for (const auto& frame : frames) {
      if (lastWord(frame) == name) bases.push_back(frame);
    }
    if (bases.size() == 1) return bases.front();
  }
  return {};
}

}  // namespace

std::vector<std::string> frameNames(const std::vector<Transforms::Message>& messages) {
  std::set<std::string> names;
  for (const auto& [frame, joint] : jointsOf(messages)) names.insert({frame, joint.parent});
  return {names.begin(), names.end()};
}

BagFrames findFrames(const std::vector<Transforms::Message>& messages, const std::string& laser,
                     const OdometryFrames& odometry, const std::string& base) {
  const Joints joints = jointsOf(messages);
  const std::vector<std::string> chain = chainOf(joints, laser);
  BagFrames frames;
  frames.base = base;
  if (frames.base.empty()) frames.base = baseInChain(joints, chain, odometry);
  if (frames.base.empty()) frames.base = baseElsewhere(frameNames(messages), odometry);
  if (frames.base.empty()) frames.base = chain.back();
  const std::vector<std::string> above = chainOf(joints, frames.base);
  // What hangs on the base, or on the same root as it, has a place on the robot.
  frames.mount_is_known = chain.back() == above.back();
  const auto odom = std::find_if(above.begin() + 1, above.end(), isOdom);
  const auto told = std::find(above.begin() + 1, above.end(), odometry.odom);
  frames.map = called({above.begin() + 1, above.end()}, "map");
  if (odom != above.end()) {
    frames.odom = *odom;
  } else if (told != above.end() && *told != frames.map) {
    frames.odom = *told;
  } else if (above.size() > 1 && joints.at(frames.base).moves && above[1] != frames.map) {
    frames.odom = above[1];
  }
  return frames;
}

}  // namespace cca
