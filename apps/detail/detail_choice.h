// Which ground between the posts a view has: what --detail says, and where.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"

namespace oro {

// Around which place the ground between the posts is invented, WGS84.
struct DetailMiddle {
    double lat_deg{};
    double lon_deg{};
    bool operator==(const DetailMiddle&) const = default;
};

struct DetailChoice {
    int halvings{};                        // of the way from post to post, 1 to most_halvings
    std::optional<double> radius_km{};     // nothing: as far as is usual, or as its posts allow
    std::optional<DetailMiddle> middle{};  // from open_view on: the eye's place when the view was made
    bool operator==(const DetailChoice&) const = default;
};
inline constexpr int most_halvings = 6;
inline constexpr double least_detail_km = 0.05, most_detail_km = 500.0;

// "3" or "3,2.5": halvings and the radius in km; nothing for "0", which asks for none. Usage errors for
// anything else.
Result<std::optional<DetailChoice>> detail_choice_from(const std::string& text);
// The words of --detail that ask for it.
std::string words_of(const DetailChoice& choice);

}  // namespace oro
