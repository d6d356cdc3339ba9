// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "arguments.hpp"
#include "locked.hpp"
#include "module.hpp"
#include "owned_array.hpp"
#include "unpickled.hpp"

namespace cca::python {
namespace {

using SharedSlam = Locked<Slam>;

nb::object array(const double* numbers, std::size_t rows) {
  auto copy = std::make_unique<double[]>(3 * rows + 1);
  std::copy_n(numbers, 3 * rows, copy.get());
  return ownedArray(std::move(copy), rows, 3);
}

SlamPose localise(SharedSlam& slam, nb::handle ranges, double angle_min, double angle_increment,
                  nb::handle odometry, nb::handle sensor_pose, double free_range_without_return) {
  Scan scan;
  readScan(ranges, angle_min, angle_increment, scan);
  const Pose2 T_robot_sensor = readPoseInRadians(sensor_pose, "sensor_pose");
  readPlace(nb::make_tuple(0.0, 0.0, 0.0), free_range_without_return, scan);
  std::optional<Pose2> T_odom_robot;
  if (!odometry.is_none()) T_odom_robot = readPose(odometry, "odometry");
  return slam.with([&](Slam& own) { return own.step(scan, T_robot_sensor, T_odom_robot); });
}

nb::object trajectory(SharedSlam& slam) {
  const std::vector<Pose2> poses = slam.with([](Slam& own) { return own.trajectory(); });
  std::vector<double> numbers;
  for (const Pose2& pose : poses) numbers.insert(numbers.end(), {pose.x, pose.y, pose.theta});
  return array(numbers.data(), poses.size());
}

}  // namespace

void addSlam(nb::module_& module) {
  nb::class_<SlamPose>(module, "SlamPose", "Where the robot is, as `Slam.step` believes.")
      .def_prop_ro(
          "pose",
          [](const SlamPose& p) {
            return nb::make_tuple(p.T_map_robot.x, p.T_map_robot.y, p.T_map_robot.theta);
          },
          nb::sig("def pose(self) -> tuple[float, float, float]"),
          "(x, y, theta) of the robot in the map frame; m, m, rad.")
      .def_prop_ro(
          "covariance", [](const SlamPose& p) { return array(p.covariance.data(), 3); },
          nb::sig("def covariance(self) -> numpy.typing.NDArray[numpy.float64]"),
          "(3, 3) of (x, y, theta) in the map's axes, of the last match.")
      .def_ro("agreement", &SlamPose::agreement, "Of the scan with what was seen before, [0, 1].")
      .def_ro("version", &SlamPose::version, "Counts corrections of the past by more than 5 cm.")
      .def_ro("is_lost", &SlamPose::is_lost,
              "Whether the scan contradicts what was seen before: nobody knows where it was taken.")
      .def(
          "__getstate__",
          [](const SlamPose& p) {
            return nb::make_tuple(
                nb::make_tuple(p.T_map_robot.x, p.T_map_robot.y, p.T_map_robot.theta),
                array(p.covariance.data(), 3), p.agreement, p.version, p.is_lost);
          },
          nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def(
          "__setstate__",
          [](SlamPose& self, const nb::tuple& state) {
            SlamPose p;
            p.T_map_robot = readPose(state[0], "pose");
            readNumbers(nb::object(state[1]).attr("ravel")(), "covariance", "(3, 3)", 9,
                        p.covariance.data());
            p.agreement = nb::cast<double>(state[2]);
            p.version = nb::cast<int>(state[3]);
            p.is_lost = nb::cast<bool>(state[4]);
            new (&self) SlamPose(p);
          },
          nb::arg("state"),
          nb::sig("def __setstate__(self, state: tuple[typing.Any, ...]) -> None"))
      .def("__repr__", [](const SlamPose& p) {
        const Pose2& at = p.T_map_robot;
        const nb::str text = nb::str("SlamPose(x={:.3f}, y={:.3f}, theta={:.4f}, agreement={:.3f})")
                                 .format(at.x, at.y, at.theta, p.agreement);
        return std::string(text.c_str());
      });
  nb::class_<SharedSlam> slam_type(module, "Slam",
                                   R"(Line SLAM: poses from wheels and laser, with loops.

Args:
    start: (x, y, theta) of the robot in the map frame at the first scan; m, m, rad.

May be used by several threads: their calls wait for each other.)");
  refusePickle(
      slam_type,
      "a Slam cannot be pickled: it is in the middle of a drive; save the Map of a Mapper, "
      "and go on with it by cca_mrpt.map(log, resume=folder)");
  slam_type
      .def(
          "__init__",
          [](SharedSlam* self, nb::handle start) {
            new (self) SharedSlam(Slam(readPose(start, "start")));
          },
          nb::arg("start").none() = nb::make_tuple(0.0, 0.0, 0.0),
          nb::sig("def __init__(self, start: collections.abc.Sequence[float] = (0.0, 0.0, 0.0)) "
                  "-> None"))
      .def("step", &localise, nb::arg("ranges").none(), nb::arg("angle_min"),
           nb::arg("angle_increment"), nb::arg("odometry").none() = nb::none(),
           nb::arg("sensor_pose").none() = nb::make_tuple(0.0, 0.0, 0.0),
           nb::arg("free_range_without_return") = 0.0,
           nb::sig(
               "def step(self, ranges: numpy.typing.ArrayLike, angle_min: float, "
               "angle_increment: float, odometry: collections.abc.Sequence[float] | None = None, "
               "sensor_pose: collections.abc.Sequence[float] = (0.0, 0.0, 0.0), "
               "free_range_without_return: float = 0.0) -> SlamPose"),
           R"(Take a scan, and say where the robot is.

Args:
    ranges, angle_min, angle_increment, free_range_without_return: as in `LineMap.insert`.
    odometry: (x, y, theta) of the robot by its wheels, in any frame that stays; None: it goes on as it
        went.
    sensor_pose: (x, y, theta) of the laser in the robot's frame.

Raises:
    ValueError: naming the argument.)")
      .def(
          "finish", [](SharedSlam& slam) { slam.with([](Slam& own) { own.finish(); }); },
          "The last pass over a whole log: all poses made to agree with all lines.")
      .def("trajectory", &trajectory,
           nb::sig("def trajectory(self) -> numpy.typing.NDArray[numpy.float64]"),
           "(N, 3) poses (x, y, theta) of the robot at each scan so far, as they are known now.")
      .def(
          "start_anywhere",
          [](SharedSlam& slam) { slam.with([](Slam& own) { own.startAnywhere(); }); },
          "From the next scan on the robot may be anywhere: a second log of the same place.")
      .def_prop_ro(
          "is_placed",
          [](SharedSlam& slam) { return slam.with([](Slam& own) { return own.isLocalised(); }); },
          nb::sig("def is_placed(self) -> list[bool]"),
          "Of each scan so far, whether its place in the map is known.")
      .def_prop_ro(
          "loops",
          [](SharedSlam& slam) { return slam.with([](Slam& own) { return own.loopsClosed(); }); },
          "Number of loops that were closed.")
      .def_prop_ro(
          "version",
          [](SharedSlam& slam) { return slam.with([](Slam& own) { return own.version(); }); },
          "Counts corrections of the past by more than 5 cm.")
      .def("__repr__", [](SharedSlam& slam) {
        return slam.with([](Slam& own) {
          return "Slam(" + std::to_string(own.trajectory().size()) + " scans, " +
                 std::to_string(own.loopsClosed()) + " loops)";
        });
      });
}

}  // namespace cca::python
