// What the forms of a trade's report share: how numbers and names are written, and the worst of each effect.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/report/figures.h"
#include "apps/trade/trade_report.h"

namespace oro {

// 10^6 bytes.
double megabytes(std::uint64_t bytes);
// UTF-8 without control characters; U+FFFD for each byte that is none.
std::string valid_text(std::string_view text);

// Larger of two; no number if one of them is none, so that a fault is never hidden by a smaller error.
double worse(double a, double b);

// How many times the measured worst a bound is; over the views with something measured above 0.
struct RatioRange {
    double least{};
    double most{};
};

// A bound that is more than this many times the measured worst tells a user nothing; below a tenth of a pixel
// it says all that anybody asks.
inline constexpr double loose_ratio = 10.0;
inline constexpr double negligible_px = 0.1;

// One effect over all views.
struct EffectWorst {
    TradeKey key;
    double predicted_m{}, predicted_px{};           // nothing unless is_predicted()
    std::optional<double> measured_m, measured_px;  // of the views where it was measured
    std::optional<RatioRange> ratio_m, ratio_px;
    EffectMeasure measured_by{};
    std::vector<std::string> broken_in;  // views where more was measured than predicted, in m or px
    int views{}, measured_views{};
};
// In the order in which they first occur.
std::vector<EffectWorst> worst_effects(const TradeReport& report);
// More was measured than predicted, in m or in px. Not where nothing is predicted, nor is that loose.
bool bound_broken(const TradeEffect& effect);
// The bound in px is loose, and not negligible.
bool bound_loose(const TradeEffect& effect);
// predicted / measured; nothing where nothing, or nothing above 0, was measured.
std::optional<double> bound_ratio(double predicted, const std::optional<double>& measured);
// Of an effect; nothing where it is not predicted, either.
std::optional<double> ratio_m(const TradeEffect& effect);
std::optional<double> ratio_px(const TradeEffect& effect);

// How an effect was measured, where that is not by drawing it; else "".
const char* remark_on(EffectMeasure measured_by);

// The report's views, in the order in which they first occur in its shots.
std::vector<std::string> views_of(const TradeReport& report);

}  // namespace oro
