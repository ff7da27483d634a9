#include <string_view>

#include "apps/trade/trade_parts.h"

namespace oro {
namespace {

// Source: RFC 4180, 2.5 to 2.7.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string cost_fields(const TradeCost& cost) {
    return all_digits(cost.gpu_ms) + "," + std::to_string(cost.triangles);
}

std::string summary_fields(const ErrorSummary& summary) {
    std::string fields;
    for (const double value : {summary.largest, summary.p9999, summary.p99, summary.mean})
        fields += "," + all_digits(value);
    return fields + "," + std::to_string(summary.count) + "," + std::to_string(summary.at_least);
}

constexpr std::string_view header =
    "view,setting,first_gpu_ms,first_triangles,settled_gpu_ms,settled_triangles,bytes,"
    "displacement_m_max,displacement_m_p9999,displacement_m_p99,displacement_m_mean,displacement_m_count,"
    "displacement_m_at_least,"
    "displacement_px_max,displacement_px_p9999,displacement_px_p99,displacement_px_mean,displacement_px_"
    "count,"
    "displacement_px_at_least,"
    "surface_px_max,surface_px_p9999,surface_px_p99,surface_px_mean,surface_px_count,"
    "surface_px_at_least,"
    "seen_px_max,seen_px_p9999,seen_px_p99,seen_px_mean,seen_px_count,"
    "seen_px_at_least,"
    "skyline_px_max,skyline_px_p9999,skyline_px_p99,skyline_px_mean,skyline_px_count,"
    "skyline_px_at_least,"
    "skyline_in_one_only";

}  // namespace

std::string trade_csv(const TradeReport& report) {
    std::string csv(header);
    csv += "\r\n";
    for (const TradeShot& shot : report.shots) {
        csv += field(shot.view) + "," + field(name_of(shot.setting)) + "," + cost_fields(shot.first) + "," +
               cost_fields(shot.settled) + "," + std::to_string(shot.bytes);
        for (const ErrorSummary* const of :
             {&shot.displacement_m, &shot.displacement_px, &shot.surface_px, &shot.seen_px, &shot.skyline_px})
            csv += summary_fields(*of);
        csv += "," + std::to_string(shot.skyline_in_one_only) + "\r\n";
    }
    return csv;
}

}  // namespace oro
