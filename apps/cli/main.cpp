// splashdown new | run | check | advise | study | price | ablate | report | sensors | render | schema

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "apps/ablate/command.hpp"
#include "apps/advise/command.hpp"
#include "apps/check/command.hpp"
#include "apps/cli/schema.hpp"
#include "apps/new/command.hpp"
#include "apps/price/command.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/version.hpp"
#include "apps/render/command.hpp"
#include "apps/report/command.hpp"
#include "apps/run/command.hpp"
#include "apps/scene/choose/presets.hpp"
#include "apps/scene/rules/problems.hpp"
#include "apps/sensors/command.hpp"
#include "apps/study/command.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {

namespace {

std::string version_text() {
  auto text = fmt::format("splashdown {} ({})", version(), git_hash());
  for (const auto& [name, number] : library_versions()) text += fmt::format("\n  {} {}", name, number);
  return text;
}

/// "2%" or "2 %"; nothing for anything else.
std::optional<double> percent_of(std::string text) {
  double value = 0;
  if (text.empty() || text.back() != '%') return {};
  text.pop_back();
  if (!text.empty() && text.back() == ' ') text.pop_back();
  if (!CLI::detail::lexical_cast(text, value) || !(value > 0) || !std::isfinite(value)) return {};
  return value;
}

/// What is written where no subcommand, no option and no file is looked for, with what was meant by it.
std::string unexpected(const CLI::App& app, const std::string& word) {
  const auto* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const auto known = fmt::format("See splashdown {}--help.", command == &app ? "" : command->get_name() + " ");
  if (command == &app && word.ends_with(".toml"))
    return fmt::format("{0}: what is to be done with it? Use e.g. splashdown run {0}. {1}", word, known);
  std::vector<std::string> words;
  if (command == &app)
    for (const auto* other : app.get_subcommands({})) words.push_back(other->get_name());
  for (const auto* option : command->get_options())
    for (const auto& name : option->get_lnames()) words.push_back("--" + name);
  const auto near = nearest(word, words);
  return fmt::format("{}: {}. {}", word, command == &app ? "there is no such command" : "not expected here",
                     near.empty() ? known : fmt::format("Did you mean {}?", near));
}

/// CLI11's own exit codes are not ours: 0 for help and version, 2 for everything it refuses.
int finish(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  if (app.get_subcommands().empty() && argc > 1) return bad_input(unexpected(app, argv[1]));
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    const auto rest = app.remaining(true);
    const auto option = std::ranges::find_if(rest, [](const auto& word) { return word.starts_with("-"); });
    if (!rest.empty()) return bad_input(unexpected(app, option == rest.end() ? rest.front() : *option));
  }
  return bad_input(fmt::format("{}. See splashdown --help.", error.what()));
}

/// --set time.end 0.1, with a blank, would take the value for another argument.
CLI::Validator key_and_value() {
  return {[](const std::string& text) {
            return text.find('=') != std::string::npos
                       ? std::string()
                       : fmt::format("must read KEY=VALUE, without blanks, e.g. --set {}=1", text);
          },
          ""};
}

constexpr const char* scene_help = "scene file (TOML; docs/scene.md)";
constexpr const char* set_help = "override a key of the scene, e.g. body.wedge.mass=100 (repeatable)";

/// CLI11's own rule prints its upper bound, 1.8e308, digit by digit.
CLI::Validator positive_number() {
  return {[](const std::string& text) {
            double value = 0;
            return CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value)
                       ? std::string()
                       : fmt::format("must be a positive number, not {}", text);
          },
          "POSITIVE"};
}

/// Of what may stand behind --refine.
CLI::Validator number_or_preset() {
  return {[](const std::string& text) {
            if (std::ranges::find(presets, text, &Preset::name) != presets.end() || positive_number()(text).empty())
              return std::string();
            std::vector<std::string> names;
            for (const auto& preset : presets) names.emplace_back(preset.name);
            const auto near = nearest(text, names);
            return fmt::format("must be a positive number, draft, standard or reference, not {}{}", text,
                               near.empty() ? "" : fmt::format("; did you mean {}", near));
          },
          ""};
}

// Options that several commands share.

void add_set(CLI::App* command, std::vector<std::string>& set) {
  command->add_option("--set", set, set_help)->type_name("KEY=VALUE")->allow_extra_args(false)->check(key_and_value());
}

