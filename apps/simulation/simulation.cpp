#include "apps/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "apps/build/build.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/parts.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/simulation/checkpoint.hpp"
#include "apps/simulation/simulation_of.hpp"

namespace splashdown {
namespace {

using namespace apps;

/// The rotations of a twist or a wrench.
template <int d>
Eigen::Vector3d turning(const Twist<d>& twist) {
  return rotation_in_space<d>(twist.template tail<rigid::rotations<d>>());
}

template <int d>
BodyNow body_at(const BodySpec<d>& spec, const BodyState<d>& state) {
  BodyNow now{.name = spec.name};
  now.position = in_space<d>(state.pose.translation());
  now.rotation.template topLeftCorner<d, d>() = state.pose.linear();
  now.velocity = in_space<d>(state.velocity.template head<d>());
  now.spin = turning<d>(state.velocity);
  return now;
}

/// A force that a program computes.
template <int d>
class Called final : public rigid::Force<d> {
 public:
  Called(std::size_t body, std::function<SimulationHooks::Push(double, const BodyNow&)> push)
      : body_(body), push_(std::move(push)) {}
  std::string name() const override { return "called"; }
  bool is_of_velocity() const override { return true; }
  void add(const rigid::BodiesAt<d>& at, std::span<rigid::Wrench<d>> wrenches) const override {
    const auto push = push_(at.time, body_at<d>(at.specs[body_], at.states[body_]));
    auto& wrench = wrenches[body_];
    wrench.template head<d>() += push.force.template head<d>();
    wrench.template tail<freedoms<d> - d>() += push.moment.template tail<freedoms<d> - d>();
  }

 private:
  std::size_t body_;
  std::function<SimulationHooks::Push(double, const BodyNow&)> push_;
};

std::size_t index_of(const Scene& scene, const std::string& body) {
  const auto found = std::ranges::find(scene.bodies, body, &Body::name);
  if (found == scene.bodies.end()) throw std::invalid_argument("the scene has no body named '" + body + "'");
  return static_cast<std::size_t>(found - scene.bodies.begin());
}

template <int d>
Hooks<d> hooks_of(const Scene& scene, const SimulationHooks& hooks) {
  Hooks<d> out;
  for (const auto& [body, push] : hooks.forces)
    out.forces.push_back(std::make_unique<Called<d>>(index_of(scene, body), push));
  for (const auto& [body, pose] : hooks.paths)
    out.paths[body] = [pose](double time) {
      const auto at = pose(time);
      Isometry<d> isometry = Isometry<d>::Identity();
      isometry.translation() = at.position.template head<d>();
      isometry.linear() = at.rotation.template topLeftCorner<d, d>();
      return isometry;
    };
  return out;
}

/// Contiguous arrays of vectors as their numbers.
template <class Number, class Rows>
std::span<const Number> flat(const Rows& rows) {
  static_assert(sizeof(typename Rows::value_type) % sizeof(Number) == 0);
  return {reinterpret_cast<const Number*>(rows.data()),
          rows.size() * (sizeof(typename Rows::value_type) / sizeof(Number))};
}

}  // namespace

class Simulation::State {
 public:
  explicit State(SceneFile file) : file_(std::move(file)) {}
  virtual ~State() = default;
  const SceneFile& file() const { return file_; }
  virtual bool advance(double stop) = 0;
  virtual coupling::Stepper& stepper() = 0;
  virtual std::vector<BodyNow> bodies() const = 0;
  virtual std::optional<WaterNow> water() const = 0;
  virtual std::optional<double> pressure_at(const Eigen::Vector3d& point) const = 0;

  const std::optional<StepMade>& tried() const { return tried_; }
  LoopState& loop() { return loop_; }
  /// As it was before the step that was tried.
  const LoopState& loop_at_tn() const { return tried_ ? before_ : loop_; }
  void forget() { tried_.reset(); }
  void expect_tried() const {
    if (!tried_) throw std::logic_error("nothing is known before advance()");
  }

 protected:
  SceneFile file_;
  LoopState loop_, before_;
  StepPlan plan_;
  std::optional<StepMade> tried_;
};

template <int d>
class Simulation::StateOf final : public Simulation::State, private StepHost {
 public:
  StateOf(SceneFile file, const SimulationHooks& hooks)
      : State(std::move(file)),
        simulation_(file_.scene, build_world<d>(file_.scene, {}, hooks_of<d>(file_.scene, hooks))) {}

  coupling::Stepper& stepper() override { return simulation_.stepper(); }

  bool advance(double stop) override {
    Steps steps(simulation_.stepper(), loop_, *this);
    if (tried_ && tried_->last) return false;
    if (tried_) steps.commit(plan_, *tried_, stop);
    tried_.reset();
    before_ = loop_;
    plan_ = steps.plan(stop);
    if (!plan_.failure.empty()) throw CannotGoOn(plan_.failure);
    auto tried = steps.attempt(plan_);
    if (!tried.made.report.ok())
      throw CannotGoOn(fmt::format("the simulation could not go on at t = {:.9g} s, step {}: {}{}{}", tried.made.time,
                                   loop_.steps, tried.made.report.cause, tried.cure.empty() ? "" : ". ", tried.cure));
    tried_ = std::move(tried.made);
    return true;
  }

