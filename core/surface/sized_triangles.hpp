// What Delaunay refinement asks of triangles whose size varies: CGAL's concept MeshingCriteria_2.
#pragma once

#include <CGAL/Mesh_2/Face_badness.h>

#include <algorithm>
#include <functional>

#include "core/types.hpp"

namespace splashdown {

/// No angle below 20.7 degrees, no edge longer than is wanted in the middle of a triangle.
template <class Triangulation>
class SizedTriangles {
 public:
  /// Of a triangle.
  struct Quality {
    double sine = 0, size = 0;  ///< square of the least sine, of the longest edge over what is wanted
    /// Whether it is to be refined first.
    bool operator<(const Quality& other) const {
      if (size > 1 || other.size > 1) return size > other.size;
      return sine < other.sine;
    }
  };
  /// As CGAL calls it.
  class Is_bad {
   public:
    /// `wanted` is not owned.
    explicit Is_bad(const std::function<double(const Vec<2>&)>& wanted) : wanted_(&wanted) {}
    /// Of a triangle that was looked at before.
    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
      constexpr double least_sine = 0.125;  // that refinement is proven to end with
      if (quality.size > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return quality.sine < least_sine ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    /// Looks at a triangle.
    CGAL::Mesh_2::Face_badness operator()(const typename Triangulation::Face_handle& face, Quality& quality) const {
      Vec<2> x[3];
      for (int k = 0; k < 3; ++k) x[k] = {face->vertex(k)->point().x(), face->vertex(k)->point().y()};
      double edges[3];
      for (int k = 0; k < 3; ++k) edges[k] = (x[(k + 1) % 3] - x[k]).squaredNorm();
      std::sort(edges, edges + 3);
      const Vec<2> a = x[1] - x[0], b = x[2] - x[0];
      const double twice = a.x() * b.y() - a.y() * b.x();
      quality.sine = twice * twice / (edges[1] * edges[2]);
      const double wanted = (*wanted_)((x[0] + x[1] + x[2]) / 3);
      quality.size = edges[2] / (wanted * wanted);
      return (*this)(quality);
    }

   private:
    const std::function<double(const Vec<2>&)>* wanted_;
  };
  /// `wanted`: longest edges by place [m].
  explicit SizedTriangles(std::function<double(const Vec<2>&)> wanted) : wanted_(std::move(wanted)) {}
  /// As CGAL asks for it; holds as long as this.
  Is_bad is_bad_object() const { return Is_bad(wanted_); }

 private:
  std::function<double(const Vec<2>&)> wanted_;
};

}  // namespace splashdown
