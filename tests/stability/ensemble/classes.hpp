// Classes of scenes, each a generator with a seed. A seed means the same scene on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/stability/ensemble/member.hpp"

namespace splashdown::ensemble {

struct Class {
  std::string name, what;
  Member (*member)(std::uint64_t seed);
};

const std::vector<Class>& classes();

/// Throws std::runtime_error that names the classes there are.
Member generate(const std::string& name, std::uint64_t seed);

Member round_drop(std::uint64_t seed);
Member round_drop_in_space(std::uint64_t seed);
Member light_solid(std::uint64_t seed);
Member light_hull(std::uint64_t seed);
Member light_polygon(std::uint64_t seed);
Member drop_or_jet(std::uint64_t seed);
Member still_tank(std::uint64_t seed);
Member slot(std::uint64_t seed);
Member uav_attitude(std::uint64_t seed);
Member effect_mix(std::uint64_t seed);

}  // namespace splashdown::ensemble
