// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"

namespace cca {

class MotionCompensation;

/// A scan as it has gone into the map.
struct MappedScan {
  std::size_t number;  ///< among the scans of its drive, as they came, from 0
  std::size_t sensor;  ///< which laser; 0 is the one that the robot is localised by
  bool is_of_earlier_drive;
  Pose2 T_map_robot;
  const Scan& scan;  ///< at its T_map_sensor
};

/// Keeps what else is made of the scans of a map: a grid, a picture, a replay.
class MapRecorder {
 public:
  virtual ~MapRecorder() = default;
  /// The map begins anew: all that was recorded of it is void.
  virtual void restart() = 0;
  /// A scan has gone into the map.
  virtual void record(const MappedScan& mapped, const LineMap& map) = 0;
};

/// Does a piece of work, now or later, but each after those that were given before.
using Executor = std::function<void(std::function<void()> work)>;
void doNow(std::function<void()> work);

/// The one pipeline from scans to a line map, whoever brings the scans: a scan is brought to one
/// instant, localised, kept, and mapped; where the past is corrected, the map is made anew of the
/// scans kept.
///
/// How each laser sweeps is learned from its scans (see MotionCompensation). Once it is known, the
/// scans before, at most kMostRepeated, are gone through once more from the first on: a map does
/// not depend on when that was. The motion during a sweep is the odometry's, else what the last two
/// estimates tell.
///
/// Which scans make the map: where the localiser corrects the past, those that PastScans keeps, one
/// every 10 cm or 5 degrees, so that a map can be made anew in time, and so that it depends on
/// the poses alone, not on when they became known. Where poses are final, every scan; those that
/// PastScans keeps assign its evidence at the end, see LineMap::lookBack().
class MappingSession {
 public:
  struct Settings {
    CcaParameters mapping;
    /// Whether nobody looks at the map before finish(). It is the same map then, and is made once.
    bool maps_at_the_end = false;
    /// s, of each laser, as Scan::sweep_duration, with its sign; nothing: is learned.
    std::optional<double> sweep = {};
  };

  static constexpr std::size_t kMostRepeated = 5000;  ///< scans; some minutes of a robot that turns

  /// @param recorder  may be null; must outlive the session.
  /// @param executor  does the mapping. Who hands over one that does it later waits for all of it
  ///                  before looking at lineMap(), agreement() or the recorder.
  MappingSession(std::unique_ptr<Localiser> localiser, const Settings& settings,
                 MapRecorder* recorder = nullptr, Executor executor = doNow);
  ~MappingSession();
  MappingSession(MappingSession&&) noexcept;
  MappingSession& operator=(MappingSession&&) noexcept;

  /// Another drive begins, perhaps with other lasers: how these sweep is learned anew.
  void beginDrive();

  /// Takes the next scan. Cost: does not depend on the size of the map, but where the past is
  /// corrected: that of all scans kept.
  Estimate add(const Measurement& measurement);

  /// Takes a scan of another laser, of about the time of the last scan. It is at its T_map_robot
  /// where that is told, else where odometry and the last estimate put it.
  /// @param sensor  1, 2, ...
  /// @return  its pose; is_known is false where neither tells it: then it is not mapped.
  Estimate addSecondary(const Measurement& measurement, std::size_t sensor);

  /// Takes a scan that an earlier drive has left, before the first scan of this one. Its pose is
  /// unknown until a correction tells it. @param T_map_robot, T_map_sensor  in the frame of that
  /// drive.
  void remember(Scan scan, const Pose2& T_map_robot, const Pose2& T_map_sensor);

  /// The last pass of the localiser, and the map of what it says.
  /// @param do_all  see Localiser::finish().
  void finish(const DoAll& do_all = doInTurn);
  /// The map of the poses as they are believed now, without a last pass.
  void mapAsItIs();

  /// The last scan, of whichever laser, of one instant, at its T_map_sensor where that is known.
  const Scan& scan() const { return analysed_.scan; }
  /// The same with what it shows.
  const AnalysedScan& analysed() const { return analysed_; }
  /// The lines of that scan, sensor frame.
  const std::vector<LineSegment>& scanLines() const { return analysed_.lines; }
  /// s, with its sign: what the last scan of a laser was undistorted by.
  double sweepDuration(std::size_t sensor) const;
  Localiser& localiser() { return *localiser_; }
  const Localiser& localiser() const { return *localiser_; }
  const LineMap& lineMap() const { return line_map_; }
  /// How far the scans of the map agree with the map that the earlier ones made.
  const ScanAgreement& agreement() const { return agreement_; }
  /// The scans kept.
  const PastScans& past() const { return state_.past; }
  /// T_map_robot of each scan of this drive, as believed now, and its time [s].
  const std::vector<Pose2>& trajectory() const { return state_.trajectory; }
  const std::vector<double>& times() const { return state_.times; }
  /// Of each scan of this drive, whether its pose is known.
  const std::vector<bool>& isLocalised() const { return state_.is_localised; }

 private:
  /// All that the scans so far have changed, but the map.
  struct State {
    PastScans past;
    Estimate last;
    std::optional<Pose2> T_map_odom;  ///< of the last scan
    std::vector<Pose2> trajectory;
    std::vector<double> times;
    std::vector<bool> is_localised;
  };
  struct Taken {
    Measurement measurement;
    std::size_t sensor;
  };
  /// The scans from which it is being learned how the lasers sweep.
  struct Lesson {
    State before;  ///< the first of them
    std::unique_ptr<Localiser> localiser;
    std::vector<Taken> taken;
  };

  struct Compensations;  ///< of each laser

  MotionCompensation& compensationOf(std::size_t sensor);
  SweepMotion motionOf(const Measurement& measurement, std::size_t sensor) const;
  /// @return  whether the scans of the lesson have to be gone through once more, this one included.
  bool undistort(const Measurement& measurement, std::size_t sensor);
  void beginLesson();
  bool isLearning() const;
  Estimate repeat();
  Estimate localise(const Measurement& measurement, std::size_t sensor);
  Estimate localiseSecondary(const Measurement& measurement, std::size_t sensor);
  LineMap emptyMap() const;
  void takeCorrection();
  void rebuild();
  void analyseUndistorted(const Measurement& measurement, std::size_t sensor);
  void analyseScan(Scan scan);
  void insert(AnalysedScan analysed, const Pose2& T_map_robot, std::size_t sensor);
  void insertNow(const MappedScan& mapped, const std::vector<LineSegment>& lines);

  std::unique_ptr<Localiser> localiser_;
  Settings settings_;
  MapRecorder* recorder_;
  Executor execute_;
  State state_;
  AnalysedScan analysed_;  ///< the last one
  std::unique_ptr<Compensations> compensations_;
  std::optional<Lesson> lesson_;
  bool lesson_is_due_ = true;
  // Changed by the executor alone.
  LineMap line_map_;
  ScanAgreement agreement_;
};

}  // namespace cca
