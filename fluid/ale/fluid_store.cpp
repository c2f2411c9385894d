// How the flow is stored.
#include <istream>
#include <ostream>
#include <stdexcept>

#include "fluid/ale/fluid.hpp"
#include "fluid/ale/mesh_spec.hpp"

namespace splashdown::ale {
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

using StoredNumbers = Eigen::Matrix<double, 20, 1>;

}  // namespace

/// The mesh, the factor that is kept and what it answers are stored as what they are of, and made again.
void AleFlow::save(std::ostream& out) const {
  const bool is_kept = kept_.is_ready(), is_answered = is_kept && kept_answers_.factor == kept_.number();
  StoredNumbers numbers;
  numbers << time_, state_.kick, state_.dt, state_.fastest, static_cast<double>(state_.steps), ledger_.work_on_walls,
      ledger_.kinetic_energy, is_kept, is_kept ? kept_.fields().rate : 0, is_kept ? kept_.fields().theta : 0,
      is_answered ? static_cast<double>(kept_answers_.motions.rows()) : 0,
      is_answered ? static_cast<double>(kept_answers_.motions.cols()) : 0, is_answered ? kept_answers_.kick : 0,
      ledger_.work_of_effects, ledger_.potential_energy, static_cast<double>(remeshings_), ledger_.energy_remesh,
      momentum_of_remesh_, static_cast<double>(missed_), bearable_;
  put_ale(out, numbers);
  if (remeshings_ > 0)
    for (const auto& placement : made_at_) put_ale(out, placement);
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

/// The mesh that the stored state is on, of so many remeshings.
void AleFlow::load_mesh(std::istream& in, double remeshings) {
  if (!(remeshings >= 0 && remeshings < 1e15)) throw std::runtime_error("holds no mesh of the fluid");
  if (remeshings > 0) {
    auto placements = made_at_;
    for (auto& placement : placements) get_ale(in, placement);
    try {
      auto made = mesh_around(placements);
      adopt(std::move(made.mesh), made.at_start, std::move(placements));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(std::string("holds no mesh of the fluid: ") + error.what());
    }
  } else if (remeshings_ > 0) {
    auto mesh = flow_mesh(mesh_spec(spec_), lines_);
    const Nodes at_start = mesh.nodes;
    std::vector<Eigen::VectorXd> placements;
    for (const auto& wall : moved_) placements.push_back(wall.motion->first());
    adopt(std::move(mesh), at_start, std::move(placements));
  }
  remeshings_ = static_cast<long>(remeshings);
  state_.velocity.resize(2, mesh_.size());
  state_.before.resize(2, mesh_.size());
  state_.pressure.resize(mesh_.corners);
}

void AleFlow::load(std::istream& in) {
  StoredNumbers numbers;
  get_ale(in, numbers);
  if (!(numbers[0] >= 0 && numbers[1] >= 0 && numbers[2] >= 0 && numbers[4] >= 0 && numbers[4] < 1e15 &&
        numbers[18] >= 0 && numbers[18] < 1e15))
    throw std::runtime_error("holds no time of the fluid");
  load_mesh(in, numbers[15]);
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
  ledger_.energy_remesh = numbers[16];
  momentum_of_remesh_ = numbers[17];
  missed_ = static_cast<long>(numbers[18]);
  bearable_ = numbers[19];
  tangent_ = first_ = &kept_;
  is_begun_ = is_solved_ = false;
  x_ = places_of(state_.placements);
  look();
}

}  // namespace splashdown::ale
