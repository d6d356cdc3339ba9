// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <memory>

#include "arguments.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/navigation/world/exploration_grid.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/session/exploration_session.hpp"
#include "mapping.hpp"
#include "module.hpp"
#include "owned_array.hpp"
#include "parameters.hpp"
#include "unpickled.hpp"

namespace cca::python {
namespace {

using SharedGrid = Locked<ExplorationGrid>;
using Pair = std::pair<double, double>;

/// What step() needs besides the explorer itself: time never falls.
struct Exploration {
  ExplorationSession session;
  MissingReturns missing_returns;  ///< of its laser
  double time = -HUGE_VAL;
};
using SharedExplorer = Locked<Exploration>;

constexpr double kMostCells = 1 << 28;

/// Rows of cells from the lowest y on; one byte a cell.
struct States {
  std::unique_ptr<std::uint8_t[]> cells;
  std::size_t rows = 0, columns = 0;
};

States statesOf(const ExplorationGrid& grid) {
  const Cell low = grid.lowest(), high = grid.highest();
  States states;
  if (high.x < low.x || high.y < low.y) return states;
  states.columns = static_cast<std::size_t>(high.x - low.x) + 1;
  states.rows = static_cast<std::size_t>(high.y - low.y) + 1;
  if (static_cast<double>(states.rows) * static_cast<double>(states.columns) > kMostCells)
    return states;
  states.cells = std::make_unique<std::uint8_t[]>(states.rows * states.columns);
  std::uint8_t* to = states.cells.get();
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) *to++ = static_cast<std::uint8_t>(grid.at({x, y}));
  }
  return states;
}

nb::object statesArray(SharedGrid& grid) {
  States states = grid.with([](ExplorationGrid& own) { return statesOf(own); });
  if (!states.cells && states.rows > 0) {
    throw nb::value_error(("grid: " + std::to_string(states.columns) + " x " +
                           std::to_string(states.rows) + " cells are too many for one array")
                              .c_str());
  }
  if (!states.cells) states.cells = std::make_unique<std::uint8_t[]>(1);
  return ownedArray(std::move(states.cells), states.rows, states.columns);
}

nb::object statesAround(SharedGrid& grid, nb::handle place, int cells) {
  double at[2];
  readNumbers(place, "place", "(x, y)", 2, at);
  if (cells < 1 || cells > 10000) throw nb::value_error("cells: must be in [1, 10000]");
  auto states = std::make_unique<std::uint8_t[]>(static_cast<std::size_t>(cells) * cells);
  const bool fits = grid.with([&](ExplorationGrid& own) {
    if (!own.covers({at[0], at[1]})) return false;
    const Cell centre = own.cellOf({at[0], at[1]});
    std::uint8_t* to = states.get();
    const int low = -(cells / 2), high = low + cells;
    for (int y = low; y < high; ++y) {
      for (int x = low; x < high; ++x) {
        *to++ = static_cast<std::uint8_t>(own.at({centre.x + x, centre.y + y}));
      }
    }
    return true;
  });
  if (!fits) throw nb::value_error("place: further from the origin than the grid can hold");
  return ownedArray(std::move(states), static_cast<std::size_t>(cells),
                    static_cast<std::size_t>(cells));
}

std::size_t revealed(SharedGrid& grid) {
  return grid.with([](ExplorationGrid& own) { return own.revealed(); });
}

double resolution(SharedGrid& grid) {
  return grid.with([](ExplorationGrid& own) { return own.resolution(); });
}

Pair origin(SharedGrid& grid) {
  return grid.with([](ExplorationGrid& own) {
    return Pair{own.lowest().x * own.resolution(), own.lowest().y * own.resolution()};
  });
}

void insertIntoGrid(SharedGrid& grid, nb::handle ranges, double angle_min, double angle_increment,
                    nb::handle pose, double free_range_without_return) {
  Scan scan;
  readScan(ranges, angle_min, angle_increment, scan);
  readPlace(pose, free_range_without_return, scan);
  const bool fits = grid.with([&scan](ExplorationGrid& own) {
    own.insert(scan);
    return own.covers(scan.T_map_sensor.position());
  });
  if (!fits) throw nb::value_error("pose: further from the origin than the grid can hold");
}

