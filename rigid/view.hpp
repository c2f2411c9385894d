// What people look at in bodies: what they are, and their state at t_n. Records know bodies by this alone.
#pragma once

#include "rigid/body.hpp"

namespace splashdown::rigid {

template <int d>
class View {
 public:
  virtual ~View() = default;
  virtual std::size_t size() const = 0;
  virtual const BodySpec<d>& spec(std::size_t body) const = 0;
  virtual const BodyState<d>& state(std::size_t body) const = 0;  ///< at t_n
};

}  // namespace splashdown::rigid
