// orograph viewshed: what is seen from one place or several, as a GeoTIFF.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/model_names.h"
#include "apps/view/view.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/sight/viewshed.h"
#include "geo/files/letter_case.h"
#include "geo/places/geodesic.h"
#include "geo/rasters/post_raster.h"

namespace oro {
namespace {

constexpr double usual_radius_km = 20.0, least_radius_km = 0.01, most_radius_km = 1000.0;
// Of a window: at 40 bytes each they take 8 GB.
constexpr double most_posts = 2.0e8;

struct ViewshedReport {
    std::vector<Geodetic> eyes;
    std::vector<MovedToSummit> moved;  // of each of them, where they were asked to stand on summits
    std::vector<std::pair<std::string, MovedToSummit>> walls;  // before those that were not, by their --at
    Air air;
    double target_m{};
    double radius_km{};
    std::size_t grid{};  // whose posts the file has
    ViewshedWindow window;
    std::vector<float> clearance_deficit_m;  // of the eye that misses it least
    std::vector<float> count;                // of eyes that see it
    std::size_t cells{}, seen{}, asked{};
    double looking_s{};
};

Result<void> check_words(const ViewshedOptions& options) {
    if (options.at.empty()) return refused("--at", "", "is missing: name the place, e.g. --at 46.67,8.06");
    for (const std::string& at : options.at) {
        if (const auto place = place_at("--at", at); !place.ok()) return place.error();
    }
    if (options.radius_km && !(*options.radius_km >= least_radius_km && *options.radius_km <= most_radius_km))
        return refused("--radius", all_digits(*options.radius_km),
                       between_words(least_radius_km, most_radius_km));
    ORO_CHECK(check_above("--target", options.target_m));
    if (options.out.empty()) return refused("--out", "", "is missing: name the file to write (.tif)");
    const std::string name = lower_case(options.out);
    if (!name.ends_with(".tif") && !name.ends_with(".tiff"))
        return refused("--out", options.out, "the file's name must end in .tif");
    return check_may_write(options.out, options.overwrite);
}

// A window moved by whole turns so that its columns are nearest to those of another.
ViewshedWindow turned_near(ViewshedWindow window, const ViewshedWindow& other, const PostGrid& grid) {
    if (!grid.wraps_longitude() || window.columns == 0) return window;
    const int turn = grid.columns() - 1;
    while (window.first_column - other.first_column > turn / 2) window.first_column -= turn;
    while (other.first_column - window.first_column > turn / 2) window.first_column += turn;
    return window;
}

ViewshedWindow around_both(const ViewshedWindow& one, const ViewshedWindow& other) {
    if (one.rows == 0 || one.columns == 0) return other;
    if (other.rows == 0 || other.columns == 0) return one;
    ViewshedWindow both;
    both.first_row = std::min(one.first_row, other.first_row);
    both.first_column = std::min(one.first_column, other.first_column);
    both.rows = std::max(one.first_row + one.rows, other.first_row + other.rows) - both.first_row;
    both.columns =
        std::max(one.first_column + one.columns, other.first_column + other.columns) - both.first_column;
    return both;
}

Result<void> make_window(const ViewshedOptions& options, const SightGround& ground, ViewshedReport& report) {
    const auto most = grid_of_most(ground.ground(), report.eyes, report.radius_km * 1000.0);
    report.grid = most.value_or(0);
    const PostGrid& grid = ground.ground().surface(report.grid).field().grid;
    for (const Geodetic& eye : report.eyes)
        report.window = around_both(
            report.window,
            turned_near(window_around(grid, eye, report.radius_km * 1000.0), report.window, grid));
    const double posts = static_cast<double>(report.window.rows) * report.window.columns;
    if (posts > most_posts)
        return refused("--radius", all_digits(report.radius_km),
                       "takes " + grouped(static_cast<std::uint64_t>(posts)) +
                           " posts, more than 200,000,000: give a smaller one");
    if (posts == 0)
        return Error{ErrorKind::no_data, "--at " + options.at.front(),
                     "no elevation data within the radius" +
                         where_data_are(grid, report.eyes.front().lat_deg, report.eyes.front().lon_deg)};
    report.clearance_deficit_m.assign(static_cast<std::size_t>(posts), Viewshed::unknown);
    report.count.assign(static_cast<std::size_t>(posts), Viewshed::unknown);
    return {};
}

void take_in(const Viewshed& shed, const PostGrid& grid, ViewshedReport& report) {
    const ViewshedWindow window = turned_near(shed.window, report.window, grid);
    for (int row = window.first_row; row < window.first_row + window.rows; ++row) {
        for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
            const float missed_m = shed.clearance_deficit_m[window.number(row, column)];
            if (missed_m == Viewshed::unknown) continue;
            const std::size_t cell = report.window.number(row, column);
            float& least_m = report.clearance_deficit_m[cell];
            if (report.count[cell] == Viewshed::unknown) {
                report.count[cell] = 0.0F;
                least_m = missed_m;
            }
            report.count[cell] += missed_m == 0.0F ? 1.0F : 0.0F;
            least_m = std::min(least_m, missed_m);
        }
    }
    report.asked += shed.asked;
}

std::string eye_text(const Geodetic& eye, const SightGround& ground) {
    char text[120];
    std::snprintf(text, sizeof text, "%.9f,%.9f H %.3f m h %.3f m", eye.lat_deg, eye.lon_deg, ground.H_m(eye),
                  eye.h_m);
    return text;
}

PostRaster raster_of(ViewshedReport& report, const SightGround& ground) {
    PostRaster raster;
    const RegionGrid& grid = ground.grids->grid(report.grid);
    raster.grid = grid.field.grid;
    raster.crs = grid.posts_crs;
    raster.first_row = report.window.first_row;
    raster.rows = report.window.rows;
    raster.first_column = report.window.first_column;
    raster.columns = report.window.columns;
    raster.no_value = Viewshed::unknown;
    std::vector<float> seen(report.count.size(), Viewshed::unknown);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (report.count[i] == Viewshed::unknown) continue;
        seen[i] = report.count[i] > 0.0F ? 1.0F : 0.0F;
        // A target that no height brings into sight is missed by no number.
        if (std::isinf(report.clearance_deficit_m[i])) report.clearance_deficit_m[i] = Viewshed::unknown;
    }
    raster.bands.push_back({"seen (1) or hidden (0)", std::move(seen)});
    raster.bands.push_back({"missed by, metres of height (0: seen)", std::move(report.clearance_deficit_m)});
    if (report.eyes.size() > 1) raster.bands.push_back({"observers that see it", std::move(report.count)});
    for (std::size_t i = 0; i < report.eyes.size(); ++i)
        raster.tags.emplace_back("OBSERVER_" + std::to_string(i + 1), eye_text(report.eyes[i], ground));
    raster.tags.emplace_back("TARGET_ABOVE_GROUND_M", all_digits(report.target_m));
    raster.tags.emplace_back("RADIUS_KM", all_digits(report.radius_km));
    raster.tags.emplace_back("LIGHT", light_words(report.air, report.eyes.front().h_m));
    raster.tags.emplace_back("SOFTWARE", "orograph " OROGRAPH_VERSION);
    return raster;
}

