#include "apps/trade/trade_parts.h"

#include <utf8.h>

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

// U+0000 to U+001F, U+007F to U+009F.
bool is_control(std::uint32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0);
}

constexpr std::string_view replacement = "\xEF\xBF\xBD";

void widen(std::optional<RatioRange>& range, const std::optional<double>& ratio) {
    if (!ratio) return;
    if (!range) range = RatioRange{*ratio, *ratio};
    range->least = std::min(range->least, *ratio);
    range->most = std::max(range->most, *ratio);
}

void widen(std::optional<double>& worst, const std::optional<double>& value) {
    if (value) worst = worst ? worse(*worst, *value) : *value;
}

void add(EffectWorst& worst, const TradeEffect& effect) {
    worst.predicted_m = worse(worst.predicted_m, effect.predicted_m);
    worst.predicted_px = worse(worst.predicted_px, effect.predicted_px);
    widen(worst.measured_m, effect.measured_m);
    widen(worst.measured_px, effect.measured_px);
    widen(worst.ratio_m, ratio_m(effect));
    widen(worst.ratio_px, ratio_px(effect));
    worst.measured_by = effect.measured_by;
    if (bound_broken(effect)) worst.broken_in.push_back(effect.view);
    ++worst.views;
    if (effect.measured_m || effect.measured_px) ++worst.measured_views;
}

}  // namespace

double megabytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / 1e6;
}

std::string valid_text(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const auto end = utf8::find_invalid(text.begin(), text.end());
        for (auto at = text.begin(); at != end;) {
            const auto from = at;
            if (is_control(utf8::unchecked::next(at)))
                valid += replacement;
            else
                valid.append(from, at);
        }
        if (end == text.end()) break;
        valid += replacement;
        text.remove_prefix(static_cast<std::size_t>(end - text.begin()) + 1);
    }
    return valid;
}

double worse(double a, double b) {
    if (std::isnan(a)) return a;
    return a > b ? a : b;
}

bool bound_broken(const TradeEffect& effect) {
    if (!is_predicted(effect.key)) return false;
    // Not "measured > predicted": a bound that is no number holds nothing.
    return (effect.measured_m && !(*effect.measured_m <= effect.predicted_m)) ||
           (effect.measured_px && !(*effect.measured_px <= effect.predicted_px));
}

bool bound_loose(const TradeEffect& effect) {
    const std::optional<double> ratio = ratio_px(effect);
    return effect.predicted_px > negligible_px && ratio && *ratio > loose_ratio;
}

const char* remark_on(EffectMeasure measured_by) {
    switch (measured_by) {
        case EffectMeasure::picture:
        case EffectMeasure::full_detail:
            return "";
        case EffectMeasure::thinned:
            return "tried on every second post";
        case EffectMeasure::made:
            return "held against the rule of made terrain";
        case EffectMeasure::stated:
            return "stated by the source, not measured here";
    }
    return "";
}

std::optional<double> bound_ratio(double predicted, const std::optional<double>& measured) {
    if (!measured || !(*measured > 0.0)) return std::nullopt;
    return predicted / *measured;
}

std::optional<double> ratio_m(const TradeEffect& effect) {
    if (!is_predicted(effect.key)) return std::nullopt;
    return bound_ratio(effect.predicted_m, effect.measured_m);
}

std::optional<double> ratio_px(const TradeEffect& effect) {
    if (!is_predicted(effect.key)) return std::nullopt;
    return bound_ratio(effect.predicted_px, effect.measured_px);
}

std::vector<EffectWorst> worst_effects(const TradeReport& report) {
    std::vector<EffectWorst> effects;
    for (const TradeEffect& effect : report.effects) {
        auto at = std::find_if(effects.begin(), effects.end(),
                               [&](const EffectWorst& worst) { return worst.key == effect.key; });
        if (at == effects.end()) {
            at = effects.emplace(effects.end());
            at->key = effect.key;
        }
        add(*at, effect);
    }
    return effects;
}

std::vector<std::string> views_of(const TradeReport& report) {
    std::vector<std::string> views;
    for (const TradeShot& shot : report.shots)
        if (std::find(views.begin(), views.end(), shot.view) == views.end()) views.push_back(shot.view);
    return views;
}

}  // namespace oro
