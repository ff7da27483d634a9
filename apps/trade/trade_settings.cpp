#include "apps/trade/trade_settings.h"

#include <cstdio>

#include "apps/drawing/mesh_choice.h"
#include "apps/view/accuracy.h"

namespace oro {
namespace {

constexpr WorldModel true_air{Earth::ellipsoid, standard_air, Precision::relative};

void add_levels(std::vector<TradeCase>& cases, bool clusters) {
    for (const double tau_px : {0.5, 1.0, 2.0, 4.0}) {
        char options[60];
        std::snprintf(options, sizeof options, "--tau %g --air standard", tau_px);
        TradeCase one{{EffectKind::detail, tau_px, {}}, options, tau_px, true_air};
        one.keeps_tau = true;
        cases.push_back(one);
        if (!clusters) continue;
        one.key.clusters = true;
        one.options += " --mesh clusters";
        cases.push_back(one);
    }
}

void add_models(std::vector<TradeCase>& cases) {
    const auto add = [&](EffectKind effect, const char* options) -> TradeCase& {
        return cases.emplace_back(TradeCase{{effect, {}, {}}, options, 0.0, true_air});
    };
    add(EffectKind::geoid, "--tau 0 --air standard --geoid none").has_geoid = false;
    add(EffectKind::sphere, "--tau 0 --air standard --earth sphere").world.earth = Earth::sphere;
    add(EffectKind::flat, "--tau 0 --air standard --earth flat").world.earth = Earth::flat;
    add(EffectKind::refraction, "--tau 0 --refraction 0").world.air = Air{};
    add(EffectKind::float32_posts, "").world.precision = Precision::rounded_posts;
    add(EffectKind::float32_view, "--tau 0 --air standard --precision naive").world.precision =
        Precision::naive;
    add(EffectKind::steps_i16, "--tau 0 --air standard --heights i16").heights = HeightStorage::i16;
}

}  // namespace

std::vector<TradeCase> trade_cases(const View& view, const Region& region) {
    return trade_cases(keeps_own_posts(region), has_clusters(region, view));
}

std::vector<TradeCase> trade_cases(bool own_posts, bool clusters) {
    std::vector<TradeCase> cases{{{}, "--tau 0 --air standard", 0.0, true_air}};
    cases.front().keeps_tau = true;
    add_levels(cases, clusters);
    add_models(cases);
    for (const AccuracyBundle& bundle : accuracy_bundles()) {
        TradeCase one{
            {{}, {}, bundle.kind}, "--accuracy " + std::string(bundle.name), bundle.tau_px, true_air};
        one.world.air = bundle.air;
        one.heights = bundle.heights;
        // Where levels are all that is left out.
        if (bundle.heights == HeightStorage::f32 && bundle.air == standard_air) one.keeps_tau = true;
        cases.push_back(one);
    }
    if (own_posts)
        std::erase_if(cases, [](const TradeCase& one) {
            return one.world.earth != Earth::ellipsoid || one.world.precision != Precision::relative;
        });
    // As one would have to ask for them.
    for (TradeCase& one : cases)
        if (clusters && !one.key.clusters && !one.options.empty()) one.options += " --mesh grid";
    return cases;
}

}  // namespace oro
