// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/spatial_index.hpp"

#include <algorithm>
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost.Geometry includes one itself
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <nanoflann.hpp>
#include <utility>

namespace cca {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostBox = bg::model::box<BoostPoint>;
using BoostSegment = bg::model::segment<BoostPoint>;

BoostPoint toBoost(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

BoostSegment toBoost(const Segment2& s) { return {toBoost(s.start), toBoost(s.end)}; }

BoostBox boxAround(const Segment2& s, double margin) {
  const Eigen::Vector2d low = s.start.cwiseMin(s.end).array() - margin;
  const Eigen::Vector2d high = s.start.cwiseMax(s.end).array() + margin;
  return {toBoost(low), toBoost(high)};
}

}  // namespace

double distance(const Eigen::Vector2d& point, const Segment2& segment) {
  const Eigen::Vector2d along = segment.end - segment.start, offset = point - segment.start;
  const double squared = along.squaredNorm();
  if (squared <= 0.0) return offset.norm();
  const double t = std::clamp(offset.dot(along) / squared, 0.0, 1.0);
  return (offset - t * along).norm();
}

struct SegmentIndex::Tree {
  bgi::rtree<std::pair<BoostBox, std::size_t>, bgi::rstar<16>> boxes;
};

SegmentIndex::SegmentIndex(const std::vector<Segment2>& segments) : segments_(segments) {
  std::vector<std::pair<BoostBox, std::size_t>> values;
  values.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    values.emplace_back(boxAround(segments[i], 0), i);
  tree_.reset(new Tree{decltype(Tree::boxes)(values)});
}

SegmentIndex::~SegmentIndex() = default;

Neighbour SegmentIndex::nearest(const Eigen::Vector2d& point, double cap) const {
  // Boxes come by rising distance, a lower bound of the segment's own.
  Neighbour best{npos, cap};
  const auto query = bgi::nearest(toBoost(point), static_cast<unsigned>(segments_.size()));
  if (segments_.empty()) return best;
  for (auto it = tree_->boxes.qbegin(query); it != tree_->boxes.qend(); ++it) {
    if (bg::distance(toBoost(point), it->first) > best.distance) break;
    const double d = distance(point, segments_[it->second]);
    if (d < best.distance || (d == best.distance && it->second < best.index)) {
      best = {it->second, d};
    }
  }
  return best;
}

std::vector<std::size_t> SegmentIndex::within(const Eigen::Vector2d& point, double radius) const {
  return within(Segment2{point, point}, radius);
}

std::vector<std::size_t> SegmentIndex::within(const Segment2& segment, double radius) const {
  std::vector<std::size_t> found;
  const bool is_point = segment.length() <= 0.0;
  for (auto it = tree_->boxes.qbegin(bgi::intersects(boxAround(segment, radius)));
       it != tree_->boxes.qend(); ++it) {
    const Segment2& other = segments_[it->second];
    const double d =
        is_point ? distance(segment.start, other) : bg::distance(toBoost(segment), toBoost(other));
    if (d <= radius) found.push_back(it->second);
  }
  std::sort(found.begin(), found.end());
  return found;
}

struct PointIndex::Tree {
  struct Points {
    const std::vector<Eigen::Vector2d>& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i](static_cast<Eigen::Index>(axis));
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>,
                                                    Points, 2, std::size_t>;

  explicit Tree(const std::vector<Eigen::Vector2d>& p)
      : points{p}, index(2, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}

  Points points;
  Index index;
};

PointIndex::PointIndex(const std::vector<Eigen::Vector2d>& points) : tree_(new Tree(points)) {
  tree_->index.buildIndex();
}

PointIndex::~PointIndex() = default;

double PointIndex::nearestDistance(const Eigen::Vector2d& point, double cap) const {
  if (tree_->points.points.empty()) return cap;
  std::size_t index = 0;
  double squared = 0.0;
  tree_->index.knnSearch(point.data(), 1, &index, &squared);
  return std::min(cap, std::sqrt(squared));
}

void PointIndex::within(const Eigen::Vector2d& point, double radius,
                        std::vector<std::size_t>& found) const {
  found.clear();
  if (tree_->points.points.empty()) return;
  std::vector<std::pair<std::size_t, double>> matches;
  // nanoflann keeps distances below the bound; the next number up makes it at most the radius.
  const double bound = std::nextafter(radius * radius, 2.0 * radius * radius + 1.0);
  tree_->index.radiusSearch(point.data(), bound, matches, nanoflann::SearchParams(32, 0.f, false));
  found.reserve(matches.size());
  for (const auto& match : matches) found.push_back(match.first);
}

}  // namespace cca
