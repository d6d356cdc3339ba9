// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cross.hpp"
#include "mapping/arcs_of_chain.hpp"
#include "mapping/description_length.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

/// What arcs, and what else may tell their points, cost in nats: all in proportion to a vertex. The
/// figures named are those where it costs 12.
struct Prices {
  double next_line;  ///< a line that meets the one before it: one vertex more
  double line;       ///< see linePrice()
  /// A line with a bulge, 8.3 more: noise alone lets this one parameter raise the likelihood by
  /// more than e^8.3 in one of 22 000 trials.
  double arc;
  /// A pillar that stands free, 14.6: three parameters, for it ends where the rays cease to meet
  /// it. Noise alone lets it raise the likelihood by more in one of 500 000 trials, as a line of
  /// four.
  double pillar;
  /// The corner of a box that stands free, 20: four likewise, and the choice of the ray that it
  /// lies at, one of some fifty.
  double free_corner;

  explicit Prices(double vertex)
      : next_line(vertex),
        line(linePrice(vertex)),
        arc(line + vertex * 8.3 / 12.0),
        pillar(vertex * 14.6 / 12.0),
        free_corner(line + vertex * 4.0 / 12.0) {}
};

/// Two lines that meet fit any four points: these are the fewest that can tell a bulge from that.
constexpr int kFewestOnArc = 5;

/// m, how far an arc stands off its chord at most.
double bulge(const Arc& arc) {
  return arc.radius * (1.0 - std::cos(0.5 * std::min(arc.sweep, M_PI)));
}

/// What it costs to tell points otherwise than by an arc.
struct Telling {
  double price = 0.0;       ///< nats, but for the residuals
  double chi_square = 0.0;  ///< of the points on lines
  double freedom = 0.0;     ///< what that is to be expected

  /// How many times its residuals are what noise makes them.
  double roughness() const { return freedom > 0.0 ? chi_square / freedom : 1.0; }
  void addLine(double points, double line_chi_square, const Prices& prices) {
    price += price > 0.0 ? prices.next_line : prices.line;
    chi_square += line_chi_square;
    freedom += std::max(0.0, points - 2.0);
  }
};

/// Moments of any run of points, each of the weight of its variance.
PrefixMoments weighedRuns(const std::vector<CurvePoint>& points) {
  std::vector<Eigen::Vector2d> positions;
  std::vector<double> weights;
  for (const CurvePoint& p : points) {
    positions.push_back(p.position);
    weights.push_back(1.0 / p.variance);
  }
  return PrefixMoments(positions, weights);
}

/// Chi-square of the best line through points first <= i < last.
double ofLine(const PrefixMoments& runs, int first, int last) {
  return principalAxis(runs.run(first, last)).residual_sum_sq;
}

Telling asTold(const std::vector<ChainLink>& links, const PrefixMoments& runs, int first, int last,
               const Prices& prices) {
  Telling told;
  for (int k = first; k < last; ++k) {
    const ChainLink& link = links[static_cast<std::size_t>(k)];
    const double points = link.last - link.first;
    if (link.is_line) {
      told.addLine(points, ofLine(runs, link.first, link.last), prices);
    } else {
      told.price += kPointPrice * points;
    }
  }
  return told;
}

/// The points as they would be told with the noise alone: by two lines that meet, wherever that is.
/// @param free  they stand free, as the two faces of a box.
Telling byCorner(const PrefixMoments& runs, int first, int last, bool free, const Prices& prices) {
  Telling best;
  best.price = free ? prices.free_corner : prices.line + prices.next_line;
  best.freedom = last - first - 4.0;
  best.chi_square = std::numeric_limits<double>::infinity();
  for (int middle = first + 2; middle + 2 <= last; ++middle) {
    best.chi_square =
        std::min(best.chi_square, ofLine(runs, first, middle) + ofLine(runs, middle, last));
  }
  return best;
}

/// What an arc of at least so much chi-square saves where it replaces that at most, nats.
double mostSaved(const Telling& told, double least_chi_square, double price) {
  const double less = told.chi_square - least_chi_square;
  return told.price - price + 0.5 * less / (less < 0.0 ? std::max(1.0, told.roughness()) : 1.0);
}

/// What an arc saves where it replaces that, nats.
double saving(const Telling& told, const FittedArc& fitted, double price) {
  // A wall may be rough: what neither its lines nor the arc explain is no sign of a bulge.
  if (std::isinf(told.chi_square)) return told.chi_square;
  const double by_arc = fitted.chi_square / std::max(1.0, fitted.arc.support - 3.0);
  const double rough = std::max(1.0, std::min(told.roughness(), by_arc));
  return told.price - price + 0.5 * (told.chi_square - fitted.chi_square) / rough;
}

