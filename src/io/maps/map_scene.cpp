// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/map_scene.hpp"

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/stock_objects.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/files/gzip_archive.hpp"
#include "io/files/png_file.hpp"
#include "io/maps/map_picture.hpp"

namespace cca {
namespace {

constexpr float kWallHeight = 1.0F;      // m
constexpr double kFloorGrid = 5.0;       // m
constexpr double kMostSquares = 1000.0;  // along a side; beyond, they grow
constexpr double kCameraDistance = 2.1;  // of the map's longer side

mrpt::math::TPoint3Df at(const Eigen::Vector2d& p, float height) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), height};
}

mrpt::opengl::CSetOfTriangles::Ptr walls(const std::vector<MapLine>& lines) {
  auto faces = mrpt::opengl::CSetOfTriangles::Create();
  const auto face = [&](const auto& a, const auto& b, const auto& c) {
    mrpt::opengl::TTriangle triangle(a, b, c);
    triangle.computeNormals();
    triangle.setColor(mrpt::img::TColor(70, 120, 180, 160));
    faces->insertTriangle(triangle);
  };
  for (const MapLine& line : lines) {
    const auto &start = line.segment.start, &end = line.segment.end;
    face(at(start, 0), at(end, 0), at(end, kWallHeight));
    face(at(start, 0), at(end, kWallHeight), at(start, kWallHeight));
  }
  faces->setName("walls");
  return faces;
}

mrpt::opengl::CSetOfLines::Ptr strokes(const std::string& name, const mrpt::img::TColor& colour,
                                       float width) {
  auto lines = mrpt::opengl::CSetOfLines::Create();
  lines->setName(name);
  lines->setColor_u8(colour);
  lines->setLineWidth(width);
  return lines;
}

mrpt::opengl::CRenderizable::Ptr corner(const Pose2& pose, const std::string& name) {
  auto object = mrpt::opengl::stock_objects::CornerXYZSimple(0.5F, 3.0F);
  object->setPose(mrpt::poses::CPose3D(pose.x, pose.y, 0.0, pose.theta, 0.0, 0.0));
  object->setName(name);
  object->enableShowName(true);
  return object;
}

}  // namespace

mrpt::opengl::COpenGLScene::Ptr makeScene(const MapProducts& products) {
  auto scene = mrpt::opengl::COpenGLScene::Create();
  const auto view = wholeView(products);
  const double side =
      kFloorGrid * std::max(1.0, std::ceil(view.sizes().maxCoeff() / (kMostSquares * kFloorGrid)));
  const auto snapped = [side](double v, double up) {
    return static_cast<float>(side * (std::floor(v / side) + up));
  };
  scene->insert(mrpt::opengl::CGridPlaneXY::Create(
      snapped(view.min().x(), 0), snapped(view.max().x(), 1), snapped(view.min().y(), 0),
      snapped(view.max().y(), 1), 0.0F, static_cast<float>(side)));

  auto lines = strokes("lines", {20, 60, 120}, 3.0F);
  for (const MapLine& line : products.lines) {
    const auto &start = line.segment.start, &end = line.segment.end;
    lines->appendLine(start.x(), start.y(), kWallHeight, end.x(), end.y(), kWallHeight);
  }
  scene->insert(lines);

  const auto& trajectory = products.trajectory;
  auto path = strokes("trajectory", {235, 140, 35}, 2.0F);
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    path->appendLine(trajectory[k - 1].x, trajectory[k - 1].y, 0.02, trajectory[k].x,
                     trajectory[k].y, 0.02);
  }
  scene->insert(path);
  if (!trajectory.empty()) {
    scene->insert(corner(trajectory.front(), "start"));
    scene->insert(corner(trajectory.back(), "end"));
  }
  scene->insert(walls(products.lines));  // last: it is transparent
  return scene;
}

void writeScene(const std::string& path, const MapProducts& products) {
  GzipArchive file(path);
  file.write(*makeScene(products));
  file.commit();
}

void writeSolidPicture(const std::string& png_path, const MapProducts& products, int longest_side,
                       const std::optional<Eigen::AlignedBox2d>& shown) {
  const auto side =
      static_cast<unsigned>(std::clamp(longest_side, kSmallestPicture, kLargestSolidPicture));
  // Twice as large, then halved: the renderer itself does not smooth edges.
  mrpt::opengl::CFBORender::Parameters sheet(2 * side, 2 * (3 * side / 4));
  mrpt::opengl::CFBORender renderer(sheet);
  const auto scene = makeScene(products);
  scene->getViewport()->setCustomBackgroundColor({1.0F, 1.0F, 1.0F});
  const auto view = shown ? *shown : wholeView(products);
  auto& camera = renderer.getCamera(*scene);
  camera.setPointingAt(view.center().x(), view.center().y(), 0.0);
  camera.setAzimuthDegrees(-110.0F);
  camera.setElevationDegrees(50.0F);
  camera.setZoomDistance(static_cast<float>(kCameraDistance * view.sizes().maxCoeff()));
  mrpt::img::CImage large, image;
  try {
    renderer.render_RGB(*scene, large);
  } catch (const std::exception&) {  // MRPT's own text is a stack of addresses
    throw std::runtime_error(png_path + ": cannot be drawn in 3-D");
  }
  large.scaleHalf(image, mrpt::img::IMG_INTERP_AREA);
  writePng(image, png_path);
}

}  // namespace cca
