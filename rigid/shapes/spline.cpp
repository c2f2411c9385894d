#include "rigid/shapes/spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/Splines>

#include "rigid/message.hpp"
#include "rigid/shapes/solids.hpp"

namespace splashdown::rigid {
namespace {

using Curve = Eigen::Spline<double, 2>;

constexpr int highest_degree = 5;
constexpr std::size_t most_chords = 100'000;

void require_spline(const Spline& spline) {
  if (spline.degree < 1 || spline.degree > highest_degree)
    throw std::invalid_argument(
        message("spline: degree ", spline.degree, "; it must lie between 1 and ", highest_degree));
  const auto least = spline.closed ? std::max(3, spline.degree + 1) : spline.degree + 1;
  if (static_cast<int>(spline.points.size()) < least)
    throw std::invalid_argument(message("spline: ", spline.points.size(), " control points; ",
                                        spline.closed ? "a closed" : "an open", " one of degree ", spline.degree,
                                        " needs at least ", least));
  for (std::size_t i = 0; i < spline.points.size(); ++i)
    if (!spline.points[i].allFinite())
      throw std::invalid_argument(message("spline: control point ", i + 1, " is not finite"));
}

double extent_of(const std::vector<Vec<2>>& points) {
  Eigen::AlignedBox2d box;
  for (const auto& point : points) box.extend(point);
  return box.sizes().maxCoeff();
}

/// The spans of knots that the curve runs over are [k, k + 1] for k from the degree on.
struct Spans {
  Curve curve;
  std::vector<double> knots;  ///< ends of the spans
};

Spans spans_of(const Spline& spline) {
  const auto n = static_cast<Eigen::Index>(spline.points.size()), p = static_cast<Eigen::Index>(spline.degree);
  const Eigen::Index wrapped = spline.closed ? p : 0, count = n + wrapped, spans = count - p;
  Curve::ControlPointVectorType control(2, count);
  for (Eigen::Index i = 0; i < count; ++i) control.col(i) = spline.points[static_cast<std::size_t>(i % n)];
  Curve::KnotVectorType knots(count + p + 1);
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const auto at = static_cast<double>(i - p);
    knots[i] = spline.closed ? at : std::clamp(at, 0., static_cast<double>(spans));
  }
  std::vector<double> ends;
  for (Eigen::Index k = 0; k <= spans; ++k) ends.push_back(static_cast<double>(k));
  return {Curve(knots, control), ends};
}

/// Chords of a curve, halved until they are near enough.
class Sampler {
 public:
  Sampler(const Curve& curve, double tolerance) : curve_(curve), tolerance_(tolerance) {}

  Vec<2> at(double u) const { return curve_(u).matrix(); }
  /// Without the point at its beginning.
  void add(double from, double to) {
    const double step = (to - from) / pieces;
    std::array<Vec<2>, pieces + 1> x;
    for (std::size_t i = 0; i <= pieces; ++i) x[i] = at(from + static_cast<double>(i) * step);
    if (near_enough(x)) {
      points.push_back(x.back());
      if (points.size() > most_chords)
        throw std::invalid_argument(
            message("spline: a tolerance of ", tolerance_, " m needs more than ", most_chords, " chords"));
      return;
    }
    const double middle = 0.5 * (from + to);
    add(from, middle);
    add(middle, to);
  }

  std::vector<Vec<2>> points;

 private:
  static constexpr std::size_t pieces = 4;

  bool near_enough(const std::array<Vec<2>, pieces + 1>& x) const {
    const Vec<2> chord = x.back() - x.front();
    const double length = chord.norm();
    double turned = 0, way = 0;
    Vec<2> last = Vec<2>::Zero();
    for (std::size_t i = 1; i <= pieces; ++i) {
      const Vec<2> piece = x[i] - x[i - 1];
      const double off = length > 0 ? std::abs(chord.x() * (x[i] - x[0]).y() - chord.y() * (x[i] - x[0]).x()) / length
                                    : (x[i] - x[0]).norm();
      if (off > tolerance_) return false;
      if (i > 1 && piece.norm() > 0 && last.norm() > 0)
        turned += std::abs(std::atan2(last.x() * piece.y() - last.y() * piece.x(), last.dot(piece)));
      if (piece.norm() > 0) last = piece;
      way += piece.norm();
    }
    // What is shorter than the tolerance may turn as it likes: the inside of a bend that is as good as a corner.
    return way <= tolerance_ || turned <= largest_turn;
  }

  const Curve& curve_;
  double tolerance_;
};

std::vector<Vec<2>> sampled_within(const Spline& spline, double tolerance) {
  const auto [curve, ends] = spans_of(spline);
  Sampler sampler(curve, tolerance);
  sampler.points.push_back(sampler.at(ends.front()));
  for (std::size_t k = 1; k < ends.size(); ++k) sampler.add(ends[k - 1], ends[k]);
  // Spans between equal control points are points.
  auto& points = sampler.points;
  const double same = 1e-9 * extent_of(points);
  const auto repeated = [&](const Vec<2>& a, const Vec<2>& b) { return (a - b).norm() <= same; };
  points.erase(std::unique(points.begin(), points.end(), repeated), points.end());
  while (spline.closed && points.size() > 1 && repeated(points.front(), points.back())) points.pop_back();
  return points;
}

double tolerance_of(const Spline& spline) {
  constexpr double as_of_a_circle = 5e-5;
  return spline.tolerance > 0 ? spline.tolerance : as_of_a_circle * extent_of(spline.points);
}

/// For mass properties, whose errors go with the tolerance.
std::vector<Vec<2>> finely_sampled(const Spline& spline) {
  constexpr double finer = 1e-4;
  Spline fine = spline;
  fine.tolerance = std::max(finer * tolerance_of(spline), 1e-9 * extent_of(spline.points));
  return sampled_within(fine, fine.tolerance);
}

}  // namespace

std::vector<Vec<2>> sampled(const Spline& spline) {
  require_spline(spline);
  return sampled_within(spline, tolerance_of(spline));
}

Shape<2> outline_of(const Spline& spline) {
  auto points = sampled(spline);
  // An open curve that ends where it began is closed already.
  if (points.size() > 1 && (points.front() - points.back()).norm() <= 1e-9 * extent_of(points)) points.pop_back();
  Shape<2> shape;
  try {
    shape = polygon(points);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(
        message("spline: its curve is no outline. As ", points.size(), " chords: ", error.what()));
  }
  auto fine = finely_sampled(spline);
  if (signed_area(fine) < 0) std::ranges::reverse(fine);
  shape.at_unit_density = mass_properties(closed_polyline(fine));
  return shape;
}

Shape<3> solid_of(const Spline& spline) {
  if (spline.closed)
    throw std::invalid_argument("spline: a closed curve is no profile; it must begin and end at the axis");
  auto shape = revolved(sampled(spline));
  shape.at_unit_density = mass_properties_of_revolution(finely_sampled(spline));
  return shape;
}

}  // namespace splashdown::rigid
