// SPDX-License-Identifier: BSD-3-Clause
//
// The module _simulation: built where MRPT is, for worlds are kept in its grids.
#include "cca_mrpt/simulation/simulation.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "arguments.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "cca_mrpt/simulation/world_generator.hpp"
#include "locked.hpp"
#include "owned_array.hpp"
#include "parameters.hpp"

namespace cca::python {
namespace {

using Pair = std::pair<double, double>;
using Pose = std::tuple<double, double, double>;

constexpr double kLongestDrive = 60.0;  // s, of one call

/// A robot in a building, and how much of that it has seen.
struct Drive {
  Drive(World world, const Pose2& T_map_start, const SimulationParameters& parameters)
      : simulation(std::move(world), T_map_start, parameters),
        coverage(simulation.world(), T_map_start.position(), parameters.robot.radius,
                 parameters.laser.range) {}
  Simulation simulation;
  Coverage coverage;  // looks at the simulation's world
};
using SharedDrive = Locked<std::unique_ptr<Drive>>;

World worldOf(nb::handle given, double resolution, int seed) {
  if (nb::isinstance<nb::str>(given)) {
    const std::string name = nb::cast<std::string>(given);
    const auto kinds = buildingKinds();
    if (std::find(kinds.begin(), kinds.end(), name) == kinds.end()) return loadWorld(name);
    return rasterise(generateBuilding(name, static_cast<std::uint64_t>(seed)), resolution);
  }
  const nb::module_ numpy = nb::module_::import_("numpy");
  const auto cells = nb::cast<nb::ndarray<const bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>>(
      numpy.attr("ascontiguousarray")(given, numpy.attr("bool_")));
  const std::size_t rows = cells.shape(0), columns = cells.shape(1);
  if (rows < 3 || columns < 3 || rows > 100000 || columns > 100000)
    throw nb::value_error("world: from 3 x 3 to 100000 x 100000 cells are needed");
  return World("array", static_cast<int>(columns), static_cast<int>(rows),
               std::vector<unsigned char>(cells.data(), cells.data() + rows * columns), resolution,
               Eigen::Vector2d::Zero());
}

void construct(SharedDrive* self, nb::handle world, nb::handle start, int seed, double resolution,
               nb::kwargs keywords) {
  SimulationParameters parameters;
  readParameters(keywords, parameters.laser, parameters.robot, parameters.odometry);
  if (seed < 0) throw nb::value_error("seed: 0 or more is needed");
  if (!(resolution >= 0.005 && resolution <= 1.0))
    throw nb::value_error("resolution: must be in [0.005, 1] m");
  parameters.seed = static_cast<std::uint64_t>(seed);
  try {
    World building = worldOf(world, resolution, seed);
    const Pose2 T_map_start = start.is_none() ? defaultStart(building, parameters.robot.radius)
                                              : readPose(start, "start");
    new (self) SharedDrive(std::make_unique<Drive>(std::move(building), T_map_start, parameters));
  } catch (const std::runtime_error& error) {
    throw nb::value_error((std::string("world: ") + error.what()).c_str());
  }
}

nb::object observe(SharedDrive& drive) {
  auto ranges = drive.with([](std::unique_ptr<Drive>& own) {
    own->coverage.look(own->simulation.T_map_robot());
    return own->simulation.observe().scan.ranges;
  });
  auto numbers = std::make_unique<double[]>(ranges.size() + 1);
  std::copy(ranges.begin(), ranges.end(), numbers.get());
  return ownedArray(std::move(numbers), 1, ranges.size())[nb::int_(0)];
}

void driveOn(SharedDrive& drive, double linear, double angular, double seconds) {
  if (!std::isfinite(linear)) throw nb::value_error("linear: a finite number is needed");
  if (!std::isfinite(angular)) throw nb::value_error("angular: a finite number is needed");
  if (!(seconds >= 0.0 && seconds <= kLongestDrive))
    throw nb::value_error("seconds: must be in [0, 60]");
  drive.with([&](std::unique_ptr<Drive>& own) {
    own->simulation.drive({linear, angular}, seconds);
  });
}

double shareSeen(SharedDrive& drive) {
  return drive.with([](std::unique_ptr<Drive>& own) {
    own->coverage.wait();
    return own->coverage.sofar().value_or(0.0);
  });
}

nb::object obstacles(SharedDrive& drive) {
  std::size_t rows = 0, columns = 0;
  auto cells = drive.with([&](std::unique_ptr<Drive>& own) {
    const World& world = own->simulation.world();
    rows = static_cast<std::size_t>(world.height());
    columns = static_cast<std::size_t>(world.width());
    auto copy = std::make_unique<std::uint8_t[]>(rows * columns + 1);
    std::copy(world.obstacles().begin(), world.obstacles().end(), copy.get());
    return copy;
  });
  return ownedArray(std::move(cells), rows, columns);
}

/// A property of the simulation.
template <class Ask>
auto of(Ask ask) {
  return [ask](SharedDrive& drive) {
    return drive.with([&](std::unique_ptr<Drive>& own) { return ask(own->simulation); });
  };
}

Pose numbersOf(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }

}  // namespace

NB_MODULE(_simulation, module) {
  module.doc() = "The simulator; use the names that the package itself offers.";
  static const std::string docs =
      parameterDocs<LaserParameters, RobotParameters, OdometryParameters>(
          R"(A round differential-drive robot with a laser at its centre, in a building.

Args:
    world: a kind of building, see `building_kinds`, which `seed` varies; or the path of a map_server
        YAML file; or a (rows, columns) array, True where an obstacle is, from the lowest y on.
    start: (x, y, theta) in the map frame; None: where the world says, else the widest place.
    seed: of all that is random: equal seeds and commands give equal scans, bit by bit.
    resolution: m, side of a cell of a drawn building or an array.

Raises:
    ValueError: naming the argument.)");
  static const std::string signature =
      parameterSignature<LaserParameters, RobotParameters, OdometryParameters>(
          "__init__(self, world: str | numpy.typing.ArrayLike, start: "
          "collections.abc.Sequence[float] | None = None, seed: int = 1, resolution: float = 0.05",
          "None");
  nb::class_<SharedDrive>(module, "Simulation", docs.c_str())
      .def("__init__", &construct, nb::arg("world"), nb::arg("start").none() = nb::none(),
           nb::arg("seed") = 1, nb::arg("resolution") = 0.05, nb::arg("parameters"),
           nb::sig(signature.c_str()))
      .def_static("building_kinds", &buildingKinds, "The kinds of building that can be drawn.")
      .def("observe", &observe, nb::sig("def observe(self) -> numpy.typing.NDArray[numpy.float64]"),
           "(beams,) ranges [m] of a new scan, float64; each call draws new noise.")
      .def("drive", &driveOn, nb::arg("linear"), nb::arg("angular"), nb::arg("seconds"),
           "Drive towards a commanded velocity [m/s, rad/s] within the robot's limits. Obstacles "
           "stop it.")
      .def_prop_ro("angle_min", of([](const Simulation& s) {
                     return -0.5 * s.parameters().laser.field_of_view_deg * M_PI / 180.0;
                   }),
                   "rad, bearing of the first beam.")
      .def_prop_ro("angle_increment", of([](const Simulation& s) {
                     const LaserParameters& laser = s.parameters().laser;
                     return laser.field_of_view_deg * M_PI / 180.0 / std::max(1, laser.beams - 1);
                   }),
                   "rad, from beam to beam.")
      .def_prop_ro("free_range_without_return",
                   of([](const Simulation& s) { return s.parameters().laser.range; }),
                   "m, free along a beam without return.")
      .def_prop_ro("limits", of([](const Simulation& s) {
                     return Pair{s.parameters().robot.max_linear_velocity,
                                 s.parameters().robot.max_angular_velocity};
                   }),
                   "(m/s, rad/s) at the most.")
      .def_prop_ro("pose", of([](const Simulation& s) { return numbersOf(s.T_map_robot()); }),
                   "The true (x, y, theta).")
      .def_prop_ro("odometry", of([](const Simulation& s) { return numbersOf(s.T_odom_robot()); }),
                   "(x, y, theta) by the wheels, which drift.")
      .def_prop_ro("velocity", of([](const Simulation& s) {
                     return Pair{s.velocity().linear, s.velocity().angular};
                   }),
                   "(m/s forwards, rad/s counter-clockwise), true.")
      .def_prop_ro("time", of([](const Simulation& s) { return s.time(); }), "s since the start.")
      .def_prop_ro("distance", of([](const Simulation& s) { return s.distance(); }), "m driven.")
      .def_prop_ro("contacts", of([](const Simulation& s) { return s.collisions(); }),
                   "How often the robot has driven into something.")
      .def_prop_ro("share_seen", &shareSeen,
                   "Of all that can be seen from where the robot gets to, what `observe` has seen: "
                   "[0, 1].")
      .def_prop_ro(
          "obstacles", &obstacles,
          nb::for_getter(nb::sig("def obstacles(self) -> numpy.typing.NDArray[numpy.uint8]")),
          "(rows, columns) uint8, 1 where an obstacle is, from `origin` on.")
      .def_prop_ro("origin", of([](const Simulation& s) {
                     return Pair{s.world().origin().x(), s.world().origin().y()};
                   }),
                   "(x, y) m of the lower left corner of `obstacles`.")
      .def_prop_ro("resolution", of([](const Simulation& s) { return s.world().resolution(); }),
                   "m, side of a cell.");
}

}  // namespace cca::python
