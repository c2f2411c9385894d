// The catalogue: a row an effect.
#include "apps/effects/absorber/absorber.hpp"
#include "apps/effects/aero/aero.hpp"
#include "apps/effects/compressibility/compressibility.hpp"
#include "apps/effects/elastic/elastic.hpp"
#include "apps/effects/force/force.hpp"
#include "apps/effects/form_drag/form_drag.hpp"
#include "apps/effects/gravity/gravity.hpp"
#include "apps/effects/lines/lines.hpp"
#include "apps/effects/skin_friction/skin_friction.hpp"
#include "apps/effects/symmetry/symmetry.hpp"
#include "apps/effects/viscosity/viscosity.hpp"
#include "apps/effects/wavemaker/wavemaker.hpp"
#include "apps/effects/waves/waves.hpp"
#include "apps/effects/wind/wind.hpp"

namespace splashdown::apps {
namespace {

template <class Kind>
const EffectKind* row() {
  static const Kind kind;
  return &kind;
}

}  // namespace

std::span<const EffectKind* const> effect_kinds() {
  static const EffectKind* const catalogue[] = {
      row<GravityKind>(),  row<ViscosityKind>(), row<AbsorberKind>(),  row<SkinFrictionKind>(),
      row<FormDragKind>(), row<WindKind>(),      row<AeroKind>(),      row<ForceKind>(),
      row<LinesKind>(),    row<WavesKind>(),     row<WavemakerKind>(), row<CompressibilityKind>(),
      row<ElasticKind>(),
      row<SymmetryKind>(),  // the last: it cuts what the others have made
  };
  return catalogue;
}

}  // namespace splashdown::apps
