// What a trade has measured: each view drawn with each setting, and each effect predicted and measured.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/trade/trade_key.h"
#include "core/base/result.h"
#include "core/measure/seen_error.h"
#include "core/truth/picture_error.h"

namespace oro {

// What a setting costs in one of the two states that its users meet: the first picture, drawn by a program
// that has drawn nothing yet; and a settled one, drawn again from the same eye, when what the last one saw is
// known and tables of light and shadow are there. In both what other ground hides is left out.
struct TradeCost {
    double gpu_ms{};  // timestamps: levels, triangles and shading of one sample, median of the repeats
    std::uint64_t triangles{};

    bool operator==(const TradeCost&) const = default;
};

// One view drawn with one setting.
struct TradeShot {
    std::string view;  // "far over the Alps"
    TradeKey setting;
    TradeCost first, settled;
    std::uint64_t bytes{};  // of the pages and clusters that the first picture reads, on the GPU
    ErrorSummary displacement_m, displacement_px, surface_px, seen_px, skyline_px;
    // The largest error of all of them in pixels; of edges less what they are found to.
    [[nodiscard]] double largest_px() const {
        return std::max({displacement_px.largest, surface_px.largest, seen_px.largest - seen_resolution_px,
                         skyline_px.largest - seen_resolution_px});
    }
    // What each of them may be: tau and what drawing rounds off, where all else is there.
    std::optional<double> limit_px;
    [[nodiscard]] bool over_limit() const { return limit_px && !(largest_px() <= *limit_px); }
    std::uint64_t skyline_in_one_only{};
};

// All views with one setting.
struct TradeSetting {
    TradeKey key;
    std::string options;             // "--tau 2 --heights i16": how a user asks for it
    std::optional<double> limit_px;  // the largest of its shots' limits, where they have one
    TradeCost first, settled;        // median time, sum of triangles over the views
    std::uint64_t bytes{};           // sum over the views
    double displacement_m{}, displacement_px{}, displacement_p99_px{}, displacement_mean_px{}, surface_px{},
        seen_px{}, skyline_px{};  // worst (mean of means) over the views
    // Some of the values that it comes from are at least what they say: so is the worst (ErrorSummary).
    bool displacement_px_at_least{}, surface_px_at_least{}, seen_px_at_least{};
    std::uint64_t
        displacement_pixels{};  // sums over the views of what was measured; 0: the errors mean nothing
    std::uint64_t skyline_columns{};
    bool over_limit{};  // a shot is off by more than its own limit, by any of the four
    // Pareto: no other setting is at least as good in first.gpu_ms and displacement_px, and better in one;
    // equals are on it together. Settings where nothing was measured, or a number is not finite, are not.
    bool on_front{};
};

// One effect in one view.
struct TradeEffect {
    std::string view;
    TradeKey key;                          // the setting, or a limit of the data
    double predicted_m{}, predicted_px{};  // bounds; nothing unless is_predicted()
    // Worst; nothing where it cannot be measured. Pixels up to the picture's diagonal: farther no bound
    // reaches.
    std::optional<double> measured_m, measured_px;
    EffectMeasure measured_by{};  // picture, thinned or stated
};

struct TradePicture {
    std::string title;
    std::string caption;
    std::vector<std::uint8_t> png;
};

struct TradeReport {
    std::string region;   // "N46E008.hgt, N46E007.hgt"
    std::string command;  // that made it
    std::string machine, gpu, driver, pipeline, version, time;
    int width_px{}, height_px{};
    std::vector<TradeShot> shots;
    std::vector<TradeSetting> settings;
    std::vector<TradeEffect> effects;
    std::vector<TradePicture> pictures;
};

// Fills `settings` from the shots: the settings in the order in which they first occur, `options` and
// `limit_px` kept from those that are there already. An error that is no number stays the worst.
void sum_up(TradeReport& report);

// One line a shot, with a header; RFC 4180, numbers with all their digits ("nan", "inf" for what is none).
std::string trade_csv(const TradeReport& report);
// A page that needs nothing but itself: the static one of apps/trade_page with the report as JSON in it,
// which its script draws. Its <main> states data-plots, data-settings, data-shots, data-effects and
// data-pictures; each plot becomes an <svg> with data-plot (its name) and data-points, and has as many <g
// class="point">, each with data-setting, data-view or data-effect: plot "views" has one for each shot. Needs
// sum_up first.
std::string trade_html(const TradeReport& report);
// For a terminal of 120 columns: settings, then effects (worst over the views). Needs sum_up first.
std::string trade_text(const TradeReport& report);

}  // namespace oro
