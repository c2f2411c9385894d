// A program that knows the installed package only: one step of a circle under water.
#include <cstdio>

#include "coupling/schemes/steppers.hpp"
#include "rigid/shapes/hydrostatics.hpp"
#include "rigid/shapes/shapes.hpp"

namespace sp = splashdown;

namespace {

sp::fluid::Surface<2> rectangle(double x0, double y0, double x1, double y1) {
  sp::fluid::Surface<2> s{Eigen::Matrix2Xd(2, 4), Eigen::Matrix2Xi(2, 4)};
  s.vertices << x0, x1, x1, x0, y0, y0, y1, y1;
  s.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  return s;
}

}  // namespace

int main() {
  const auto shape = sp::rigid::circle(0.5, 64);
  sp::rigid::BodySpec<2> body;
  body.name = "circle";
  body.surface = shape.surface;
  body.mass = 300;
  body.inertia.setConstant(40);
  body.free.fill(true);
  body.pose.translate(Eigen::Vector2d(0, -1.5));

  sp::fluid::FluidSpec<2> spec;
  spec.size = {.surface = 0.3, .far = 0.3};
  spec.liquids.push_back({rectangle(-2, -3, 2, 0), {}});
  sp::fluid::WallSpec<2> hull, tank;
  hull.name = body.name;
  hull.surface = {body.surface.vertices, body.surface.facets};
  hull.pose = body.pose;
  hull.size = 0.15;
  tank.name = "tank";
  tank.surface = rectangle(-2, -3, 2, 1);
  tank.surface.facets.row(0).swap(tank.surface.facets.row(1));
  tank.size = 0.3;
  spec.walls = {hull, tank};

  const Eigen::Vector2d g(0, -9.81);
  std::vector<std::unique_ptr<sp::fluid::Term<2>>> terms;
  terms.push_back(std::make_unique<sp::fluid::Gravity<2>>(g));
  std::vector<std::unique_ptr<sp::rigid::Force<2>>> forces;
  forces.push_back(std::make_unique<sp::rigid::Gravity<2>>(g));
  sp::coupling::Simultaneous<2> stepper(std::make_unique<sp::fluid::Fluid<2>>(spec, std::move(terms)),
                                        std::make_unique<sp::rigid::Bodies<2>>(std::vector{body}, std::move(forces)));
  const auto report = stepper.attempt(1e-3);
  if (!report.ok()) return std::puts(report.cause.c_str()), 1;
  stepper.commit();
  const double up = stepper.bodies().state(0).velocity[1];
  std::printf("after %g s the circle rises at %g m/s\n", stepper.time(), up);
  return up > 0 ? 0 : 1;
}