void addGrid(nb::module_& module) {
  nb::enum_<CellState>(module, "CellState", nb::is_arithmetic(), "What is known of a cell.")
      .value("UNKNOWN", CellState::kUnknown)
      .value("PRESUMED_FREE", CellState::kPresumedFree, "between two beams that both went on")
      .value("PRESUMED_WALL", CellState::kPresumedWall,
             "between two returns of one surface, or in line with returns on both sides")
      .value("FREE", CellState::kFree)
      .value("OCCUPIED", CellState::kOccupied);
  const auto copyOf = [](SharedGrid& grid) {
    return new SharedGrid(grid.with([](ExplorationGrid& own) { return own; }));
  };
  nb::class_<SharedGrid> grid_type(module, "ExplorationGrid",
                                   "What is known of each place; grows by itself.");
  refusePickle(
      grid_type,
      "an ExplorationGrid cannot be pickled: it holds the evidence of each cell; copy it, or "
      "pickle its states() and origin");
  grid_type
      .def(
          "__init__",
          [](SharedGrid* self, double cell_side) {
            if (!(cell_side >= 0.005 && cell_side <= 1.0))
              throw nb::value_error("resolution: must be in [0.005, 1] m");
            new (self) SharedGrid(ExplorationGrid(cell_side));
          },
          nb::arg("resolution") = 0.05)
      .def("insert", &insertIntoGrid, nb::arg("ranges").none(), nb::arg("angle_min"),
           nb::arg("angle_increment"), nb::arg("pose").none(),
           nb::arg("free_range_without_return") = 0.0,
           nb::sig("def insert(self, ranges: numpy.typing.ArrayLike, angle_min: float, "
                   "angle_increment: float, pose: collections.abc.Sequence[float], "
                   "free_range_without_return: float = 0.0) -> None"),
           "Take a scan; arguments as in `LineMap.insert`.")
      .def("states", &statesArray, nb::sig("def states(self) -> numpy.typing.NDArray[numpy.uint8]"),
           "(rows, columns) uint8 of `CellState`, from the lowest known x and y on: [0, 0] is the "
           "cell whose\nlower left corner is `origin`.")
      .def(
          "states_around", &statesAround, nb::arg("place"), nb::arg("cells"),
          nb::sig("def states_around(self, place: collections.abc.Sequence[float], cells: int) "
                  "-> numpy.typing.NDArray[numpy.uint8]"),
          "(cells, cells) uint8 of `CellState` about (x, y): its cell is [cells // 2, cells // 2].")
      .def_prop_ro("origin", &origin, "(x, y) m, map frame, of the lower left corner of [0, 0].")
      .def_prop_ro("resolution", &resolution, "m, side of a cell.")
      .def_prop_ro("revealed", &revealed, "Number of cells that have ever been seen.")
      .def("__repr__",
           [](SharedGrid& grid) {
             const nb::str text = nb::str("ExplorationGrid({} cells of {:g} m seen)")
                                      .format(revealed(grid), resolution(grid));
             return std::string(text.c_str());
           })
      .def("__copy__", copyOf)
      .def(
          "__deepcopy__", [copyOf](SharedGrid& grid, nb::handle) { return copyOf(grid); },
          nb::arg("memo"), nb::sig("def __deepcopy__(self, memo: object) -> ExplorationGrid"));
}

