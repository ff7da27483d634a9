#include "core/unseen/azimuth_sights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oro {
namespace {

constexpr double quarter_rad = 0.5 * std::numbers::pi;
// Lines that graze the ceiling or the ground a quarter of the way round the Earth come from as far as eyes
// are.
constexpr double track_end_rad = quarter_rad;
// How far inside a stretch the cell of its beginning is asked for: 6 m.
constexpr double inside_rad = 1.0e-6;

}  // namespace

AzimuthSights::AzimuthSights(const Oracle& oracle, const TrueSurface& surface, const KnownGround& known,
                             const Geodetic& eye, const Sight& sight, double ceiling_h_m)
    : oracle_(oracle),
      known_(known),
      eye_(eye),
      up_(ecef_from_enu(eye.lat_deg, eye.lon_deg)[2]),
      sight_(sight),
      ceiling_h_m_(ceiling_h_m) {
    const TrueSurface::Layer all = surface.levels() > 0 ? surface.layer({surface.levels() - 1, 0, 0})
                                                        : TrueSurface::Layer{ceiling_h_m, ceiling_h_m};
    lowest_h_m_ = all.empty() ? ceiling_h_m : std::min(all.lowest_h_m, ceiling_h_m);
}

std::vector<AzimuthSights::Stretch> AzimuthSights::without_data(const GroundTrack& track) const {
    std::vector<double> ends{0.0, track_end_rad};
    for (const double lat_deg : known_.parallels_deg())
        track.add_crossings_of_parallel(lat_deg, track_end_rad, ends);
    for (const double lon_deg : known_.meridians_deg())
        track.add_crossings_of_meridian(lon_deg, track_end_rad, ends);
    std::sort(ends.begin(), ends.end());
    std::vector<Stretch> stretches;
    // What is shorter than a rounding of a longitude is the same crossing, found twice.
    constexpr double rounding_rad = 1.0e-13;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (ends[i + 1] - ends[i] < rounding_rad) continue;
        const Geodetic middle = track.place_at(0.5 * (ends[i] + ends[i + 1]));
        if (known_.holds(middle.lat_deg, middle.lon_deg)) continue;
        if (!stretches.empty() && ends[i] - stretches.back().end_rad < rounding_rad)
            stretches.back().end_rad = ends[i + 1];
        else
            stretches.push_back({ends[i], ends[i + 1]});
    }
    return stretches;
}

double AzimuthSights::elevation_rad(const Azimuth& azimuth, double angle_rad, double h_m) const {
    const GroundTrack::Vertical vertical = azimuth.track.vertical_at(angle_rad);
    const double ahead_m = vertical.ahead_m + h_m * vertical.normal_ahead;
    const double up_m = vertical.up_m + h_m * vertical.normal_up;
    return std::atan2(up_m + sight_.refraction.lift_m(ahead_m * azimuth.ahead), ahead_m);
}

// By golden sections: up to there the elevation rises, beyond it falls.
double AzimuthSights::horizon_of(const Azimuth& azimuth, double h_m) const {
    if (eye_.h_m <= h_m) return 0.0;
    constexpr double share = 0.6180339887498949;
    double low = 0.0, high = track_end_rad;
    double one = high - share * (high - low), other = low + share * (high - low);
    double at_one = elevation_rad(azimuth, one, h_m), at_other = elevation_rad(azimuth, other, h_m);
    constexpr int sections = 30;  // to 1e-6: the elevation is then right to 1e-12
    for (int i = 0; i < sections; ++i) {
        if (at_one < at_other) {
            low = one;
            one = other;
            at_one = at_other;
            other = low + share * (high - low);
            at_other = elevation_rad(azimuth, other, h_m);
        } else {
            high = other;
            other = one;
            at_other = at_one;
            one = high - share * (high - low);
            at_one = elevation_rad(azimuth, one, h_m);
        }
    }
    return 0.5 * (low + high);
}

bool AzimuthSights::meets_ground(const Azimuth& azimuth, double elevation, double before_rad) const {
    // How far along the line the vertical there is met: where the line, t (cos, sin), is on it.
    const GroundTrack::Vertical wall = azimuth.track.vertical_at(before_rad);
    const double cosine = std::cos(elevation), sine = std::sin(elevation);
    const double nearing = wall.normal_up * cosine - wall.normal_ahead * sine;
    double reach_m = sight_reach_m(eye_.h_m);
    if (nearing > 0.0) {
        double t_m = 0.0;
        // The lift depends on where the vertical is met, hardly.
        double ahead_m = wall.ahead_m;
        for (int i = 0; i < 3; ++i) {
            const double up_m = wall.up_m + sight_.refraction.lift_m(ahead_m * azimuth.ahead);
            t_m = (wall.ahead_m * wall.normal_up - wall.normal_ahead * up_m) / nearing;
            ahead_m = t_m * cosine;
        }
        constexpr double rounding_m = 1.0e-3;
        reach_m = std::clamp(t_m + rounding_m, 0.0, reach_m);
    }
    return oracle_.first_hit(cosine * azimuth.ahead + sine * up_, reach_m).has_value();
}

