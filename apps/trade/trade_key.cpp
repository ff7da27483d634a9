#include "apps/trade/trade_key.h"

#include <cstdio>

namespace oro {

std::string name_of(const TradeKey& key) {
    if (key.bundle) return bundle_name(*key.bundle);
    if (!key.effect) return facts_of(EffectKind::detail).name;
    if (!key.tau_px) return key.clusters ? "clusters" : error_name(*key.effect);
    char tau[40];
    std::snprintf(tau, sizeof tau, "%stau %g", key.clusters ? "clusters, " : "", *key.tau_px);
    return tau;
}

}  // namespace oro
