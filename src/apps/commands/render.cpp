// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/logs/log_warnings.hpp"
#include "apps/options/parameter_options.hpp"
#include "apps/options/within.hpp"
#include "apps/runs/interruption.hpp"
#include "apps/runs/progress.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text.hpp"
#include "io/lines/line_formats.hpp"
#include "io/maps/map_picture.hpp"
#include "io/maps/map_scene.hpp"
#include "io/maps/occupancy_files.hpp"
#include "io/plans/plan_files.hpp"
#include "io/poses/local_frame.hpp"
#include "io/replay/replay.hpp"
#include "io/replay/video.hpp"

namespace cca::apps {
namespace {

constexpr double kSmallestView = 0.01;  // m
constexpr const char* kReplay = "replay.html";

struct RenderOptions {
  std::string map, log, out, beside;
  std::vector<double> view;  ///< x0, y0, x1, y1 [m]
  PictureOptions picture;
  int size = 0;  ///< pixels; 0: by kind
  bool no_background = false, no_trajectory = false, no_caption = false, video = false,
       solid = false, html = false, force = false;
  double seconds = 10.0;
};

/// Puts a log's scans and poses below the map.
void addLog(const std::string& path, MapProducts& products) {
  const auto log = openUndistortedLog(path);
  ScanRaster grid(wholeView(products).center());
  while (auto record = log->next()) {
    record->scan.T_map_sensor = seenFrom(products.origin, record->scan.T_map_sensor);
    grid.insert(record->scan);
    products.trajectory.push_back(record->scan.T_map_sensor * record->T_robot_sensor.inverse());
  }
  products.grid = grid.raster();
  tellWarnings(path, log->warnings());
}

/// What lies beside a map of our own: its poly-lines, and without a log its trajectory.
void addChains(const std::string& map, bool with_log, MapProducts& products) {
  const auto folder = std::filesystem::path(map).parent_path();
  const std::string chains = (folder / "lines.geojson").string();
  if (std::filesystem::path(map).filename() != "lines.csv" || !std::filesystem::exists(chains))
    return;
  auto [poly_lines, trajectory] = readLinesGeoJson(contentOf(chains), chains);
  products.poly_lines = std::move(poly_lines);
  if (!with_log) products.trajectory = std::move(trajectory);
}

/// The same for its grid.
void addGrid(const std::string& map, MapProducts& products) {
  const auto yaml = std::filesystem::path(map).parent_path() / "map.yaml";
  if (std::filesystem::exists(yaml)) {
    products.grid = readOccupancyMap(yaml.string());
    products.grid->origin -= products.origin;
  }
}

/// The frame of the lines' median, for what is drawn far from (0, 0).
Eigen::Vector2d frameOf(const std::vector<MapLine>& lines) {
  std::vector<Eigen::Vector2d> places;
  for (const MapLine& line : lines) places.push_back(line.segment.start);
  return localOrigin(medianPlace(places));
}

void renderPicture(RenderOptions options) {
  MapProducts products;
  products.title = std::filesystem::path(options.map).string();
  products.lines = readLinesCsv(contentOf(options.map), options.map);
  addChains(options.map, !options.log.empty(), products);
  products = seenFrom(frameOf(products.lines), std::move(products));
  if (options.picture.view) options.picture.view->translate(-products.origin);
  if (options.log.empty()) addGrid(options.map, products);
  // Lines and grid are in the picture's frame by now.
  if (options.picture.background && products.grid)
    options.picture.rooms = planOfMap(products.lines, *products.grid).rooms;
  if (!options.log.empty()) addLog(options.log, products);
  if (options.solid) {
    if (options.no_trajectory) products.trajectory.clear();
    writeSolidPicture(options.out, products, options.picture.longest_side, options.picture.view);
  } else {
    writePicture(options.out, products, options.picture);
  }
}

std::size_t countScans(const std::string& path) {
  const auto log = openUndistortedLog(path);
  std::size_t scans = 0;
  while (log->next()) ++scans;
  return scans;
}

/// Maps the log again, and draws it as it grows. The view is that of the finished map.
void renderVideo(const RenderOptions& options, const Parameters& parameters) {
  const auto frames = static_cast<std::size_t>(std::lround(options.seconds * kFramesPerSecond));
  const std::size_t scans = countScans(options.log);
  Video video(options.out);
  PictureOptions picture = options.picture;
  const Interruption interruption;
  Progress progress("render");
  for (const bool drawing : {false, true}) {
    LocalLog log(openUndistortedLog(options.log));
    if (!drawing && picture.view) picture.view->translate(-log.origin());
    LineMap map(parameters.mapping);
    ScanRaster grid(log.start());
    MapProducts products;
    products.title = std::filesystem::path(options.log).filename().string();
    std::size_t scan = 0, frame = 0;
    while (const auto record = log.next()) {
      map.insert(record->scan);
      grid.insert(record->scan);
      products.trajectory.push_back(record->scan.T_map_sensor * record->T_robot_sensor.inverse());
      ++scan;
      if (interruption.requested()) throw std::runtime_error("interrupted; no video was written");
      if (!drawing || scan * frames < (frame + 1) * scans) continue;
      products.lines = map.lines();
      products.poly_lines = map.polyLines();
      products.grid = grid.raster();
      writePicture(video.nextFrame(), products, picture);
      frame = scan * frames / scans;
      progress.show(log.progress(), std::to_string(frame) + " frames");
    }
    products.lines = map.lines();
    if (!drawing && !picture.view) picture.view = wholeView(products);
  }
  video.encode();
}

/// The run that a folder, or a page, holds.
std::string runOf(const std::string& path) {
  const std::string page =
      std::filesystem::is_directory(path) ? (std::filesystem::path(path) / kReplay).string() : path;
  return runsOfReplayPage(contentOf(page), page).front();
}

void renderPage(const RenderOptions& options) {
  std::vector<std::string> runs{runOf(options.map)};
  if (!options.beside.empty()) runs.push_back(runOf(options.beside));
  writeFile(options.out, replayPage(runs));
}

void render(RenderOptions options, const Parameters& parameters) {
  if (!options.out.empty()) requireNew(options.out, options.force);
  requireApart(options.out, {options.map, options.log});
  options.picture.longest_side = options.size > 0 ? options.size : options.video ? 800 : 1600;
  if (options.solid && options.picture.longest_side > kLargestSolidPicture) {
    throw CLI::ValidationError("--size", "a picture in 3-D has at most " +
                                             std::to_string(kLargestSolidPicture) + " pixels");
  }
  options.picture.background = !options.no_background;
  options.picture.trajectory = !options.no_trajectory;
  options.picture.caption = !options.no_caption;
  if (!options.view.empty()) {
    const auto& v = options.view;
    if (v[2] - v[0] < kSmallestView || v[3] - v[1] < kSmallestView)
      throw CLI::ValidationError("--view", "X0,Y0 must lie below X1,Y1, by a centimetre at least");
    options.picture.view =
        Eigen::AlignedBox2d(Eigen::Vector2d(v[0], v[1]), Eigen::Vector2d(v[2], v[3]));
  }
  if (options.video) {
    if (options.out.empty()) throw CLI::RequiredError("--out");
    if (options.log.empty()) throw CLI::RequiredError("--log (what --video is made from)");
    renderVideo(options, parameters);
  } else if (options.html) {
    if (options.map.empty()) throw CLI::RequiredError("DIR (that map or explore has written)");
    if (options.out.empty() && std::filesystem::is_directory(options.map) &&
        options.beside.empty()) {
      options.out = (std::filesystem::path(options.map) / kReplay).string();
    }
    if (std::filesystem::path(options.out).extension() != ".html") {
      throw CLI::ValidationError("--out", "a page that ends in .html is needed");
    }
    renderPage(options);
  } else {
    if (options.map.empty()) throw CLI::RequiredError("MAP.csv");
    if (options.out.empty()) throw CLI::RequiredError("--out");
    if (std::filesystem::path(options.out).extension() != ".png") {
      throw CLI::ValidationError("--out", options.out + " must end in .png");
    }
    renderPicture(options);
  }
}

}  // namespace

void addRenderCommand(CLI::App& program) {
  auto* command = program.add_subcommand("render", "picture of a line map, or video of its making");
  auto options = std::make_shared<RenderOptions>();
  auto* map = command->add_option(
      "MAP", options->map,
      "lines.csv of a map, or any CSV with x1,y1,x2,y2; with --html a map's folder");
  command->add_option("--log", options->log, "scans and poses to draw below the map");
  command->add_option("--out", options->out,
                      "PNG to write; with --video a .gif or .mp4; with --html a page "
                      "[the folder's replay.html]");
  command->add_flag("--force", options->force, "overwrite what --out names");
  command->add_option("--size", options->size, "pixels of the longer side [1600; video 800]")
      ->check(CLI::Range(kSmallestPicture, kLargestPicture));
  command->add_option("--view", options->view, "X0,Y0,X1,Y1: what to show, m; default: all")
      ->delimiter(',')
      ->expected(4)
      ->check(within(-2e7, 2e7));
  command->add_flag("--no-background", options->no_background, "lines alone");
  command->add_flag("--no-trajectory", options->no_trajectory, "without the robot's way");
  command->add_flag("--no-caption", options->no_caption, "without title and numbers");
  auto* solid =
      command->add_flag("--3d", options->solid, "walls raised, seen from above and aside");
  auto* video = command->add_flag("--video", options->video,
                                  "the map of --log as it is built (needs ffmpeg)");
  video->excludes(map)->excludes(solid);
  auto* html = command->add_flag("--html", options->html,
                                 "a page to replay the run in, from its folder's replay.html");
  html->excludes(video)->excludes(solid);
  command->add_option("--beside", options->beside, "folder of a second run, to be seen beside it")
      ->needs(html);
  command->add_option("--seconds", options->seconds, "length of the video")
      ->check(within(0.5, 600.0))
      ->needs(video)
      ->capture_default_str();
  auto parameters =
      std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  command->callback([options, parameters] { render(*options, parameters->resolve()); });
}

}  // namespace cca::apps