void add_quantity(CLI::App* command, std::vector<std::string>& quantities) {
  command
      ->add_option("--quantity", quantities,
                   "what matters: NAME=EXPRESSION [from TABLE] [where CONDITION] (repeatable; docs/price.md)")
      ->type_name("NAME=EXPR")
      ->allow_extra_args(false);
}

void add_jobs(CLI::App* command, int& jobs) {
  command->add_option("--jobs", jobs, "runs at a time")->check(CLI::Range(1, 1024))->capture_default_str();
}

void add_collect(CLI::App* command, bool& collect) {
  command->add_flag("--collect", collect, "make no runs: tables and chart of those that are there");
}

/// Of commands that make several runs.
void add_runs(CLI::App* command, bool& large, bool& quiet) {
  command->add_flag("--large", large, "make runs even if they are predicted to take more than 4 GB of memory");
  command->add_flag("--quiet", quiet, "print errors only");
}

/// The last word on it: behind all of --set.
void add_refine(CLI::App* command, std::vector<std::string>& set) {
  command
      ->add_option_function<std::string>(
          "--refine",
          [&set](const std::string& value) {
            set.push_back(fmt::format("--refine {0}: fluid.size.refine={0}", value));
          },
          "divide all lengths of the mesh, and dt_max, by this: a number, or draft (0.35), standard (1) or reference "
          "(2); "
          "the same as --set fluid.size.refine=X")
      ->type_name("X")
      ->check(number_or_preset())
      ->trigger_on_parse(false);
}

CLI::Validator percentage() {
  return {[](const std::string& text) {
            return percent_of(text) ? std::string()
                                    : fmt::format("must be a positive percentage, e.g. 2%, not {}", text);
          },
          ""};
}

CLI::Option* add_accuracy(CLI::App* command, std::optional<double>& accuracy, const std::string& help) {
  return command
      ->add_option_function<std::string>(
          "--accuracy", [&accuracy](const std::string& text) { accuracy = percent_of(text); }, help)
      ->type_name("PERCENT")
      ->check(percentage());
}

/// What chooses the mesh.
void add_aims(CLI::App* run_app, RunOptions& run) {
  auto* accuracy =
      add_accuracy(run_app, run.accuracy,
                   "choose the mesh for this band of the loads, e.g. 2%, by the scene's price list or coarse runs");
  auto* seconds = run_app->add_option("--seconds", run.seconds, "choose the mesh for a run of these wall seconds");
  seconds->check(positive_number());
  run_app->add_option("--price", run.price,
                      "folder of the price list to choose by (default: that of splashdown price)");
  for (auto* aim : {accuracy, seconds}) {
    for (const char* other : {"--resume", "--refine", "--until", "--budget"}) aim->excludes(run_app->get_option(other));
  }
  accuracy->excludes(seconds);
}

CLI::App* add_run(CLI::App& app, RunOptions& run) {
  auto* run_app = app.add_subcommand("run", "Run a scene");
  run_app->add_option("scene", run.scene, scene_help)->required();
  run_app->add_option("--out", run.out,
                      "folder for the files (default: out/<folder of the scene>, or out/<folder>_<file>)");
  add_set(run_app, run.overrides);
  add_refine(run_app, run.overrides);
  run_app->add_option("--threads", run.threads, "threads; default: one in the plane, all cores in space")
      ->check(CLI::Range(1, 1024));
  run_app->add_option("--until", run.until, "simulated time to stop at, with a checkpoint [s]")
      ->check(positive_number());
  run_app
      ->add_option("--budget", run.budget,
                   "wall seconds, the start included, after which to stop with a checkpoint (exit code 130)")
      ->check(positive_number());
  auto* resume = run_app->add_flag(
      "--resume", run.resume, "continue from the folder's checkpoint; refused if there is one that cannot be read");
  add_aims(run_app, run);
  run_app->add_flag("--restart", run.restart, "begin anew and replace what a run of this scene left (the default)")
      ->excludes(resume);
  run_app->add_flag("--force", run.force, "replace also what a run of another scene left in the folder");
  run_app->add_flag("--large", run.large, "run it even if it is predicted to take more than 4 GB of memory");
  run_app->add_flag("--no-report", run.no_report, "draw no report.html at the end (splashdown report does)");
  run_app->add_flag("--quiet", run.quiet, "print errors only");
  return run_app;
}

