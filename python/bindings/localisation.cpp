// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/logs/localized_log.hpp"
#include "apps/runs/interruption.hpp"
#include "arguments.hpp"
#include "io/lines/line_formats.hpp"
#include "io/logs/undistorted_log.hpp"
#include "io/plans/plan_reader.hpp"
#include "io/plans/plan_reader_formats.hpp"
#include "module.hpp"
#include "owned_array.hpp"
#include "python_log.hpp"
#include "raster.hpp"

namespace cca::python {
namespace {

using apps::LocalizedLog;
using GridArrays = std::tuple<Cells, double, std::pair<double, double>>;

/// What Python is told of it: ((n, 4) of time, x, y, theta; summary as JSON; files by name;
/// warnings; why it is localised nowhere).
nb::object tupleOf(const LocalizedLog& log, const PlanFile& plan, const std::string& plan_path) {
  const auto& poses = log.poses();
  auto numbers = std::make_unique<double[]>(4 * poses.size() + 1);
  double* to = numbers.get();
  for (const StampedPose& pose : poses) {
    for (const double number :
         {pose.time, pose.T_map_robot.x, pose.T_map_robot.y, pose.T_map_robot.theta}) {
      *to++ = number;
    }
  }
  nlohmann::ordered_json summary;
  log.describe(plan, plan_path, summary);
  nb::dict files;
  const auto put = [&files](const char* name, const std::string& content) {
    files[name] = nb::bytes(content.data(), content.size());
  };
  put("poses.csv", posesCsv(poses));
  put("poses.tum", posesTum(poses));
  return nb::make_tuple(ownedArray(std::move(numbers), poses.size(), 4), summary.dump(), files,
                        log.warnings(), log.shortcoming(plan, plan_path));
}

/// @param records  an iterable that can be gone through twice.
/// @param until_interrupted  Ctrl-C ends the reading instead of raising KeyboardInterrupt.
nb::object localizeRecords(nb::handle records, const std::string& plan_path,
                           const std::optional<GridArrays>& grid, nb::handle start, double scale,
                           bool until_interrupted) {
  std::optional<OccupancyRaster> raster;
  if (grid) raster = rasterOf(std::get<0>(*grid), std::get<1>(*grid), std::get<2>(*grid));
  std::optional<Pose2> T_map_start;
  if (!start.is_none()) T_map_start = readPoseInRadians(start, "start");
  if (T_map_start && T_map_start->position().cwiseAbs().maxCoeff() > kFarthestPlan)
    throw nb::value_error("start: x and y must be in [-1e8, 1e8] m");
  RepeatedLog repeated(records);
  std::optional<LocalizedLog> log;
  PlanFile plan;
  try {
    const nb::gil_scoped_release others_may_run;
    std::optional<apps::Interruption> interruption;
    if (until_interrupted) interruption.emplace();
    plan = readPlan(plan_path, scale, [&raster](const std::string&) { return gridPlan(*raster); });
    log.emplace(plan.lines, plan.sigmas, T_map_start);
    const std::unique_ptr<LogReader> reader =
        undistortedLog([&] { return repeated.open(); }, std::nullopt);
    log->take(*reader, [&] { return !(interruption && interruption->requested()); });
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
  return tupleOf(*log, plan, plan_path);
}

}  // namespace

void addLocalisation(nb::module_& module) {
  module.def(
      "localize_records", &localizeRecords, nb::arg("records"), nb::arg("plan"),
      nb::arg("grid").none(), nb::arg("start").none(), nb::arg("scale"),
      nb::arg("until_interrupted"),
      nb::sig("def localize_records(records: collections.abc.Iterable[LogRecord], plan: str, "
              "grid: tuple[numpy.typing.NDArray[numpy.uint8], float, tuple[float, float]] | None, "
              "start: tuple[float, float, float] | None, scale: float, until_interrupted: bool) -> "
              "tuple[numpy.typing.NDArray[numpy.float64], str, dict[str, bytes], str, str]"),
      "Poses of scans in a plan: see `cca_mrpt.localize`.");
}

}  // namespace cca::python
