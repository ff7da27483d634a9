// What the readers of the forms in place.h share: not for use outside place*.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/places/place.h"

namespace oro::place_text {

// The usage error for a place that cannot be read; `text` is shown on one line, control characters escaped.
Error refused(const std::string& text, const std::string& what);

// Range checks and longitude -180 -> 180. `letters`: N/S/E/W were written, so the two cannot be swapped.
Result<Place> checked(const std::string& text, double lat_deg, double lon_deg, const std::string& form,
                      bool letters);

// A finite decimal number, "-7.5", "+8", "1e-3", and nothing after it; independent of the locale.
std::optional<double> decimal_number(const std::string& token);

std::vector<std::string> words(const std::string& text);

// One of these, when the text has its form, or nothing. `plain`: ASCII, trimmed; `text`: what the person
// wrote.
std::optional<Result<Place>> read_utm_ups(const std::string& text, const std::string& plain);
std::optional<Result<Place>> read_mgrs(const std::string& text, const std::string& plain);
Result<Place> read_geohash(const std::string& text, const std::string& hash);
bool reads_as_geohash(const std::string& lower_case);

}  // namespace oro::place_text
