// SPDX-License-Identifier: BSD-3-Clause
#include "run_window.hpp"

#include <mrpt/gui/CDisplayWindow3D.h>
#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/CCylinder.h>
#include <mrpt/opengl/CPointCloud.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "io/maps/map_scene.hpp"

namespace cca::apps {

namespace {

constexpr auto kEvery = std::chrono::milliseconds(150);

using mrpt::opengl::CCylinder;

CCylinder::Ptr disc(const Eigen::Vector2d& p_map, double radius, double height,
                    const mrpt::img::TColorf& colour) {
  auto cylinder = CCylinder::Create(static_cast<float>(radius), static_cast<float>(radius),
                                    static_cast<float>(height));
  cylinder->setLocation(p_map.x(), p_map.y(), 0.0);
  cylinder->setColor(colour);
  return cylinder;
}

mrpt::opengl::CRenderizable::Ptr shapeOf(const Body& body) {
  constexpr double kHeight = 1.2;  // m
  const mrpt::img::TColorf colour(0.9f, 0.4f, 0.1f);
  const Pose2& T = body.T_map_body;
  if (body.shape == Body::Shape::kDisc) return disc(T.position(), body.radius(), kHeight, colour);
  const double x = body.half_size.x(), y = body.half_size.y();
  auto box = mrpt::opengl::CBox::Create(mrpt::math::TPoint3D(-x, -y, 0.0),
                                        mrpt::math::TPoint3D(x, y, kHeight));
  box->setPose(mrpt::poses::CPose2D(T.x, T.y, T.theta));
  box->setColor(colour);
  return box;
}

mrpt::opengl::CPointCloud::Ptr returnsOf(const Scan& scan) {
  auto points = mrpt::opengl::CPointCloud::Create();
  points->setPointSize(3.0f);
  points->setColor(mrpt::img::TColorf(0.8f, 0.1f, 0.1f));
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!isReturn(scan.ranges[beam])) continue;
    const double bearing = scan.bearing(beam), range = scan.ranges[beam];
    const Eigen::Vector2d p_map =
        scan.T_map_sensor * Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing));
    points->insertPoint(static_cast<float>(p_map.x()), static_cast<float>(p_map.y()), 0.3f);
  }
  return points;
}

class MrptWindow : public RunObserver {
 public:
  MrptWindow(const World& world, double robot_radius) : robot_radius_(robot_radius) {
    if (!std::getenv("DISPLAY")) {
      throw std::runtime_error("--gui: there is no display (DISPLAY is not set)");
    }
    window_ = mrpt::gui::CDisplayWindow3D::Create("cca-mrpt explore: " + world.name, 1200, 800);
    const Eigen::Vector2d size =
        world.resolution() * Eigen::Vector2d(world.width(), world.height());
    const Eigen::Vector2d middle = world.origin() + 0.5 * size;
    window_->setCameraPointingToPoint(static_cast<float>(middle.x()),
                                      static_cast<float>(middle.y()), 0.0f);
    window_->setCameraElevationDeg(70.0f);
    window_->setCameraAzimuthDeg(-90.0f);
    window_->setCameraZoom(static_cast<float>(1.3 * size.maxCoeff()));
  }

  bool isDue() const override {
    return window_->isOpen() && std::chrono::steady_clock::now() - last_ >= kEvery;
  }

  void show(const RunView& view) override {
    last_ = std::chrono::steady_clock::now();
    auto scene = makeScene(view.products());
    scene->insert(disc(view.moment.T_map_robot.position(), robot_radius_, 0.5,
                       mrpt::img::TColorf(0.1f, 0.3f, 0.8f)));
    scene->insert(returnsOf(view.scan));
    for (const Body& body : view.bodies) scene->insert(shapeOf(body));
    if (view.moment.goal) {
      scene->insert(disc(*view.moment.goal, 0.15, 1.5, mrpt::img::TColorf(0.1f, 0.7f, 0.2f)));
    }
    window_->get3DSceneAndLock() = scene;
    window_->unlockAccess3DScene();
    window_->forceRepaint();
  }

 private:
  double robot_radius_;  // m
  mrpt::gui::CDisplayWindow3D::Ptr window_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace
}  // namespace cca::apps

extern "C" cca::RunObserver* openRunWindow(const cca::World& world, double robot_radius) {
  return new cca::apps::MrptWindow(world, robot_radius);
}
