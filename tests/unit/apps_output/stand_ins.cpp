#include "stand_ins.hpp"

#include <cmath>
#include <numbers>

#include "box_of_water.hpp"

namespace splashdown::apps {

namespace {

Surface<2> outline(std::initializer_list<Vec<2>> points) {
  Surface<2> surface;
  const auto count = static_cast<Eigen::Index>(points.size());
  surface.vertices.resize(2, count);
  surface.facets.resize(2, count);
  Eigen::Index i = 0;
  for (const auto& point : points) {
    surface.vertices.col(i) = point;
    surface.facets.col(i) << static_cast<int>(i), static_cast<int>((i + 1) % count);
    ++i;
  }
  return surface;
}

// The wedge's frame has its origin two thirds up: the centre of mass.
Surface<2> wedge() {
  const double keel = -2 * wedge_height / 3, top = wedge_height / 3;
  return outline({{0, keel}, {wedge_half_breadth, top}, {-wedge_half_breadth, top}});
}

Surface<2> tank() {  // clockwise
  const double w = tank_half_width, low = -water_depth, high = 0.5;
  return outline({{-w, low}, {-w, high}, {w, high}, {w, low}});
}

struct Motion {
  double depth, velocity, acceleration, load, repair;
};

/// A smooth load pulse around 15 ms decelerates the wedge; the depth of the keel is negative above water.
Motion motion_at(double t) {
  const double peak = 26.7e3, centre = 0.015, width = 0.005;
  const double pulse = std::exp(-std::pow((t - centre) / width, 2));
  const double integral =
      0.5 * std::sqrt(std::numbers::pi) * width * (std::erf((t - centre) / width) + std::erf(centre / width));
  const double velocity = 6.15 - peak / 241 * integral;
  return {6.15 * t - 0.35 * 6.15 * t * t / drop_end, -velocity, peak / 241 * pulse, peak * pulse,
          40 * std::sin(5e3 * t)};
}

/// Height of the water's upper side: the wedge where it is wetted, a pile-up beside it, still water far away.
double top_of_water(double x, double depth) {
  const double slope = wedge_height / wedge_half_breadth;
  const double wetted = std::min(wedge_half_breadth, 1.5 * std::max(0.0, depth) / slope);
  if (std::abs(x) < wetted) return -depth + slope * std::abs(x);
  const double rise = -depth + slope * wetted;
  return std::max(0.0, rise) * std::pow(std::max(wetted, 1e-9) / std::max(std::abs(x), 1e-9), 4);
}

}  // namespace

StandInDrop::StandInDrop(int nodes_across) : nodes_across_(nodes_across) {
  fluid_.gravity = 9.81;
  fluid_.made = {{"wedge", wedge()}, {"tank", tank()}};
  fluid_.poses.resize(2, Isometry<2>::Identity());
  BodySpec<2> body;
  body.name = "wedge";
  body.surface = {wedge().vertices, wedge().facets};
  body.mass = 241;
  bodies_.specs.push_back(body);
  bodies_.states.push_back({body.pose, body.velocity});
  input_.fluid = &fluid_;
  input_.bodies = &bodies_;
}

Surface<2> StandInDrop::hull() { return wedge(); }

const RecordInput<2>& StandInDrop::at(double time, double dt) {
  const Motion motion = motion_at(time);
  auto& water = fluid_;
  auto& ledger = fluid_.books;
  auto& pose = fluid_.poses[0];
  pose = Isometry<2>::Identity();
  pose.translation() = Vec<2>(0, 2 * wedge_height / 3 - motion.depth);
  bodies_.states[0].pose = pose;

  const int across = nodes_across_, down = across / 2;
  water.x.clear(), water.v.clear(), water.p.clear(), water.places.clear(), water.simplices.clear(),
      water.facets.clear();
  const double wetted = std::min(wedge_half_breadth, 1.5 * motion.depth * wedge_half_breadth / wedge_height);
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= across; ++i) {
      const double u = 2.0 * i / across - 1, x = tank_half_width * (0.3 * u + 0.7 * u * u * u);
      const double top = top_of_water(x, motion.depth), s = static_cast<double>(j) / down;
      const double y = top - (top + water_depth) * (0.3 * s + 0.7 * s * s);
      water.x.emplace_back(x, y);
      water.v.emplace_back(0.2 * x, motion.velocity * std::exp(-4 * std::hypot(x, y)));
      const bool x_is_dry = std::abs(x) >= wetted;
      const double r = std::hypot(std::abs(x) - wetted, 2 * (y - top)) / 0.08;
      water.p.push_back(1000 * 9.81 * (top - y) + (x_is_dry ? 1 - std::exp(-60 * s) : 1.0) * motion.load *
                                                      (3 * std::exp(-r * r) + std::exp(-std::pow(x / 0.3, 2) - 6 * s)));
      const bool on_wedge = j == 0 && std::abs(x) < wetted, on_tank = j == down || i == 0 || i == across;
      water.places.push_back({on_wedge ? 0 : on_tank ? 1 : -1, false, j == 0 && !on_wedge});
    }
  const auto id = [&](int i, int j) { return j * (across + 1) + i; };
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      const int a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), e = id(i, j + 1);
      if (i < across / 2) {
        water.simplices.push_back({a, e, b});
        water.simplices.push_back({b, e, c});
      } else {
        water.simplices.push_back({a, e, c});
        water.simplices.push_back({a, c, b});
      }
    }
  const auto wall = [&](int point) { return water.places[static_cast<std::size_t>(point)].wall; };
  for (int i = 0; i < across; ++i) {
    const int a = id(i, 0), b = id(i + 1, 0);
    water.facets.push_back({{b, a}, wall(a) == 0 || wall(b) == 0 ? 0 : -1});
    water.facets.push_back({{id(i, down), id(i + 1, down)}, 1});
  }
  water.x.emplace_back(0.5, 0.2 + time);
  water.v.emplace_back(0, 1);
  water.p.push_back(0);
  water.places.push_back({.on_free_surface = true});
  water.drops = 1;
  water.volume_of_drop = std::numbers::pi / 4 * 0.01 * 0.01;  // of a centimetre

  ledger.volume_initial = 2 * tank_half_width * water_depth;
  ledger.time_integration = -2e-6 * time / drop_end;
  ledger.remesh_created = 2e-4 * time / drop_end;
  ledger.remesh_deleted = -1e-4 * std::pow(time / drop_end, 2);
  ledger.returned = -0.9 * (ledger.time_integration + ledger.remesh_created + ledger.remesh_deleted);
  ledger.volume =
      ledger.volume_initial + ledger.time_integration + ledger.remesh_created + ledger.remesh_deleted + ledger.returned;
  const double lost = 0.5 * 241 * (6.15 * 6.15 - motion.velocity * motion.velocity);
  ledger.kinetic_energy = 0.85 * lost;
  ledger.potential_energy = -2800 + 0.1 * lost;
  ledger.work_on_walls = -lost;
  ledger.energy_repair = -0.01 * lost;

  input_.body_velocity_n = {Twist<2>(0, motion.velocity, 0)};
  input_.body_acceleration_n = {Twist<2>(0, motion.acceleration, 0)};
  WallLoad<2> load;
  load.physical = Wrench<2>(0, motion.load, 0);
  load.repair = Wrench<2>(0, time > 0 ? motion.repair : 0, 0);
  load.wetted = 2 * std::max(0.0, wetted);
  input_.body_load = {load};
  input_.time = time;
  input_.dt = dt;
  input_.passes = time > 0.014 && time < 0.016 ? 2 : 1;
  input_.residual = 1e-9;
  input_.pass_residuals = {1e-9};
  if (input_.passes == 2) input_.pass_residuals = {1e-4, 1e-9};
  input_.wall_seconds = 400 * time;
  input_.last = false;
  return input_;
}

