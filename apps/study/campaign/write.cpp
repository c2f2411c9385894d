#include <fmt/format.h>

#include <algorithm>

#include "apps/files/csv.hpp"
#include "apps/study/campaign/results.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json json_of_band(const std::optional<Band>& band) { return band ? Json{band->low, band->high} : Json(nullptr); }

Json where(const Group& group) {
  Json at = Json::object();
  for (const auto& [axis, value] : group.at) at[axis] = value;
  return at;
}

std::string where_text(const Group& group) {
  std::string text;
  for (const auto& [axis, value] : group.at) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", axis, value);
  return text;
}

std::string cells(const std::optional<Band>& band) { return band ? fmt::format("{},{}", band->low, band->high) : ","; }

std::string aliases_text(const Effect& effect, const Campaign& campaign) {
  std::string text;
  for (const Factors alias : effect.aliases)
    if (alias != effect.factors) text += (text.empty() ? "" : " + ") + product_text(alias, campaign.factors);
  return text;
}

std::string statistics_csv(const Campaign& campaign) {
  std::string text =
      "quantity,at,runs,without,mean,mean_low,mean_high,deviation,least,share_5,quarter,median,median_low,median_high,"
      "three_quarters,share_95,most,split\n";
  for (const auto& entry : campaign.statistics) {
    const auto& s = entry.found;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", entry.quantity,
                        csv_cell(where_text(*entry.group)), s.runs, entry.without, s.mean, cells(s.mean_band),
                        s.deviation, s.least, s.share_5, s.quarter, s.median, cells(s.median_band), s.three_quarters,
                        s.share_95, s.most, s.split ? fmt::format("{}", *s.split) : "");
  }
  return text;
}

std::string convergence_csv(const Campaign& campaign) {
  std::string text = "quantity,at,runs,mean,low,high\n";
  for (const auto& entry : campaign.statistics)
    for (const auto& partial : entry.growth)
      text += fmt::format("{},{},{},{},{}\n", entry.quantity, csv_cell(where_text(*entry.group)), partial.runs,
                          partial.mean, cells(partial.band));
  return text;
}

std::string probabilities_csv(const Campaign& campaign) {
  std::string text = "limit,at,yes,no,within_the_band,without,probability,low,high,low_at_least_95,high_at_least_95\n";
  for (const auto& p : campaign.probabilities)
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", p.limit, csv_cell(where_text(*p.group)), p.yes, p.no, p.open,
                        p.without, p.least().estimate(), cells(p.band()), cells(p.wide_band()));
  return text;
}

std::string effects_csv(const Campaign& campaign) {
  std::string text = "quantity,effect,value,standard_error,low,high,aliases\n";
  for (const auto& [quantity, effects] : campaign.effects)
    for (const auto& effect : effects)
      text += fmt::format("{},{},{},{},{},{}\n", quantity, csv_cell(product_text(effect.factors, campaign.factors)),
                          effect.value, effect.standard_error ? fmt::format("{}", *effect.standard_error) : "",
                          cells(effect.band), csv_cell(aliases_text(effect, campaign)));
  return text;
}

std::string indices_csv(const Campaign& campaign) {
  std::string text = "quantity,at,axis,rows,first,first_low,first_high,total,total_low,total_high\n";
  for (const auto& entry : campaign.indices)
    for (std::size_t a = 0; a < entry.indices.size(); ++a) {
      const auto& index = entry.indices[a];
      text += fmt::format("{},{},{},{},{},{},{},{}\n", entry.quantity, csv_cell(where_text(*entry.group)),
                          campaign.random_axes[a], entry.rows, index.first, cells(index.first_band), index.total,
                          cells(index.total_band));
    }
  return text;
}

std::string envelope_csv(const Campaign& campaign) {
  const auto& envelope = *campaign.envelope;
  std::string text = fmt::format("{},{},yes,no,within_the_band,probability,doubt\n", envelope.x, envelope.y);
  for (const auto& cell : envelope.cells)
    text += fmt::format("{},{},{},{},{},{},{}\n", envelope.x_values[cell.x], envelope.y_values[cell.y], cell.yes,
                        cell.no, cell.open, cell.probability, cell.doubt);
  return text;
}

