// CGAL's Delaunay triangulation in space, for delaunay.cpp and delaunay_patch.hpp alone.
#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "fluid/types.hpp"

namespace splashdown::fluid {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Vertices and cells carry their number.
template <class Concurrency>
using TriangulationInSpace = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>,
                                                 CGAL::Triangulation_cell_base_with_info_3<
                                                     int, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>,
                                                 Concurrency>>;

inline Kernel::Point_3 cgal_point(const Vec<3>& x) { return {x.x(), x.y(), x.z()}; }

}  // namespace splashdown::fluid
