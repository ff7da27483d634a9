#include "apps/trade/trade_key.h"

#include <cstdio>

namespace oro {

std::string name_of(const TradeKey& key) {
    if (key.bundle) return bundle_name(*key.bundle);
    if (!key.effect) return facts_of(EffectKind::detail).name;
    std::string name = key.clusters ? "clusters" : error_name(*key.effect);
    if (key.tau_px) {
        char tau[40];
        std::snprintf(tau, sizeof tau, ", tau %g", *key.tau_px);
        name += tau;
    }
    return name;
}

}  // namespace oro
