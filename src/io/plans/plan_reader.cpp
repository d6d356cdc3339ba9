// SPDX-License-Identifier: BSD-3-Clause
#include "io/plans/plan_reader.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "io/files/memory_file.hpp"
#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"
#include "plan_reader_formats.hpp"

namespace cca {
namespace {

// m: whoever localises in it keeps a grid over all of it, 1.4 GB for so much. Drawings with
// coordinates of a country often have something left at (0, 0).
constexpr double kWidestPlan = 1000.0;

std::string endingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// @param scale  m, of their unit.
std::vector<PlanLine> planLinesOf(const std::vector<MapLine>& lines, double scale = 1.0) {
  std::vector<PlanLine> plan;
  for (const MapLine& line : lines) {
    plan.emplace_back(scale * line.segment.start, scale * line.segment.end);
  }
  return plan;
}

/// Nothing where the file tells none: a plan that is true.
std::vector<LineSigma> sigmasOf(const std::vector<MapLine>& lines, double scale) {
  std::vector<LineSigma> sigmas;
  for (const MapLine& line : lines) {
    const Eigen::Matrix2d& covariance = line.segment.covariance;
    if (!(covariance(0, 0) > 0.0 && covariance(1, 1) > 0.0)) return {};
    sigmas.push_back({scale * std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1))});
  }
  return sigmas;
}

/// What map.slam remembers, mapped anew.
PlanFile readMemoryPlan(const std::string& path) {
  const SlamMemory memory = seenFrom({0.0, 0.0}, loadMemory(path));
  LineMap map;
  for (std::size_t k = 0; k < memory.scans.size(); ++k) {
    Scan scan = memory.scans[k].scan;
    scan.T_map_sensor = memory.graph.pose(static_cast<int>(k));
    map.insert(scan);
  }
  return {"map.slam", planLinesOf(map.lines()), "", {}};
}

PlanFile read(const std::filesystem::path& path, double scale,
              const std::function<PlanFile(const std::string&)>& read_grid) {
  const std::string name = path.string(), ending = endingOf(path);
  const bool is_grid = ending == ".yaml" || ending == ".yml";
  if (scale > 0.0 && (is_grid || ending == ".slam")) {
    throw std::runtime_error(name + ": tells its own metres; a scale is for drawings and .csv");
  }
  if (ending == ".csv") {
    const std::vector<MapLine> lines = readLinesCsv(contentOf(name), name);
    const double unit = scale > 0.0 ? scale : 1.0;
    return {"CSV", planLinesOf(lines, unit), "", sigmasOf(lines, unit)};
  }
  if (ending == ".slam") return readMemoryPlan(name);
  if (ending == ".geojson" || ending == ".json") {
    return readGeoJsonPlan(contentOf(name), name, scale);
  }
  if (ending == ".dxf") return readDxfPlan(contentOf(name), name, scale);
  if (ending == ".svg") return readSvgPlan(contentOf(name), name, scale);
  if (is_grid) return read_grid(name);
  throw std::runtime_error(name +
                           ": is no plan by its name; allowed are a map's folder, .csv, .slam, "
                           ".geojson, .json, .dxf, .svg and .yaml");
}

/// @param lines  one at least.
void checkExtent(const std::vector<PlanLine>& lines, const std::string& path) {
  for (const auto& [a, b] : lines) {
    const double farthest = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    if (!(farthest <= kFarthestPlan)) {
      throw std::runtime_error(path +
                               ": a line ends more than 1e8 m from (0, 0), or at no finite place");
    }
  }
  const Eigen::AlignedBox2d bounds = boundsOf(lines);
  if (bounds.sizes().maxCoeff() <= kWidestPlan) return;
  throw std::runtime_error(
      path + formatted(": its %zu lines lie between (%g, %g) and (%g, %g) m, more than %g m apart: "
                       "it is in other units, or a line of it is astray",
                       lines.size(), bounds.min().x(), bounds.min().y(), bounds.max().x(),
                       bounds.max().y(), kWidestPlan));
}

}  // namespace

std::string inWords(const Counts& counts) {
  std::string words;
  for (const auto& [kind, count] : counts) {
    words += (words.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return words;
}

void addChain(const std::vector<Eigen::Vector2d>& chain, bool closed,
              std::vector<PlanLine>& lines) {
  for (std::size_t k = 1; k < chain.size(); ++k) lines.emplace_back(chain[k - 1], chain[k]);
  if (closed && chain.size() > 2) lines.emplace_back(chain.back(), chain.front());
}

void addArc(const Eigen::Vector2d& centre, double radius, double from, double to,
            std::vector<PlanLine>& lines) {
  constexpr double kOff = 0.01;  // m
  const double most = radius > kOff ? 2.0 * std::acos(1.0 - kOff / radius) : M_PI_2;
  const int steps = std::clamp(static_cast<int>(std::ceil((to - from) / most)), 1, 720);
  std::vector<Eigen::Vector2d> chain;
  for (int k = 0; k <= steps; ++k) {
    const double angle = from + (to - from) * k / steps;
    chain.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  addChain(chain, false, lines);
}

PlanFile readPlan(const std::string& path, double scale,
                  const std::function<PlanFile(const std::string&)>& read_grid) {
  std::filesystem::path file(path);
  if (std::filesystem::is_directory(file)) file /= "lines.csv";
  PlanFile plan = read(file, scale, read_grid);
  if (plan.lines.empty()) {
    const std::string rest = plan.not_understood;
    throw std::runtime_error(path + ": holds no line" + (rest.empty() ? "" : ", but " + rest));
  }
  checkExtent(plan.lines, path);
  return plan;
}

Eigen::AlignedBox2d boundsOf(const std::vector<PlanLine>& lines) {
  Eigen::AlignedBox2d bounds;
  for (const auto& [a, b] : lines) bounds.extend(a).extend(b);
  return bounds;
}

std::string sizeInWords(const std::vector<PlanLine>& lines) {
  const Eigen::Vector2d size = boundsOf(lines).sizes();
  return formatted("%zu lines within %.1f x %.1f m", lines.size(), size.x(), size.y());
}

std::vector<MapLine> mapLinesOf(const std::vector<PlanLine>& plan) {
  std::vector<MapLine> lines;
  for (const auto& [start, end] : plan) {
    MapLine line;
    line.id = lines.size();
    line.segment.start = start;
    line.segment.end = end;
    lines.push_back(line);
  }
  return lines;
}

}  // namespace cca
