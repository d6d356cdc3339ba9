// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace cca {

/// A piece of a straight line, as a map's file has it.
struct Segment2 {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< m

  double length() const { return (end - start).norm(); }
};

/// @return  m, from a point to the nearest point of a segment (its start where it has no length).
double distance(const Eigen::Vector2d& point, const Segment2& segment);

/// What a search found: the element's number and its distance.
struct Neighbour {
  std::size_t index = 0;
  double distance = 0.0;  ///< m
};

/// Fixed set of segments, searched by exact distance (Boost.Geometry's R-tree).
class SegmentIndex {
 public:
  explicit SegmentIndex(const std::vector<Segment2>& segments);
  ~SegmentIndex();

  /// The nearest segment, or index = npos and distance = cap where none lies within the cap [m].
  Neighbour nearest(const Eigen::Vector2d& point, double cap) const;
  /// All segments within `radius` [m] of a point, by rising number.
  std::vector<std::size_t> within(const Eigen::Vector2d& point, double radius) const;
  /// All segments within `radius` [m] of a segment, by rising number.
  std::vector<std::size_t> within(const Segment2& segment, double radius) const;

  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  std::vector<Segment2> segments_;
};

/// Fixed set of points (nanoflann's k-d tree). The points must outlive the index.
class PointIndex {
 public:
  explicit PointIndex(const std::vector<Eigen::Vector2d>& points);
  ~PointIndex();

  /// Distance [m] to the nearest point, at most `cap`.
  double nearestDistance(const Eigen::Vector2d& point, double cap) const;
  /// Numbers of the points within `radius` [m], unordered.
  void within(const Eigen::Vector2d& point, double radius, std::vector<std::size_t>& found) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace cca
