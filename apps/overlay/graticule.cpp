#include "apps/overlay/graticule.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace oro {
namespace {

constexpr double most_lines = 8.0, most_lines_of_all = 40.0;
constexpr double second_per_deg = 3600.0;

bool is_enough(const CoordinateRange& range, double interval) {
    return range.most_high - range.most_low <= most_lines * interval &&
           range.high - range.low <= most_lines_of_all * interval;
}

// The least of 1, 2 and 5 times powers of ten, from 10^-9 on, that is enough.
template <class IsEnough>
double decimal_step(const IsEnough& is_wide_enough) {
    for (int power = -9; power < 12; ++power)
        for (const double digit : {1.0, 2.0, 5.0})
            if (const double step = digit * std::pow(10.0, power); is_wide_enough(step)) return step;
    return 1e12;
}

// Whole multiples within a range.
std::vector<std::int64_t> multiples_in(double low, double high, double interval) {
    constexpr double rounding = 1e-6;  // of an interval
    std::vector<std::int64_t> all;
    const auto last = static_cast<std::int64_t>(std::floor(high / interval + rounding));
    for (auto i = static_cast<std::int64_t>(std::ceil(low / interval - rounding)); i <= last; ++i)
        all.push_back(i);
    return all;
}

// "46°30'N", "8°05'30\"E", "8°05'30.2\"E"; what is 0 at the end is left out.
std::string angle_label(double angle_s, double interval_s, const char* positive, const char* negative) {
    const double all_s = std::abs(angle_s);
    const int decimals = interval_s < 1.0 ? static_cast<int>(std::ceil(-std::log10(interval_s) - 1e-9)) : 0;
    const double unit = std::pow(10.0, decimals);
    const auto units = static_cast<std::int64_t>(std::llround(all_s * unit));
    const auto per_minute = static_cast<std::int64_t>(60.0 * unit);
    const auto minutes = units / per_minute;
    char text[60];
    int length = std::snprintf(text, sizeof text, "%d°", static_cast<int>(minutes / 60));
    std::string label(text, static_cast<std::size_t>(length));
    if (interval_s < second_per_deg) {
        length = std::snprintf(text, sizeof text, "%02d'", static_cast<int>(minutes % 60));
        label.append(text, static_cast<std::size_t>(length));
    }
    if (interval_s < 60.0) {
        length = std::snprintf(text, sizeof text, "%0*.*f\"", decimals > 0 ? 3 + decimals : 2, decimals,
                               static_cast<double>(units % per_minute) / unit);
        label.append(text, static_cast<std::size_t>(length));
    }
    if (units == 0) return label;
    return label + (angle_s < 0.0 ? negative : positive);
}

VectorShape line_of(std::vector<VectorPlace> places) {
    VectorShape shape;
    shape.kind = VectorKind::line;
    shape.paths.push_back(std::move(places));
    return shape;
}

double normalised_deg(double lon_deg) {
    const double turned_deg = std::remainder(lon_deg, 360.0);
    return turned_deg <= -180.0 ? 180.0 : turned_deg;
}

}  // namespace

CoordinateRange range_of(std::vector<double> values) {
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
    };
    return {values.front(), values.back(), at(0.05), at(0.95)};
}

double graticule_interval_s(const CoordinateRange& lat_deg, const CoordinateRange& lon_deg) {
    const auto is_wide_enough = [&](double step_s) {
        return is_enough(lat_deg, step_s / second_per_deg) && is_enough(lon_deg, step_s / second_per_deg);
    };
    if (is_wide_enough(1.0)) return decimal_step(is_wide_enough);
    for (const double unit_s : {1.0, 60.0, second_per_deg})
        for (const double count : {1.0, 2.0, 5.0, 10.0, 30.0})
            if (is_wide_enough(count * unit_s)) return count * unit_s;
    return 45.0 * second_per_deg;
}

double graticule_interval(const CoordinateRange& x, const CoordinateRange& y) {
    return decimal_step([&](double step) { return is_enough(x, step) && is_enough(y, step); });
}

