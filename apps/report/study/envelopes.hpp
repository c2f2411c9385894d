// Where in the plane of two axes a limit is passed, as maps on the page of a campaign.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace splashdown::apps {

/// A map a limit whose groups lie over two axes of numbers, or that the study has an [envelope] of; HTML. From the entry `campaign` of
/// study.json.
std::string envelopes(const nlohmann::ordered_json& campaign);

}  // namespace splashdown::apps
