// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/support_bin.hpp"

namespace cca {

void SupportBin::add(const SupportBin& other) {
  if (other.hits > 0.0) {
    t_min = hits > 0.0 ? std::min(t_min, other.t_min) : other.t_min;
    t_max = hits > 0.0 ? std::max(t_max, other.t_max) : other.t_max;
  }
  hits += other.hits;
  passed += other.passed;
  t += other.t;
  d += other.d;
  tt += other.tt;
  td += other.td;
  dd += other.dd;
  if (hits > kMostHits) scale(kMostHits / hits);
}

void SupportBin::scale(double factor) {
  for (double* sum : {&hits, &passed, &t, &d, &tt, &td, &dd}) *sum *= factor;
}

SupportBin SupportBin::part(double share, double t_first, double t_last) const {
  const double n = hits, t_mean = t / n, d_mean = d / n;
  const double var_t = tt / n - t_mean * t_mean, cov = td / n - t_mean * d_mean,
               var_d = dd / n - d_mean * d_mean;
  const double slope = var_t > 1e-9 ? cov / var_t : 0.0;
  const double t_part = 0.5 * (t_first + t_last), d_part = d_mean + slope * (t_part - t_mean);
  const double spread = (t_last - t_first) * (t_last - t_first) / 12.0;
  SupportBin r;
  r.hits = share * n;
  r.passed = share * passed;
  r.t = r.hits * t_part;
  r.d = r.hits * d_part;
  r.tt = r.hits * (t_part * t_part + spread);
  r.td = r.hits * (t_part * d_part + slope * spread);
  r.dd = r.hits * (d_part * d_part + std::max(0.0, var_d - slope * slope * (var_t - spread)));
  r.t_min = t_first;
  r.t_max = t_last;
  return r;
}

void BinSums::addPoint(double weight, double t_mean, double d_mean) {
  add({weight, weight * t_mean, weight * d_mean, weight * t_mean * t_mean, weight * t_mean * d_mean,
       weight * d_mean * d_mean});
}

double BinSums::residual() const {
  if (w <= 0.0) return 0.0;
  const double var_t = tt - t * t / w, cov = td - t * d / w, var_d = dd - d * d / w;
  if (var_t <= 1e-9) return std::max(0.0, var_d);
  return std::max(0.0, var_d - cov * cov / var_t);
}

LateralFit BinSums::fit() const {
  if (w <= 0.0) return {};
  const double var_t = tt - t * t / w, cov = td - t * d / w;
  const double slope = var_t > 1e-9 ? cov / var_t : 0.0;
  return {(d - slope * t) / w, slope};
}

}  // namespace cca
