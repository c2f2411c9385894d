// splashdown._simulation: a scene stepped from Python (apps/simulation/simulation.hpp).
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstring>
#include <map>

#include "apps/scene/rules/problems.hpp"
#include "apps/simulation/simulation.hpp"
#include "python/hydrostatics.hpp"

namespace py = pybind11;
using splashdown::BodyNow;
using splashdown::Simulation;
using splashdown::SimulationHooks;

namespace {

/// A copy, `columns` numbers a row; the simulation's own arrays move with every step.
template <class Number, class Range>
py::array_t<Number> array_of(const Range& numbers, py::ssize_t columns = 1) {
  const auto rows = static_cast<py::ssize_t>(numbers.size()) / columns;
  auto out = columns == 1 ? py::array_t<Number>(rows) : py::array_t<Number>({rows, columns});
  if (!numbers.empty()) std::memcpy(out.mutable_data(), numbers.data(), numbers.size() * sizeof(Number));
  return out;
}

using Push = std::pair<Eigen::Vector3d, Eigen::Vector3d>;
using Pose = std::pair<Eigen::Vector3d, Eigen::Matrix3d>;
using Forces = std::map<std::string, std::function<Push(double, const BodyNow&)>>;
using Paths = std::map<std::string, std::function<Pose(double)>>;

/// pybind11's callables take the interpreter's lock themselves.
SimulationHooks hooks(const Forces& forces, const Paths& paths) {
  SimulationHooks out;
  for (const auto& [body, push] : forces)
    out.forces.push_back({body, [push](double time, const BodyNow& now) {
                            const auto [force, moment] = push(time, now);
                            return SimulationHooks::Push{force, moment};
                          }});
  for (const auto& [body, pose] : paths)
    out.paths.push_back({body, [pose](double time) {
                           const auto [position, rotation] = pose(time);
                           return SimulationHooks::Pose{position, rotation};
                         }});
  return out;
}

py::object water(const Simulation& simulation) {
  const auto now = simulation.water();
  if (!now) return py::none();
  const int d = simulation.dimension();
  py::dict out;
  out["positions"] = array_of<double>(now->positions, d);
  out["velocities"] = array_of<double>(now->velocities, d);
  out["pressure"] = array_of<double>(now->pressure);
  out["cells"] = array_of<int>(now->cells, d + 1);
  out["boundary"] = array_of<int>(now->boundary, d);
  out["walls"] = array_of<int>(now->walls);
  out["volume"] = now->volume;
  out["kinetic_energy"] = now->kinetic;
  out["potential_energy"] = now->potential;
  return out;
}

}  // namespace

