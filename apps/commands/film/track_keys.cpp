#include "apps/commands/film/track_keys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/eye/standpoint.h"
#include "apps/film/written_keys.h"
#include "apps/options/option_table.h"
#include "apps/options/view_limits.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

constexpr std::size_t most_track_keys = 20'000;
constexpr double spacing_unsmoothed_m = 5.0;
constexpr int samples_of_mean = 16;
constexpr Limits track_above_m{1.0, 1e6}, track_smoothing_m{0.0, 1e5}, track_ahead_m{1.0, 1e6},
    track_duration_s{0.1, 1e6}, track_speed_m_s{0.01, 1e6};

// "500", "500m": metres; "10s": seconds.
struct LookAhead {
    double value{};
    bool is_seconds{};
};
Result<LookAhead> look_ahead_of(const std::string& text) {
    std::string_view number(text);
    LookAhead ahead;
    ahead.is_seconds = number.ends_with('s');
    if (number.ends_with('s') || number.ends_with('m')) number.remove_suffix(1);
    if (!read_whole(number, ahead.value))
        return refused("--look-ahead", text, "must be metres or seconds, e.g. 500 or 10s");
    return ahead;
}

// A track, sampled evenly along it.
struct SampledTrack {
    double spacing_m{};
    double length_m{};
    std::vector<LatLon> places;
    std::vector<double> ground_m;  // h of the ground there; NaN: none
    std::vector<double> even_m;    // the same, evened out
};

// So much of the track to each side of a sample a mean is over: less near its ends, which so stay where they
// are.
double half_mean_m(const SampledTrack& track, std::size_t number, double smoothing_m) {
    const double along_m = static_cast<double>(number) * track.spacing_m;
    return std::max(0.0, std::min({0.5 * smoothing_m, along_m, track.length_m - along_m}));
}

LatLon mean_place(const LineAlong& line, double along_m, double half_m) {
    if (!(half_m > 0.0)) return place_on_line(line, along_m);
    glm::dvec3 sum_m(0.0);
    for (int i = 0; i <= samples_of_mean; ++i) {
        const double at_m = along_m + half_m * (2.0 * i / samples_of_mean - 1.0);
        const LatLon place = place_on_line(line, std::clamp(at_m, 0.0, line.distances_m.back()));
        sum_m += ecef_from_geodetic({place.lat_deg, place.lon_deg, 0.0}).m;
    }
    const Geodetic mean = geodetic_from_ecef(Ecef{sum_m / (samples_of_mean + 1.0)});
    return {mean.lat_deg, mean.lon_deg};
}

// How many samples away the nearest one with ground is, of each sample; one has ground.
std::vector<std::size_t> steps_to_ground(const std::vector<double>& ground_m) {
    const std::size_t count = ground_m.size();
    std::vector<std::size_t> steps(count, count);
    for (std::size_t i = 0; i < count; ++i)
        steps[i] = !std::isnan(ground_m[i]) ? 0 : i > 0 ? std::min(count, steps[i - 1] + 1) : count;
    for (std::size_t i = count - 1; i-- > 0;) steps[i] = std::min(steps[i], steps[i + 1] + 1);
    return steps;
}

void even_out(double smoothing_m, SampledTrack& track) {
    const std::size_t count = track.places.size();
    // Of all samples before each: the sum of their ground, and how many have some.
    std::vector<double> sums_m{0.0};
    std::vector<int> found{0};
    for (const double ground_m : track.ground_m) {
        const bool is_there = !std::isnan(ground_m);
        sums_m.push_back(sums_m.back() + (is_there ? ground_m : 0.0));
        found.push_back(found.back() + (is_there ? 1 : 0));
    }
    const std::vector<std::size_t> to_ground = steps_to_ground(track.ground_m);
    for (std::size_t i = 0; i < count; ++i) {
        // One sample at least, and as many as it takes until one has ground.
        const auto reach = std::max(
            to_ground[i],
            static_cast<std::size_t>(std::floor(half_mean_m(track, i, smoothing_m) / track.spacing_m)));
        const std::size_t first = i > reach ? i - reach : 0, end = std::min(count, i + reach + 1);
        track.even_m.push_back((sums_m[end] - sums_m[first]) / (found[end] - found[first]));
    }
}

Result<SampledTrack> sampled(const LineAlong& line, double smoothing_m, const Region& region,
                             double exaggeration) {
    SampledTrack track;
    track.length_m = line.distances_m.back();
    const double wanted_m = smoothing_m > 0.0 ? std::max(1.0, smoothing_m / 8.0) : spacing_unsmoothed_m;
    const auto steps = static_cast<std::size_t>(
        std::clamp(std::ceil(track.length_m / wanted_m), 1.0, static_cast<double>(most_track_keys)));
    track.spacing_m = track.length_m / static_cast<double>(steps);
    bool has_ground = false;
    for (std::size_t i = 0; i <= steps; ++i) {
        const double along_m = std::min(track.length_m, static_cast<double>(i) * track.spacing_m);
        const LatLon place = mean_place(line, along_m, half_mean_m(track, i, smoothing_m));
        const HeightField& field = grid_at(region, place.lat_deg, place.lon_deg).field;
        const auto ground = ground_h_m(field, place.lat_deg, place.lon_deg, exaggeration);
        ORO_CHECK(field.health());
        has_ground |= ground.has_value();
        track.places.push_back(place);
        track.ground_m.push_back(ground.value_or(std::nan("")));
    }
    const LatLon& first = track.places.front();
    if (!has_ground)
        return Error{ErrorKind::no_data, line.file,
                     "no elevation data along the track" +
                         where_data_are(grid_at(region, first.lat_deg, first.lon_deg).field.grid,
                                        first.lat_deg, first.lon_deg)};
    even_out(smoothing_m, track);
    return track;
}

