// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/metric_map.hpp"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/core/initializer.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluation/spatial_index.hpp"
#include "io/files/gzip_archive.hpp"
#include "io/files/gzip_lines.hpp"
#include "io/lines/line_formats.hpp"
#include "io/mrpt/mrpt_objects.hpp"
#include "io/mrpt/mrpt_scan.hpp"

IMPLEMENTS_SERIALIZABLE(CLineMap2D, mrpt::maps::CMetricMap, cca)
MAP_DEFINITION_REGISTER("cca::CLineMap2D,lineMap", cca::CLineMap2D)

// So that archives know the class by its name.
MRPT_INITIALIZER(registerLineMap) { mrpt::rtti::registerClass(CLASS_ID(cca::CLineMap2D)); }

namespace cca {
namespace {

constexpr std::size_t kClassName = 64;  // bytes, that hold the name of the class
constexpr double kHeight = 1.0;         // m, of the 3-D view

/// Reads each described field of an .ini section, where the section has it.
struct FromIni {
  const mrpt::config::CConfigFileBase& source;
  std::string section;

  template <class Number>
  void operator()(const char* name, Number& value, Number low, Number high, const char* unit,
                  const char*) {
    if (!source.keyExists(section, name)) return;
    const double read = source.read_double(section, name, value);
    if (!(read >= low && read <= high)) {
      throw std::runtime_error("[" + section + "] " + name + " = " + std::to_string(read) +
                               ": must be in [" + std::to_string(low) + ", " +
                               std::to_string(high) + "] " + unit);
    }
    value = static_cast<Number>(read);
  }
};

struct ToText {
  std::ostream& out;

  template <class Number>
  void operator()(const char* name, Number& value, Number, Number, const char* unit, const char*) {
    out << name << " = " << value << " " << unit << "\n";
  }
};

struct ToArchive {
  mrpt::serialization::CArchive& out;

  template <class Number>
  void operator()(const char*, Number& value, Number, Number, const char*, const char*) {
    out << value;
  }
};

struct FromArchive {
  mrpt::serialization::CArchive& in;

  template <class Number>
  void operator()(const char* name, Number& value, Number low, Number high, const char*,
                  const char*) {
    in >> value;
    if (value >= low && value <= high) return;
    throw std::runtime_error(std::string("line map: ") + name + " is out of range");
  }
};

void write(mrpt::serialization::CArchive& out, const MapLine& line) {
  const LineSegment& s = line.segment;
  const PointMoments& m = s.moments;
  out << line.id << line.support << s.start.x() << s.start.y() << s.end.x() << s.end.y();
  out << m.weight << m.mean.x() << m.mean.y() << m.scatter(0, 0) << m.scatter(0, 1)
      << m.scatter(1, 0) << m.scatter(1, 1);
  out << s.covariance(0, 0) << s.covariance(0, 1) << s.covariance(1, 1);
}

MapLine readLine(mrpt::serialization::CArchive& in) {
  MapLine line;
  LineSegment& s = line.segment;
  PointMoments& m = s.moments;
  in >> line.id >> line.support >> s.start.x() >> s.start.y() >> s.end.x() >> s.end.y();
  in >> m.weight >> m.mean.x() >> m.mean.y() >> m.scatter(0, 0) >> m.scatter(0, 1) >>
      m.scatter(1, 0) >> m.scatter(1, 1);
  in >> s.covariance(0, 0) >> s.covariance(0, 1) >> s.covariance(1, 1);
  s.covariance(1, 0) = s.covariance(0, 1);
  const bool sound = s.start.allFinite() && s.end.allFinite() && m.mean.allFinite() &&
                     m.scatter.allFinite() && s.covariance.allFinite() && std::isfinite(m.weight) &&
                     std::isfinite(line.support);
  if (!sound) throw std::runtime_error("line map: a line that is not finite");
  return line;
}

Pose2 planar(const mrpt::poses::CPose3D& pose) {
  return {pose.x(), pose.y(), wrapAngle(pose.yaw())};
}

std::optional<Scan> placed(const mrpt::obs::CObservation& observation,
                           const mrpt::poses::CPose3D& robot_pose) {
  const auto* laser = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation);
  if (!laser) return std::nullopt;
  auto mounted = fromMrpt(*laser);
  if (!mounted) return std::nullopt;
  mounted->scan.T_map_sensor = planar(robot_pose) * mounted->T_robot_sensor;
  return std::move(mounted->scan);
}

}  // namespace

CLineMap2D::TMapDefinition::TMapDefinition() = default;

void CLineMap2D::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& prefix) {
  file = source.read_string(prefix + "_creationOpts", "file", file);
  describe(insertion, FromIni{source, prefix + "_insertOpts"});
  describe(likelihood, FromIni{source, prefix + "_likelihoodOpts"});
}

void CLineMap2D::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
  CcaParameters insertion_copy = insertion;
  LineLikelihoodParameters likelihood_copy = likelihood;
  out << "file = " << file << "\n";
  describe(insertion_copy, ToText{out});
  describe(likelihood_copy, ToText{out});
}

mrpt::maps::CMetricMap* CLineMap2D::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& definition) {
  const auto& own = dynamic_cast<const CLineMap2D::TMapDefinition&>(definition);
  auto lines = own.file.empty() ? std::vector<MapLine>{} : readLineMap(own.file);
  auto map = std::make_unique<CLineMap2D>(own.insertion, std::move(lines));
  map->likelihood_options = own.likelihood;
  return map.release();
}

