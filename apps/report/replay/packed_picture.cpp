#include "apps/report/replay/packed_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/report/replay/mesh_code.hpp"

namespace splashdown::apps {
namespace {

using Place = std::array<double, 3>;
using Steps = std::array<std::int32_t, 3>;

/// The value that a share of these is below; 0: there are none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, nth);
  return *nth;
}

/// Where the colours end, and whether something lies beyond. In space one point of a hull in twenty feels more at some time:
/// noise in time does not count, and of all times most are calm. In the plane few points of hulls and not most of the water are
/// above it.
std::pair<double, bool> colour_limit(const MovingPicture& picture) {
  constexpr double of_highest = 0.95, of_hulls = 0.995, of_water = 0.9;
  std::vector<double> at_hulls, in_water, highest;
  const auto add = [](std::vector<double>& all, const std::vector<double>& pressures) {
    std::ranges::copy_if(pressures, std::back_inserter(all), [](double p) { return p > 0; });
  };
  if (picture.dimension == 3 && !picture.frames.empty()) {
    for (std::size_t b = 0; b < picture.names.size(); ++b) {
      auto most = picture.frames.front().bodies[b].pressure;
      for (const auto& frame : picture.frames)
        for (std::size_t i = 0; i < std::min(most.size(), frame.bodies[b].pressure.size()); ++i)
          most[i] = std::max(most[i], frame.bodies[b].pressure[i]);
      add(highest, most);
    }
    const double limit = quantile(highest, of_highest);
    return {limit, std::ranges::any_of(highest, [&](double p) { return p > limit; })};
  }
  for (const auto& frame : picture.frames) {
    add(in_water, frame.water.pressure);
    for (const auto& body : frame.bodies) add(at_hulls, body.pressure);
  }
  const double limit = std::max(quantile(at_hulls, of_hulls), quantile(in_water, of_water));
  const auto beyond = [&](const std::vector<double>& all) {
    return std::ranges::any_of(all, [&](double p) { return p > limit; });
  };
  return {limit, beyond(at_hulls) || beyond(in_water)};
}

std::size_t index_of(int number) { return static_cast<std::size_t>(number); }

/// All that is seen: its low corner, and the step of its places [m].
struct Lattice {
  Place low{0, 0, 0};
  double step = 1;

  explicit Lattice(const MovingPicture& picture) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Place high{-far, -far, -far};
    low = {far, far, far};
    std::vector<double> edges;
    for (const auto& frame : picture.frames) {
      look(frame.water, 3, high, edges);
      for (const auto& body : frame.bodies)
        look(body, &frame == &picture.frames.front() ? picture.dimension : 0, high, edges);
    }
    if (!(low[0] <= high[0])) low = high = {0, 0, 0};
    constexpr double of_edge = 1. / 32, shorter = 0.01;
    // Differences of places have to fit into 32 bits.
    const double width = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    step = std::max({of_edge * quantile(std::move(edges), shorter), std::ldexp(width, -24), 1e-300});
    // Whole steps from the mirror plane: both halves meet.
    if (picture.mirror) {
      double& begin = low[index_of(picture.mirror->axis)];
      begin = picture.mirror->at - std::ceil((picture.mirror->at - begin) / step) * step;
    }
  }
  Steps of(const Place& x) const {
    Steps steps{};
    for (std::size_t k = 0; k < 3; ++k) steps[k] = static_cast<std::int32_t>(std::lround((x[k] - low[k]) / step));
    return steps;
  }

