// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cca_mrpt/io/icp_localiser.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/motion/robot.hpp"
#include "cca_mrpt/navigation/explorer_parameters.hpp"
#include "cca_mrpt/simulation/laser_models.hpp"
#include "cca_mrpt/simulation/parameters.hpp"

namespace cca {

/// Every parameter of the program, a member a module.
struct Parameters {
  CcaParameters mapping;
  ExplorerParameters exploration;
  RobotParameters robot;
  LaserParameters laser = laserModels().front().laser;
  IcpParameters icp;
  OdometryParameters odometry;
  RunParameters run;
};

/// Calls section(name, parameters of the module) for each: the sections of the .ini file.
template <class Section>
void describeSections(Parameters& p, Section&& section) {
  section("mapping", p.mapping);
  section("exploration", p.exploration);
  section("robot", p.robot);
  section("laser", p.laser);
  section("icp", p.icp);
  section("odometry", p.odometry);
  section("run", p.run);
}

/// One parameter as people write it. Made from the describe() beside each struct; .ini files,
/// command line, --dump-config and ROS parameters all go through a list of these.
struct ParameterField {
  std::string section;
  std::string name;
  std::string allowed;  ///< "in [0.1, 200] m", "one of greedy, ...", "true or false"
  std::string meaning;
  std::function<std::string()> get;
  /// @throws std::runtime_error that tells the value and what is allowed.
  std::function<void(const std::string& text)> set;

  /// "section.name", as the command line has it.
  std::string key() const { return section + "." + name; }
};

/// @return  every parameter, bound to p, which must outlive the list.
std::vector<ParameterField> listParameters(Parameters& p);

/// Sets what an MRPT .ini file names; the rest stays as it is, all of it where the file is empty.
/// @throws std::runtime_error naming file, line or key, value and what is allowed: for a file that
///         cannot be read, a line that is none of an .ini file, an unknown section or key, a key
///         given twice, or a bad value. p is then unchanged.
void loadParameters(const std::string& ini_path, Parameters& p);

/// Some sections' parameters, {section: {name: value}}, numbers and flags as such: for
/// summary.json.
nlohmann::ordered_json parametersJson(const Parameters& p,
                                      const std::vector<std::string>& sections);

/// An .ini text with every key at its present value, its unit, range and meaning as comments;
/// loadParameters() reads it back.
std::string dumpParameters(const Parameters& p);

}  // namespace cca