PYBIND11_MODULE(_simulation, m) {
  m.doc() = "Scenes stepped by hand. SI units; in two dimensions loads and masses are per metre of depth.";
  py::register_exception<splashdown::apps::SceneError>(m, "SceneError", PyExc_ValueError).attr("__doc__") =
      "A scene that is wrong: place, key, value, rule and cure of each problem, a line each.";
  py::register_exception<splashdown::CannotGoOn>(m, "CannotGoOn", PyExc_RuntimeError).attr("__doc__") =
      "A simulation that found no step: when, where and why, and what may help.";

  splashdown::add_hydrostatics(m);
  py::class_<BodyNow>(
      m, "Body", "A body at an instant. World frame, vectors of three; plane: the third entries are spins and moments.")
      .def_readonly("name", &BodyNow::name)
      .def_readonly("position", &BodyNow::position, "of the centre of mass [m]")
      .def_readonly("rotation", &BodyNow::rotation, "body frame to world, 3 x 3")
      .def_readonly("velocity", &BodyNow::velocity, "of the centre of mass [m/s]")
      .def_readonly("spin", &BodyNow::spin, "angular velocity [rad/s]")
      .def_readonly("acceleration", &BodyNow::acceleration, "of the centre of mass [m/s^2]")
      .def_readonly("angular_acceleration", &BodyNow::angular_acceleration, "[rad/s^2]")
      .def_readonly("force", &BodyNow::force, "of the water [N; plane: N/m]")
      .def_readonly("moment", &BodyNow::moment, "of the water about the centre of mass [N m; plane: N]")
      .def_readonly("wetted", &BodyNow::wetted, "area of the hull [m^2; plane: m]")
      .def("__repr__", [](const BodyNow& b) { return "<Body " + b.name + ">"; });

  const auto no_lock = py::call_guard<py::gil_scoped_release>();
  py::class_<Simulation>(m, "Simulation",
                         "A scene that is stepped by hand; results are those of the command, bit for bit.")
      .def_static(
          "open",
          [](const std::filesystem::path& scene, const std::vector<std::string>& set, const Forces& forces,
             const Paths& paths) {
            auto hooked = hooks(forces, paths);
            const py::gil_scoped_release unlocked;
            return Simulation::open(scene, set, std::move(hooked));
          },
          py::arg("scene"), py::arg("set") = std::vector<std::string>{}, py::arg("forces") = Forces{},
          py::arg("paths") = Paths{},
          "The scene of a file. set: texts KEY=VALUE. forces: by body, (time, Body) -> (force, moment) about the "
          "centre of mass, "
          "world frame. paths: by body with motion = \"prescribed\", time -> (position, rotation 3 x 3).")
      .def_static(
          "of_text",
          [](const std::string& toml, const std::filesystem::path& folder, const std::vector<std::string>& set,
             const Forces& forces, const Paths& paths) {
            auto hooked = hooks(forces, paths);
            const py::gil_scoped_release unlocked;
            return Simulation::of_text(toml, folder, set, std::move(hooked));
          },
          py::arg("toml"), py::arg("folder") = ".", py::arg("set") = std::vector<std::string>{},
          py::arg("forces") = Forces{}, py::arg("paths") = Paths{},
          "The same of a text; files that it names are looked for in folder.")
      .def("advance", &Simulation::advance, no_lock,
           "To the next instant, of which everything is known then; False at the end. Raises CannotGoOn.")
      .def("advance_to", &Simulation::advance_to, no_lock, py::arg("time"),
           "To the first instant at or after a time [s].")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](py::object self) {
             auto& simulation = self.cast<Simulation&>();
             bool there = false;
             {
               const py::gil_scoped_release unlocked;
               there = simulation.advance();
             }
             if (!there) throw py::stop_iteration();
             return self;
           })
      .def_property_readonly("dimension", &Simulation::dimension, "2 or 3")
      .def_property_readonly("title", &Simulation::title)
      .def_property_readonly("resolved", &Simulation::resolved, "the scene as TOML with every value in force")
      .def_property_readonly("time", &Simulation::time, "[s]")
      .def_property_readonly("end", &Simulation::end, "time.end of the scene [s]")
      .def_property_readonly("dt", &Simulation::dt, "of the step from here [s]")
      .def_property_readonly("steps", &Simulation::steps)
      .def_property_readonly("passes", &Simulation::passes, "of the coupling in the step from here")
      .def_property_readonly("body_names", &Simulation::body_names)
      .def_property_readonly(
          "bodies",
          [](const Simulation& of) {
            py::dict out;
            for (auto& body : of.bodies()) out[py::str(body.name)] = body;
            return out;
          },
          "Body by name")
      .def_property_readonly(
          "water", &water,
          "Arrays of nodes (positions [m], velocities [m/s], pressure [Pa]), cells and boundary with the wall of each "
          "facet (body, then tank; -1: free surface), volume and energies; None without water")
      .def("pressure_at", &Simulation::pressure_at, py::arg("point"), "[Pa]; None outside of the water")
      .def("save", &Simulation::save, no_lock, py::arg("folder"), "the state, whole or not at all")
      .def("restore", &Simulation::restore, no_lock, py::arg("folder"),
           "what save() or a run's folder checkpoint/ holds of the same scene");
}
