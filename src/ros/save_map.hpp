// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/Trigger.h>

#include <functional>
#include <string>
#include <vector>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

/// A map in the making, and the way on which it was made.
struct MapRecord {
  ScanGrid grid;
  std::vector<Pose2> way;  ///< T_map_robot, a pose a scan

  void add(const Scan& scan, const Pose2& T_map_robot);
};

/// Writes the folder of writeMapFolder(), over one that is there, and says so on the console.
/// @throws std::runtime_error naming the file and the reason, and where there is no scan yet.
void saveMap(const std::string& folder, const std::string& title, const LineMap& line_map,
             const MapRecord& record, const nlohmann::ordered_json& summary);

/// A service's answer: success and the folder, or why it failed.
void answer(std_srvs::Trigger::Response& response, const std::string& folder,
            const std::function<void()>& save);

/// At the end of a node: a failure is told, and nothing more.
void saveOrTell(const std::function<void()>& save);

}  // namespace cca
