#include "apps/commands/sight/horizon_around.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/sight/horizon_question.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/model_names.h"
#include "apps/view/view_words.h"
#include "core/base/parallel.h"
#include "core/sight/observer.h"
#include "core/sight/post_horizons.h"
#include "geo/files/letter_case.h"
#include "geo/files/whole_file.h"
#include "geo/places/geodesic.h"

namespace oro {
namespace {

// Where the horizon stands in an azimuth.
struct HorizonInAzimuth {
    double azimuth_deg{};
    std::optional<double> elevation_deg;  // over the level plane of the eye; nothing: no ground there
    std::optional<Geodetic> place;        // the ground that makes it
    double distance_m{};                  // along the ellipsoid
};

struct HorizonAround {
    Standpoint from;
    std::vector<HorizonInAzimuth> azimuths;
    std::optional<double> sky_view;  // nothing where an azimuth has no ground
    const HorizonInAzimuth* highest{};
    Air air;
    double radius_m{};
};

Result<void> check_words_around(const HorizonOptions& options) {
    if (const auto place = place_at("--at", options.at); !place.ok()) return place.error();
    if (options.out.empty()) return {};
    if (!lower_case(options.out).ends_with(".csv"))
        return refused("--out", options.out, "the file's name must end in .csv with --at");
    return check_may_write(options.out, options.overwrite);
}

// The ground that a line just below the horizon meets.
void find_place(const Oracle& oracle, const Geodetic& eye, double radius_m, HorizonInAzimuth& found) {
    constexpr double below_deg = 2.0e-5;
    const SineCosine azimuth = sine_cosine_deg(found.azimuth_deg),
                     elevation = sine_cosine_deg(*found.elevation_deg - below_deg);
    const glm::dvec3 direction =
        ecef_from_enu(eye.lat_deg, eye.lon_deg) *
        glm::dvec3(elevation.cosine * azimuth.sine, elevation.cosine * azimuth.cosine, elevation.sine);
    const auto hit = oracle.first_hit(direction, radius_m / std::max(1.0e-3, elevation.cosine));
    if (!hit) return;
    found.place = hit->point;
    found.distance_m =
        geodesic_between(eye.lat_deg, eye.lon_deg, hit->point.lat_deg, hit->point.lon_deg).distance_m;
}

HorizonAround horizon_around(const TrueGround& ground, const Standpoint& from,
                             const PostHorizonsRequest& request) {
    HorizonAround around;
    around.from = from;
    around.air = request.air;
    around.radius_m = request.radius_m;
    around.azimuths.resize(static_cast<std::size_t>(request.directions));
    const Geodetic& eye = from.eye;
    const Oracle oracle(ground, sight_from(eye, request.air));
    in_parallel(request.directions, request.threads, [&](int i) {
        HorizonInAzimuth& one = around.azimuths[static_cast<std::size_t>(i)];
        one.azimuth_deg = 360.0 * i / request.directions;
        one.elevation_deg = horizon_by_lines_deg(ground, eye, request.air, one.azimuth_deg, request.radius_m);
        if (one.elevation_deg) find_place(oracle, eye, request.radius_m, one);
    });
    std::vector<double> elevations_deg;
    for (const HorizonInAzimuth& one : around.azimuths) {
        if (!one.elevation_deg) continue;
        elevations_deg.push_back(*one.elevation_deg);
        if (around.highest == nullptr || *one.elevation_deg > *around.highest->elevation_deg)
            around.highest = &one;
    }
    if (elevations_deg.size() == around.azimuths.size()) around.sky_view = sky_view_factor(elevations_deg);
    return around;
}

std::string csv_of(const HorizonAround& around, const SightGround& ground) {
    std::string text = "azimuth_deg,elevation_deg,distance_m,lat_deg,lon_deg,H_m\n";
    for (const HorizonInAzimuth& one : around.azimuths) {
        char line[200];
        text += all_digits(one.azimuth_deg) + ",";
        if (one.elevation_deg) {
            std::snprintf(line, sizeof line, "%.5f", *one.elevation_deg);
            text += line;
        }
        if (one.place)
            std::snprintf(line, sizeof line, ",%.1f,%.8f,%.8f,%.2f\n", one.distance_m, one.place->lat_deg,
                          one.place->lon_deg, ground.H_m(*one.place));
        else
            std::snprintf(line, sizeof line, ",,,,\n");
        text += line;
    }
    return text;
}

nlohmann::ordered_json json_of(const HorizonAround& around, const SightGround& ground) {
    nlohmann::ordered_json json = json_object("eye", point_json(ground, around.from.eye));
    if (around.from.moved) json["on_summit"] = summit_json(*around.from.moved);
    json["radius_km"] = around.radius_m / 1000.0;
    json["light"] = light_words(around.air, around.from.eye.h_m);
    json["sky_view"] = nullptr;
    if (around.sky_view) json["sky_view"] = *around.sky_view;
    json["azimuths"] = nlohmann::ordered_json::array();
    for (const HorizonInAzimuth& one : around.azimuths) {
        nlohmann::ordered_json row =
            json_object("azimuth_deg", one.azimuth_deg, "elevation_deg", nullptr, "distance_m", nullptr);
        if (one.elevation_deg) row["elevation_deg"] = *one.elevation_deg;
        if (one.place) {
            row["distance_m"] = one.distance_m;
            row["place"] = point_json(ground, *one.place);
        }
        json["azimuths"].push_back(std::move(row));
    }
    json["notes"] = all_notes(ground.region);
    return json;
}

void print_around(const HorizonAround& around, const SightGround& ground) {
    const Geodetic& eye = around.from.eye;
    std::printf("Horizon around %.6f %.6f, H %.1f m", eye.lat_deg, eye.lon_deg, ground.H_m(eye));
    if (const auto above_m = ground.above_m(eye)) std::printf(", %.1f m above the ground", *above_m);
    std::printf(", within %s km\n", figure(around.radius_m / 1000.0).c_str());
    std::printf("azimuth   elevation     distance          H   place\n");
    for (const HorizonInAzimuth& one : around.azimuths) {
        std::printf("%6.5g°", one.azimuth_deg);
        if (!one.elevation_deg) {
            std::printf("   no ground\n");
            continue;
        }
        std::printf("   %8.3f°", *one.elevation_deg);
        if (one.place)
            std::printf("  %8.2f km  %7.0f m   %.5f %.5f", one.distance_m / 1000.0, ground.H_m(*one.place),
                        one.place->lat_deg, one.place->lon_deg);
        std::printf("\n");
    }
    if (around.highest != nullptr)
        std::printf("Highest: %.3f° in azimuth %s, %.2f km away\n", *around.highest->elevation_deg,
                    all_digits(around.highest->azimuth_deg).c_str(), around.highest->distance_m / 1000.0);
    if (around.sky_view) std::printf("Sky-view factor: %.4f\n", *around.sky_view);
    std::printf("Light: %s\n", light_words(around.air, eye.h_m).c_str());
}

// Whether a circle around a place leaves the data.
bool leaves_data(const SightGround& ground, const Geodetic& eye, double radius_m) {
    constexpr int directions = 8;
    for (int i = 0; i < directions; ++i) {
        const LatLon rim = geodesic_towards(eye.lat_deg, eye.lon_deg, 360.0 * i / directions, radius_m);
        const bool inside = std::ranges::any_of(ground.region.grids, [&](const RegionGrid& grid) {
            return holds(grid.field.grid, rim.lat_deg, rim.lon_deg);
        });
        if (!inside) return true;
    }
    return false;
}

}  // namespace

Result<void> run_horizon_around(const HorizonOptions& options) {
    ORO_TRY(const PostHorizonsRequest request, horizon_request(options));
    ORO_CHECK(check_words_around(options));
    ProgressBar bar(options.quiet);
    ORO_TRY(const auto ground, open_sight_ground(options.region, bar.progress()));
    if (!options.out.empty())
        ORO_CHECK(spare_inputs({options.out}, {files_of_ground(options.region.paths, ground->region)}));
    Standing standing{"--at", options.at, "--above", options.above_m, 2.0, options.altitude_m};
    standing.on_summit = options.on_summit;
    ORO_TRY(const Standpoint from, stand_over_ground(standing, *ground));
    bar.show(1.0, "looking around");
    const HorizonAround around = horizon_around(ground->ground(), from, request);
    ORO_CHECK(ground->region.health());
    bar.clear();
    if (!options.out.empty())
        ORO_CHECK(write_whole_file(options.out, csv_of(around, *ground), options.overwrite));
    say_notes(ground->region, options.quiet);
    say_summit(from.moved, options.quiet);
    say_wall(from.wall, options.quiet);
    if (leaves_data(*ground, from.eye, request.radius_m))
        say(options.quiet,
            "note: the radius reaches beyond the data: ground there does not count, and horizons may be "
            "higher");
    if (options.json)
        std::printf("%s\n", json_text(json_of(around, *ground), true).c_str());
    else
        print_around(around, *ground);
    if (!options.out.empty()) say(options.quiet, "wrote " + options.out);
    return {};
}

}  // namespace oro
