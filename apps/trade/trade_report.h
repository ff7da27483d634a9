// What a trade has measured: each view drawn with each setting, and each effect predicted and measured.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/trade/trade_key.h"
#include "core/base/result.h"
#include "core/truth/picture_error.h"

namespace oro {

// One view drawn with one setting.
struct TradeShot {
    std::string view;  // "far over the Alps"
    TradeKey setting;
    double gpu_ms{};  // timestamps: levels, triangles and shading of one sample, median of the repeats
    std::uint64_t triangles{};
    std::uint64_t bytes{};  // of the pages that the frame reads, on the GPU
    ErrorSummary interior_m, interior_px, skyline_px;
    std::uint64_t skyline_in_one_only{};
};

// All views with one setting.
struct TradeSetting {
    TradeKey key;
    std::string options;  // "--tau 2 --heights i16": how a user asks for it
    std::optional<double>
        limit_px;               // what the interior error must not exceed (tau and some more), if it has one
    double gpu_ms{};            // median over the views
    std::uint64_t triangles{};  // sums over the views
    std::uint64_t bytes{};
    double interior_m{}, interior_px{}, interior_p99_px{}, interior_mean_px{},
        skyline_px{};                 // worst (mean of means) over the views
    std::uint64_t interior_pixels{};  // sums over the views of what was measured; 0: the errors mean nothing
    std::uint64_t skyline_columns{};
    // Pareto: no other setting is at least as good in gpu_ms and interior_px, and better in one; equals are
    // on it together. Settings where nothing was measured, or a number is not finite, are not.
    bool on_front{};
};

// One effect in one view.
struct TradeEffect {
    std::string view;
    TradeKey key;                                   // the setting, or a limit of the data
    double predicted_m{}, predicted_px{};           // bounds
    std::optional<double> measured_m, measured_px;  // worst; nothing where it cannot be measured
    EffectMeasure measured_by{};                    // picture, thinned or stated
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