std::vector<GraticuleLine> geographic_lines(const CoordinateRange& lat_deg, const CoordinateRange& lon_deg,
                                            double interval_s) {
    constexpr double longest_deg = 30.0;  // a line goes the shorter way round
    const double interval_deg = interval_s / second_per_deg;
    std::vector<GraticuleLine> lines;
    for (const std::int64_t i : multiples_in(lat_deg.low, lat_deg.high, interval_deg)) {
        const double angle_s = static_cast<double>(i) * interval_s;
        std::vector<VectorPlace> places;
        const auto pieces =
            std::max(1, static_cast<int>(std::ceil((lon_deg.high - lon_deg.low) / longest_deg)));
        for (int k = 0; k <= pieces; ++k)
            places.push_back(
                {angle_s / second_per_deg,
                 normalised_deg(std::lerp(lon_deg.low, lon_deg.high, static_cast<double>(k) / pieces))});
        lines.push_back({line_of(std::move(places)), angle_label(angle_s, interval_s, "N", "S")});
    }
    for (const std::int64_t i : multiples_in(lon_deg.low, lon_deg.high, interval_deg)) {
        const double lon = normalised_deg(static_cast<double>(i) * interval_s / second_per_deg);
        lines.push_back({line_of({{lat_deg.low, lon}, {lat_deg.high, lon}}),
                         angle_label(lon * second_per_deg, interval_s, "E", "W")});
    }
    return lines;
}

std::vector<GraticuleLine> projected_lines(const CrsPlaces& crs, const CoordinateRange& x,
                                           const CoordinateRange& y, double interval) {
    constexpr int pieces = 32;
    std::vector<GraticuleLine> lines;
    const auto add = [&](const char* axis, double value, const CoordinateRange& along, bool is_easting) {
        std::vector<VectorPlace> places;
        const auto end_part = [&](VectorShape& shape) {
            if (places.size() > 1) shape.paths.push_back(std::move(places));
            places.clear();
        };
        VectorShape shape;
        shape.kind = VectorKind::line;
        for (int k = 0; k <= pieces; ++k) {
            const double other = std::lerp(along.low, along.high, static_cast<double>(k) / pieces);
            const auto place = is_easting ? crs.place(value, other) : crs.place(other, value);
            if (place.ok())
                places.push_back({place->lat_deg, place->lon_deg});
            else
                end_part(shape);
        }
        end_part(shape);
        if (shape.paths.empty()) return;
        const int decimals = interval < 1.0 ? static_cast<int>(std::ceil(-std::log10(interval) - 1e-9)) : 0;
        char label[60];
        std::snprintf(label, sizeof label, "%s %.*f", axis, decimals, value);
        lines.push_back({std::move(shape), label});
    };
    for (const std::int64_t i : multiples_in(x.low, x.high, interval))
        add("E", static_cast<double>(i) * interval, y, true);
    for (const std::int64_t i : multiples_in(y.low, y.high, interval))
        add("N", static_cast<double>(i) * interval, x, false);
    return lines;
}

std::optional<glm::dvec2> label_place(const std::vector<const SeenLine*>& parts, glm::dvec2 picture_px,
                                      glm::dvec2 half_text_px, double least_px) {
    std::optional<glm::dvec2> best;
    double nearest_px = 0.0, seen_px = 0.0;
    for (const SeenLine* const part : parts) {
        for (std::size_t i = 0; i + 1 < part->places_px.size(); ++i)
            seen_px += glm::distance(part->places_px[i], part->places_px[i + 1]);
        for (const glm::dvec2& end : {part->places_px.front(), part->places_px.back()}) {
            const glm::dvec2 inside = glm::clamp(end, glm::dvec2(0.0), picture_px);
            const glm::dvec2 away = glm::min(inside, picture_px - inside);
            const double border_px = std::min(away.x, away.y);
            if (best && border_px >= nearest_px) continue;
            best = inside;
            nearest_px = border_px;
        }
    }
    if (!best || seen_px < least_px) return std::nullopt;
    const glm::dvec2 least = glm::min(half_text_px, 0.5 * picture_px);
    return glm::clamp(*best, least, picture_px - least);
}

}  // namespace oro