Json json_of_envelope(const CampaignEnvelope& envelope) {
  Json root = {{"limit", envelope.limit}, {"x", envelope.x}, {"y", envelope.y}, {"level", envelope.level}};
  for (const auto& cell : envelope.cells)
    root["cells"].push_back({{"x", envelope.x_values[cell.x]},
                             {"y", envelope.y_values[cell.y]},
                             {"yes", cell.yes},
                             {"no", cell.no},
                             {"within_the_band", cell.open},
                             {"probability", cell.probability},
                             {"doubt", cell.doubt}});
  return root;
}

/// "envelope of hot: 61 of 400 cells have runs, 12 are in doubt"
std::string envelope_text(const CampaignEnvelope& envelope) {
  const auto known = std::ranges::count_if(envelope.cells,
                                           [](const EnvelopeCell& cell) { return cell.yes + cell.no + cell.open > 0; });
  const auto doubtful =
      std::ranges::count_if(envelope.cells, [&](const EnvelopeCell& cell) { return cell.doubt > envelope.doubt; });
  return fmt::format("  envelope of {}: {} of {} cells have runs, {} are in doubt\n", envelope.limit, known,
                     envelope.cells.size(), doubtful);
}

Json json_of_statistics(const Campaign& campaign) {
  Json list = Json::array();
  for (const auto& entry : campaign.statistics) {
    const auto& s = entry.found;
    list.push_back({{"quantity", entry.quantity},
                    {"at", where(*entry.group)},
                    {"runs", s.runs},
                    {"without", entry.without},
                    {"mean", s.mean},
                    {"mean_band", json_of_band(s.mean_band)},
                    {"deviation", s.deviation},
                    {"least", s.least},
                    {"share_5", s.share_5},
                    {"quarter", s.quarter},
                    {"median", s.median},
                    {"median_band", json_of_band(s.median_band)},
                    {"three_quarters", s.three_quarters},
                    {"share_95", s.share_95},
                    {"most", s.most},
                    {"split", s.split ? Json(*s.split) : Json(nullptr)}});
    for (const auto& partial : entry.growth)
      list.back()["growth"].push_back(
          {{"runs", partial.runs}, {"mean", partial.mean}, {"band", json_of_band(partial.band)}});
  }
  return list;
}

Json json_of_effects(const Campaign& campaign) {
  Json list = Json::array();
  for (const auto& [quantity, effects] : campaign.effects)
    for (const auto& effect : effects)
      list.push_back({{"quantity", quantity},
                      {"effect", product_text(effect.factors, campaign.factors)},
                      {"value", effect.value},
                      {"standard_error", effect.standard_error ? Json(*effect.standard_error) : Json(nullptr)},
                      {"band", json_of_band(effect.band)},
                      {"aliases", aliases_text(effect, campaign)}});
  return list;
}

/// With a space before it; empty for pure numbers.
std::string unit_of(const Study& study, const std::string& quantity) {
  const auto found = std::ranges::find(study.quantities, quantity, &StudyQuantity::name);
  return found == study.quantities.end() || found->unit == "-" ? "" : " " + one_line(found->unit);
}

std::string resolution_text(int resolution) {
  static const std::vector<std::string> roman = {"", "I", "II", "III", "IV", "V", "VI", "VII", "VIII"};
  return resolution < static_cast<int>(roman.size()) ? roman[static_cast<std::size_t>(resolution)]
                                                     : std::to_string(resolution);
}

}  // namespace

