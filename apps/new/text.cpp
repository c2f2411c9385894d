#include "apps/new/text.hpp"

#include <fmt/format.h>

#include <sstream>

#include "apps/scene/read/echo.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

constexpr std::size_t widest = 110;  // of a line

/// Words as comment lines.
std::string comment(const std::string& text) {
  std::istringstream words(one_line(text));
  std::string result, line = "#";
  for (std::string word; words >> word; line += " " + word)
    if (line.size() + 1 + word.size() > widest) {
      result += line + "\n";
      line = "#  ";
    }
  return result + line + "\n";
}

template <int d>
std::string list(const Point& point) {
  return toml_list(std::vector<double>(point.data(), point.data() + d));
}

class Writer {
 public:
  Writer(const NewOptions& options, const NewHull& hull, const LandingPlan& plan, const std::string& file)
      : options_(options), hull_(hull), plan_(plan), file_(file) {}

  template <int d>
  std::string scene() {
    const auto& scene = plan_.scene;
    text_ = comment("Written by: " + options_.command);
    text_ += "# Each line is yours to change; docs/scene.md has all keys. SI units.\n";
    line("title", toml_text(scene.title));
    line("dimension", toml_text(d));
    head("[time]", {"end"});
    line("end", toml_text(scene.time.end));
    line("dt_max", toml_text(scene.time.dt_max), "CFC 60 needs 600 samples a second");
    head("[gravity]", {});
    line("acceleration", list<d>(scene.gravity->acceleration));
    if (plan_.symmetric) {
      head("[symmetry]", {"symmetry"});
      line("normal", toml_text(std::string(d == 3 ? "y" : "x")));
    }
    head("[tank]", {"tank"});
    if (!plan_.symmetric) about("symmetry");
    line("min", list<d>(scene.tank->min));
    line("max", list<d>(scene.tank->max));
    head("[fluid]", {"water"});
    text_ += "# Element sizes are left to the program: check prints them. [fluid.size] would name them.\n";
    line("density", toml_text(scene.fluid->density));
    head("[[fluid.region]]", {});
    const auto& water = std::get<BoxRegion>(scene.fluid->regions.front().shape);
    line("shape", "\"box\"");
    line("min", list<d>(water.min));
    line("max", list<d>(water.max));
    body<d>();
    head("[output]", {});
    line("frames", toml_text(*scene.output.frames), "pictures for ParaView, about 50");
    if (!scene.records.empty()) text_ += "\n# Records. Points are in the hull's frame, in metres.\n";
    about("points");
    about("panels");
    for (const auto& record : scene.records) std::visit([&](const auto& entry) { this->record<d>(entry); }, record);
    return text_;
  }

 private:
  void about(const std::string& what) {
    for (const auto& told : plan_.told)
      if (told.about == what) text_ += comment(what + ": " + told.text);
  }
  void head(const std::string& header, const std::vector<std::string>& abouts) {
    text_ += "\n" + header + "\n";
    for (const auto& what : abouts) about(what);
  }
  void line(const std::string& key, const std::string& value, const std::string& why = {}) {
    text_ += fmt::format("{} = {}{}\n", key, value, why.empty() ? "" : "  # " + why);
  }

  template <int d>
  void body() {
    const auto& body = plan_.scene.bodies.front();
    head("[[body]]", {"units", "axes", "hull", "repair", "mass", "start", "motion"});
    const auto type = shape_type();
    line("name", toml_text(body.name));
    line("shape", fmt::format("{{type = \"{}\", {}{}}}", type, file_.empty() ? "" : "file = " + toml_text(file_) + ", ",
                              hull_.toml));
    line("mass", toml_text(*body.mass));
    if (body.centre_of_mass) line("centre_of_mass", list<d>(*body.centre_of_mass));
    if (body.inertia) line("inertia", d == 2 ? toml_text((*body.inertia)(2, 2)) : list<3>(body.inertia->diagonal()));
    line("position", list<d>(body.position));
    line("pitch_deg", toml_text(body.attitude.pitch_deg));
    if (body.attitude.roll_deg != 0) line("roll_deg", toml_text(body.attitude.roll_deg));
    line("velocity", list<d>(body.velocity));
  }
  std::string shape_type() const { return options_.shape.empty() ? "surface" : options_.shape; }

  void record_head(const char* kind) {
    text_ += "\n[[record]]\n";
    line("kind", toml_text(std::string(kind)));
  }
  void limit(const std::optional<double>& above) {
    if (above) line("limit", fmt::format("{{above = {}}}", toml_text(*above)));
  }
  template <int d>
  void record(const AccelerationEntry& entry) {
    record_head("acceleration");
    line("name", toml_text(entry.name));
    line("body", toml_text(plan_.scene.bodies.front().name));
    line("point", list<d>(entry.point));
    limit(options_.limit_g);
  }
  template <int d>
  void record(const PatchEntry& entry) {
    record_head("pressure_patch");
    line("name", toml_text(entry.name));
    line("body", toml_text(plan_.scene.bodies.front().name));
    line("min", list<d>(*entry.min));
    line("max", list<d>(*entry.max));
    limit(options_.limit_pressure);
  }
  template <int d>
  void record(const MaximumPressureEntry&) {
    record_head("maximum_pressure");
    line("body", toml_text(plan_.scene.bodies.front().name));
  }
  template <int d, class Other>
  void record(const Other&) {}

  const NewOptions& options_;
  const NewHull& hull_;
  const LandingPlan& plan_;
  const std::string& file_;
  std::string text_;
};

}  // namespace

template <int d>
std::string scene_text(const NewOptions& options, const NewHull& hull, const LandingPlan& plan,
                       const std::string& file) {
  return Writer(options, hull, plan, file).scene<d>();
}

template std::string scene_text<2>(const NewOptions&, const NewHull&, const LandingPlan&, const std::string&);
template std::string scene_text<3>(const NewOptions&, const NewHull&, const LandingPlan&, const std::string&);

}  // namespace splashdown::apps
