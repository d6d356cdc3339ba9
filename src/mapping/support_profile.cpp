// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/support_profile.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cca {
namespace {

constexpr int kWindow = 2;            // bins on either side that speak for a place
constexpr double kFewestRays = 2.0;   // that can refute a place
constexpr double kRaysPerHit = 0.5;   // from which on a place is free
constexpr double kPartingRays = 2.0;  // that keep a gap open
constexpr int kMostUpdates = 1000;    // of a tally, before it is added up anew

}  // namespace

void SupportProfile::grow(int i) {
  if (contains(i)) return;
  if (bins_.empty()) first_ = i;
  if (i < first_) {
    bins_.insert(bins_.begin(), static_cast<std::size_t>(first_ - i), SupportBin{});
    first_ = i;
  }
  if (i >= last()) bins_.resize(static_cast<std::size_t>(i - first_ + 1));
}

const SupportBin& SupportProfile::hit(double t, double d) {
  const int i = binOf(t);
  if (!open_ || i != open_bin_) {
    settle();
    grow(i);
    if (tallied_) {
      open_ = true;
      open_bin_ = i;
      before_ = at(i);
    }
  }
  SupportBin& bin = at(i);
  if (bin.hits + 1.0 > SupportBin::kMostHits && bin.passed > 0.0) parted_ = false;  // both scaled
  bin.hit(t, d);
  refuted_ = refuted_ || bin.isRefuted();  // where rays had gone before
  return bin;
}

void SupportProfile::settle() const {
  if (!std::exchange(open_, false)) return;
  if (++updates_ > kMostUpdates) return forget();
  BinTally change, old;
  change.add(bin(open_bin_));
  old.add(before_);
  change.remove(old);
  tally_.add(change);
  if (!parted_) return;
  Stretch* const stretch = stretchAt(open_bin_);
  parted_ = stretch != nullptr && !movesPlace(open_bin_, change.returns.w, 0.0);
  if (parted_) stretch->tally.add(change);
}

Stretch* SupportProfile::stretchAt(int i) const {
  for (Stretch& stretch : stretches_) {
    if (i >= stretch.range.first && i < stretch.range.last) return &stretch;
  }
  return nullptr;
}

bool SupportProfile::pass(double t, double rays) {
  const int i = binOf(t);
  if (!contains(i) || at(i).passed >= SupportBin::kMostHits) return false;
  settle();
  const double before = at(i).passed;
  at(i).passed = std::min(before + rays, SupportBin::kMostHits);
  const bool refutes_bin = at(i).isRefuted();
  refuted_ = refuted_ || refutes_bin;
  const bool changes =
      refutes_bin || before < kPartingRays || movesPlace(i, 0.0, at(i).passed - before);
  if (changes) parted_ = false;
  return changes;
}

bool SupportProfile::movesPlace(int i, double new_hits, double new_rays) const {
  double rays_near = 0.0;
  for (int k = std::max(first(), i - 2 * kWindow); k < std::min(last(), i + 2 * kWindow + 1); ++k) {
    rays_near += bin(k).passed;
  }
  if (rays_near < kFewestRays) return false;
  if (new_hits > 0.0 && bin(i).hits <= new_hits) return true;  // a place that was none
  for (int k = std::max(first(), i - kWindow); k < std::min(last(), i + kWindow + 1); ++k) {
    if (bin(k).hits <= 0.0) continue;
    const Counts now = countsAround(k);
    if (now.stand() != Counts{now.hits - new_hits, now.passed - new_rays}.stand()) return true;
  }
  return false;
}

SupportProfile::Counts SupportProfile::countsAround(int i) const {
  const SupportBin* from = bins_.data() + (std::max(first(), i - kWindow) - first_);
  const SupportBin* to = bins_.data() + (std::min(last(), i + kWindow + 1) - first_);
  Counts counts;
  for (const SupportBin* b = from; b < to; ++b) {
    counts.hits += b->hits;
    counts.passed += b->passed;
  }
  return counts;
}

bool SupportProfile::Counts::stand() const {
  return passed < kFewestRays || passed < kRaysPerHit * hits;
}

