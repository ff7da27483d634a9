// The sun's risings and settings, found by stepping through a day.
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/light/sun_position.h"

namespace oro {
namespace {

struct Sample {
    double time_s{};
    double elevation_deg{};
};

// The elevation of a day is smooth with one top and one bottom, and ends that cut it anywhere.
class DayCurve {
  public:
    explicit DayCurve(const Geodetic& place) : place_(place) {}

    [[nodiscard]] Sample at(double time_s) const {
        return {time_s, sun_position(time_s, place_).airless_elevation_deg};
    }

    // The top (side 1) or the bottom (side -1) between two times that enclose one, by golden section.
    [[nodiscard]] Sample extreme(double from_s, double to_s, double side) const {
        constexpr double golden = 0.6180339887498949;
        Sample low = at(to_s - golden * (to_s - from_s)), high = at(from_s + golden * (to_s - from_s));
        while (to_s - from_s > 1.0) {
            if (side * low.elevation_deg > side * high.elevation_deg) {
                to_s = high.time_s;
                high = low;
                low = at(to_s - golden * (to_s - from_s));
            } else {
                from_s = low.time_s;
                low = high;
                high = at(from_s + golden * (to_s - from_s));
            }
        }
        return side * low.elevation_deg > side * high.elevation_deg ? low : high;
    }

    // Where it crosses a level, between two times on either side of it.
    [[nodiscard]] double crossing_s(Sample from, Sample to, double level_deg) const {
        while (to.time_s - from.time_s > 0.005) {
            const Sample middle = at(0.5 * (from.time_s + to.time_s));
            const bool same_side = (middle.elevation_deg >= level_deg) == (from.elevation_deg >= level_deg);
            (same_side ? from : to) = middle;
        }
        return 0.5 * (from.time_s + to.time_s);
    }

  private:
    Geodetic place_;
};

// Samples through the day with its tops and bottoms among them, so that the curve is monotonic between two:
// no crossing hides there. One step before and after the day shows those next to its ends.
std::vector<Sample> monotonic_pieces(const DayCurve& curve, double from_utc_s) {
    constexpr int steps = 96;
    constexpr double day_s = 86400.0, step_s = day_s / steps;
    const double to_utc_s = from_utc_s + day_s;
    std::vector<Sample> pieces{curve.at(from_utc_s)};
    Sample before = curve.at(from_utc_s - step_s), here = pieces.front();
    for (int i = 0; i <= steps; ++i) {
        const Sample after = curve.at(from_utc_s + (i + 1) * step_s);
        const double climbed = here.elevation_deg - before.elevation_deg;
        const double climbs = after.elevation_deg - here.elevation_deg;
        const bool turns = climbed * climbs <= 0.0;
        const Sample next =
            turns ? curve.extreme(before.time_s, after.time_s, climbed > climbs ? 1.0 : -1.0) : here;
        if (next.time_s > from_utc_s && next.time_s < to_utc_s) pieces.push_back(next);
        before = here;
        here = after;
    }
    pieces.push_back(curve.at(to_utc_s));
    return pieces;
}

}  // namespace

SunDayEvents sun_day(double from_utc_s, const Geodetic& place, double horizon_deg) {
    const DayCurve curve(place);
    const std::vector<Sample> pieces = monotonic_pieces(curve, from_utc_s);
    SunDayEvents events;
    Sample highest = pieces.front();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (pieces[i].elevation_deg > highest.elevation_deg) highest = pieces[i];
        if (i == 0) continue;
        const bool was_up = pieces[i - 1].elevation_deg >= horizon_deg;
        const bool is_up = pieces[i].elevation_deg >= horizon_deg;
        if (was_up != is_up)
            events.crossings.push_back({curve.crossing_s(pieces[i - 1], pieces[i], horizon_deg), is_up});
    }
    events.highest_utc_s = highest.time_s;
    events.highest_deg = highest.elevation_deg;
    events.day = !events.crossings.empty()                     ? SunDay::rises_or_sets
                 : pieces.front().elevation_deg >= horizon_deg ? SunDay::up_all_day
                                                               : SunDay::down_all_day;
    return events;
}

double up_s(const SunDayEvents& events, double from_utc_s) {
    constexpr double day_s = 86400.0;
    if (events.day == SunDay::up_all_day) return day_s;
    double sum_s = 0.0, since_s = from_utc_s;
    for (const SunCrossing& crossing : events.crossings) {
        if (!crossing.rising) sum_s += crossing.time_utc_s - since_s;
        since_s = crossing.time_utc_s;
    }
    if (!events.crossings.empty() && events.crossings.back().rising) sum_s += from_utc_s + day_s - since_s;
    return sum_s;
}

double solar_noon_utc_s(double from_utc_s, const Geodetic& place) {
    constexpr double half_way_s = 6.0 * 3600.0, nearest_pole_deg = 89.999;
    const double highest_s = sun_day(from_utc_s, place).highest_utc_s;
    if (std::abs(place.lat_deg) > nearest_pole_deg) return highest_s;
    // In the east before noon, in the west after, wherever it stands.
    const auto in_east = [&place](double time_s) {
        return sine_cosine_deg(sun_position(time_s, place).azimuth_deg).sine > 0.0;
    };
    double low_s = highest_s - half_way_s, high_s = highest_s + half_way_s;
    while (high_s - low_s > 0.01) {
        const double middle_s = 0.5 * (low_s + high_s);
        (in_east(middle_s) ? low_s : high_s) = middle_s;
    }
    return 0.5 * (low_s + high_s);
}

}  // namespace oro
