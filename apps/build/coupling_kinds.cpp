#include "apps/scene/kinds/coupling_kinds.hpp"

#include <fmt/format.h>

#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/interface_term.hpp"

namespace splashdown::apps {
namespace {

using coupling::Accelerator;
using coupling::InterfaceTerm;

std::size_t count(int number) { return static_cast<std::size_t>(number); }

template <class Scheme>
std::unique_ptr<Accelerator> relaxed(const Coupling& c) {
  return std::make_unique<Scheme>(c.relaxation);
}

template <class Term>
std::unique_ptr<InterfaceTerm> term() {
  return std::make_unique<Term>();
}

}  // namespace

std::span<const AcceleratorKind> accelerator_kinds() {
  static const AcceleratorKind kinds[] = {
      {.name = "constant", .make = relaxed<coupling::ConstantRelaxation>},
      {.name = "aitken", .make = relaxed<coupling::Aitken>},
      {.name = "anderson",
       .make = [](const Coupling& c) -> std::unique_ptr<Accelerator> {
         return std::make_unique<coupling::Anderson>(c.relaxation, count(c.depth));
       },
       .details = [](const Coupling& c) { return fmt::format("depth {}", c.depth); }},
      {.name = "broyden", .make = relaxed<coupling::Broyden>},
      {.name = "iqn_ils",
       .make = [](const Coupling& c) -> std::unique_ptr<Accelerator> {
         return std::make_unique<coupling::IqnIls>(c.relaxation, count(c.reuse));
       },
       .details = [](const Coupling& c) { return fmt::format("reuse {}", c.reuse); }},
      {.name = "probe", .make = relaxed<coupling::Probe>, .staggered_passes = 2}};
  return kinds;
}

std::span<const InterfaceKind> interface_kinds() {
  static const InterfaceKind kinds[] = {{"rigid", nullptr},
                                        {"laplacian", term<coupling::LaplacianTerm>},
                                        {"robin", term<coupling::RobinTerm>},
                                        {"none", term<coupling::NoTerm>}};
  return kinds;
}

}  // namespace splashdown::apps