void SupportProfile::add(const SupportBin& other) {
  if (other.hits <= 0.0) return;
  const int i = binOf(other.t_min), j = binOf(other.t_max);
  grow(i);
  grow(j);
  forget();
  if (i == j) {
    at(i).add(other);
  } else {
    // The hits straddle two bins: they are shared out as if they were spread evenly. A last hit on
    // the border may lie before it by a rounding error, and no bin may hold less than nothing.
    const double border = j * kBinLength;
    const double share = std::min((border - other.t_min) / (other.t_max - other.t_min), 1.0);
    at(i).add(other.part(share, other.t_min, border));
    if (share < 1.0) at(j).add(other.part(1.0 - share, border, other.t_max));
  }
  refuted_ = refuted_ || at(i).isRefuted() || at(j).isRefuted();
}

SupportBin SupportProfile::take(int i) {
  forget();
  return std::exchange(at(i), SupportBin{});
}

SupportProfile SupportProfile::cutFrom(int from) {
  forget();
  SupportProfile tail;
  const auto begin = bins_.begin() + (from - first_);
  tail.first_ = from;
  tail.bins_.assign(begin, bins_.end());
  tail.refuted_ = refuted_;
  bins_.erase(begin, bins_.end());
  return tail;
}

bool SupportProfile::prune() {
  if (std::exchange(refuted_, false)) {
    for (SupportBin& bin : bins_) {
      if (!bin.isRefuted()) continue;
      const double passed = bin.passed;
      bin = SupportBin{};
      bin.passed = passed;
      forget();
    }
  }
  const auto stands = [](const SupportBin& bin) { return bin.hits > 0.0; };
  if (bins_.empty() || (stands(bins_.front()) && stands(bins_.back()))) return false;
  forget();
  const auto begin = std::find_if(bins_.begin(), bins_.end(), stands);
  const auto end = std::find_if(bins_.rbegin(), bins_.rend(), stands).base();
  if (begin == bins_.end()) {
    bins_.clear();
    return true;
  }
  first_ += static_cast<int>(begin - bins_.begin());
  bins_.erase(end, bins_.end());
  bins_.erase(bins_.begin(), begin);
  return true;
}

bool SupportProfile::occupied(int i) const { return bin(i).hits > 0.0 && countsAround(i).stand(); }

const std::vector<Stretch>& SupportProfile::stretches() const {
  settle();
  if (parted_) return stretches_;
  tally();
  parted_ = true;
  stretches_.clear();
  double passed_since = 0.0;
  int rays = first() - kWindow - 1;  // the last bin up to i + kWindow that any ray went through
  for (int i = first() - kWindow; i < last(); ++i) {
    if (i + kWindow < last() && bin(i + kWindow).passed > 0.0) rays = i + kWindow;
    if (i < first()) continue;
    const bool stands = rays < i - kWindow ? bin(i).hits > 0.0 : occupied(i);
    if (!stands) {
      passed_since += bin(i).passed;
      continue;
    }
    const bool joins = !stretches_.empty() && i - stretches_.back().range.last <= kBridgedBins &&
                       passed_since < kPartingRays;
    if (joins) {
      stretches_.back().range.last = i + 1;
    } else {
      stretches_.push_back({{i, i + 1}, {}});
    }
    passed_since = 0.0;
  }
  for (Stretch& s : stretches_) {
    const bool whole = s.range.first == first() && s.range.last == last();
    s.tally = whole ? tally_ : tally(s.range);
  }
  return stretches_;
}

const BinTally& SupportProfile::tally() const {
  settle();
  if (!tallied_) {
    tally_ = tally({first(), last()});
    tallied_ = true;
    updates_ = 0;
  }
  return tally_;
}

BinTally SupportProfile::tally(const BinRange& range) const {
  BinTally tally;
  for (int i = range.first; i < range.last; ++i) tally.add(bin(i));
  return tally;
}

SupportProfile::Cut SupportProfile::bestCut() const {
  BinSums left, right = sums();
  const double whole = right.residual();
  Cut best{first(), 0.0};
  for (int i = first(); i + 1 < last(); ++i) {
    const SupportBin& b = bin(i);
    if (b.hits <= 0.0) continue;
    BinSums one;
    one.addMeanPoint(b);
    left.add(one);
    right.remove(one);
    const double gain = whole - left.residual() - right.residual();
    if (gain > best.gain) best = {i + 1, gain};
  }
  return best;
}

}  // namespace cca
