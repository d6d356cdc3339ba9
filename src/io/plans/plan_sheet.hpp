// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/floor_plan/floor_plan.hpp"
#include "cca_mrpt/io/geo_reference.hpp"
#include "io/maps/colour.hpp"

namespace cca {

/// Something on a sheet of paper: areas with holes (even-odd), lines, or a line of text. In
/// millimetres from the upper left corner, y downwards.
struct SheetShape {
  std::vector<Polygon> rings;
  bool is_closed = true;
  Colour fill{0, 0, 0, 0};  ///< of text its colour
  Colour stroke{0, 0, 0, 0};
  double stroke_width = 0.0;  ///< mm
  bool is_dashed = false;
  std::string text;        ///< UTF-8; centred about the first point, unless it is left-aligned
  double text_size = 0.0;  ///< mm
  bool is_bold = false, is_left_aligned = false;
  std::string title;  ///< what a pointer that rests on it is told; may be empty
  std::string layer;  ///< what it shows: one of kWallLayer, kFurnitureLayer and others
};

/// A drawing to scale. One shape lies above those before it.
struct PlanSheet {
  double width = 0.0, height = 0.0;                        ///< mm
  int scale = 100;                                         ///< 1 : scale
  Eigen::Vector2d p_map_corner = Eigen::Vector2d::Zero();  ///< m: where its upper left corner lies
  std::vector<SheetShape> shapes;
};

/// Lays a plan out: rooms with names and areas, walls, openings with widths, furniture, the outer
/// dimensions, a legend and a title. The scale is the greatest of 1:50, 1:100, 1:200, 1:500 ...
/// that fits A1. @param place  an arrow shows where north is; nothing: no arrow.
PlanSheet layOutPlan(const FloorPlan& plan, const std::string& title,
                     const std::optional<GeoReference>& place = {});

/// The faces and ends of a wall of two faces [m, map frame].
Polygon outlineOf(const PlanWall& wall);

/// "Kitchen", or "Room 5" where nobody named it.
std::string nameOf(const PlanRoom& room);

}  // namespace cca
