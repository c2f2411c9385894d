// Hulls as people draw them: lofted along x through sections, closed, normals outward.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "rigid/shapes/mass_properties.hpp"

namespace splashdown::apps::testing {

using Section = std::vector<Eigen::Vector2d>;  // (y, z) around

/// Triangles between sections of equally many points, with fans over both ends.
inline Surface<3> loft(const std::vector<double>& x, const std::vector<Section>& sections) {
  const int n = static_cast<int>(sections.front().size()), m = static_cast<int>(x.size());
  Surface<3> s{Eigen::Matrix3Xd(3, m * n + 2), Eigen::Matrix3Xi(3, 2 * n * m)};
  for (int i = 0; i < m; ++i)
    for (int k = 0; k < n; ++k) s.vertices.col(i * n + k) << x[i], sections[i][k];
  for (const int end : {0, m - 1})
    s.vertices.col(m * n + (end > 0)) = s.vertices.middleCols(end * n, n).rowwise().mean();
  int f = 0;
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n, last = (m - 1) * n;
    for (int i = 0; i + 1 < m; ++i) {
      s.facets.col(f++) << i * n + k, (i + 1) * n + k, (i + 1) * n + next;
      s.facets.col(f++) << i * n + k, (i + 1) * n + next, i * n + next;
    }
    s.facets.col(f++) << m * n, k, next;
    s.facets.col(f++) << m * n + 1, last + next, last + k;
  }
  return s;
}

inline Surface<3> turned_over(Surface<3> s) {
  s.facets.row(1).swap(s.facets.row(2));
  return s;
}

inline Surface<3> outward(const Surface<3>& s) {
  try {
    rigid::mass_properties<3>(s);
    return s;
  } catch (const std::invalid_argument&) {
    return turned_over(s);
  }
}

inline Surface<3> moved(Surface<3> s, const Vec<3>& by) {
  s.vertices.colwise() += by;
  return s;
}

inline Surface<3> joined(const Surface<3>& a, const Surface<3>& b) {
  Surface<3> s{Eigen::Matrix3Xd(3, a.vertices.cols() + b.vertices.cols()),
               Eigen::Matrix3Xi(3, a.facets.cols() + b.facets.cols())};
  s.vertices << a.vertices, b.vertices;
  s.facets << a.facets, (b.facets.array() + static_cast<int>(a.vertices.cols())).matrix();
  return s;
}

inline Surface<3> without_facets(Surface<3> s, int first, int count) {
  Eigen::Matrix3Xi left(3, s.facets.cols() - count);
  left << s.facets.leftCols(first), s.facets.rightCols(s.facets.cols() - first - count);
  s.facets = left;
  return s;
}

inline Surface<3> block(const Vec<3>& size, const Vec<3>& centre = Vec<3>::Zero()) {
  const Vec<3> h = 0.5 * size;
  const Section around = {{-h.y(), -h.z()}, {h.y(), -h.z()}, {h.y(), h.z()}, {-h.y(), h.z()}};
  return moved(outward(loft({-h.x(), h.x()}, {around, around})), centre);
}

/// A float with a hard chine, its bow drawn in and up.
inline Surface<3> chine_float(double length, double breadth, double height, double deadrise_deg) {
  std::vector<double> x;
  std::vector<Section> sections;
  const int parts = 12;
  for (int i = 0; i <= parts; ++i) {
    const double share = i / static_cast<double>(parts), bow = std::max(0., share - 0.6) / 0.4;
    const double w = 0.5 * breadth * std::max(0.05, 1 - bow * bow), keel = 0.4 * height * bow * bow;
    const double chine = keel + w * std::tan(deadrise_deg * std::numbers::pi / 180),
                 top = std::max(height, chine + 0.1 * height);
    x.push_back(length * (share - 0.5));
    sections.push_back({{0, keel}, {w, chine}, {w, top}, {-w, top}, {-w, chine}});
  }
  return outward(loft(x, sections));
}

/// A body with wings that swell out of it; sections are ellipses.
inline Surface<3> winged(double length, double span, double height) {
  std::vector<double> x;
  std::vector<Section> sections;
  const int parts = 20, around = 20;
  for (int i = 0; i <= parts; ++i) {
    const double share = (i + 0.5) / (parts + 1), full = std::sqrt(std::sin(std::numbers::pi * share));
    const double wing = std::exp(-std::pow((share - 0.45) / 0.15, 2));
    const double half = 0.5 * (0.15 * length * full + 0.85 * span * wing), high = 0.5 * height * full;
    Section section;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      section.emplace_back(half * std::cos(angle), high * std::sin(angle));
    }
    x.push_back(length * (share - 0.5));
    sections.push_back(section);
  }
  return outward(loft(x, sections));
}

inline Surface<3> catamaran(double length, double breadth, double height, double deadrise_deg) {
  const auto hull = chine_float(length, 0.25 * breadth, height, deadrise_deg);
  return joined(moved(hull, {0, -0.375 * breadth, 0}), moved(hull, {0, 0.375 * breadth, 0}));
}

inline Surface<3> ball(double diameter) {
  std::vector<double> x;
  std::vector<Section> sections;
  const int parts = 16, around = 24;
  for (int i = 0; i < parts; ++i) {
    const double polar = std::numbers::pi * (i + 0.5) / parts, r = 0.5 * diameter * std::sin(polar);
    Section section;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      section.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    x.push_back(-0.5 * diameter * std::cos(polar));
    sections.push_back(section);
  }
  return outward(loft(x, sections));
}

}  // namespace splashdown::apps::testing