CLI::App* add_study(CLI::App& app, StudyOptions& study) {
  auto* study_app = app.add_subcommand("study", "Run every combination of a scene's values");
  study_app->add_option("study", study.study, "study file (TOML; docs/study.md)")->required();
  study_app->add_option("--out", study.out,
                        "folder for the runs and tables (default: out/<folder of the study>, or out/<folder>_<file>)");
  add_jobs(study_app, study.jobs);
  study_app->add_option("--on", study.on, "where the runs are made")
      ->check(CLI::IsMember({"local", "parallel", "slurm"}))
      ->capture_default_str();
  add_collect(study_app, study.collect);
  add_runs(study_app, study.large, study.quiet);
  return study_app;
}

CLI::App* add_price(CLI::App& app, PriceOptions& price) {
  auto* price_app = app.add_subcommand("price", "Say what accuracy costs: a ladder of meshes, bands and seconds");
  price_app->add_option("scene", price.scene, scene_help)->required();
  price_app->add_option("--out", price.out,
                        "folder for the runs and the price list (default: that of run, with _price)");
  add_set(price_app, price.set);
  add_quantity(price_app, price.quantities);
  price_app->add_option("--rungs", price.rungs, "meshes, each 1.41 times finer than the one before, from half on")
      ->check(CLI::Range(fewest_rungs, most_rungs))
      ->capture_default_str();
  add_accuracy(price_app, price.accuracy,
               fmt::format("go on with finer meshes, {} in all, or further runs, until a mesh or a mean has this band, "
                           "e.g. 10%; with --budget 20% "
                           "is asked for anyway",
                           most_rungs));
  price_app->add_flag("--open-water", price.open_water,
                      "the tank stands for open water: one more run, in a larger tank, for its influence");
  price_app->add_option("--budget", price.budget, "wall seconds for all runs; what does not fit is left out")
      ->check(positive_number());
  price_app->add_option("--threads", price.threads, "threads of each run; default: that of run")
      ->check(CLI::Range(1, 1024));
  add_runs(price_app, price.large, price.quiet);
  return price_app;
}

CLI::App* add_advise(CLI::App& app, AdviseOptions& advise) {
  auto* advise_app = app.add_subcommand("advise", "Say which effects the scene calls for: numbers, changes, sources");
  advise_app->add_option("scene", advise.scene, scene_help)->required();
  add_set(advise_app, advise.set);
  advise_app->add_flag("--json", advise.json, "print JSON for programs (docs/files.md)");
  return advise_app;
}

