// SPDX-License-Identifier: BSD-3-Clause
//
// draw_traps DIR: drives through each trap, writes DIR/<trap>.svg and prints the table of
// docs/tangent_bug.md.
#include <cstdio>
#include <fstream>
#include <string>

#include "path_bound.hpp"
#include "tangent_run.hpp"

namespace cca::testing {
namespace {

constexpr double kPixels = 40.0;    // a metre
constexpr double kGoalMark = 0.12;  // m

// The picture's y axis points down.
class Picture {
 public:
  Picture(const std::string& path, double width, double height) : out_(path), height_(height) {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" << -0.2 * kPixels << ' '
         << -0.2 * kPixels << ' ' << (width + 0.4) * kPixels << ' ' << (height + 0.4) * kPixels
         << "\" width=\"" << width * kPixels << "\">\n<rect x=\"-10\" y=\"-10\" width=\"100%\" "
         << "height=\"100%\" fill=\"white\"/>\n";
  }
  ~Picture() { out_ << "</svg>\n"; }

  void box(const Box& b) {
    out_ << "<rect x=\"" << b.low.x() * kPixels << "\" y=\"" << y(b.high.y()) << "\" width=\""
         << (b.high - b.low).x() * kPixels << "\" height=\"" << (b.high - b.low).y() * kPixels
         << "\" fill=\"#444\"/>\n";
  }
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const char* colour, double width) {
    out_ << "<line x1=\"" << a.x() * kPixels << "\" y1=\"" << y(a.y()) << "\" x2=\""
         << b.x() * kPixels << "\" y2=\"" << y(b.y()) << "\" stroke=\"" << colour
         << "\" stroke-width=\"" << width << "\" stroke-linecap=\"round\"/>\n";
  }
  void disc(const Eigen::Vector2d& p, double radius, const char* fill, const char* stroke) {
    out_ << "<circle cx=\"" << p.x() * kPixels << "\" cy=\"" << y(p.y()) << "\" r=\""
         << radius * kPixels << "\" fill=\"" << fill << "\" stroke=\"" << stroke << "\"/>\n";
  }

 private:
  double y(double metres) const { return (height_ - metres) * kPixels; }
  std::ofstream out_;
  double height_;
};

void draw(const Trap& trap, const std::string& directory) {
  const double height = trap.name == "comb" ? 6.0 : trap.size;
  Picture picture(directory + "/" + trap.name + ".svg", trap.size, height);
  for (const Box& box : trap.world.boxes) picture.box(box);
  const RobotParameters robot;
  TangentBug bug(robot);
  bug.setGoal(trap.goal);
  Pose2 pose = trap.start;
  Velocity velocity;
  bool graph_drawn = false;
  for (int i = 0; i < 4000; ++i) {
    const Velocity command = bug.step(trap.world.scan(pose, 8.0), pose, velocity, 0.1 * i);
    const bool following = bug.state() == TangentBugState::kBoundaryFollowing;
    if (!graph_drawn && (following || i == 20)) {
      for (const TangentNode& node : bug.tangentGraph()) {
        picture.line(pose.position(), node.p_map, "#9c9", 1.5);
        picture.disc(node.p_map, 0.06, "#393", "none");
      }
      graph_drawn = true;
    }
    const Eigen::Vector2d before = pose.position();
    drive(command, robot, 0.1, pose, velocity);
    picture.line(before, pose.position(), following ? "#d60" : "#06c", 3.0);
    if (bug.state() == TangentBugState::kReached || bug.state() == TangentBugState::kUnreachable) {
      break;
    }
  }
  picture.disc(trap.start.position(), robot.radius, "none", "#06c");
  picture.disc(pose.position(), robot.radius, "none", "#d60");
  picture.disc(trap.goal, kGoalMark, "#c00", "none");
}

void tabulate(const Trap& trap) {
  const TangentRun end = run(trap.world, trap.start, trap.goal);
  std::printf("| %s | %s | %.1f | ", trap.name.c_str(),
              end.state == TangentBugState::kReached ? "reached" : "unreachable", end.distance);
  const double shortest = shortestWay(trap, trap.size, 0.3);
  if (std::isfinite(shortest)) {
    std::printf("%.1f", shortest);
  } else {
    std::printf("none");
  }
  std::printf(" | %.0f | %.3f |\n", tangentBugBound(trap, 0.3), end.clearance);
}

}  // namespace
}  // namespace cca::testing

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_traps DIR\n");
    return 2;
  }
  std::printf(
      "| trap | verdict | path m | shortest m | bound m | clearance m |\n"
      "|---|---|---|---|---|---|\n");
  for (const cca::testing::Trap& trap : cca::testing::allTraps()) {
    cca::testing::draw(trap, argv[1]);
    cca::testing::tabulate(trap);
  }
}
