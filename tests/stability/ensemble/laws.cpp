#include "tests/stability/ensemble/laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/quantity/names.hpp"
#include "apps/quantity/table.hpp"
#include "tests/stability/ensemble/release.hpp"

namespace splashdown::ensemble {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The larger one; nan stays, an explosion must not hide behind it.
double most(double a, double b) { return std::isnan(a) || std::isnan(b) ? nan : std::max(a, b); }

const std::vector<double>& column(const quantity::Table& table, const std::string& name) {
  const auto* const values = table.find(name);
  if (values == nullptr) throw std::runtime_error("there is no column " + name);
  if (values->empty()) throw std::runtime_error("there is no row of " + name);
  return *values;
}

/// Over all rows: what the water holds beyond its first energy and what walls and effects gave, over what walls gave.
double energy_gain(const quantity::Table& fluid, double scale) {
  const auto &kinetic = column(fluid, "kinetic_energy"), &potential = column(fluid, "potential_energy"),
             &work = column(fluid, "work_on_walls");
  const auto* const effects = fluid.find("work_of_effects");
  double gain = 0, given = scale;
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (kinetic[i] < 0) return infinite;
    const double by_effects = effects != nullptr ? (*effects)[i] : 0;
    gain = most(gain, kinetic[i] + potential[i] - kinetic[0] - potential[0] + work[i] - by_effects);
    given = most(given, -work[i]);
  }
  return given > 0 || gain > 0 ? gain / given : 0;
}

/// Over all rows: what remeshing has given to the water, over what walls gave.
double remesh_gain(const quantity::Table& fluid, double scale) {
  const auto &remesh = column(fluid, "energy_remesh"), &work = column(fluid, "work_on_walls");
  double gain = 0, given = scale;
  for (std::size_t i = 0; i < work.size(); ++i) gain = most(gain, remesh[i]), given = most(given, -work[i]);
  return given > 0 || gain > 0 ? gain / given : 0;
}

double volume_error(const quantity::Table& fluid, double scale) {
  const auto &liquid = column(fluid, "volume"), &spray = column(fluid, "volume_spray");
  double error = 0;
  for (std::size_t i = 0; i < liquid.size(); ++i)
    error = most(error, std::abs(liquid[i] + spray[i] - liquid[0] - spray[0]));
  return error / scale;
}

double body_speed(const std::filesystem::path& run) {
  if (!std::filesystem::exists(run / "bodies.csv")) return 0;
  const auto bodies = quantity::read_table(run, "bodies.csv");
  const auto &vx = column(bodies, "vx"), &vy = column(bodies, "vy"), &vz = column(bodies, "vz");
  double speed = 0;
  for (std::size_t i = 0; i < vx.size(); ++i) speed = most(speed, std::hypot(vx[i], vy[i], vz[i]));
  return speed;
}

double node_speed(const quantity::Table& fluid) {
  double speed = 0;
  for (const double v : column(fluid, "max_speed")) speed = most(speed, v);
  return speed;
}

double number_at(const nlohmann::json& summary, const char* path) {
  const auto found = quantity::find_entry(summary, path);
  if (!found) throw std::runtime_error(fmt::format("summary.json has no {}", path));
  return found->numbers.front();
}

std::string text_at(const nlohmann::json& summary, const char* pointer) {
  const auto value = summary.value(nlohmann::json::json_pointer(pointer), nlohmann::json());
  return value.is_string() ? value.get<std::string>() : "";
}

class Judgement {
 public:
  Judgement(const Member& member, const Run& run) : laws_(member.laws), run_(run) {}

  Verdict verdict() {
    const auto summary = quantity::read_summary(run_.folder);
    verdict_.cut = run_.exit_code == 130 || run_.exit_code == -1;
    verdict_.cause = text_at(summary, "/cause");
    if (verdict_.cause.empty() && run_.exit_code != 0 && run_.exit_code != 130) verdict_.cause = run_.log;
    const bool red = text_at(summary, "/verdict/grade") == "unphysical";
    verdict_.refused = (laws_.may_be_refused && (run_.exit_code == 2 || run_.exit_code == 3 || red)) ||
                       (laws_.may_not_be_meshed && run_.exit_code == 2);
    if (verdict_.refused) return verdict_;
    verdict_.findings.push_back({"ends", run_.exit_code == 0 ? 0.0 : 1.0, 0, verdict_.cause});
    if (run_.exit_code != 2) measure(summary);
    return verdict_;
  }

 private:
  template <class Measure>
  void find(const std::string& law, double bound, Measure measure) {
    Finding finding{law, nan, bound, ""};
    try {
      finding.measured = measure();
    } catch (const std::exception& error) {
      finding.note = error.what();
    }
    verdict_.findings.push_back(finding);
  }

  void measure(const nlohmann::json& summary) {
    quantity::Table fluid;
    try {
      fluid = quantity::read_table(run_.folder, "fluid.csv");
    } catch (const std::exception&) {  // each law says that its column is missing
    }
    if (laws_.energy) find("energy", laws_.energy->bound, [&] { return energy_gain(fluid, laws_.energy->scale); });
    if (laws_.energy)
      find("energy of remeshing", laws_.energy->remesh, [&] { return remesh_gain(fluid, laws_.energy->scale); });
    if (laws_.speed) {
      find("speed of nodes", 1, [&] { return node_speed(fluid) / laws_.speed->nodes; });
      if (std::isfinite(laws_.speed->bodies))
        find("speed of bodies", 1, [&] { return body_speed(run_.folder) / laws_.speed->bodies; });
    }
    if (laws_.volume) find("volume", laws_.volume->bound, [&] { return volume_error(fluid, laws_.volume->scale); });
    if (laws_.release)
      find("release", laws_.release->bound, [&] { return release_error(run_.folder, laws_.release->water); });
    // A killed run leaves no summary; that it did not end is said already.
    if (summary.empty()) return;
    if (laws_.passes && summary.contains("coupling"))
      find("passes", *laws_.passes, [&] { return number_at(summary, "coupling.passes_max"); });
    if (laws_.refused)
      find("refused steps", *laws_.refused,
           [&] { return number_at(summary, "rejected_steps") / std::max(1.0, number_at(summary, "steps")); });
  }

  const Laws& laws_;
  const Run& run_;
  Verdict verdict_;
};

/// Over its bound; broken laws without a bound come first.
double severity(const Finding& f) {
  if (!f.held()) return std::isnan(f.measured) || f.bound == 0 ? infinite : f.measured / f.bound;
  return f.bound > 0 ? f.measured / f.bound : 0;
}

}  // namespace

bool Verdict::held() const {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.held(); });
}

const Finding* Verdict::worst() const {
  const auto found = std::max_element(findings.begin(), findings.end(),
                                      [](const Finding& a, const Finding& b) { return severity(a) < severity(b); });
  return found == findings.end() ? nullptr : &*found;
}

Verdict judge(const Member& member, const Run& run) { return Judgement(member, run).verdict(); }

}  // namespace splashdown::ensemble