double AzimuthSights::ground_top(const Azimuth& azimuth, double before_rad, ElevationInterval between,
                                 const std::optional<double>& guess_rad) const {
    double low = between.low_rad, high = between.high_rad;
    if (high <= low) return high;
    if (guess_rad && *guess_rad > low && *guess_rad < high) {
        // Steps away from the guess, each twice the last, until the end lies between two.
        double at = *guess_rad, step = 2.0 * azimuth.exact_rad;
        const bool up = meets_ground(azimuth, at, before_rad);
        (up ? low : high) = at;
        for (;; step *= 2.0) {
            at += up ? step : -step;
            if (at <= low || at >= high) break;
            const bool meets = meets_ground(azimuth, at, before_rad);
            (meets ? low : high) = at;
            if (meets != up) break;
        }
    }
    if (high == between.high_rad && meets_ground(azimuth, high, before_rad)) return high;
    while (high - low > azimuth.exact_rad) {
        const double middle = 0.5 * (low + high);
        (meets_ground(azimuth, middle, before_rad) ? low : high) = middle;
    }
    // What is left above is too little to be told.
    return between.high_rad - low <= azimuth.exact_rad ? between.high_rad : low;
}

// Divided by the cells that the lines come into first.
void AzimuthSights::add(const Azimuth& azimuth, const Stretch& stretch, double top_angle_rad,
                        double floor_rad, std::vector<BeyondData>& found) const {
    constexpr double part_rad = 0.004;  // 25 km
    const double length_rad = top_angle_rad - stretch.begin_rad;
    const int parts = std::clamp(static_cast<int>(std::ceil(length_rad / part_rad)), 1, 256);
    const std::size_t already = found.size();
    for (int i = 0; i < parts; ++i) {
        const double begin = stretch.begin_rad + length_rad * i / parts;
        const double end = stretch.begin_rad + length_rad * (i + 1) / parts;
        const double top = elevation_rad(azimuth, end, ceiling_h_m_);
        if (top <= floor_rad) continue;
        const double inside = std::min(0.5 * (stretch.begin_rad + stretch.end_rad),
                                       std::max(0.5 * (begin + end), stretch.begin_rad + inside_rad));
        const Geodetic place = azimuth.track.place_at(inside);
        const UnseenPlace unseen = known_.unseen_at(place.lat_deg, place.lon_deg);
        if (found.size() > already && found.back().place == unseen)
            found.back().lines.high_rad = top;
        else
            found.push_back(
                {{found.size() > already ? found.back().lines.high_rad : floor_rad, top}, unseen});
    }
}

std::vector<BeyondData> AzimuthSights::beyond(const Azimuth& azimuth, const std::vector<Stretch>& stretches,
                                              std::optional<double>& guess_rad) const {
    std::vector<BeyondData> found;
    const bool below_ceiling = eye_.h_m <= ceiling_h_m_;
    const double highest_rad = horizon_of(azimuth, ceiling_h_m_);
    double floor_rad = -quarter_rad;
    for (std::size_t i = 0; i < stretches.size() && (i == 0 || !below_ceiling); ++i) {
        const Stretch& stretch = stretches[i];
        const bool at_eye = stretch.begin_rad == 0.0;
        if (at_eye && below_ceiling) {
            const Geodetic place = azimuth.track.place_at(std::min(inside_rad, 0.5 * stretch.end_rad));
            found.push_back({{-quarter_rad, quarter_rad}, known_.unseen_at(place.lat_deg, place.lon_deg)});
            break;
        }
        const double top_angle = std::clamp(highest_rad, stretch.begin_rad, stretch.end_rad);
        const double top = elevation_rad(azimuth, top_angle, ceiling_h_m_);
        if (top <= std::max(floor_rad, azimuth.wanted.low_rad)) continue;
        if (at_eye) {
            add(azimuth, stretch, top_angle, -quarter_rad, found);
            continue;
        }
        const double lowest = elevation_rad(azimuth, stretch.begin_rad, lowest_h_m_);
        const ElevationInterval between{
            std::max({floor_rad, lowest, azimuth.wanted.low_rad - azimuth.exact_rad}),
            std::min(top, azimuth.wanted.high_rad + 2.0 * azimuth.exact_rad)};
        floor_rad = std::max(
            floor_rad, ground_top(azimuth, stretch.begin_rad, between, i == 0 ? guess_rad : std::nullopt));
        if (i == 0) guess_rad = floor_rad;
        if (floor_rad < between.high_rad) add(azimuth, stretch, top_angle, floor_rad, found);
    }
    return found;
}

AzimuthSights::Look AzimuthSights::look(const glm::dvec3& ahead, const ElevationInterval& wanted,
                                        double exact_rad, std::optional<double>& guess_rad) const {
    const GroundTrack track(eye_, ahead);
    const Azimuth azimuth{track, ahead, wanted, exact_rad};
    const std::vector<Stretch> stretches = without_data(track);
    if (stretches.empty()) return {{}, quarter_rad};
    Look look{beyond(azimuth, stretches, guess_rad), -quarter_rad};
    // A line that comes below all ground has met some, known or not.
    if (eye_.h_m > lowest_h_m_)
        look.ground_below_rad = elevation_rad(azimuth, horizon_of(azimuth, lowest_h_m_), lowest_h_m_);
    return look;
}

}  // namespace oro
