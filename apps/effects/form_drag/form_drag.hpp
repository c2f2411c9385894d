// [fluid.form_drag]: drag of separated flow on hulls, which an inviscid fluid does not know.
#pragma once

#include <map>

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct FormDrag {
  std::map<std::string, double> coefficients;  ///< of bodies by name; of the others: by their shape (shape_classes.hpp)
};

class FormDragKind final : public EffectOf<FormDragKind, FormDrag> {
 public:
  std::string_view name() const override { return "form_drag"; }
  std::optional<std::string> asymmetry(const Scene&, const Mirror&) const override { return {}; }
  TablePlace place() const override { return TablePlace::fluid; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Advice> advise(const Outlook& look) const override;

 private:
  friend EffectOf;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
