// The tables of a scene, one function each. Derived defaults (element sizes, the largest time step) are set
// just before their key is read, from tables that were read earlier.
#pragma once

#include "apps/scene/read/reader.hpp"

namespace splashdown::apps {

void read_fluid(Reader& reader, Fluid& fluid);
/// The table [fluid] of a fluid on a grid, but for what bodies and the tank decide (finish_vortex).
void read_vortex(Reader& reader, VortexFluid& fluid);
/// The rest of it, after the tank and the bodies.
void finish_vortex(Reader& reader, Scene& scene);
/// The table [fluid] of a fluid on a mesh that moves with bodies.
void read_ale(Reader& reader, AleFluid& fluid);
/// Points (r, z) of what is turned about the z axis.
void read_profile(Reader& reader, std::string_view key, std::vector<std::array<double, 2>>& profile);
/// The keys `points`, `degree`, `ends` and `tolerance`.
void read_spline(Reader& reader, SplineShape& spline);
void read_body(Reader& reader, Body& body, const Scene& scene);
/// The key `name`: letters, digits, _ and -, so that tables, files and other programs can take it as it is.
void read_name(Reader& reader, std::string& name, const std::string& example);
std::vector<std::string> body_names(const Scene& scene);
/// The index of the body that `key` names; nothing if it is absent or unknown. `what` it is that names it.
std::optional<std::size_t> read_body_name(Reader& reader, std::string_view key, const Scene& scene, Need need,
                                          const std::string& what);
std::optional<Joint> read_joint(Reader& reader, const Scene& scene);
void read_contact(Reader& reader, Contact& contact);
void read_record(Reader& reader, Scene& scene);
/// The key `limit` of the record that was read last.
void read_limit_of_record(Reader& record, Scene& scene);
void read_limit(Reader& reader, Scene& scene);
void read_coupling(Reader& reader, Coupling& coupling);

}  // namespace splashdown::apps