uint8_t CLineMap2D::serializeGetVersion() const { return 1; }

void CLineMap2D::serializeTo(mrpt::serialization::CArchive& out) const {
  CcaParameters insertion_copy = insertion_;
  LineLikelihoodParameters likelihood_copy = likelihood_options;
  describe(insertion_copy, ToArchive{out});
  describe(likelihood_copy, ToArchive{out});
  const std::vector<MapLine> all = lines();
  out << static_cast<std::uint32_t>(all.size());
  for (const MapLine& line : all) write(out, line);
}

void CLineMap2D::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  internal_clear();
  describe(insertion_, FromArchive{in});
  describe(likelihood_options, FromArchive{in});
  map_ = LineMap(insertion_);
  std::uint32_t count = 0;
  in >> count;
  for (std::uint32_t k = 0; k < count; ++k) read_lines_.push_back(readLine(in));
}

std::vector<MapLine> CLineMap2D::lines() const {
  std::vector<MapLine> all = read_lines_;
  const std::uint64_t first_id = all.empty() ? 0 : all.back().id;
  for (MapLine line : map_.lines()) {
    line.id += first_id;
    all.push_back(line);
  }
  return all;
}

bool CLineMap2D::isEmpty() const { return lines().empty(); }

std::string CLineMap2D::asString() const {
  return "Line map, " + std::to_string(lines().size()) + " lines";
}

void CLineMap2D::saveMetricMapRepresentationToFile(const std::string& prefix) const {
  const std::vector<MapLine> all = lines();
  const std::vector<PolyLine> poly_lines =
      read_lines_.empty() ? map_.polyLines() : std::vector<PolyLine>{};
  writeFile(prefix + "_lines.csv", linesCsv(all));
  writeFile(prefix + "_lines.geojson", linesGeoJson(all, poly_lines));
  writeFile(prefix + "_lines.svg", linesSvg(all, poly_lines, {}));
}

void CLineMap2D::getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const {
  if (!genericMapParams.enableSaveAs3DObject) return;
  auto walls = mrpt::opengl::CSetOfLines::Create();
  walls->setName("lines");
  walls->setColor_u8(mrpt::img::TColor(20, 60, 120));
  walls->setLineWidth(2.0F);
  for (const MapLine& line : lines()) {
    const auto &a = line.segment.start, &b = line.segment.end;
    walls->appendLine(a.x(), a.y(), 0.0, b.x(), b.y(), 0.0);
    walls->appendLine(a.x(), a.y(), kHeight, b.x(), b.y(), kHeight);
    walls->appendLine(a.x(), a.y(), 0.0, a.x(), a.y(), kHeight);
    walls->appendLine(b.x(), b.y(), 0.0, b.x(), b.y(), kHeight);
  }
  objects.insert(walls);
}

const SegmentIndex& CLineMap2D::nearest() const {
  if (!nearest_) {
    std::vector<Segment2> segments;
    for (const MapLine& line : lines()) segments.push_back({line.segment.start, line.segment.end});
    nearest_ = std::make_shared<const SegmentIndex>(segments);
  }
  return *nearest_;
}

float CLineMap2D::squareDistanceToClosestCorrespondence(float x, float y) const {
  const double infinite = std::numeric_limits<double>::infinity();
  const double distance = nearest().nearest({x, y}, infinite).distance;
  return static_cast<float>(distance * distance);
}

void CLineMap2D::internal_clear() {
  read_lines_.clear();
  map_ = LineMap(insertion_);
  nearest_.reset();
}

bool CLineMap2D::internal_insertObservation(
    const mrpt::obs::CObservation& observation,
    const std::optional<const mrpt::poses::CPose3D>& robot_pose) {
  const auto scan = placed(observation, robot_pose.value_or(mrpt::poses::CPose3D()));
  if (!scan || !map_.insert(*scan)) return false;
  nearest_.reset();
  return true;
}

bool CLineMap2D::internal_canComputeObservationLikelihood(
    const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation) != nullptr;
}

double CLineMap2D::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& observation, const mrpt::poses::CPose3D& taken_from) const {
  const auto scan = placed(observation, taken_from);
  if (!scan) return 0.0;
  const LineLikelihoodParameters& p = likelihood_options;
  const auto step = static_cast<std::size_t>(p.decimation);
  double sum_sq = 0.0;
  for (std::size_t beam = 0; beam < scan->size(); beam += step) {
    if (!isReturn(scan->ranges[beam])) continue;
    const double range = scan->ranges[beam], bearing = scan->bearing(beam);
    const Eigen::Vector2d p_sensor(range * std::cos(bearing), range * std::sin(bearing));
    const double distance =
        nearest().nearest(scan->T_map_sensor * p_sensor, p.max_distance).distance;
    sum_sq += distance * distance;
  }
  return -0.5 * sum_sq / (p.sigma * p.sigma);
}

void writeLineMap(const std::string& path, const std::vector<MapLine>& lines) {
  GzipArchive file(path);
  file.write(CLineMap2D({}, lines));
  file.commit();
}

std::vector<MapLine> readLineMap(const std::string& path) {
  MrptObjects objects(path);
  const bool is_one = mrptClassName(fileHead(path, kClassName)) == "cca::CLineMap2D";
  const auto map = is_one ? std::dynamic_pointer_cast<CLineMap2D>(objects.next()) : nullptr;
  if (map) return map->lines();
  throw std::runtime_error(path + ": no line map of MRPT's" +
                           (objects.fault().empty() ? "" : ": " + objects.fault()));
}

}  // namespace cca
