// A wall's state in a checkpoint.
#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <type_traits>

#include "core/stored.hpp"
#include "fluid/vortex/penalised/wall.hpp"

namespace splashdown::vortex {
namespace {

template <class Number>
void put(std::ostream& out, const Number* from, std::size_t count) {
  out.write(reinterpret_cast<const char*>(from), static_cast<std::streamsize>(count * sizeof(Number)));
}
template <class Number>
void get(std::istream& in, Number* to, std::size_t count) {
  if (!in.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof(Number))))
    throw std::runtime_error("the forces of a wall end early");
  if constexpr (std::is_same_v<Number, double>)
    if (!std::all_of(to, to + count, [](double x) { return std::isfinite(x); }))
      throw std::runtime_error("holds forces of a wall that are not finite");
}

}  // namespace

void PenalisedWall::save(std::ostream& out) const {
  put(out, &force_.box, 1);
  put(out, placed_.matrix().data(), 9);
  put(out, filling_.data(), 3);
  const std::uint64_t count = force_.field.u.size();
  put(out, &count, 1);
  put(out, force_.field.u.data(), force_.field.u.size());
  put(out, force_.field.v.data(), force_.field.v.size());
}

void PenalisedWall::load(std::istream& in) {
  get(in, &force_.box, 1);
  get(in, placed_.matrix().data(), 9);
  get(in, filling_.data(), 3);
  const std::size_t count = stored_count(in, 2 * sizeof(double));
  const auto& box = force_.box;
  const bool fits = box.i0 >= 0 && box.j0 >= 0 && box.width >= 0 && box.height >= 0 && box.width <= grid_.nx + 1 &&
                    box.height <= grid_.ny + 1 && box.i0 <= grid_.nx + 1 - box.width &&
                    box.j0 <= grid_.ny + 1 - box.height;
  if (!fits || (count != 0 && count != box.size())) throw std::runtime_error("holds forces of another grid");
  force_.field.u.resize(count);
  force_.field.v.resize(count);
  get(in, force_.field.u.data(), count);
  get(in, force_.field.v.data(), count);
  is_covered_ = false;
}

}  // namespace splashdown::vortex