CLI::App* add_ablate(CLI::App& app, AblateOptions& ablate) {
  auto* ablate_app = app.add_subcommand("ablate", "Say what each effect and choice does to numbers and clock, by runs");
  ablate_app->add_option("scene", ablate.scene, scene_help)->required();
  ablate_app->add_option("--out", ablate.out,
                         "folder for the runs and the tables (default: that of run, with _ablate)");
  add_set(ablate_app, ablate.set);
  add_refine(ablate_app, ablate.set);
  add_quantity(ablate_app, ablate.quantities);
  ablate_app->add_option("--only", ablate.only, "an effect or choice, e.g. viscosity, walls, tank (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  ablate_app->add_flag("--all", ablate.all, "add effects that are not advised, too");
  ablate_app
      ->add_option_function<std::string>(
          "--matters", [&ablate](const std::string& text) { ablate.matters = *percent_of(text); },
          "change above which an effect matters (default: 1%)")
      ->type_name("PERCENT")
      ->check(percentage());
  add_jobs(ablate_app, ablate.jobs);
  ablate_app
      ->add_option("--threads", ablate.threads, "threads of each run; default: one in the plane, all cores in space")
      ->check(CLI::Range(1, 1024));
  add_collect(ablate_app, ablate.collect);
  add_runs(ablate_app, ablate.large, ablate.quiet);
  return ablate_app;
}

void add_accuracy_of_tank(CLI::App* new_app, NewOptions& made) {
  new_app
      ->add_option_function<std::string>(
          "--accuracy", [&made](const std::string& text) { made.accuracy = *percent_of(text); },
          "what walls and floor of the tank may change, e.g. 1% (default: 2%)")
      ->type_name("PERCENT")
      ->check(percentage());
}

/// The shape's numbers of a new scene.
void add_new_shape(CLI::App* new_app, NewOptions& made) {
  new_app->add_option("--shape", made.shape,
                      "instead of a file: capsule, sphere, box, cone; with --plane wedge, circle, box, capsule");
  new_app->add_flag("--plane", made.plane, "a scene in the plane, masses per metre of depth");
  new_app->add_option("--radius", made.radius, "of a sphere, capsule, cone, circle [m]");
  new_app->add_option("--length", made.length, "of a capsule's straight part [m]");
  new_app->add_option("--size", made.size, "of a box: X,Y,Z, in the plane X,Y [m]");
  new_app->add_option("--deadrise", made.deadrise, "of a cone or wedge [deg]");
  new_app->add_option("--breadth", made.breadth, "of a wedge [m]");
  new_app->add_option("--height", made.height, "of a wedge, keel to top [m]");
}

CLI::App* add_new(CLI::App& app, NewOptions& made) {
  auto* new_app = app.add_subcommand("new", "Write a scene for a hull that lands: STL or OBJ file, or a shape");
  new_app->add_option("hull", made.hull, "STL or OBJ file, nose along x, z up");
  add_new_shape(new_app, made);
  new_app->add_option("--mass", made.mass, "[kg], in the plane [kg/m]; needed");
  new_app->add_option("--sink", made.sink, "speed downward at the water [m/s]; needed");
  new_app->add_option("--forward", made.forward, "speed along x [m/s]");
  new_app->add_option("--pitch", made.pitch, "nose up [deg]");
  new_app->add_option("--roll", made.roll, "about x [deg]");
  new_app->add_option("--units", made.units,
                      "of the file: mm, cm, in, ft or m (default: guessed from extent and mass)");
  new_app->add_option("--scale", made.scale, "metres per unit of the file, instead");
  new_app->add_option("--nose", made.nose, "axis of the file towards the nose: x, -x, y ...")->capture_default_str();
  new_app->add_option("--up", made.up, "axis of the file that is up")->capture_default_str();
  new_app->add_flag("--repair", made.repair, "mend the file's mesh and write it beside the scene; says what was done");
  new_app->add_option("--centre", made.centre, "centre of mass X,Y,Z in the hull's frame [m]");
  new_app->add_option("--inertia", made.inertia, "moments about it, IX,IY,IZ [kg m^2]");
  new_app
      ->add_option("--point", made.points, "acceleration at a place of the hull's frame: NAME=X,Y,Z [m] (repeatable)")
      ->allow_extra_args(false);
  new_app->add_option("--panels", made.panels, "pressure patches along the bottom")->capture_default_str();
  new_app->add_option("--limit-g", made.limit_g, "asks at all points: is it above so many g?");
  new_app->add_option("--limit-pressure", made.limit_pressure, "asks at all panels: is it above so many Pa?");
  new_app->add_option("--end", made.end, "of the run [s] (default: from the motion)");
  new_app->add_option("--depth", made.depth, "of the water [m] (default: deep)");
  new_app->add_option("--water", made.density, "density of the water [kg/m^3]")->capture_default_str();
  add_accuracy_of_tank(new_app, made);
  new_app->add_option("--name", made.name, "of the body and the folder (default: that of the file or shape)");
  new_app->add_option("-o,--out", made.out, "folder of the scene (default: the name), or a .toml file");
  new_app->add_flag("--force", made.force, "replace files that are there");
  return new_app;
}

CLI::App* add_render(CLI::App& app, RenderOptions& render) {
  auto* render_app = app.add_subcommand("render", "Draw a run's frames without a display: a still or a film");
  render_app->add_option("directory", render.directory, "folder of a run with frames (output.frames)")->required();
  render_app->add_option("--time", render.time, "simulated time of a still [s]; the nearest frame is taken");
  render_app->add_option("-o,--out", render.out, "file of the still, FILE.png (default: render.png in the folder)");
  render_app->add_option("--movie", render.movie, "film of all frames, FILE.mp4");
  render_app->add_option("--fps", render.fps, "frames a second of the film (default: all in five seconds)")
      ->check(CLI::Range(0.5, 120.));
  render_app->add_option("--size", render.size, "pixels")->type_name("WxH")->capture_default_str();
  render_app->add_option("--view", render.view,
                         "in space: bow (default), stern, side, ahead, above, below; or AZIMUTH,ELEVATION [deg]: where "
                         "the camera stands, from ahead to port, and up");
  render_app->add_option("--zoom", render.zoom, "how much nearer")->check(positive_number())->capture_default_str();
  render_app->add_flag("--follow", render.follow, "the camera follows the first body");
  render_app->add_flag("--so-far", render.so_far, "colour hulls by their highest pressure so far");
  render_app->add_flag("--mesh", render.mesh, "draw the mesh");
  render_app->add_flag("--quiet", render.quiet, "print errors only");
  return render_app;
}

CLI::App* add_sensors(CLI::App& app, SensorsOptions& sensors) {
  auto* sensors_app = app.add_subcommand("sensors", "Say where signals of two runs differ most");
  sensors_app->add_option("reference", sensors.reference, "folder of the run that others are compared with")
      ->required();
  sensors_app->add_option("other", sensors.other, "folder of a run with the same points in another state")->required();
  sensors_app->add_option("--signal", sensors.kind, "what follows the dot in the names of probes, e.g. uy, vx or exx")
      ->capture_default_str();
  sensors_app->add_option("--count", sensors.count, "places that are chosen")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  sensors_app->add_flag("--all", sensors.all, "print all candidates, too");
  return sensors_app;
}

int command_line(int argc, char** argv) {
  CLI::App app("Light bodies landing on water: PFEM fluid, rigid bodies, strong coupling.", "splashdown");
  app.set_version_flag("--version", version_text);
  app.require_subcommand(1);
  NewOptions made;
  const auto* new_app = add_new(app, made);
  for (int i = 0; i < argc; ++i) made.command += i == 0 ? "splashdown" : " " + shell_word(argv[i]);
  RunOptions run;
  const auto* run_app = add_run(app, run);

  std::filesystem::path scene;
  std::vector<std::string> overrides;
  auto* check_app = app.add_subcommand("check", "Say what would run: masses, numbers, effects, cost");
  check_app->add_option("scene", scene, scene_help)->required();
  add_set(check_app, overrides);
  add_refine(check_app, overrides);

  StudyOptions study;
  const auto* study_app = add_study(app, study);
  PriceOptions price;
  const auto* price_app = add_price(app, price);
  AdviseOptions advise;
  const auto* advise_app = add_advise(app, advise);
  AblateOptions ablate;
  const auto* ablate_app = add_ablate(app, ablate);

  std::filesystem::path directory;
  auto* report_app =
      app.add_subcommand("report", "Write report.html from the files of a run, a study, a price or an ablation");
  report_app->add_option("directory", directory, "folder of the run, the study, the price or the ablation")->required();

  SensorsOptions sensors;
  const auto* sensors_app = add_sensors(app, sensors);
  RenderOptions render;
  const auto* render_app = add_render(app, render);

  std::string schema_of = "scene";
  auto* schema_app = app.add_subcommand("schema", "Print the JSON Schema of scenes or studies, for editors");
  schema_app->add_option("what", schema_of, "scene or study")
      ->check(CLI::IsMember({"scene", "study"}))
      ->capture_default_str();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return finish(app, error, argc, argv);
  }
  if (*new_app) return new_command(made);
  if (*run_app) return run.accuracy || run.seconds ? aimed_run_command(run) : run_command(run);
  if (*check_app) return check_command(scene, overrides);
  if (*study_app) return study_command(study);
  if (*price_app) return price_command(price);
  if (*advise_app) return advise_command(advise);
  if (*ablate_app) return ablate_command(ablate);
  if (*sensors_app) return sensors_command(sensors);
  if (*render_app) return render_command(render);
  if (*schema_app) {
    fmt::print("{}", schema_of == "scene" ? scene_schema() : study_schema());
    return exit_code::done;
  }
  return report_command(directory);
}

}  // namespace
}  // namespace splashdown::apps

int main(int argc, char** argv) {
  try {
    return splashdown::apps::command_line(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", splashdown::apps::trouble(error));
    return splashdown::apps::exit_code::cannot_go_on;
  }
}
