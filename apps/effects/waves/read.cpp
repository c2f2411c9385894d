// The keys of [waves].
#include "apps/effects/waves/waves.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

void read_regular(Reader& reader, Waves& table) {
  reader.choice("theory", table.theory, {"stream_function", "linear"});
  reader.number("height", table.height, positive("m", "Use the height of a crest above a trough."), Need::required);
  reader.number("period", table.period, positive("s", "Use the time from crest to crest, or give the length."));
  reader.number("length", table.length, positive("m", "Use the distance from crest to crest, or give the period."));
  if (table.period.has_value() == table.length.has_value())
    reader.context().problems.add(reader.key(table.length ? "length" : "period"), "a wave has a period or a length",
                                  table.length ? "Remove one of them." : "Give one of them.");
  reader.number("phase_deg", table.phase_deg,
                any("deg", "Use e.g. 0 for a crest in the tank's middle, 180 for a trough."));
}

void read_spectrum(Reader& reader, Waves& table) {
  reader.number("peak_period", table.peak_period, positive("s", "Use the period of the largest waves."),
                Need::required);
  reader.number("gamma", table.gamma, within(1, 20, "", "Use 3.3 for JONSWAP, 1 for Pierson and Moskowitz."));
}

void read_irregular(Reader& reader, Waves& table) {
  reader.number("significant_height", table.significant_height,
                positive("m", "Use the mean height of the highest third of the waves."), Need::required);
  read_spectrum(reader, table);
  reader.integer("seed", table.seed, within(0, 2e9, "", "Use any whole number; the same seed gives the same sea."));
  reader.integer("repeat", table.repeat, within(10, 5000, "", "Use at least as many peak periods as the run lasts."));
  if (reader.context().dimension == 3)
    reader.number("spreading", table.spreading,
                  within(0, 1000, "", "Use e.g. 10 for wind waves, 50 for swell, 0 for none."));
  else
    reader.refuse("spreading", "in the plane all waves run one way", "Remove it, or use dimension = 3.");
}

void read_focused(Reader& reader, Waves& table) {
  reader.number("crest", table.crest, positive("m", "Use the height of the crest above still water."), Need::required);
  read_spectrum(reader, table);
  table.repeat = 40;
  reader.point("focus", table.focus, place_rule(reader.context().dimension), Need::required);
  reader.number("focus_time", table.focus_time, any("s", "Use the time at which the crest shall be there."),
                Need::required);
}

void read_direction(Reader& reader, Waves& table) {
  reader.number("direction_deg", table.direction_deg,
                any("deg", "Use 0 for waves that run along x, 180 for waves that run against it."));
  if (reader.context().dimension == 2 && table.direction_deg != 0 && table.direction_deg != 180)
    reader.context().problems.add(reader.key("direction_deg"), "must be 0 or 180 in the plane",
                                  "Use dimension = 3 for others.");
}

void read_zones(Reader& reader, Waves& table) {
  reader.number("zone", table.zone, positive("m", "Use 1.5 wavelengths, the default."));
  if (reader.context().dimension == 3)
    reader.number("side_zone", table.side_zone, not_negative("m", "Use a wavelength, or 0 for walls that throw back."));
  reader.number("rate", table.rate,
                positive("1/s", "Use three times the waves' angular frequency, about the default."));
  reader.number("ramp", table.ramp, not_negative("s", "Use e.g. two periods, or 0 for a sea that is there at t = 0."));
}

double phase_of(const std::string& at) { return at == "crest" ? 0 : at == "back" ? 90 : at == "trough" ? 180 : 270; }

void read_touchdown(Reader& reader, const Scene& scene, Waves& table) {
  Waves::Touchdown touchdown;
  const auto body = read_body_name(reader, "body", scene, Need::required, "touchdown");
  std::string at;
  if (reader.holds("phase_deg")) {
    reader.number("phase_deg", touchdown.phase_deg,
                  any("deg", "Use 0 for the crest, 90 for the back, 180 for the trough, 270 for the front."),
                  Need::required);
    reader.refuse("at", "at and phase_deg exclude each other", "Remove one of them.");
  } else {
    if (!reader.choice("at", at, {"crest", "trough", "front", "back"}, Need::required)) return;
    touchdown.phase_deg = phase_of(at);
  }
  if (body) touchdown.body = *body, table.touchdown = touchdown;
}

}  // namespace

void WavesKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Waves>();
  if (!reader.choice("type", table.type, {"regular", "irregular", "focused"}, Need::required)) return reader.skip_all();
  if (table.type == "regular") read_regular(reader, table);
  if (table.type == "irregular") read_irregular(reader, table);
  if (table.type == "focused") read_focused(reader, table);
  read_direction(reader, table);
  reader.number("current", table.current, any("m/s", "Use the water's speed over ground along the waves; 0 is none."));
  read_zones(reader, table);
  if (table.type == "irregular")
    reader.refuse("touchdown", "an irregular sea has no one phase",
                  "Use type = \"regular\" or \"focused\", or try seeds.");
  else if (auto touchdown = reader.table("touchdown"))
    read_touchdown(*touchdown, scene, table);
}

}  // namespace splashdown::apps