// The even ground so far along the track; beyond its end straight on, and not upwards: a track that ends on a
// slope would end in the sky.
glm::dvec3 ground_along(const std::vector<glm::dvec3>& ground_m, const SampledTrack& track, double along_m,
                        double look_ahead_m) {
    const auto at = [&](double here_m) {
        const double step =
            std::clamp(here_m / track.spacing_m, 0.0, static_cast<double>(ground_m.size() - 1));
        const auto i = std::min(static_cast<std::size_t>(step), ground_m.size() - 2);
        const double part = step - static_cast<double>(i);
        return ground_m[i] * (1.0 - part) + ground_m[i + 1] * part;
    };
    if (along_m <= track.length_m) return at(along_m);
    glm::dvec3 way_m = ground_m.back() - at(track.length_m - std::min(look_ahead_m, track.length_m));
    const glm::dvec3 up = ecef_from_enu(track.places.back().lat_deg, track.places.back().lon_deg)[2];
    way_m -= std::max(0.0, glm::dot(way_m, up)) * up;
    const double way_length_m = glm::length(way_m);
    if (!(way_length_m > 0.0)) return ground_m.back();
    return ground_m.back() + way_m * ((along_m - track.length_m) / way_length_m);
}

}  // namespace

const char* first_track_option(const FilmOptions& options) {
    if (options.above_m) return "--above";
    if (options.look_ahead) return "--look-ahead";
    if (options.smoothing_m) return "--smoothing";
    if (options.duration_s) return "--duration";
    if (options.speed_m_s) return "--speed";
    return options.line ? "--line" : nullptr;
}

Result<TrackFlight> track_flight(const FilmOptions& options, double length_m) {
    TrackFlight flight;
    flight.vertical_fov_deg = options.view.vertical_fov_deg.value_or(flight.vertical_fov_deg);
    ORO_TRY(flight.above_m, within("--above", options.above_m.value_or(flight.above_m), track_above_m));
    ORO_TRY(flight.smoothing_m,
            within("--smoothing", options.smoothing_m.value_or(flight.smoothing_m), track_smoothing_m));
    if (options.duration_s && options.speed_m_s)
        return refused("--speed", "", either_words("--duration", "--speed"));
    ORO_TRY(flight.duration_s,
            within("--duration", options.duration_s.value_or(flight.duration_s), track_duration_s));
    if (options.speed_m_s) {
        ORO_TRY(const double speed_m_s, within("--speed", *options.speed_m_s, track_speed_m_s));
        flight.duration_s = length_m / speed_m_s;
        if (!track_duration_s.hold(flight.duration_s))
            return refused("--speed", "",
                           "the film's length " + between_words(track_duration_s.low, track_duration_s.high) +
                               " seconds");
    }
    if (!options.look_ahead) return flight;
    ORO_TRY(const LookAhead ahead, look_ahead_of(*options.look_ahead));
    const double ahead_m = ahead.is_seconds ? ahead.value * length_m / flight.duration_s : ahead.value;
    if (!track_ahead_m.hold(ahead_m))
        return refused("--look-ahead", *options.look_ahead,
                       "the way ahead " + between_words(track_ahead_m.low, track_ahead_m.high) + " metres");
    flight.look_ahead_m = ahead_m;
    return flight;
}

Result<std::vector<CameraKey>> keys_along_track(const LineAlong& line, const TrackFlight& flight,
                                                const Region& region, double exaggeration) {
    ORO_TRY(const SampledTrack track, sampled(line, flight.smoothing_m, region, exaggeration));
    std::vector<glm::dvec3> ground_m;
    for (std::size_t i = 0; i < track.places.size(); ++i)
        ground_m.push_back(
            ecef_from_geodetic({track.places[i].lat_deg, track.places[i].lon_deg, track.even_m[i]}).m);
    std::vector<CameraKey> keys;
    for (std::size_t i = 0; i < track.places.size(); ++i) {
        const double along_m = static_cast<double>(i) * track.spacing_m;
        CameraKey key;
        key.time_s = flight.duration_s * (along_m / track.length_m);
        key.eye = {track.places[i].lat_deg, track.places[i].lon_deg, track.even_m[i] + flight.above_m};
        if (!std::isnan(track.ground_m[i]))
            key.eye.h_m = std::max(key.eye.h_m, track.ground_m[i] + 0.5 * flight.above_m);
        key.attitude = attitude_towards(
            key.eye, geodetic_from_ecef(Ecef{
                         ground_along(ground_m, track, along_m + flight.look_ahead_m, flight.look_ahead_m)}));
        key.vertical_fov_deg = flight.vertical_fov_deg;
        keys.push_back(key);
    }
    ORO_CHECK(check_keys(keys, line.file));
    return keys;
}

}  // namespace oro