// Of the grid whose posts the file has.
std::string first_source(const SightGround& ground, const ViewshedReport& report) {
    const RegionGrid& grid = ground.grids->grid(report.grid);
    return grid.sources.empty() ? std::string("the first grid") : grid.sources.front().path;
}

void tell(const ViewshedOptions& options, const ViewshedReport& report, const SightGround& ground) {
    const double share =
        static_cast<double>(report.seen) / static_cast<double>(std::max<std::size_t>(1, report.cells));
    if (options.json) {
        nlohmann::ordered_json json =
            json_object("file", options.out, "cells", report.cells, "seen", report.seen, "seen_share", share);
        json["observers"] = nlohmann::ordered_json::array();
        for (const Geodetic& eye : report.eyes) json["observers"].push_back(point_json(ground, eye));
        for (std::size_t i = 0; i < report.moved.size(); ++i)
            json["observers"][i]["on_summit"] = summit_json(report.moved[i]);
        json["target_m"] = report.target_m;
        json["radius_km"] = report.radius_km;
        json["columns"] = report.window.columns;
        json["rows"] = report.window.rows;
        json["posts_of"] = first_source(ground, report);
        json["asked_of_the_oracle"] = report.asked;
        json["looking_s"] = report.looking_s;
        json["light"] = light_json(report.air, report.eyes.front().h_m);
        json["notes"] = all_notes(ground.region);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Seen: %s of %s within %s km, %.2f %%\n", grouped(report.seen).c_str(),
                counted(report.cells, "post", "posts").c_str(), figure(report.radius_km).c_str(),
                100.0 * share);
    for (std::size_t i = 0; i < report.eyes.size(); ++i) {
        std::printf("From: %s\n", eye_text(report.eyes[i], ground).c_str());
        if (!report.moved.empty())
            std::printf("Summit: %s\n", summit_words("the observer stands", report.moved[i]).c_str());
    }
    std::printf("Light: %s\n", light_words(report.air, report.eyes.front().h_m).c_str());
}

