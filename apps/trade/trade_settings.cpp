#include "apps/trade/trade_settings.h"

#include "apps/accuracy/accuracy.h"

namespace oro {
namespace {

constexpr WorldModel true_air{Earth::ellipsoid, usual_refraction_k, Precision::relative};

void add_levels(std::vector<TradeCase>& cases) {
    struct Level {
        double tau_px;
        const char* name;
    };
    for (const Level& level :
         {Level{0.5, "tau 0.5"}, Level{1.0, "tau 1"}, Level{2.0, "tau 2"}, Level{4.0, "tau 4"}}) {
        TradeCase one{level.name, "--tau" + std::string(level.name).substr(3), level.tau_px, true_air};
        one.options += " --refraction 0.13";
        one.limit_px = level.tau_px + drawing_slack_px;
        one.effect = std::string(facts_of(EffectKind::detail).name) + ", " + level.name;
        cases.push_back(one);
    }
}

void add_models(std::vector<TradeCase>& cases) {
    const auto add = [&](const char* name, const char* options, EffectKind effect) -> TradeCase& {
        cases.push_back({name, options, 0.0, true_air});
        cases.back().effect = facts_of(effect).name;
        return cases.back();
    };
    add("no geoid", "--tau 0 --refraction 0.13 --geoid none", EffectKind::geoid).has_geoid = false;
    add("sphere", "--tau 0 --refraction 0.13 --earth sphere", EffectKind::sphere).world.earth = Earth::sphere;
    add("flat", "--tau 0 --refraction 0.13 --earth flat", EffectKind::flat).world.earth = Earth::flat;
    add("no refraction", "--tau 0 --refraction 0", EffectKind::refraction).world.refraction_k = 0.0;
    add("posts in float32", "", EffectKind::float32_posts).world.precision = Precision::rounded_posts;
    add("naive float32", "--tau 0 --refraction 0.13 --precision naive", EffectKind::float32_view)
        .world.precision = Precision::naive;
    add("16-bit heights", "--tau 0 --refraction 0.13 --heights i16", EffectKind::steps_i16).heights =
        HeightStorage::i16;
}

}  // namespace

std::vector<TradeCase> trade_cases() {
    std::vector<TradeCase> cases{{"full detail", "--tau 0 --refraction 0.13", 0.0, true_air}};
    cases.front().limit_px = drawing_slack_px;
    cases.front().effect = "all that remains at full detail";
    add_levels(cases);
    add_models(cases);
    for (const AccuracyBundle& bundle : accuracy_bundles()) {
        TradeCase one{bundle.name, "--accuracy " + std::string(bundle.name), bundle.tau_px, true_air};
        one.world.refraction_k = bundle.refraction_k;
        one.heights = bundle.heights;
        one.bundle = bundle.kind;
        // Where levels are all that is left out.
        if (bundle.heights == HeightStorage::f32 && bundle.refraction_k == usual_refraction_k)
            one.limit_px = bundle.tau_px + drawing_slack_px;
        one.effect = std::string(bundle.name) + ", all together";
        cases.push_back(one);
    }
    return cases;
}

}  // namespace oro
