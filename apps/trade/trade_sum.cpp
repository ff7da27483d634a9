#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/trade/trade_parts.h"
#include "core/base/median.h"

namespace oro {
namespace {

TradeSetting sum_of(const std::vector<TradeShot>& shots, const TradeKey& key) {
    TradeSetting sum;
    sum.key = key;
    std::vector<double> first_ms, settled_ms;
    double means_px = 0.0;
    int measured = 0;
    for (const TradeShot& shot : shots) {
        if (shot.setting != key) continue;
        first_ms.push_back(shot.first.gpu_ms);
        settled_ms.push_back(shot.settled.gpu_ms);
        sum.first.triangles += shot.first.triangles;
        sum.settled.triangles += shot.settled.triangles;
        sum.bytes += shot.bytes;
        sum.displacement_pixels += shot.displacement_px.count;
        sum.skyline_columns += shot.skyline_px.count;
        sum.displacement_m = worse(sum.displacement_m, shot.displacement_m.largest);
        sum.displacement_px = worse(sum.displacement_px, shot.displacement_px.largest);
        sum.displacement_p99_px = worse(sum.displacement_p99_px, shot.displacement_px.p99);
        sum.displacement_px_at_least |= shot.displacement_px.at_least > 0;
        sum.surface_px_at_least |= shot.surface_px.at_least > 0;
        sum.seen_px_at_least |= shot.seen_px.at_least > 0;
        sum.surface_px = worse(sum.surface_px, shot.surface_px.largest);
        sum.over_limit = sum.over_limit || (shot.over_limit() && shot.displacement_px.count > 0);
        sum.seen_px = worse(sum.seen_px, shot.seen_px.largest);
        sum.skyline_px = worse(sum.skyline_px, shot.skyline_px.largest);
        if (shot.limit_px) sum.limit_px = std::max(sum.limit_px.value_or(0.0), *shot.limit_px);
        if (shot.displacement_px.count == 0) continue;
        means_px += shot.displacement_px.mean;
        ++measured;
    }
    sum.first.gpu_ms = median_of(std::move(first_ms));
    sum.settled.gpu_ms = median_of(std::move(settled_ms));
    if (measured > 0) sum.displacement_mean_px = means_px / measured;
    return sum;
}

bool can_compare(const TradeSetting& setting) {
    return setting.displacement_pixels > 0 && std::isfinite(setting.first.gpu_ms) &&
           std::isfinite(setting.displacement_px);
}

bool better(const TradeSetting& a, const TradeSetting& b) {
    const double a_ms = a.first.gpu_ms, b_ms = b.first.gpu_ms;
    return a_ms <= b_ms && a.displacement_px <= b.displacement_px &&
           (a_ms < b_ms || a.displacement_px < b.displacement_px);
}

}  // namespace

void sum_up(TradeReport& report) {
    const std::vector<TradeSetting> known = std::move(report.settings);
    const auto of = [](const std::vector<TradeSetting>& settings, const TradeKey& key) {
        return std::find_if(settings.begin(), settings.end(),
                            [&](const TradeSetting& setting) { return setting.key == key; });
    };
    report.settings.clear();
    for (const TradeShot& shot : report.shots) {
        if (of(report.settings, shot.setting) != report.settings.end()) continue;
        TradeSetting sum = sum_of(report.shots, shot.setting);
        if (const auto at = of(known, shot.setting); at != known.end()) {
            sum.options = at->options;
            if (!sum.limit_px) sum.limit_px = at->limit_px;
        }
        report.settings.push_back(std::move(sum));
    }
    for (TradeSetting& setting : report.settings)
        setting.on_front =
            can_compare(setting) &&
            std::none_of(report.settings.begin(), report.settings.end(), [&](const TradeSetting& other) {
                return can_compare(other) && better(other, setting);
            });
}

}  // namespace oro