// The sides on which a circle leaves the box of the data.
std::string sides_beyond(const ViewshedReport& report, const PostGrid& grid) {
    constexpr std::array<const char*, 4> names{"north", "east", "south", "west"};
    std::array<bool, 4> beyond{};
    const double middle_deg = 0.5 * (grid.west_deg() + grid.east_deg());
    for (const Geodetic& eye : report.eyes) {
        const double eye_deg = middle_deg + std::remainder(eye.lon_deg - middle_deg, 360.0);
        const auto rim = [&](double bearing_deg) {
            return geodesic_towards(eye.lat_deg, eye.lon_deg, bearing_deg, report.radius_km * 1000.0);
        };
        if (grid.net) {
            for (std::size_t side = 0; side < names.size(); ++side) {
                const auto there = rim(90.0 * static_cast<double>(side));
                const PostNumber post = grid.post_at(there.lat_deg, there.lon_deg);
                beyond[side] |= !(post.row >= 0.0 && post.row <= grid.rows() - 1.0 && post.column >= 0.0 &&
                                  post.column <= grid.columns() - 1.0);
            }
            continue;
        }
        beyond[0] |= rim(0.0).lat_deg > grid.north_deg();
        beyond[2] |= rim(180.0).lat_deg < grid.south_deg();
        if (grid.wraps_longitude()) continue;
        beyond[1] |= eye_deg + std::remainder(rim(90.0).lon_deg - eye.lon_deg, 360.0) > grid.east_deg();
        beyond[3] |= eye_deg + std::remainder(rim(270.0).lon_deg - eye.lon_deg, 360.0) < grid.west_deg();
    }
    std::string said;
    for (std::size_t side = 0; side < names.size(); ++side)
        if (beyond[side]) said += (said.empty() ? "" : ", ") + std::string(names[side]);
    return said;
}

Result<void> place_eyes(const ViewshedOptions& options, const SightGround& ground, ViewshedReport& report) {
    for (const std::string& at : options.at) {
        Standing standing{"--at", at, "--above", options.above_m, 2.0, options.altitude_m};
        standing.on_summit = options.on_summit;
        ORO_TRY(const Standpoint stood, stand_over_ground(standing, ground));
        report.eyes.push_back(stood.eye);
        if (stood.moved) report.moved.push_back(*stood.moved);
        if (stood.wall) report.walls.emplace_back(at, *stood.wall);
    }
    return {};
}

void say_walls(const ViewshedReport& report, bool quiet) {
    for (const auto& [at, wall] : report.walls) {
        if (report.eyes.size() == 1)
            say_wall(wall, quiet);
        else
            say(quiet, "note: --at " + at + ": " + wall_words(wall) + "; --on-summit stands there");
    }
}

}  // namespace

Result<void> run_viewshed(const ViewshedOptions& options) {
    ORO_CHECK(check_words(options));
    ViewshedReport report;
    report.target_m = options.target_m.value_or(0.0);
    report.radius_km = options.radius_km.value_or(usual_radius_km);
    ORO_TRY(report.air, air_asked_for(options.view.refraction_k, options.view.air, standard_air));
    ProgressBar bar(options.quiet);
    ORO_TRY(const auto ground, open_sight_ground(options.region, [&](double share, const std::string& what) {
                bar.show(share, "reading " + what);
            }));
    ORO_CHECK(spare_inputs({options.out}, {files_of_ground(options.region.paths, ground->region)}));
    ORO_CHECK(place_eyes(options, *ground, report));
    ORO_CHECK(make_window(options, *ground, report));
    const PostGrid& grid = ground->ground().surface(report.grid).field().grid;
    const auto looking = Clock::now();
    for (std::size_t i = 0; i < report.eyes.size(); ++i) {
        const ViewshedRequest request{report.eyes[i], report.air, report.target_m, report.radius_km * 1000.0,
                                      thread_count()};
        const auto of_all = static_cast<double>(report.eyes.size());
        take_in(viewshed(ground->ground(), report.grid, request,
                         [&](double share) {
                             bar.show((static_cast<double>(i) + share) / of_all, "looking around");
                         }),
                grid, report);
    }
    report.looking_s = seconds_since(looking);
    ORO_CHECK(ground->ground().health());
    for (const float count : report.count) {
        report.cells += count != Viewshed::unknown;
        report.seen += count > 0.0F;
    }
    bar.show(1.0, "writing");
    ORO_CHECK(write_post_raster(options.out, options.overwrite, raster_of(report, *ground)));
    bar.clear();
    say_notes(ground->region, options.quiet);
    say_walls(report, options.quiet);
    if (ground->ground().grids() > 1)
        say(options.quiet, "note: the file has the posts of " + first_source(*ground, report) +
                               "; where other grids are the ground, it is their ground that is looked at");
    if (const std::string sides = sides_beyond(report, grid); !sides.empty())
        say(options.quiet, "note: the circle reaches beyond the data (" + sides +
                               "): what is seen there is not in the file");
    tell(options, report, *ground);
    return {};
}

}  // namespace oro
