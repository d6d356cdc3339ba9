// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/laser_models.hpp"

#include <stdexcept>

namespace cca {
namespace {

/// A mirror that turns all round, of which the laser uses its field of view.
LaserModel spinning(const char* name, double rate, double field_of_view_deg, int beams,
                    double range) {
  LaserModel model{name, {}, rate};
  model.laser.range = range;
  model.laser.field_of_view_deg = field_of_view_deg;
  model.laser.beams = beams;
  model.laser.sweep = field_of_view_deg / 360.0 / rate;
  model.laser.missing = MissingReading::kInfinity;
  return model;
}

LaserModel withNoise(LaserModel model, double noise, double share, double dropout) {
  model.laser.range_noise = noise;
  model.laser.range_noise_share = share;
  model.laser.dropout = dropout;
  return model;
}

/// Its driver reverses the array.
LaserModel clockwise(LaserModel model) {
  model.laser.sweep = -model.laser.sweep;
  return model;
}

std::vector<LaserModel> allModels() {
  return {
      clockwise(withNoise(spinning("ld19", 10.0, 359.2, 450, 12.0), 0.01, 0.0, 0.02)),
      {"ideal", {}, 10.0},
      // Triangulation: the error grows with the range.
      clockwise(withNoise(spinning("rplidar_a1", 5.5, 359.0, 360, 12.0), 0.005, 0.01, 0.03)),
      withNoise(spinning("urg_04lx", 10.0, 239.77, 682, 5.6), 0.005, 0.01, 0.01),
      withNoise(spinning("utm_30lx", 40.0, 270.0, 1081, 30.0), 0.01, 0.0, 0.01),
      withNoise(spinning("lds_01", 5.0, 359.0, 360, 3.5), 0.005, 0.0175, 0.03),
      withNoise(spinning("tim_571", 15.0, 270.0, 811, 25.0), 0.02, 0.0, 0.01),
  };
}

}  // namespace

const std::vector<LaserModel>& laserModels() {
  static const std::vector<LaserModel> models = allModels();
  return models;
}

std::string laserModelNames() {
  std::string names;
  for (const LaserModel& model : laserModels()) names += (names.empty() ? "" : ", ") + model.name;
  return names;
}

const LaserModel& laserModel(const std::string& name) {
  for (const LaserModel& model : laserModels()) {
    if (model.name == name) return model;
  }
  throw std::runtime_error("'" + name + "' must be one of " + laserModelNames());
}

}  // namespace cca