/// Whether all links turn the same way about the centre: a wall is seen from one side.
bool turnsOneWay(const std::vector<CurvePoint>& points, const std::vector<ChainLink>& links,
                 int first, int last, const Arc& arc) {
  bool left = false, right = false;
  for (int k = first; k < last; ++k) {
    const ChainLink& link = links[static_cast<std::size_t>(k)];
    const Eigen::Vector2d &a = points[static_cast<std::size_t>(link.first)].position,
                          &b = points[static_cast<std::size_t>(link.last - 1)].position;
    const double turn = cross(a - arc.centre, b - arc.centre);
    left = left || turn > 0.0;
    right = right || turn < 0.0;
  }
  return !(left && right);
}

/// Whether all of the arc can be seen from the origin: its ends face it as its middle does, but for
/// the noise of the points there.
bool isSeenFromOrigin(const Arc& arc, double variance) {
  const auto facing = [&](double share) {
    const Eigen::Vector2d p = arc.at(share);
    return (arc.centre - p).dot(p) / arc.radius;  // m, > 0 from outside
  };
  const double side = facing(0.5) > 0.0 ? 1.0 : -1.0, noise = kNormalGate * std::sqrt(variance);
  // A point off the circle by the noise may seem to lie so far behind its limb.
  const double behind = std::sqrt(2.0 * arc.radius * noise);
  return side * facing(0.0) > -behind && side * facing(1.0) > -behind;
}

}  // namespace

std::vector<ArcOfLinks> arcsOfChain(const std::vector<CurvePoint>& points,
                                    const std::vector<ChainLink>& links, double least_bulge,
                                    double vertex_price, const OneView* view) {
  const Prices prices(vertex_price);
  const int n = static_cast<int>(links.size());
  struct Best {
    double saved = 0.0;
    int from = -1;  ///< of the arc that ends here; -1: none does
    Arc arc;
  };
  std::vector<Best> best(links.size() + 1);
  const PrefixMoments runs = weighedRuns(points);
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  // Chi-square of the arc of links first to last at least: that of any arc of some of them.
  std::vector<double> least(links.size() + 1, 0.0);
  const auto consider = [&](int first, int last, const std::optional<Limbs>& touched) {
    const int from = links[at(first)].first, to = links[at(last - 1)].last;
    const auto begin = links.begin() + first, end = links.begin() + last;
    const bool chain = std::any_of(begin, end, [](const ChainLink& l) { return l.is_line; });
    if (!touched && (to - from < kFewestOnArc || !chain)) return;
    const double price = touched ? prices.pillar : prices.arc;
    const double wanted = std::max(0.0, best[at(last)].saved - best[at(first)].saved);
    const double least_chi_square = touched ? 0.0 : least[at(first)];
    const Telling told = asTold(links, runs, first, last, prices);
    if (mostSaved(told, least_chi_square, price) <= wanted) return;
    const Telling corner = byCorner(runs, from, to, touched.has_value(), prices);
    if (mostSaved(corner, least_chi_square, price) <= wanted) return;
    const auto fitted = fitArc(points, from, to, touched);
    if (!fitted) return;
    if (!touched) least[at(first)] = std::max(least[at(first)], fitted->chi_square);
    if (bulge(fitted->arc) < least_bulge) return;
    if (!turnsOneWay(points, links, first, last, fitted->arc)) return;
    if (view && !isSeenFromOrigin(fitted->arc, points[at(from)].variance)) return;
    const double gain = std::min(saving(told, *fitted, price), saving(corner, *fitted, price));
    const double saved = best[at(first)].saved + gain;
    if (gain > 0.0 && saved > best[at(last)].saved) best[at(last)] = {saved, first, fitted->arc};
  };
  for (int last = 1; last <= n; ++last) {
    best[at(last)].saved = best[at(last - 1)].saved;
    for (int first = last - 1; first >= 0; --first) {
      least[at(first)] = std::max(least[at(first)], least[at(first + 1)]);
      consider(first, last, std::nullopt);
    }
  }
  if (view && view->limbs) consider(0, n, view->limbs);
  std::vector<ArcOfLinks> arcs;
  for (int last = n; last > 0;) {
    const Best& here = best[at(last)];
    if (here.from >= 0) arcs.push_back({here.arc, here.from, last});
    last = here.from >= 0 ? here.from : last - 1;
  }
  std::reverse(arcs.begin(), arcs.end());
  return arcs;
}

}  // namespace cca
