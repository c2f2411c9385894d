#include "python/hydrostatics.hpp"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "apps/statistics/attitude.hpp"
#include "core/surface/surface_file.hpp"
#include "rigid/shapes/hydrostatics.hpp"
#include "rigid/shapes/mass_properties.hpp"

namespace py = pybind11;

namespace splashdown {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// A hull and its mass on still water at z = 0; lengths in metres, angles in degrees.
struct Afloat {
  double volume = 0;  ///< of the hull
  double mass = 0;
  Eigen::Vector3d centre_of_mass = Eigen::Vector3d::Zero();  ///< in the file's frame
  bool floats = false;
  // Where it does not float these mean nothing.
  double displacement = 0, draft = 0, heel = 0, trim = 0, waterplane = 0, gm_roll = 0, gm_pitch = 0;
  double freeboard = std::numeric_limits<double>::infinity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the centre of mass
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  std::vector<double> heels, levers, trims;  ///< the curve of static stability
};

/// Where a hull lies and what is in it.
struct Laden {
  std::filesystem::path hull;
  double mass, scale, density;
  std::optional<Eigen::Vector3d> centre_of_mass;
  std::vector<double> heels;
};

void check(const Laden& asked) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value))
      throw py::value_error(fmt::format("{} = {:g}: must be positive", name, value));
  };
  positive("mass", asked.mass);
  positive("scale", asked.scale);
  positive("density", asked.density);
  for (std::size_t i = 0; i < asked.heels.size(); ++i)
    if (!(asked.heels[i] >= 0 && asked.heels[i] <= 180) || (i > 0 && asked.heels[i] <= asked.heels[i - 1]))
      throw py::value_error(
          fmt::format("heels: {:g}: must rise from 0 or more to 180 degrees at most", asked.heels[i]));
}

Surface<3> read(const Laden& asked) try {
  Surface<3> surface = read_surface_file(asked.hull).surface;
  surface.vertices *= asked.scale;
  return surface;
} catch (const SurfaceFileError& error) {
  throw py::value_error(fmt::format("{}: {}. {}", asked.hull.string(), error.what(), error.cure()));
}

Afloat hydrostatics(const Laden& asked) {
  check(asked);
  Surface<3> surface = read(asked);
  const auto whole = rigid::mass_properties<3>(surface);  // of unit density
  Afloat out;
  out.volume = whole.mass;
  out.mass = asked.mass;
  out.centre_of_mass = asked.centre_of_mass.value_or(whole.centre);
  surface.vertices.colwise() -= out.centre_of_mass;
  const auto rest = rigid::floating_stable<3>(surface, Isometry<3>::Identity(), asked.mass, asked.density, 0);
  if (!rest) return out;
  out.floats = true;
  out.displacement = rest->submerged.volume;
  out.draft = rest->draft;
  const auto angles = apps::attitude_deg<3>(rest->pose.linear());
  out.heel = angles[0], out.trim = angles[1];
  out.waterplane = rest->submerged.waterline;
  out.freeboard = rest->freeboard;
  out.position = rest->pose.translation();
  out.rotation = rest->pose.linear();
  const rigid::Slope<3> length = rigid::length_axis(*rest), across(-length.y(), length.x());
  out.gm_roll = rigid::metacentric_height<3>(*rest, across);
  out.gm_pitch = rigid::metacentric_height<3>(*rest, length);
  std::vector<double> heels = asked.heels;
  for (double& heel : heels) heel *= radians;
  for (const auto& at : rigid::righting_levers(surface, *rest, asked.mass, asked.density, 0, length, heels)) {
    out.heels.push_back(at.heel / radians);
    out.levers.push_back(at.lever);
    out.trims.push_back(at.trim / radians);
  }
  return out;
}

}  // namespace

void add_hydrostatics(py::module_& m) {
  py::class_<Afloat>(m, "Afloat", "A hull with its mass on still water at z = 0; lengths in metres, angles in degrees.")
      .def_readonly("volume", &Afloat::volume, "of the hull [m^3]")
      .def_readonly("mass", &Afloat::mass, "[kg]")
      .def_readonly("centre_of_mass", &Afloat::centre_of_mass, "in the file's frame [m]")
      .def_readonly("floats", &Afloat::floats,
                    "False: heavier than the water it can displace; what follows means nothing")
      .def_readonly("displacement", &Afloat::displacement, "volume below the water at rest [m^3]")
      .def_readonly("draft", &Afloat::draft, "of the lowest point [m]")
      .def_readonly("heel", &Afloat::heel, "roll at rest [deg]")
      .def_readonly("trim", &Afloat::trim, "pitch at rest, nose (x axis) up [deg]")
      .def_readonly("waterplane", &Afloat::waterplane, "area of the water plane [m^2]")
      .def_readonly("gm_roll", &Afloat::gm_roll, "metacentric height in roll [m]")
      .def_readonly("gm_pitch", &Afloat::gm_pitch, "metacentric height in pitch [m]")
      .def_readonly("freeboard", &Afloat::freeboard, "of the rim of a hollow above the water [m]; infinite without one")
      .def_readonly("position", &Afloat::position, "of the centre of mass at rest [m]")
      .def_readonly("rotation", &Afloat::rotation, "the file's frame to the world at rest, 3 x 3")
      .def_property_readonly(
          "heels", [](const Afloat& a) { return py::array(py::cast(a.heels)); }, "of the curve of stability [deg]")
      .def_property_readonly(
          "levers", [](const Afloat& a) { return py::array(py::cast(a.levers)); }, "GZ at these heels [m]")
      .def_property_readonly(
          "trims", [](const Afloat& a) { return py::array(py::cast(a.trims)); },
          "beyond that at rest, at these heels [deg]")
      .def("__repr__", [](const Afloat& a) {
        return a.floats ? fmt::format("<Afloat: draft {:.4g} m, heel {:.3g} deg, trim {:.3g} deg, GM {:.3g} m>",
                                      a.draft, a.heel, a.trim, a.gm_roll)
                        : fmt::format("<Afloat: sinks, {:.4g} kg on {:.4g} m^3>", a.mass, a.volume);
      });
  std::vector<double> usual;
  for (int degree = 0; degree <= 180; degree += 15) usual.push_back(degree);
  m.def(
      "hydrostatics",
      [](const std::filesystem::path& hull, double mass, const std::optional<Eigen::Vector3d>& centre_of_mass,
         double scale, double density, const std::vector<double>& heels) {
        const py::gil_scoped_release unlocked;
        return hydrostatics({hull, mass, scale, density, centre_of_mass, heels});
      },
      py::arg("hull"), py::arg("mass"), py::arg("centre_of_mass") = py::none(), py::kw_only(), py::arg("scale") = 1.0,
      py::arg("density") = 1000.0, py::arg("heels") = usual,
      "Where a hull of an STL or OBJ file floats, left alone from its attitude in the file, and how far it rights "
      "itself.\n\n"
      "mass [kg]; centre_of_mass in the file's frame [m], default: the hull's centroid; scale: metres per unit of the "
      "file;\n"
      "density of the water [kg/m^3]; heels of the curve of stability [deg], rising. GZ is the derivative of the "
      "energy over the\n"
      "weight along the curve, free to sink and to trim. Raises ValueError for a file or number that is wrong.");
}

}  // namespace splashdown
