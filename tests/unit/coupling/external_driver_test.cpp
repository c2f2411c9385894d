// One participant, driven from outside: what an implicit coupling with a solver elsewhere needs (preCICE: Chourdakis et al. 2022).
// The other side says when a state is to be written or read back, and when a step is to be repeated.
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <vector>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::coupling::external_driver_test {
namespace {

constexpr double dt = 1e-3;

/// A solver elsewhere: it takes impulses, gives motions, and repeats a step until both sides agree.
class Elsewhere {
 public:
  Elsewhere(std::unique_ptr<StructurePart> part, int steps) : part_(std::move(part)), left_(steps) { begin(); }

  bool goes_on() const { return left_ > 0; }
  bool wants_state_written() const { return !repeats_; }
  bool wants_state_read() const { return repeats_; }  ///< after `advance`: the step is not the last word
  Step step() const { return {.kick = first_ ? dt / 2 : dt, .dt = dt}; }
  const Velocities& read() const { return velocities_; }
  const Placement& placement() const { return placement_; }  ///< of walls at the end of the step that was advanced
  void write(const Impulse& impulse) { impulse_ = impulse; }

  void advance() {
    const Velocities image = part_->solve(impulse_);
    placement_ = part_->placement();
    most_ = std::max(most_, ++passes_);
    repeats_ = !((image - velocities_).norm() <= 1e-10 * image.norm());
    if (repeats_) {
      velocities_ = scheme_.next(velocities_, image);
      return;
    }
    part_->commit();
    first_ = false;
    if (--left_ > 0) begin();
  }

  const StructurePart& part() const { return *part_; }
  int most_passes() const { return most_; }

 private:
  void begin() {
    part_->begin(step());
    scheme_.begin_step();
    velocities_ = part_->solve(Impulse::Zero(part_->scales().size()));
    passes_ = 0;
  }

  std::unique_ptr<StructurePart> part_;
  IqnIls scheme_{0.5};
  Velocities velocities_;
  Impulse impulse_;
  Placement placement_;
  int left_, passes_ = 0, most_ = 0;
  bool first_ = true, repeats_ = false;
};

Status solve(FluidPart& fluid, const Elsewhere& other) { return fluid.solve({.velocities = other.read()}); }

/// As an adapter for codes that cannot repeat a step: each pass is a whole step, and taken back.
Status drive_by_states(FluidPart& fluid, Elsewhere& other) {
  std::string state;
  while (other.goes_on()) {
    if (other.wants_state_written()) {
      std::ostringstream out;
      fluid.save(out);
      state = out.str();
    }
    if (const auto status = fluid.begin(other.step(), {}); !status.ok()) return status;
    if (const auto status = solve(fluid, other); !status.ok()) return status;
    other.write(fluid.solution().impulse);
    other.advance();
    fluid.commit(other.placement());
    if (!other.wants_state_read()) continue;
    std::istringstream in(state);
    fluid.load(in);
  }
  return {};
}

/// As they are meant: one step, solved until the other side is content.
Status drive_by_repeats(FluidPart& fluid, Elsewhere& other) {
  while (other.goes_on()) {
    if (other.wants_state_written())
      if (const auto status = fluid.begin(other.step(), {}); !status.ok()) return status;
    if (const auto status = solve(fluid, other); !status.ok()) return status;
    other.write(fluid.solution().impulse);
    other.advance();
    if (!other.wants_state_read()) fluid.commit(other.placement());
  }
  return {};
}

scenes::Scene scene() { return scenes::submerged_circle(0.5, 0.2); }

std::unique_ptr<StructurePart> bodies() { return std::make_unique<rigid::Participant<2>>(scenes::bodies_of(scene())); }

std::string state_of(const Participant& part) {
  std::ostringstream out;
  part.save(out);
  return out.str();
}

constexpr int steps = 4;

TEST(ExternalDriver, that_takes_steps_back_and_one_that_repeats_them_end_with_the_same_bits) {
  fluid::Participant<2> taken_back(scenes::water_of(scene())), repeated(scenes::water_of(scene()));
  Elsewhere one(bodies(), steps), other(bodies(), steps);
  ASSERT_TRUE(drive_by_states(taken_back, one).ok());
  ASSERT_TRUE(drive_by_repeats(repeated, other).ok());
  EXPECT_GT(one.most_passes(), 2) << "light in water: there is something to repeat";
  EXPECT_EQ(one.most_passes(), other.most_passes());
  EXPECT_EQ(state_of(taken_back), state_of(repeated));
  EXPECT_EQ(state_of(one.part()), state_of(other.part()));
}

TEST(ExternalDriver, finds_the_velocities_of_the_exact_term) {
  fluid::Participant<2> water(scenes::water_of(scene()));
  Elsewhere other(bodies(), steps);
  ASSERT_TRUE(drive_by_repeats(water, other).ok());
  const auto exact = scenes::coupled(scene());
  for (int k = 0; k < steps; ++k) {
    ASSERT_TRUE(exact->attempt(dt).ok());
    exact->commit();
  }
  // The corrections of the pressure are cut off; what they leave depends on the term, 1e-5 a step (steppers_test.cpp).
  const auto& body = exact->bodies().state(0).velocity;
  EXPECT_LE((other.part().velocities() - Velocities(body)).norm(), steps * 1e-5 * body.norm());
}

TEST(ExternalDriver, of_bodies_replays_impulses_bit_for_bit) {
  Elsewhere recorded(bodies(), steps);
  fluid::Participant<2> water(scenes::water_of(scene()));
  const auto replayed = bodies();
  for (int k = 0; k < steps; ++k) {
    const Step step = recorded.step();
    Impulse impulse;
    do {  // a step
      if (recorded.wants_state_written()) {
        ASSERT_TRUE(water.begin(step, {}).ok());
      }
      ASSERT_TRUE(solve(water, recorded).ok());
      recorded.write(impulse = water.solution().impulse);
      recorded.advance();
    } while (recorded.wants_state_read());
    water.commit(recorded.placement());
    replayed->begin(step);
    replayed->solve(2 * impulse);  // a trial leaves no trace
    replayed->solve(impulse);
    replayed->commit();
  }
  EXPECT_EQ(state_of(*replayed), state_of(recorded.part()));
}

TEST(ExternalDriver, that_sends_numbers_of_other_walls_is_told) {
  fluid::Participant<2> water(scenes::water_of(scene()));
  ASSERT_TRUE(water.begin({.kick = dt, .dt = dt}, {}).ok());
  const auto asked = [&](Eigen::Index numbers) { return water.solve({.velocities = Velocities::Zero(numbers)}); };
  EXPECT_THROW(asked(4), std::invalid_argument) << "no wall of the plane has four coordinates";
  EXPECT_THROW(asked(9), std::invalid_argument) << "a circle and a tank";
  EXPECT_TRUE(asked(3).ok()) << "the tank stands still";
  EXPECT_THROW(water.commit(Placement::Zero(5)), std::invalid_argument);
  const auto body = bodies();
  body->begin({.kick = dt, .dt = dt});
  EXPECT_THROW(body->solve(Impulse::Zero(4)), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::coupling::external_driver_test
