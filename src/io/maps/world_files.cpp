// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/world_files.hpp"

#include <mrpt/img/CImage.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "io/files/atomic_file.hpp"
#include "io/files/png_file.hpp"
#include "io/files/text.hpp"

namespace cca {

namespace {

constexpr std::size_t kLongestName = 100;

/// The name stands in the YAML file, and is that of files in the folder.
void requirePlainName(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
  if (!plain || name.empty() || name.front() == '.' || name.size() > kLongestName) {
    throw std::runtime_error("name of a world '" + name +
                             "': letters, digits, '_', '-' and '.' only, at most 100 of them");
  }
}

std::string yamlText(const Building& plan) {
  return formatted(
      "image: %s.png\nresolution: %g\norigin: [0.0, 0.0, 0.0]\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\nnegate: 0\nstart: [%g, %g, %g]\n",
      plan.name.c_str(), kWorldResolution, plan.start.x, plan.start.y,
      plan.start.theta * kDegreesPerRadian);
}

mrpt::img::CImage picture(const World& world) {
  mrpt::img::CImage image(world.width(), world.height(), mrpt::img::CH_GRAY);
  for (int iy = 0; iy < world.height(); ++iy) {
    auto* line = image.ptrLine<unsigned char>(world.height() - 1 - iy);
    for (int ix = 0; ix < world.width(); ++ix) line[ix] = world.isObstacle(ix, iy) ? 0 : 254;
  }
  return image;
}

std::string truthText(const Building& plan) {
  std::string text = "x1,y1,x2,y2\n";
  for (const auto& [a, b] : wallFaces(plan, kWorldResolution)) {
    // Adding 0 turns a negative zero into a plain one.
    text += formatted("%.6f,%.6f,%.6f,%.6f\n", a.x() + 0.0, a.y() + 0.0, b.x() + 0.0, b.y() + 0.0);
  }
  return text;
}

}  // namespace

void writeWorldFiles(const Building& plan, const std::string& folder) {
  requirePlainName(plan.name);
  makeFolder(folder);
  const std::string stem = folder + "/" + plan.name;
  writePng(picture(rasterise(plan, kWorldResolution)), stem + ".png");
  writeFile(stem + ".truth.csv", truthText(plan));
  writeFile(stem + ".yaml", yamlText(plan));  // last: a world that is there is whole
}

}  // namespace cca