double press_at(double time) { return 20e3 * std::exp(-std::pow((time - 0.5 * drop_end) / (0.2 * drop_end), 2)); }

Surface<3> StandInPress::hull() {
  auto box = unit_box<3>();
  box.vertices.topRows<2>() *= 2 * press_half_length;
  box.vertices.row(2) *= 2 * press_half_height;
  return box;
}

// A block of cubes, six tetrahedra each around the diagonal; the box lies on the middle of its upper side.
StandInPress::StandInPress(int nodes_across) {
  Isometry<3> pose = Isometry<3>::Identity();
  pose.translation().z() = press_half_height;
  fluid_.made = {{"box", hull(), pose}};
  fluid_.poses = {pose};
  BodySpec<3> body;
  body.name = "box";
  body.surface = {hull().vertices, hull().facets};
  body.mass = 100;
  body.pose = pose;
  bodies_.specs.push_back(body);
  bodies_.states.push_back({body.pose, body.velocity});
  input_.fluid = &fluid_;
  input_.bodies = &bodies_;

  auto& water = fluid_;
  const int n = nodes_across, deep = n / 2;
  const double h = 2.0 / n;
  const auto id = [&](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= deep; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        water.x.emplace_back(i * h - 1, j * h - 1, (k - deep) * h);
        water.places.push_back({.on_free_surface = k == deep});
      }
  water.v.assign(water.x.size(), Vec<3>::Zero());
  water.p.assign(water.x.size(), 0);
  constexpr int paths[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};  // of a cube's corners, bits x y z
  for (int k = 0; k < deep; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto corner = [&](int c) { return id(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2)); };
        for (const auto& path : paths)
          water.simplices.push_back({corner(0), corner(path[0]), corner(path[1]), corner(7)});
        if (k + 1 < deep) continue;
        const auto under = [&](int c) { return std::abs((i + c) * h - 1) <= press_half_length + 1e-12; };
        const auto beside = [&](int c) { return std::abs((j + c) * h - 1) <= press_half_length + 1e-12; };
        const int wall = under(0) && under(1) && beside(0) && beside(1) ? 0 : -1;
        water.facets.push_back({{corner(4), corner(5), corner(7)}, wall});
        water.facets.push_back({{corner(4), corner(7), corner(6)}, wall});
      }
}

const RecordInput<3>& StandInPress::at(double time, double dt) {
  auto& water = fluid_;
  const double press = press_at(time), area = 4 * press_half_length * press_half_length;
  for (std::size_t i = 0; i < water.x.size(); ++i) water.p[i] = press - 9810 * water.x[i].z();
  Twist<3> velocity = Twist<3>::Zero(), acceleration = Twist<3>::Zero();
  acceleration(2) = press * area / 100;
  velocity(5) = 10;
  input_.body_velocity_n = {velocity};
  input_.body_acceleration_n = {acceleration};
  WallLoad<3> load;
  load.physical(2) = press * area;
  load.physical(3) = 0.1 * load.physical(2);
  load.wetted = area;
  input_.body_load = {load};
  input_.time = time;
  input_.dt = dt;
  input_.passes = 1;
  return input_;
}

}  // namespace splashdown::apps
