// How the flow is looked at and stored.
#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "core/leapfrog.hpp"
#include "fluid/ale/fluid.hpp"

namespace splashdown::ale {

void AleFlow::look() {
  points_.resize(static_cast<std::size_t>(mesh_.size()));
  for (int a = 0; a < mesh_.size(); ++a) points_[static_cast<std::size_t>(a)] = x_.col(a);
  poses_.clear();
  vertices_.resize(moved_.size());
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const auto& placement = state_.placements[w];
    poses_.push_back(moved_[w].motion->pose(placement));
    if (spec_.walls[w].deforms) vertices_[w] = placement.reshaped(2, placement.size() / 2);
  }
  pressure_.clear();
  finds_ = false;
}

PointPlace AleFlow::place(std::size_t point) const { return {.wall = wall_of_[point]}; }

std::span<const double> AleFlow::pressure() const {
  if (!pressure_.empty()) return pressure_;
  const Eigen::VectorXd p = is_solved_ ? Eigen::VectorXd(at_.tail(mesh_.corners)) : state_.pressure;
  pressure_.resize(points_.size());
  for (int k = 0; k < mesh_.corners; ++k) pressure_[static_cast<std::size_t>(k)] = p[k];
  for (const auto& cell : mesh_.cells)
    for (std::size_t e = 0; e < 3; ++e)
      pressure_[static_cast<std::size_t>(cell[3 + e])] = 0.5 * (p[cell[static_cast<std::size_t>(cell_edges[e][0])]] +
                                                                p[cell[static_cast<std::size_t>(cell_edges[e][1])]]);
  for (std::size_t a = 0; a < points_.size(); ++a)
    pressure_[a] += spec_.density * spec_.gravity.dot(points_[a] - spec_.max);
  return pressure_;
}

Vec<2> AleFlow::velocity_n(std::size_t point) const {
  const Vec<2> before = state_.velocity.col(static_cast<Eigen::Index>(point));
  if (!is_solved_) return before;
  const Vec<2> after = at_.segment<2>(2 * static_cast<Eigen::Index>(point));
  return velocity_at_t_n(before, after, state_.dt, dt_);
}

std::optional<double> AleFlow::pressure_at(const Vec<2>& point) const {
  if (!finds_) finder_.place(pieces_, points_);
  finds_ = true;
  const auto found = finder_.find(point);
  if (!found) return {};
  const auto p = pressure();
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += found->at[k] * p[static_cast<std::size_t>(pieces_[found->piece][static_cast<std::size_t>(k)])];
  return sum;
}

std::vector<Diagnostic> AleFlow::diagnostics() const {
  return {{"newton_iterations", static_cast<double>(iterations_)},
          {"mesh_stretch", equations_.least_stretch(x_)},
          {"divergence", std::sqrt(equations_.divergence(x_, state_.velocity))}};
}

namespace {

template <class Numbers>
void put_ale(std::ostream& out, const Numbers& numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size()) * static_cast<std::streamsize>(sizeof(double)));
}
template <class Numbers>
void get_ale(std::istream& in, Numbers& numbers) {
  in.read(reinterpret_cast<char*>(numbers.data()),
          static_cast<std::streamsize>(numbers.size()) * static_cast<std::streamsize>(sizeof(double)));
  if (!in || !numbers.allFinite()) throw std::runtime_error("holds no state of the fluid");
}

}  // namespace

/// The factor that is kept, and what it answers, are stored as what they are of, and made again.
void AleFlow::save(std::ostream& out) const {
  const bool is_kept = kept_.is_ready(), is_answered = is_kept && kept_answers_.factor == kept_.number();
  Eigen::Matrix<double, 15, 1> numbers;
  numbers << time_, state_.kick, state_.dt, state_.fastest, static_cast<double>(state_.steps), ledger_.work_on_walls,
      ledger_.kinetic_energy, is_kept, is_kept ? kept_.fields().rate : 0, is_kept ? kept_.fields().theta : 0,
      is_answered ? static_cast<double>(kept_answers_.motions.rows()) : 0,
      is_answered ? static_cast<double>(kept_answers_.motions.cols()) : 0, is_answered ? kept_answers_.kick : 0,
      ledger_.work_of_effects, ledger_.potential_energy;
  put_ale(out, numbers);
  for (const auto* field : {&state_.velocity, &state_.before}) put_ale(out, *field);
  put_ale(out, state_.pressure);
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    put_ale(out, state_.placements[w]);
    put_ale(out, state_.rates[w]);
  }
  if (!is_kept) return;
  const auto& of = kept_.fields();
  for (const auto* field : {&of.x, &of.x_after, &of.before, &of.mesh_velocity}) put_ale(out, *field);
  put_ale(out, kept_.at());
  if (!is_answered) return;
  put_ale(out, kept_answers_.motions);
  for (const auto* of_walls : {&kept_answers_.middle, &kept_answers_.placements})
    for (const auto& placement : *of_walls) put_ale(out, placement);
}

void AleFlow::load_answers(std::istream& in, double rows, double columns, double kick) {
  kept_answers_ = {};
  kept_answers_.kick = kick;
  answers_ = &kept_answers_;
  if (columns == 0) return;
  if (!(rows >= 0 && rows <= static_cast<double>(coordinates(moved_.size())) && columns >= 0 && columns <= rows))
    throw std::runtime_error("holds no answers of the fluid");
  kept_answers_.motions.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  get_ale(in, kept_answers_.motions);
  for (auto* of_walls : {&kept_answers_.middle, &kept_answers_.placements}) {
    *of_walls = state_.placements;
    for (auto& placement : *of_walls) get_ale(in, placement);
  }
  find_answers(kept_, kept_answers_);
}

void AleFlow::load(std::istream& in) {
  Eigen::Matrix<double, 15, 1> numbers;
  get_ale(in, numbers);
  if (!(numbers[0] >= 0 && numbers[1] >= 0 && numbers[2] >= 0 && numbers[4] >= 0 && numbers[4] < 1e15))
    throw std::runtime_error("holds no time of the fluid");
  for (auto* field : {&state_.velocity, &state_.before}) get_ale(in, *field);
  get_ale(in, state_.pressure);
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    get_ale(in, state_.placements[w]);
    get_ale(in, state_.rates[w]);
  }
  kept_.drop();
  if (numbers[7] != 0) {
    StepFields of;
    of.rate = numbers[8];
    of.theta = numbers[9];
    for (auto* field : {&of.x, &of.x_after, &of.before, &of.mesh_velocity}) {
      field->resize(2, mesh_.size());
      get_ale(in, *field);
    }
    Unknowns at(equations_.size());
    get_ale(in, at);
    kept_.make(equations_, given_, of, at, assembly_seconds_, factor_seconds_);
    kept_.number(++factorisations_);
  }
  load_answers(in, numbers[10], numbers[11], numbers[12]);
  time_ = numbers[0];
  state_.kick = numbers[1];
  state_.dt = numbers[2];
  state_.fastest = numbers[3];
  state_.steps = static_cast<long>(numbers[4]);
  ledger_.work_on_walls = numbers[5];
  ledger_.kinetic_energy = numbers[6];
  ledger_.work_of_effects = numbers[13];
  ledger_.potential_energy = numbers[14];
  tangent_ = first_ = &kept_;
  is_begun_ = is_solved_ = false;
  x_ = places_of(state_.placements);
  look();
}

}  // namespace splashdown::ale