 private:
  /// `corners` of a cell, 0: its edges do not count.
  void look(const MovingPart& part, int corners, Place& high, std::vector<double>& edges) {
    for (const auto& x : part.points)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
    if (corners == 0) return;
    const auto count = index_of(corners);
    for (std::size_t c = 0; c < part.cells.size(); ++c) {
      const auto next = c % count + 1 < count ? c + 1 : c + 1 - count;
      const auto &a = part.points[index_of(part.cells[c])], &b = part.points[index_of(part.cells[next])];
      edges.push_back(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
};

/// The lowest bit is the sign.
std::uint32_t folded(std::int32_t difference) {
  return difference < 0 ? ~(static_cast<std::uint32_t>(difference) << 1) : static_cast<std::uint32_t>(difference) << 1;
}

class Packer {
 public:
  Packer(const MovingPicture& picture, const Lattice& lattice, double limit)
      : picture_(picture), lattice_(lattice), limit_(limit) {}

  void add_body(const MovingPart& body) {
    if (picture_.dimension == 3) {
      orders_.push_back(add_triangles(body, false).order);
    } else {
      std::vector<int> order(body.points.size());
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
      Steps before{};
      for (const auto& x : body.points) before = add_place(x, before);
      int last = 0;
      for (const int point : body.cells) segments_.push_back(folded(point - std::exchange(last, point)));
      orders_.push_back(std::move(order));
    }
    felt_.emplace_back(orders_.back().size(), std::uint8_t{0});
    bent_.emplace_back(orders_.back().size(), Steps{});
  }

  nlohmann::json add_water(const MovingPart& water) {
    const auto code = add_triangles(water, picture_.dimension == 2);
    return {{"points", code.order.size()},
            {"cells", water.cells.size()},
            {"steps", code.steps.size()},
            {"references", code.references.size()}};
  }

  void add_pressures(std::size_t body, const MovingPart& part) {
    for (std::size_t i = 0; i < felt_[body].size(); ++i) {
      const auto now = level(part.pressure[index_of(orders_[body][i])]);
      hulls_.push_back(static_cast<std::uint8_t>(now - std::exchange(felt_[body][i], now)));
    }
  }

  /// `bends`: of its points beside the rigid motion, in the first frame's place [m].
  void add_bends(std::size_t body, const Eigen::Matrix3Xd& bends) {
    auto& before = bent_[body];
    for (std::size_t i = 0; i < orders_[body].size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto now = static_cast<std::int32_t>(
            std::lround(bends(static_cast<Eigen::Index>(k), orders_[body][i]) / lattice_.step));
        bends_[k].push_back(folded(now - std::exchange(before[i][k], now)));
      }
  }

  std::size_t points_of(std::size_t body) const { return orders_[body].size(); }

  /// What the arrays are, and their bytes.
  nlohmann::json write(std::string& bytes) const {
    nlohmann::json arrays = nlohmann::json::array();
    const auto write_array = [&]<class Number>(const char* name, const std::vector<Number>& numbers) {
      arrays.push_back({{"name", name}, {"size", sizeof(Number)}, {"count", numbers.size()}});
      for (std::size_t byte = 0; byte < sizeof(Number); ++byte)
        for (const Number number : numbers) bytes.push_back(static_cast<char>((number >> (8 * byte)) & 0xff));
    };
    write_array("steps", steps_);
    write_array("references", references_);
    for (std::size_t k = 0; k < 3; ++k) write_array(std::array{"x", "y", "z"}[k], places_[k]);
    write_array("segments", segments_);
    write_array("water", water_);
    write_array("hulls", hulls_);
    for (std::size_t k = 0; k < 3; ++k) write_array(std::array{"bends_x", "bends_y", "bends_z"}[k], bends_[k]);
    return arrays;
  }

 private:
  MeshCode add_triangles(const MovingPart& part, bool with_pressure) {
    auto code = mesh_code(part.cells, part.points.size());
    std::vector<Steps> places;
    std::vector<std::uint8_t> levels;
    for (std::size_t i = 0; i < code.order.size(); ++i) {
      const auto& [u, w, o] = code.expected[i];
      const auto point = index_of(code.order[i]);
      Steps expected{};
      if (u >= 0)
        for (std::size_t k = 0; k < 3; ++k)
          expected[k] = places[index_of(u)][k] + places[index_of(w)][k] - places[index_of(o)][k];
      places.push_back(add_place(part.points[point], expected));
      if (!with_pressure) continue;
      levels.push_back(level(part.pressure[point]));
      const int guess = u < 0 ? 0 : levels[index_of(u)] + levels[index_of(w)] - levels[index_of(o)];
      water_.push_back(static_cast<std::uint8_t>(levels.back() - std::clamp(guess, 0, 255)));
    }
    steps_.insert(steps_.end(), code.steps.begin(), code.steps.end());
    references_.insert(references_.end(), code.references.begin(), code.references.end());
    return code;
  }

  Steps add_place(const Place& x, const Steps& expected) {
    const auto place = lattice_.of(x);
    for (std::size_t k = 0; k < 3; ++k) places_[k].push_back(folded(place[k] - expected[k]));
    return place;
  }

  std::uint8_t level(double pressure) const {
    return limit_ > 0 ? static_cast<std::uint8_t>(std::lround(255 * std::clamp(pressure / limit_, 0., 1.)))
                      : std::uint8_t{0};
  }

  const MovingPicture& picture_;
  const Lattice& lattice_;
  double limit_;
  std::vector<std::vector<int>> orders_;         // of each body: the old number of each point
  std::vector<std::vector<std::uint8_t>> felt_;  // of each body: pressures of the frame before
  std::vector<std::vector<Steps>> bent_;         // likewise what it is bent
  std::vector<std::uint8_t> steps_, water_, hulls_;
  std::vector<std::uint32_t> references_, segments_;
  std::array<std::vector<std::uint32_t>, 3> places_, bends_;
};

/// How a body's points come from its first frame to another: a rigid motion of points that are bent.
struct Motion {
  std::array<double, 7> pose{0, 0, 0, 0, 0, 0, 1};  // x, y, z, qx, qy, qz, qw
  Eigen::Matrix3Xd bends;                           // in the first frame's place [m]
};

/// The rigid motion fits best (Umeyama 1991). Throws for other points.
Motion motion_of(const MovingPart& first, const MovingPart& now, const std::string& name) {
  if (now.points.size() != first.points.size())
    throw std::runtime_error(fmt::format("the hull of {} has other points in another frame", name));
  Motion motion;
  if (first.points.empty()) return motion;
  const auto matrix = [](const MovingPart& part) {
    return Eigen::Map<const Eigen::Matrix3Xd>(part.points.front().data(), 3,
                                              static_cast<Eigen::Index>(part.points.size()));
  };
  const Eigen::Isometry3d rigid(Eigen::umeyama(matrix(first), matrix(now), false));
  motion.bends = rigid.inverse() * matrix(now) - matrix(first);
  const Eigen::Quaterniond q(rigid.linear());
  const auto& x = rigid.translation();
  motion.pose = {x.x(), x.y(), x.z(), q.x(), q.y(), q.z(), q.w()};
  return motion;
}

/// Of each body, in each frame.
std::vector<std::vector<Motion>> motions_of(const MovingPicture& picture) {
  std::vector<std::vector<Motion>> all(picture.names.size());
  for (std::size_t b = 0; b < all.size(); ++b)
    for (const auto& frame : picture.frames)
      all[b].push_back(motion_of(picture.frames.front().bodies[b], frame.bodies[b], picture.names[b]));
  return all;
}

/// Whether places on the lattice show it.
bool bends(const std::vector<Motion>& motions, double step) {
  return std::ranges::any_of(motions, [&](const Motion& motion) {
    return motion.bends.size() > 0 && !(motion.bends.cwiseAbs().maxCoeff() <= step);
  });
}

}  // namespace

PackedPicture packed(const MovingPicture& picture) {
  PackedPicture result;
  const Lattice lattice(picture);
  const auto [limit, is_exceeded] = colour_limit(picture);
  result.limit = limit;
  result.step = lattice.step;
  nlohmann::json json{{"dimension", picture.dimension},
                      {"names", picture.names},
                      {"low", lattice.low},
                      {"step", lattice.step},
                      {"pressure", result.limit},
                      {"above", is_exceeded},
                      {"bodies", nlohmann::json::array()}};
  if (picture.mirror) json["mirror"] = {{"axis", picture.mirror->axis}, {"at", picture.mirror->at}};
  Packer packer(picture, lattice, result.limit);
  const auto motions = motions_of(picture);
  const std::vector<MovingPart> none;
  const auto& bodies = picture.frames.empty() ? none : picture.frames.front().bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    packer.add_body(bodies[b]);
    json["bodies"].push_back({{"points", packer.points_of(b)},
                              {"cells", bodies[b].cells.size()},
                              {"bends", bends(motions[b], lattice.step)}});
  }
  for (std::size_t f = 0; f < picture.frames.size(); ++f) {
    const auto& frame = picture.frames[f];
    auto entry = packer.add_water(frame.water);
    entry["time"] = frame.time;
    entry["poses"] = nlohmann::json::array();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      entry["poses"].push_back(motions[b][f].pose);
      packer.add_pressures(b, frame.bodies[b]);
      if (json["bodies"][b]["bends"]) packer.add_bends(b, motions[b][f].bends);
    }
    json["frames"].push_back(std::move(entry));
  }
  json["arrays"] = packer.write(result.bytes);
  result.json = json.dump();
  return result;
}

}  // namespace splashdown::apps
