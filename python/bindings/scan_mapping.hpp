// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "apps/runs/background_work.hpp"
#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "io/files/memory_file.hpp"
#include "io/logs/measurements.hpp"
#include "live/live_page.hpp"
#include "map_files.hpp"
#include "scan_recorder.hpp"

namespace cca::python {

namespace nb = nanobind;

/// @throws nb::value_error
PoseSource sourceOf(const std::string& name);

/// A session, and what the files of its map need besides. Of a map that is looked at when it has
/// finished, the scans go into it in another thread, which needs no interpreter.
struct Mapping {
  /// @param of_what  is recorded, for people.
  Mapping(PoseSource source, const CcaParameters& parameters, bool at_the_end,
          const std::string& of_what);

  Estimate add(LogRecord record);
  /// Goes on with the map in a folder, before the first scan.
  void resume(const std::string& folder);
  /// Another log begins: its drive may begin anywhere in the place of the first one.
  void beginDrive();
  void finish();
  /// The map of the scans so far, without a last pass: the rest is left.
  void stop();
  /// On all cores, as long as somebody wants the map.
  DoAll doAll() const;
  /// Does the last of the work on a map, which asks no interpreter, and listens to Ctrl-C
  /// meanwhile. Without the interpreter's lock. @throws what Ctrl-C raises: there is no map then.
  void listening(const std::function<void()>& work);
  /// After the session's last pass: all scans are in the map.
  void complete();
  std::string serve(LivePageSettings settings);
  /// Whether a viewer of the page wants no more scans to be taken for now.
  bool isPaused();

  PoseSource pose;
  std::string title;
  SlamLocaliser* slam = nullptr;           ///< of the session
  std::unique_ptr<LivePage> page;          ///< null: none
  std::unique_ptr<ScanRecorder> recorder;  ///< the session's
  std::unique_ptr<MappingSession> session;
  MissingReturns missing_returns;                    ///< of a laser whose records somebody made
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: where its frame lies
  std::size_t beams = 0, unguided = 0;               ///< of all scans; scans without odometry
  std::optional<StoredMemory> earlier;  ///< of earlier drives, that this one goes on with
  std::string resumed;                  ///< the folder that it is from
  bool maps_at_the_end, finished = false, is_paused = false;
  std::unique_ptr<apps::BackgroundWork> background;  ///< the session's; null: all is done at once
};

MappedScans resultOf(const Mapping& mapping);

/// Waits while a viewer wants it. With the interpreter's lock; @throws what Ctrl-C raises.
template <class IsPaused>
void waitForViewers(IsPaused&& is_paused) {
  while (is_paused()) {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    const nb::gil_scoped_release others_may_run;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// @throws nb::value_error
LivePageSettings pageAt(const std::string& address, int port, const std::string& title);

/// Adds what maps whole logs, and joins maps, to the module.
void addLogMapping(nb::module_& module);

}  // namespace cca::python
