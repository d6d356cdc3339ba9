// SPDX-License-Identifier: BSD-3-Clause
#include "scan_mapping.hpp"

#include <chrono>
#include <functional>
#include <future>
#include <utility>

#include "apps/logs/session_warnings.hpp"
#include "apps/runs/on_all_cores.hpp"
#include "cca_mrpt/localisation/given_poses.hpp"
#include "cca_mrpt/localisation/wheel_odometry.hpp"
#include "cca_mrpt/session/earlier_drive.hpp"
#include "io/files/stray_places.hpp"
#include "python_log.hpp"

namespace cca::python {
namespace {

constexpr std::chrono::milliseconds kListening{50};  // nobody feels that Ctrl-C waits for it

std::unique_ptr<Localiser> localiserOf(PoseSource source) {
  if (source == PoseSource::kSlam) return std::make_unique<SlamLocaliser>();
  if (source == PoseSource::kOdometry) return std::make_unique<WheelOdometry>();
  return std::make_unique<GivenPoses>();
}

}  // namespace

PoseSource sourceOf(const std::string& name) {
  for (const PoseSource source : {PoseSource::kLog, PoseSource::kOdometry, PoseSource::kSlam}) {
    if (name == nameOf(source)) return source;
  }
  throw nb::value_error(("pose: '" + name + "' is none of auto log odometry slam").c_str());
}

Mapping::Mapping(PoseSource source, const CcaParameters& parameters, bool at_the_end,
                 const std::string& of_what)
    : pose(source),
      title(of_what),
      recorder(std::make_unique<ScanRecorder>(of_what)),
      maps_at_the_end(at_the_end) {
  if (at_the_end) recorder->keepReplay();
  auto localiser = localiserOf(source);
  slam = dynamic_cast<SlamLocaliser*>(localiser.get());
  MappingSession::Settings settings;
  settings.mapping = parameters;
  settings.maps_at_the_end = maps_at_the_end;
  Executor executor = doNow;
  if (at_the_end) {
    background = std::make_unique<apps::BackgroundWork>();
    executor = [others = background.get()](std::function<void()> work) {
      others->add(std::move(work));
    };
  }
  session = std::make_unique<MappingSession>(std::move(localiser), settings, recorder.get(),
                                             std::move(executor));
}

Estimate Mapping::add(LogRecord record) {
  judgeOnce(missing_returns, record);
  beams += record.scan.size();
  unguided += !record.odometry;
  ReplayMoment moment;
  moment.time = record.has_time ? record.time : 0.0;
  const auto tell = [own = recorder.get(), time = moment.time, reference = referencePose(record)] {
    own->add(time, reference);
  };
  if (background) {
    background->add(tell);
  } else {
    tell();
  }
  const Estimate estimate = session->add(measurementOf(std::move(record), pose));
  moment.T_map_robot = estimate.T_map_robot;
  // Of a map that grows in the background, the recorder shows it.
  const bool is_at_rest = !background || slam;
  if (is_at_rest && page && page->isDue())
    page->show({moment, session->scan(), session->lineMap(), {}, {}});
  return estimate;
}

void Mapping::resume(const std::string& folder) {
  earlier = loadMemory(folder);
  resumed = folder;
  rememberDrive(earlier->memory, *slam, *session);
}

void Mapping::beginDrive() {
  if (session->trajectory().empty()) return;
  session->beginDrive();
  if (slam) slam->startAnywhere();
}

void Mapping::finish() {
  session->finish(doAll());
  complete();
  if (page) page->finish(session->lineMap().lines(), "all is mapped");
}

DoAll Mapping::doAll() const {
  return [own = recorder.get()](int count, const std::function<void(int)>& task) {
    apps::doOnAllCores(count, [own, &task](int k) {
      own->goOn();
      task(k);
    });
  };
}

void Mapping::listening(const std::function<void()>& work) {
  std::future<void> done = std::async(std::launch::async, work);
  while (done.wait_for(kListening) != std::future_status::ready) {
    const nb::gil_scoped_acquire turn;
    if (PyErr_CheckSignals() == 0) continue;
    recorder->stop();
    {
      const nb::gil_scoped_release others_may_run;
      done.wait();
    }
    throw nb::python_error();
  }
  done.get();
}

void Mapping::stop() {
  session->mapAsItIs();
  complete();
  finished = false;
  if (page) page->finish(session->lineMap().lines(), "interrupted");
}

void Mapping::complete() {
  if (background) background->wait();
  finished = true;
  if (earlier && slam->slam().isInMemory()) origin = earlier->origin;
}

std::string Mapping::serve(LivePageSettings settings) {
  settings.origin = origin;
  page = openLivePage(settings);
  if (maps_at_the_end) recorder->showOn(page.get());
  return page->url();
}

bool Mapping::isPaused() {
  while (const auto command = page ? page->nextCommand() : std::nullopt) {
    is_paused = command->kind != RunCommand::Kind::kStart;
    page->setPaused(is_paused);
  }
  return is_paused;
}

MappedScans resultOf(const Mapping& mapping) {
  const MappingSession& session = *mapping.session;
  const Slam* slam = mapping.slam ? &mapping.slam->slam() : nullptr;
  MappedScans result;
  MapProducts& products = result.products;
  products = mapProducts(mapping.title, session);
  products.origin = mapping.origin;
  products.grid = mapping.recorder->raster();
  products.replay = mapping.recorder->replay(products.lines, mapping.origin);
  result.is_placed = session.isLocalised();
  auto& summary = products.summary;
  if (!mapping.title.empty()) summary["title"] = mapping.title;
  summary["finished"] = mapping.finished;
  summary["pose"] = nameOf(mapping.pose);
  summary["scans"] = products.trajectory.size();
  summary["beams"] = mapping.beams;
  summary["distance_m"] = drivenLength(products.trajectory);
  summary["agreement"] = session.agreement().overall();
  if (slam) {
    products.graph = slam->graph();
    products.memory = packedMemory({slam->memory(), mapping.origin});
    summary["key_frames"] = products.graph.size();
    summary["loops"] = slam->loopsClosed();
  }
  if (mapping.earlier) {
    summary["resumed"] = mapping.resumed;
    summary["found_in_memory"] = slam->isInMemory();
  }
  result.warnings = apps::sessionWarnings(session, slam, mapping.pose, mapping.unguided,
                                          mapping.resumed, mapping.origin);
  result.shortcoming = apps::shortcomingOf(session, slam);
  return result;
}

LivePageSettings pageAt(const std::string& address, int port, const std::string& title) {
  if (port < 0 || port > 65535) throw nb::value_error("port: must be in [0, 65535]");
  if (address.empty())
    throw nb::value_error("address: is empty, which would be all of this machine's");
  LivePageSettings settings;
  settings.address = address;
  settings.port = port;
  settings.title = title;
  return settings;
}

}  // namespace cca::python