void addAction(nb::module_& module) {
  nb::class_<Action>(module, "Action", "What the robot shall do next.")
      .def_prop_ro(
          "velocity",
          [](const Action& a) {
            return Pair{a.velocity.linear, a.velocity.angular};
          },
          "(m/s forwards, rad/s counter-clockwise).")
      .def_prop_ro(
          "goal",
          [](const Action& a) {
            return a.goal ? std::optional<Pair>(Pair{a.goal->x(), a.goal->y()}) : std::nullopt;
          },
          "(x, y) m, map frame, or None.")
      .def_prop_ro(
          "status", [](const Action& a) { return nameOf(a.status); },
          "'exploring', 'returning', 'paused' or 'finished'.")
      .def_ro("reason", &Action::reason, "Why it drives there, or why it has finished.")
      .def(
          "__getstate__",
          [](const Action& a) {
            const auto goal =
                a.goal ? std::optional<Pair>(Pair{a.goal->x(), a.goal->y()}) : std::nullopt;
            return nb::make_tuple(Pair{a.velocity.linear, a.velocity.angular}, goal,
                                  static_cast<int>(a.status), a.reason, a.goal_heading);
          },
          nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def(
          "__setstate__",
          [](Action& self, const nb::tuple& state) {
            Action a;
            std::tie(a.velocity.linear, a.velocity.angular) = nb::cast<Pair>(state[0]);
            if (const auto goal = nb::cast<std::optional<Pair>>(state[1]))
              a.goal = {goal->first, goal->second};
            a.status = static_cast<ExplorationStatus>(nb::cast<int>(state[2]));
            a.reason = nb::cast<std::string>(state[3]);
            a.goal_heading = nb::cast<double>(state[4]);
            new (&self) Action(std::move(a));
          },
          nb::arg("state"),
          nb::sig("def __setstate__(self, state: tuple[typing.Any, ...]) -> None"))
      .def("__repr__", [](const Action& a) {
        const nb::str text =
            nb::str("Action({}, {:.3f} m/s, {:.3f} rad/s, {!r})")
                .format(nameOf(a.status), a.velocity.linear, a.velocity.angular, a.reason);
        return std::string(text.c_str());
      });
}

Action explore(SharedExplorer& explorer, nb::handle ranges, double angle_min,
               double angle_increment, nb::handle pose, double time, nb::handle velocity,
               nb::handle sensor_pose, double free_range_without_return) {
  Observation observation;
  readScan(ranges, angle_min, angle_increment, observation.scan);
  readPlace(pose, free_range_without_return, observation.scan);
  observation.T_map_robot = observation.scan.T_map_sensor;
  observation.scan.T_map_sensor =
      observation.T_map_robot * readPoseInRadians(sensor_pose, "sensor_pose");
  double measured[2];
  readNumbers(velocity, "velocity", "(m/s, rad/s)", 2, measured);
  observation.velocity = {measured[0], measured[1]};
  observation.time = time;
  if (!std::isfinite(time)) throw nb::value_error("time: a finite number is needed");
  const auto action = explorer.with([&observation](Exploration& own) -> std::optional<Action> {
    if (observation.time < own.time) return std::nullopt;
    own.time = observation.time;
    own.missing_returns.judge(observation.scan);
    return own.session.decide(
        own.session.sense(measurementOf(observation, std::nullopt), observation.velocity));
  });
  if (!action) throw nb::value_error("time: before that of the last step");
  return *action;
}

void addExplorer(nb::module_& module) {
  static const std::string docs = parameterDocs<CcaParameters, RobotParameters, ExplorerParameters>(
      "Maps and explores: give it what the robot sees, drive as it says.");
  static const std::string signature =
      parameterSignature<CcaParameters, RobotParameters, ExplorerParameters>("__init__(self",
                                                                             "None");
  nb::class_<SharedExplorer> explorer_type(module, "Explorer", docs.c_str());
  refusePickle(explorer_type,
               "an Explorer cannot be pickled: it is in the middle of a drive; pickle the lines() "
               "of its line_map()");
  explorer_type
      .def(
          "__init__",
          [](SharedExplorer* self, nb::kwargs keywords) {
            CcaParameters mapping;
            RobotParameters robot;
            ExplorerParameters parameters;
            readParameters(keywords, mapping, robot, parameters);
            new (self) SharedExplorer(Exploration{
                ExplorationSession(std::make_unique<GivenPoses>(), {mapping, robot, parameters}),
                {}});
          },
          nb::arg("parameters"), nb::sig(signature.c_str()))
      .def("__repr__",
           [](SharedExplorer& explorer) {
             const std::size_t scans = explorer.with(
                 [](Exploration& own) { return own.session.mapping().trajectory().size(); });
             return "Explorer(" + std::to_string(scans) + " scans)";
           })
      .def("step", &explore, nb::arg("ranges").none(), nb::arg("angle_min"),
           nb::arg("angle_increment"), nb::arg("pose").none(), nb::arg("time"),
           nb::arg("velocity").none() = nb::make_tuple(0.0, 0.0),
           nb::arg("sensor_pose").none() = nb::make_tuple(0.0, 0.0, 0.0),
           nb::arg("free_range_without_return") = 0.0,
           nb::sig("def step(self, ranges: numpy.typing.ArrayLike, angle_min: float, "
                   "angle_increment: float, pose: collections.abc.Sequence[float], time: float, "
                   "velocity: collections.abc.Sequence[float] = (0.0, 0.0), "
                   "sensor_pose: collections.abc.Sequence[float] = (0.0, 0.0, 0.0), "
                   "free_range_without_return: float = 0.0) -> Action"),
           R"(Map what the robot sees, and say where to drive.

Args:
    ranges, angle_min, angle_increment, free_range_without_return: as in `LineMap.insert`.
    pose: (x, y, theta) of the robot in the map frame; m, m, rad.
    time: s, never falling.
    velocity: (m/s forwards, rad/s counter-clockwise) as measured.
    sensor_pose: (x, y, theta) of the laser in the robot's frame.

Raises:
    ValueError: naming the argument.)")
      .def(
          "pause",
          [](SharedExplorer& explorer, bool paused) {
            explorer.with([paused](Exploration& own) { own.session.explorer().pause(paused); });
          },
          nb::arg("paused") = true, "While paused it maps, and stands still.")
      .def(
          "return_to_start",
          [](SharedExplorer& explorer) {
            explorer.with([](Exploration& own) { own.session.explorer().returnToStart(); });
          },
          "Give up exploring and drive back to where it began.")
      .def(
          "line_map",
          [](SharedExplorer& explorer) {
            return new SharedLineMap(
                explorer.with([](Exploration& own) { return own.session.mapping().lineMap(); }));
          },
          "A copy of the line map as it stands.")
      .def(
          "grid",
          [](SharedExplorer& explorer) {
            return new SharedGrid(
                explorer.with([](Exploration& own) { return own.session.explorer().grid(); }));
          },
          "A copy of the grid as it stands.");
}

}  // namespace

void addNavigation(nb::module_& module) {
  addGrid(module);
  addAction(module);
  addExplorer(module);
}

}  // namespace cca::python
