// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/raster.hpp"
#include "io/plans/plan_reader.hpp"

namespace cca {

/// Kinds of things, each with how many there were.
using Counts = std::map<std::string, int>;
/// "12 TEXT, 3 HATCH"
std::string inWords(const Counts& counts);

/// Appends the lines from vertex to vertex. @param closed  and back to the first.
void addChain(const std::vector<Eigen::Vector2d>& chain, bool closed, std::vector<PlanLine>& lines);
/// The chords of an arc, which are off by a centimetre at most. @param from, to  rad, to > from.
void addArc(const Eigen::Vector2d& centre, double radius, double from, double to,
            std::vector<PlanLine>& lines);

/// See readPlan(). @param name  of the file, for messages. @param scale  m a unit; 0: as it tells.
PlanFile readGeoJsonPlan(const std::string& text, const std::string& name, double scale);
PlanFile readDxfPlan(const std::string& text, const std::string& name, double scale);
PlanFile readSvgPlan(const std::string& text, const std::string& name, double scale);
PlanFile gridPlan(const OccupancyRaster& raster);

}  // namespace cca
