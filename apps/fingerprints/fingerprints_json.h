// Fingerprints in the JSON of a view.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/fingerprints/fingerprints.h"

namespace oro {

nlohmann::ordered_json fingerprints_json(const Fingerprints& fingerprints);
// Throws JsonFault.
Fingerprints fingerprints_from(const nlohmann::json& json);

// The pixels' fingerprint as a view's text has it: known when the last of them is drawn, and put where it was
// 0 until then.
std::string pixels_field(std::uint64_t pixels);

}  // namespace oro
