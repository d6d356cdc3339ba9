// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/comparison.hpp"

#include <chrono>

#include "cca_mrpt/mapping/line_extraction.hpp"

namespace cca::evidence {
namespace {

double meanF1(const baselines::Extractor& extract, const std::vector<LabelledScan>& scans) {
  double sum = 0.0;
  for (const LabelledScan& labelled : scans) {
    sum += scoreExtraction(labelled, extract(labelled.scan)).f1.value_or(0.0);
  }
  return scans.empty() ? 0.0 : sum / static_cast<double>(scans.size());
}

}  // namespace

std::vector<Contender> contenders(const CcaParameters& cca) {
  std::vector<Contender> all{
      {"cca", "shipped", [cca](const Scan& scan) { return extractLines(scan, cca); }}};
  for (const baselines::Baseline& b : baselines::all()) {
    all.push_back({b.name, "recommended", b.recommended});
    all.push_back({b.name, "tuned", b.tuned});
  }
  return all;
}

const std::vector<Figure>& figures() {
  constexpr double kMillimetres = 1e3, kDegrees = 180.0 / M_PI, kPercent = 100.0;
  using Value = std::optional<double>;
  static const std::vector<Figure> all{
      {"f1", "F1", [](const Trial& t) { return t.score.f1; }},
      {"precision", "precision", [](const Trial& t) { return t.score.precision; }},
      {"recall", "recall", [](const Trial& t) { return t.score.recall; }},
      {"covered", "covered %", [](const Trial& t) { return t.score.covered; }, 1, kPercent},
      {"lateral", "lateral mm", [](const Trial& t) { return t.score.lateral; }, 1, kMillimetres},
      {"angular", "angle deg", [](const Trial& t) { return t.score.angular; }, 2, kDegrees},
      {"range_rmse", "range rmse mm", [](const Trial& t) { return t.score.range_rmse; }, 1,
       kMillimetres},
      {"explained", "explained %", [](const Trial& t) { return Value(t.score.explained); }, 1,
       kPercent},
      {"explained_per_segment", "explained / segment",
       [](const Trial& t) { return Value(t.score.explained_per_segment); }, 1},
      {"blocked", "blocked %", [](const Trial& t) { return Value(t.score.blocked); }, 2, kPercent},
      {"segments", "segments", [](const Trial& t) { return Value(t.score.segments); }, 1},
      {"microseconds", "us / scan", [](const Trial& t) { return Value(t.microseconds); }, 0, 1.0,
       true},
  };
  return all;
}

std::vector<Trial> run(const Contender& contender, const std::vector<LabelledScan>& scans) {
  std::vector<Trial> trials;
  for (const LabelledScan& labelled : scans) {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<LineSegment> segments = contender.extract(labelled.scan);
    const std::chrono::duration<double, std::micro> spent =
        std::chrono::steady_clock::now() - begin;
    trials.push_back({scoreExtraction(labelled, segments), spent.count()});
  }
  return trials;
}

std::optional<BootstrapEstimate> summarise(const std::vector<Trial>& trials, const Figure& figure) {
  std::vector<double> values;
  for (const Trial& trial : trials) {
    if (const auto value = figure.of(trial)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return figure.is_median ? bootstrapMedian(values) : bootstrapMean(values);
}

std::optional<BootstrapEstimate> f1Difference(const std::vector<Trial>& theirs,
                                              const std::vector<Trial>& ours) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < theirs.size(); ++k) {
    if (!theirs[k].score.f1 || !ours[k].score.f1) continue;
    differences.push_back(*theirs[k].score.f1 - *ours[k].score.f1);
  }
  if (differences.empty()) return std::nullopt;
  return bootstrapMean(differences);
}

std::optional<BootstrapEstimate> lateralDifference(const std::vector<Trial>& theirs,
                                                   const std::vector<Trial>& ours) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < theirs.size(); ++k) {
    for (const EdgeMatch& a : theirs[k].score.matches) {
      for (const EdgeMatch& b : ours[k].score.matches) {
        if (a.edge == b.edge) differences.push_back(a.lateral - b.lateral);
      }
    }
  }
  if (differences.empty()) return std::nullopt;
  return bootstrapMean(differences);
}

Fit fitParameters(const baselines::Baseline& baseline, const std::vector<LabelledScan>& scans,
                  int draws, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Fit best{"recommended", meanF1(baseline.recommended, scans)};
  const double tuned = meanF1(baseline.tuned, scans);
  if (tuned > best.f1) best = {"tuned", tuned};
  for (int draw = 0; draw < draws; ++draw) {
    const baselines::Candidate candidate = baseline.sample(random);
    const double f1 = meanF1(candidate.extract, scans);
    if (f1 > best.f1) best = {candidate.parameters, f1};
  }
  return best;
}

}  // namespace cca::evidence
