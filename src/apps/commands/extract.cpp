// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>
#include <string>

#include "apps/logs/log_warnings.hpp"
#include "apps/options/log_hint_options.hpp"
#include "apps/options/parameter_options.hpp"
#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/mapping/line_extraction.hpp"
#include "commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text.hpp"

namespace cca::apps {

namespace {

constexpr char kArcHeader[] =
    "scan_id,x,y,radius,start_deg,sweep_deg,returns,sigma_x,sigma_y,sigma_radius\n";
constexpr char kHeader[] = "scan_id,x1,y1,x2,y2,returns,sigma_lateral,sigma_angle\n";

std::string row(int scan_id, const LineSegment& line) {
  return formatted("%d,%.6f,%.6f,%.6f,%.6f,%.0f,%.6f,%.6f\n", scan_id, line.start.x(),
                   line.start.y(), line.end.x(), line.end.y(), line.moments.weight,
                   std::sqrt(line.covariance(0, 0)), std::sqrt(line.covariance(1, 1)));
}

std::string row(int scan_id, const Arc& arc) {
  const auto sigma = [&](int k) { return std::sqrt(arc.covariance(k, k)); };
  return formatted("%d,%.6f,%.6f,%.6f,%.4f,%.4f,%.0f,%.6f,%.6f,%.6f\n", scan_id, arc.centre.x(),
                   arc.centre.y(), arc.radius, arc.start_angle * kDegreesPerRadian,
                   arc.sweep * kDegreesPerRadian, arc.support, sigma(0), sigma(1), sigma(2));
}

}  // namespace

void addExtractCommand(CLI::App& program) {
  auto* command = program.add_subcommand("extract", "lines of each single scan, sensor frame");
  auto log = std::make_shared<std::string>(), out = std::make_shared<std::string>(),
       arcs = std::make_shared<std::string>();
  auto force = std::make_shared<bool>(false);
  command->add_option("LOG", *log, "laser log")->required();
  command->add_option("--out", *out, "CSV file to write")->required();
  command->add_option("--arcs", *arcs, "CSV file to write for round pillars and curved walls");
  command->add_flag("--force", *force, "overwrite files that are there");
  auto options = std::make_shared<ParameterOptions>(*command, std::vector<std::string>{"mapping"});
  const auto hints = addLogHintOptions(*command);
  command->callback([log, out, arcs, force, options, hints] {
    const Parameters parameters = options->resolve();
    requireNew(*out, *force);
    requireNew(*arcs, *force);
    requireApart(*out, {*log, *arcs});
    requireApart(*arcs, {*log});
    auto reader = openUndistortedLog(*log, *hints);
    std::string csv = kHeader, arcs_csv = kArcHeader;
    for (int id = 0; auto record = reader->next(); ++id) {
      if (arcs->empty()) {
        for (const auto& line : extractLines(record->scan, parameters.mapping))
          csv += row(id, line);
        continue;
      }
      const ScanFeatures features = extractFeatures(record->scan, parameters.mapping);
      for (const LineSegment& line : features.lines) csv += row(id, line);
      for (const Arc& arc : features.arcs) arcs_csv += row(id, arc);
    }
    tellWarnings(*log, reader->warnings());
    writeFile(*out, csv);
    if (!arcs->empty()) writeFile(*arcs, arcs_csv);
  });
}

}  // namespace cca::apps
