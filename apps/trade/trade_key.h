// What a row of a trade is of, as a type: shots, settings and effects find each other by it.
#pragma once

#include <optional>
#include <string>

#include "apps/view/accuracy.h"
#include "core/effects/effect_table.h"

namespace oro {

// Of full detail where it names nothing. A bundle leaves out several effects at a time, and names none.
struct TradeKey {
    std::optional<EffectKind> effect{};  // of the model: left out or rounded, alone; of the data: as it is
    std::optional<double> tau_px{};      // how far `detail` may be off; nothing for all others
    std::optional<Bundle> bundle{};
    bool clusters{};  // drawn by the region's clusters, not by blocks

    bool operator==(const TradeKey&) const = default;
};

// Whether it is predicted before it is drawn: what clusters leave out is not yet.
inline bool is_predicted(const TradeKey& key) {
    return !key.clusters;
}

// "full detail", "no geoid", "tau 2", "clusters, tau 2" (both without full detail),
// "draft", "ground between the posts": parts of the model as plan calls them.
std::string name_of(const TradeKey& key);

}  // namespace oro