Json json_of(const Campaign& campaign) {
  Json root;
  root["statistics"] = json_of_statistics(campaign);
  for (const auto& p : campaign.probabilities)
    root["probabilities"].push_back({{"limit", p.limit},
                                     {"at", where(*p.group)},
                                     {"yes", p.yes},
                                     {"no", p.no},
                                     {"within_the_band", p.open},
                                     {"without", p.without},
                                     {"probability", p.least().estimate()},
                                     {"band", json_of_band(p.band())},
                                     {"band_at_least_95", json_of_band(p.wide_band())}});
  if (const int resolution = campaign.fraction.resolution(); resolution > 0) {
    root["fraction"]["resolution"] = resolution_text(resolution);
    for (const Factors word : campaign.fraction.words())
      root["fraction"]["words"].push_back(product_text(word, campaign.factors));
  }
  if (campaign.envelope) root["envelope"] = json_of_envelope(*campaign.envelope);
  if (const auto& stop = campaign.stop)
    root["stop"] = {{"of", stop->of}, {"asked", stop->asked}, {"width", stop->width}, {"reached", stop->is_reached()}};
  if (!campaign.effects.empty()) root["effects"] = json_of_effects(campaign);
  for (const auto& entry : campaign.indices)
    for (std::size_t a = 0; a < entry.indices.size(); ++a)
      root["sobol_indices"].push_back({{"quantity", entry.quantity},
                                       {"at", where(*entry.group)},
                                       {"axis", campaign.random_axes[a]},
                                       {"rows", entry.rows},
                                       {"first", entry.indices[a].first},
                                       {"first_band", json_of_band(entry.indices[a].first_band)},
                                       {"total", entry.indices[a].total},
                                       {"total_band", json_of_band(entry.indices[a].total_band)}});
  return root;
}

void write_campaign(const Campaign& campaign, const fs::path& folder) {
  const auto write = [&](const char* name, bool has_rows, const auto& text) {
    has_rows ? write_file_atomically(folder / name, text(campaign)) : void(fs::remove(folder / name));
  };
  write("statistics.csv", !campaign.statistics.empty(), statistics_csv);
  write("convergence.csv", std::ranges::any_of(campaign.statistics, [](const auto& s) { return !s.growth.empty(); }),
        convergence_csv);
  write("probabilities.csv", !campaign.probabilities.empty(), probabilities_csv);
  write("effects.csv", !campaign.effects.empty(), effects_csv);
  write("sobol_indices.csv", !campaign.indices.empty(), indices_csv);
  write("envelope.csv", campaign.envelope.has_value(), envelope_csv);
}

std::string campaign_text(const Campaign& campaign, const Study& study) {
  std::string text;
  for (const auto& p : campaign.probabilities) {
    if (p.group != &campaign.groups.front()) continue;
    const auto band = p.band();
    if (campaign.envelope && campaign.envelope->limit == p.limit) {
      text += fmt::format("  limit {}: yes in {} of {} runs, which were chosen near its line\n", p.limit, p.yes,
                          p.answered());
      continue;
    }
    text += fmt::format("  limit {}: yes in {} of {} runs{}: {:.1f} %, band {:.1f} to {:.1f} %{}\n", p.limit, p.yes,
                        p.answered(), p.open > 0 ? fmt::format(", open in {}", p.open) : "", 100 * p.least().estimate(),
                        100 * band.low, 100 * band.high,
                        p.without > 0 ? fmt::format("; {} runs have no answer", p.without) : "");
  }
  for (const auto& entry : campaign.statistics) {
    if (entry.group != &campaign.groups.front()) continue;
    const auto& s = entry.found;
    const auto unit = unit_of(study, entry.quantity);
    text += fmt::format("  {}: mean {}{}{} of {} runs, median {}{}, 90 % of them {} to {}{}{}\n", entry.quantity,
                        digits(s.mean), s.mean_band ? " ± " + digits(s.mean_band->high - s.mean, 2) : "", unit, s.runs,
                        digits(s.median), unit, digits(s.share_5), digits(s.share_95), unit,
                        s.split ? ", two modes, apart at " + digits(*s.split, 3) + unit : "");
  }
  if (const int resolution = campaign.fraction.resolution(); resolution > 0) {
    std::string words;
    for (const Factors word : campaign.fraction.words())
      words += (words.empty() ? "" : ", ") + product_text(word, campaign.factors);
    text += fmt::format("  fraction of resolution {}: 1 = {}\n", resolution_text(resolution), words);
  }
  if (campaign.envelope) text += envelope_text(*campaign.envelope);
  return text;
}

}  // namespace splashdown::apps
