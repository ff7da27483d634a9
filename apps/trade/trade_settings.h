// The settings that a trade draws each view with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/trade/trade_key.h"
#include "apps/view/view.h"

namespace oro {

struct TradeCase {
    TradeKey key;
    std::string options{};  // what a user would type; empty for what only measurements ask for
    double tau_px{0.0};
    WorldModel world;
    bool has_geoid{true};
    HeightStorage heights{HeightStorage::f32};
    bool keeps_tau{};  // levels are all that is left out: no error exceeds tau and what drawing rounds off
};

// Full detail first, then levels, then one thing left out or rounded at a time, then bundles. All but those
// that leave it out have standard air. Posts in a CRS of their own (`own_posts`) are not drawn on another
// Earth, nor placed in float32. With `clusters` each tau is tried with them, too (draws_clusters()); all else
// is drawn by blocks, as it is where there are none.
std::vector<TradeCase> trade_cases(bool own_posts, bool clusters);
// The cases of a region, in a view's size and models.
std::vector<TradeCase> trade_cases(const View& view, const Region& region);

}  // namespace oro
