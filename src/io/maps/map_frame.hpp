// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/io/map_products.hpp"
#include "io/plans/plan_files.hpp"

namespace cca {

/// Those files of a map's folder that are made of its products alone, and know no MRPT: lines.csv,
/// arcs.csv, lines.geojson, lines.svg, lines.dxf; map.pgm, map.yaml, poses.csv, poses.tum,
/// graph.g2o and map.slam where there is what they hold.
/// @param map  in the map frame, its grid asWritten().
NamedFiles mapTexts(const MapProducts& map);

}  // namespace cca
