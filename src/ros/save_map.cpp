// SPDX-License-Identifier: BSD-3-Clause
#include "save_map.hpp"

#include <ros/console.h>

#include <filesystem>
#include <stdexcept>

namespace cca {

void MapRecord::add(const Scan& scan, const Pose2& T_map_robot) {
  grid.insert(scan);
  way.push_back(T_map_robot);
}

void saveMap(const std::string& folder, const std::string& title, const LineMap& line_map,
             const MapRecord& record, const nlohmann::ordered_json& summary) {
  if (record.way.empty()) throw std::runtime_error("there is no map yet");
  prepareMapFolder(folder, true);
  MapProducts products;
  products.title = title;
  products.lines = line_map.lines();
  products.poly_lines = line_map.polyLines();
  products.trajectory = record.way;
  products.grid = record.grid.grid();
  products.summary = summary;
  writeMapFolder(folder, products);
  ROS_INFO("map saved to %s", std::filesystem::absolute(folder).c_str());
}

void answer(std_srvs::Trigger::Response& response, const std::string& folder,
            const std::function<void()>& save) {
  try {
    save();
    response.success = true;
    response.message = std::filesystem::absolute(folder).string();
  } catch (const std::runtime_error& error) {
    response.success = false;
    response.message = error.what();
  }
}

void saveOrTell(const std::function<void()>& save) {
  try {
    save();
  } catch (const std::runtime_error& error) {
    ROS_ERROR("the map could not be saved: %s", error.what());
  }
}

}  // namespace cca