  std::vector<BodyNow> bodies() const override {
    const auto known = simulation_.known(*tried_);
    std::vector<BodyNow> out;
    for (std::size_t i = 0; known.bodies && i < known.bodies->size(); ++i) {
      auto body = body_at<d>(known.bodies->spec(i), known.bodies->state(i));
      body.velocity = in_space<d>(known.body_velocity_n[i].template head<d>());
      body.spin = turning<d>(known.body_velocity_n[i]);
      body.acceleration = in_space<d>(known.body_acceleration_n[i].template head<d>());
      body.angular_acceleration = turning<d>(known.body_acceleration_n[i]);
      const Wrench<d> load = known.body_load[i].total();
      body.force = in_space<d>(load.template head<d>());
      body.moment = turning<d>(load);
      body.wetted = known.body_load[i].wetted;
      out.push_back(std::move(body));
    }
    return out;
  }

  std::optional<WaterNow> water() const override {
    const auto* fluid = simulation_.known(*tried_).fluid;
    if (!fluid) return {};
    const auto points = fluid->points();
    WaterNow now;
    now.positions = flat<double>(points);
    now.pressure = fluid->pressure();
    now.cells = flat<int>(fluid->cells());
    now.velocities.reserve(d * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<d> v = fluid->velocity_n(i);
      now.velocities.insert(now.velocities.end(), v.data(), v.data() + d);
    }
    for (const auto& facet : fluid->boundary()) {
      now.boundary.insert(now.boundary.end(), facet.nodes.begin(), facet.nodes.end());
      now.walls.push_back(facet.wall);
    }
    const auto& ledger = fluid->ledger();
    now.volume = ledger.volume + ledger.spray;
    now.kinetic = ledger.kinetic_energy;
    now.potential = ledger.potential_energy;
    return now;
  }

  std::optional<double> pressure_at(const Eigen::Vector3d& point) const override {
    const auto* fluid = simulation_.known(*tried_).fluid;
    return fluid ? fluid->pressure_at(Vec<d>(point.template head<d>())) : std::nullopt;
  }

 private:
  double dt_bound() const override { return simulation_.dt_bound(); }
  std::optional<Obstacle> obstacle() override { return simulation_.obstacle(); }

  SimulationOf<d> simulation_;
};

Simulation::Simulation(std::unique_ptr<State> state) : state_(std::move(state)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Simulation Simulation::made(SceneFile file, const SimulationHooks& hooks) {
  if (file.scene.dimension == 2) return Simulation(std::make_unique<StateOf<2>>(std::move(file), hooks));
  return Simulation(std::make_unique<StateOf<3>>(std::move(file), hooks));
}

Simulation Simulation::open(const std::filesystem::path& scene, const std::vector<std::string>& set,
                            const SimulationHooks& hooks) {
  return made(read_scene(scene, set), hooks);
}

Simulation Simulation::of_text(const std::string& toml, const std::filesystem::path& folder,
                               const std::vector<std::string>& set, const SimulationHooks& hooks) {
  return made(read_scene_text(toml, (folder / "scene.toml").string(), set), hooks);
}

bool Simulation::advance() { return state_->advance(end()); }

bool Simulation::advance_to(double time) {
  while (advance())
    if (this->time() >= std::min(time, end())) return true;
  return false;
}

int Simulation::dimension() const { return state_->file().scene.dimension; }
const std::string& Simulation::title() const { return state_->file().scene.title; }
const std::string& Simulation::resolved() const { return state_->file().resolved; }
double Simulation::time() const { return state_->stepper().time(); }
double Simulation::end() const { return state_->file().scene.time.end; }
double Simulation::dt() const { return state_->tried() ? state_->tried()->dt : 0; }
long Simulation::steps() const { return state_->loop().steps; }
int Simulation::passes() const { return state_->tried() ? state_->tried()->report.passes : 0; }

std::vector<std::string> Simulation::body_names() const { return apps::body_names(state_->file().scene); }

std::vector<BodyNow> Simulation::bodies() const {
  state_->expect_tried();
  return state_->bodies();
}

std::optional<WaterNow> Simulation::water() const {
  state_->expect_tried();
  return state_->water();
}

std::optional<double> Simulation::pressure_at(const Eigen::Vector3d& point) const {
  state_->expect_tried();
  return state_->pressure_at(point);
}

void Simulation::save(const std::filesystem::path& folder) {
  std::ostringstream stepper;
  state_->stepper().save(stepper);
  write_checkpoint(folder, {.scene = resolved(),
                            .loop = state_->loop_at_tn(),
                            .time = time(),
                            .wall_seconds = 0,
                            .processor_seconds = 0,
                            .phases = {},
                            .stepper = std::move(stepper).str(),
                            .recorder = {}});
}

void Simulation::restore(const std::filesystem::path& folder) {
  const auto stored = read_checkpoints(folder);
  if (stored.good.empty())
    throw std::runtime_error(folder.string() + ": " +
                             (stored.bad.empty() ? "holds no checkpoint" : "checkpoint " + stored.bad.front()));
  const auto& state = stored.good.front().state;
  if (state.scene != resolved()) throw std::runtime_error(folder.string() + ": is the checkpoint of another scene");
  put_back(state, state_->stepper(), state_->loop());
  state_->forget();
}

}  // namespace splashdown
