// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/TMetricMapInitializer.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/mapping/line_map.hpp"

namespace cca {

class SegmentIndex;

/// How a scan is judged against the lines: each return errs normally from the nearest one, and no
/// return counts for more than max_distance (people, furniture).
struct LineLikelihoodParameters {
  double sigma = 0.1;
  double max_distance = 0.5;
  int decimation = 5;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(LineLikelihoodParameters& p, Field&& field) {
  field("sigma", p.sigma, 0.001, 10.0, "m", "standard deviation of a return about its line");
  field("max_distance", p.max_distance, 0.01, 100.0, "m",
        "a return counts as no farther than this");
  field("decimation", p.decimation, 1, 1000, "beams", "every so many returns are looked at");
}

/// The line map as a metric map of MRPT's, for its programs and for CMultiMetricMap:
/// ```
/// [map]
/// lineMap_count = 1
/// [map_lineMap_00_creationOpts]      ; file: begins with the lines of a map.linemap.gz
/// [map_lineMap_00_insertOpts]        ; similarity_cut, vertex_price, straightness
/// [map_lineMap_00_likelihoodOpts]    ; sigma, max_distance, decimation
/// ```
/// It takes CObservation2DRangeScan. Stored are the lines, not the evidence behind them: what is
/// inserted into a map that was read from a file stands beside the lines that were read.
class CLineMap2D : public mrpt::maps::CMetricMap {
  DEFINE_SERIALIZABLE(CLineMap2D, cca)

 public:
  CLineMap2D() = default;
  explicit CLineMap2D(const CcaParameters& insertion, std::vector<MapLine> lines = {})
      : insertion_(insertion), read_lines_(std::move(lines)), map_(insertion) {}

  LineLikelihoodParameters likelihood_options;

  /// The lines as they stand, those that were read from a file first.
  std::vector<MapLine> lines() const;
  const CcaParameters& insertionOptions() const { return insertion_; }

  bool isEmpty() const override;
  std::string asString() const override;
  /// Writes PREFIX_lines.csv, .geojson and .svg.
  /// @throws std::runtime_error naming the file and the reason.
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;
  /// The lines as walls of 1 m height.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const override;
  /// m^2, from a point to the nearest line; infinite where the map is empty.
  float squareDistanceToClosestCorrespondence(float x, float y) const override;

 private:
  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& observation,
      const std::optional<const mrpt::poses::CPose3D>& robot_pose) override;
  double internal_computeObservationLikelihood(
      const mrpt::obs::CObservation& observation,
      const mrpt::poses::CPose3D& taken_from) const override;
  bool internal_canComputeObservationLikelihood(
      const mrpt::obs::CObservation& observation) const override;
  const SegmentIndex& nearest() const;

  CcaParameters insertion_;
  std::vector<MapLine> read_lines_;
  LineMap map_;
  mutable std::shared_ptr<const SegmentIndex> nearest_;  // made when first asked for, of lines()

  MAP_DEFINITION_START(CLineMap2D)
  std::string file;  ///< empty: none
  CcaParameters insertion;
  LineLikelihoodParameters likelihood;
  MAP_DEFINITION_END(CLineMap2D)
};

/// Writes lines as a CLineMap2D, as MRPT stores its objects (zipped), whole or not at all.
/// @throws std::runtime_error naming the file and the reason.
void writeLineMap(const std::string& path, const std::vector<MapLine>& lines);

/// The lines of such a file. @throws std::runtime_error naming the file and the reason.
std::vector<MapLine> readLineMap(const std::string& path);

}  // namespace cca
