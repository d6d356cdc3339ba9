// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/evidence/tuning_analysis.hpp"

#include <algorithm>
#include <stdexcept>

#include "cca_mrpt/simulation/random.hpp"

namespace cca::evidence {
namespace {

constexpr int kResamples = 1000;
constexpr double kNotRun = -1.0;

double valueOf(const TuningRow& row, Objective objective) {
  if (objective == Objective::kScan) return row.scan_f1;
  if (objective == Objective::kMap) return row.map_f1;
  return 0.5 * (row.scan_f1 + row.map_f1);
}

/// Values scene by scene, a column a combination; of complete scenes only.
std::vector<std::vector<double>> table(const TuningDesign& design,
                                       const std::vector<TuningRow>& rows, Objective objective) {
  std::vector<std::vector<double>> scenes(design.scenes(),
                                          std::vector<double>(design.combinations(), kNotRun));
  for (const TuningRow& row : rows) {
    if (row.job >= design.jobs()) continue;
    scenes[row.job / design.combinations()][row.job % design.combinations()] =
        valueOf(row, objective);
  }
  const auto incomplete = [](const std::vector<double>& scene) {
    return std::find(scene.begin(), scene.end(), kNotRun) != scene.end();
  };
  scenes.erase(std::remove_if(scenes.begin(), scenes.end(), incomplete), scenes.end());
  if (scenes.size() < 2) {
    throw std::runtime_error("fewer than two scenes are complete: run the rest of the design");
  }
  return scenes;
}

std::vector<double> meanOf(const std::vector<std::vector<double>>& scenes,
                           const std::vector<std::size_t>& chosen) {
  std::vector<double> mean(scenes[0].size(), 0.0);
  for (const std::size_t scene : chosen) {
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += scenes[scene][k];
  }
  for (double& value : mean) value /= static_cast<double>(chosen.size());
  return mean;
}

std::vector<std::size_t> allOf(std::size_t n) {
  std::vector<std::size_t> indices(n);
  for (std::size_t i = 0; i < n; ++i) indices[i] = i;
  return indices;
}

std::size_t largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

Recommendation::Interval interval(const std::vector<double>& values) {
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

}  // namespace

AnalysisOfVariance analyseTuning(const TuningDesign& design, const std::vector<TuningRow>& rows,
                                 Objective objective) {
  const auto scenes = table(design, rows, objective);
  const int cuts = static_cast<int>(design.similarity_cut.size());
  const int prices = static_cast<int>(design.vertex_price.size());
  const int straight = static_cast<int>(design.straightness.size());
  Experiment experiment;
  experiment.factors = {{"scene", static_cast<int>(scenes.size())},
                        {"similarity_cut", cuts},
                        {"vertex_price", prices},
                        {"straightness", straight}};
  for (int scene = 0; scene < static_cast<int>(scenes.size()); ++scene) {
    for (int k = 0; k < static_cast<int>(design.combinations()); ++k) {
      experiment.settings.push_back(
          {scene, k / straight / prices, k / straight % prices, k % straight});
      experiment.responses.push_back(scenes[scene][k]);
    }
  }
  return analyseVariance(experiment, {{1}, {2}, {3}, {1, 2}, {1, 3}, {2, 3}, {0}});
}

std::vector<Combination> combinationMeans(const TuningDesign& design,
                                          const std::vector<TuningRow>& rows, Objective objective) {
  const auto scenes = table(design, rows, objective);
  std::vector<Combination> means;
  for (std::size_t k = 0; k < design.combinations(); ++k) {
    std::vector<double> values;
    for (const auto& scene : scenes) values.push_back(scene[k]);
    means.push_back({tuningJob(design, k).parameters, bootstrapMean(values)});
  }
  return means;
}

Recommendation recommend(const TuningDesign& design, const std::vector<TuningRow>& rows,
                         Objective objective, const CcaParameters& shipped) {
  const auto scenes = table(design, rows, objective);
  const std::vector<double> means = meanOf(scenes, allOf(scenes.size()));
  const std::size_t best = largest(means);
  Recommendation r;
  r.best = tuningJob(design, best).parameters;
  r.best_value = means[best];

  Random random(1);
  const int last = static_cast<int>(scenes.size()) - 1;
  std::vector<double> cuts, prices, straight;
  for (int resample = 0; resample < kResamples; ++resample) {
    std::vector<std::size_t> chosen(scenes.size());
    for (std::size_t& scene : chosen) scene = static_cast<std::size_t>(random.integer(0, last));
    const CcaParameters p = tuningJob(design, largest(meanOf(scenes, chosen))).parameters;
    cuts.push_back(p.similarity_cut);
    prices.push_back(p.vertex_price);
    straight.push_back(p.straightness);
  }
  r.similarity_cut = interval(cuts);
  r.vertex_price = interval(prices);
  r.straightness = interval(straight);

  for (std::size_t k = 0; k < design.combinations(); ++k) {
    const CcaParameters p = tuningJob(design, k).parameters;
    if (p.similarity_cut != shipped.similarity_cut || p.vertex_price != shipped.vertex_price ||
        p.straightness != shipped.straightness) {
      continue;
    }
    std::vector<double> differences;
    for (const auto& scene : scenes) differences.push_back(scene[best] - scene[k]);
    r.shipped_in_design = true;
    r.shipped_value = means[k];
    r.shortfall = bootstrapMean(differences);
  }
  return r;
}

}  // namespace cca::evidence
