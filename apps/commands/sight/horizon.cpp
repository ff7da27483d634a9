// orograph horizon: how high the horizon stands around the posts of a region, and how much of the sky they
// see, as GeoTIFFs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/sight/horizon_around.h"
#include "apps/commands/sight/horizon_part.h"
#include "apps/commands/sight/horizon_question.h"
#include "apps/commands/sight/raster_styles.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/options/horizon_options.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/model_names.h"
#include "apps/view/view.h"
#include "apps/view/view_words.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/sight/observer.h"
#include "core/sight/post_horizons.h"
#include "core/sight/viewshed.h"
#include "geo/files/letter_case.h"
#include "geo/places/widened_box.h"
#include "geo/rasters/post_raster.h"

namespace oro {
namespace {

const std::string beyond_note =
    "the radius reaches beyond the data: ground there does not count, and horizons may be higher";

struct HorizonSums {
    std::size_t posts{}, with_sky{};
    double mean_sky{}, lowest_sky{1.0};
    double highest_deg{-90.0};
    std::size_t highest_post{}, highest_direction{};
};

std::string azimuth_words(int direction, int directions) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", 360.0 * direction / directions);
    return text;
}

// The air, without an eye: each post has its own.
std::string air_words(const Air& air) {
    return air.law == AirLaw::constant ? light_words(air, 0.0)
                                       : "standard air, k " + all_digits(air.k) + " at sea level";
}

Result<HorizonFiles> files_to_write(const HorizonOptions& options) {
    if (options.out.empty()) return refused("--out", "", "is missing: name the files to write (NAME.tif)");
    const std::string lower = lower_case(options.out);
    const std::string ending = lower.ends_with(".tiff") ? ".tiff" : ".tif";
    if (!lower.ends_with(ending)) return refused("--out", options.out, "the file's name must end in .tif");
    const std::string name = options.out.substr(0, options.out.size() - ending.size());
    if (name.empty() || name.ends_with('/'))
        return refused("--out", options.out, "has no name before " + ending);
    HorizonFiles files = horizon_files_of(options.out);
    ORO_CHECK(check_may_write(files.horizon, options.overwrite));
    ORO_CHECK(check_may_write(files.sky_view, options.overwrite));
    return files;
}

// The data that are read reach as much farther as is looked.
Result<RegionOptions> widened_region(const HorizonOptions& options, const std::optional<BoundingBox>& box,
                                     double radius_m) {
    RegionOptions wide = options.region;
    if (!box) return wide;
    wide.tile.clear();
    wide.bbox = box_words(widened_box(*box, radius_m));
    return wide;
}

HorizonSums sums_of_horizons(const PostHorizons& found) {
    HorizonSums sums;
    for (std::size_t i = 0; i < found.sky_view.size(); ++i) {
        bool any = false;
        for (std::size_t k = 0; k < found.elevation_deg.size(); ++k) {
            const float elevation_deg = found.elevation_deg[k][i];
            if (elevation_deg == PostHorizons::unknown) continue;
            any = true;
            if (static_cast<double>(elevation_deg) <= sums.highest_deg) continue;
            sums.highest_deg = static_cast<double>(elevation_deg);
            sums.highest_post = i;
            sums.highest_direction = k;
        }
        sums.posts += any;
        if (found.sky_view[i] == PostHorizons::unknown) continue;
        ++sums.with_sky;
        sums.mean_sky += static_cast<double>(found.sky_view[i]);
        sums.lowest_sky = std::min(sums.lowest_sky, static_cast<double>(found.sky_view[i]));
    }
    sums.mean_sky /= static_cast<double>(std::max<std::size_t>(1, sums.with_sky));
    return sums;
}

PostRaster raster_for(const RegionGrid& grid, const PostHorizonsRequest& request) {
    PostRaster raster;
    raster.grid = grid.field.grid;
    raster.crs = grid.posts_crs;
    raster.part = request.part;
    raster.no_value = PostHorizons::unknown;
    raster.tags.emplace_back("ABOVE_GROUND_M", all_digits(request.above_m));
    raster.tags.emplace_back("DIRECTIONS", std::to_string(request.directions));
    raster.tags.emplace_back("RADIUS_KM", all_digits(request.radius_m / 1000.0));
    raster.tags.emplace_back("LIGHT", air_words(request.air));
    raster.tags.emplace_back("SOFTWARE", "orograph " OROGRAPH_VERSION);
    return raster;
}

// Both, and the style by which QGIS shows the first band of horizons, or none.
Result<void> write_rasters(const HorizonOptions& options, const HorizonFiles& files, const RegionGrid& grid,
                           const PostHorizonsRequest& request, PostHorizons& found) {
    PostRaster horizon = raster_for(grid, request);
    for (int k = 0; k < request.directions; ++k)
        horizon.bands.push_back(
            {"horizon's elevation in azimuth " + azimuth_words(k, request.directions) + ", degrees",
             std::move(found.elevation_deg[static_cast<std::size_t>(k)])});
    ORO_TRY(WholeFile horizon_file, written_post_raster(files.horizon, options.overwrite, horizon));
    horizon.bands.clear();
    PostRaster sky = raster_for(grid, request);
    sky.bands.push_back({"sky-view factor of a level plane, weighted by cosine", std::move(found.sky_view)});
    ORO_TRY(WholeFile sky_file, written_post_raster(files.sky_view, options.overwrite, sky));
    ORO_TRY(std::optional<WholeFile> style_of_qgis,
            style_beside(files.horizon, static_cast<std::size_t>(request.directions), horizon_qml));
    std::vector<WholeFile*> all{&sky_file, &horizon_file};
    if (style_of_qgis) all.insert(all.begin(), &*style_of_qgis);
    return commit_together(all);
}

void tell_horizons(const HorizonOptions& options, const HorizonFiles& files, const RegionGrid& grid,
                   const PostHorizonsRequest& request, const HorizonSums& sums, const Region& region,
                   double looking_s) {
    const int columns = request.part.columns;
    const auto post = static_cast<int>(sums.highest_post);
    const PostPlace place = grid.field.grid.place_at(request.part.first_row + post / columns,
                                                     request.part.first_column + post % columns);
    const double azimuth_deg = 360.0 * static_cast<double>(sums.highest_direction) / request.directions;
    const double lon_deg = normalised_lon_deg(place.lon_deg);
    if (options.json) {
        nlohmann::ordered_json json = json_object(
            "horizon", files.horizon, "sky_view", files.sky_view, "columns", columns, "rows",
            request.part.rows, "posts", sums.posts, "directions", request.directions, "radius_km",
            request.radius_m / 1000.0, "above_m", request.above_m, "posts_with_sky_view", sums.with_sky);
        if (sums.with_sky > 0) {
            json["mean_sky_view"] = sums.mean_sky;
            json["lowest_sky_view"] = sums.lowest_sky;
        }
        if (sums.posts > 0)
            json["highest"] = json_object("elevation_deg", sums.highest_deg, "azimuth_deg", azimuth_deg,
                                          "lat_deg", place.lat_deg, "lon_deg", lon_deg);
        json["looking_s"] = looking_s;
        json["light"] = air_words(request.air);
        json["notes"] = all_notes(region);
        if (reaches_beyond(grid.field.grid, request.part, request.radius_m))
            json["notes"].push_back(beyond_note);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Horizons: %s of %s, %d azimuths, within %s km\n", grouped(sums.posts).c_str(),
                counted(request.part.count(), "post", "posts").c_str(), request.directions,
                figure(request.radius_m / 1000.0).c_str());
    if (sums.with_sky > 0)
        std::printf("Sky-view factor: %.4f on average, %.4f at least\n", sums.mean_sky, sums.lowest_sky);
    if (sums.posts > 0)
        std::printf("Highest horizon: %.3f degrees at %.6f,%.6f, azimuth %s\n", sums.highest_deg,
                    place.lat_deg, lon_deg,
                    azimuth_words(static_cast<int>(sums.highest_direction), request.directions).c_str());
    std::printf("Light: %s\n", air_words(request.air).c_str());
}

void say_horizon_notes(const HorizonOptions& options, const SightGround& ground, const RegionGrid& grid,
                       const PostHorizonsRequest& request) {
    say_notes(ground.region, options.quiet);
    if (ground.ground().grids() > 1)
        say(options.quiet,
            "note: the files have the posts of one of several grids; each horizon is found by sight lines "
            "over all of them, which takes long");
    if (reaches_beyond(grid.field.grid, request.part, request.radius_m))
        say(options.quiet, "note: " + beyond_note);
}

}  // namespace

Result<void> run_horizon(const HorizonOptions& options) {
    if (!options.at.empty()) return run_horizon_around(options);
    if (options.altitude_m || options.on_summit)
        return refused(options.altitude_m ? "--altitude" : "--on-summit", "",
                       "says nothing without --at PLACE");
    ORO_TRY(PostHorizonsRequest request, horizon_request(options));
    ORO_TRY(const HorizonFiles files, files_to_write(options));
    ORO_TRY(const RegionRequest asked, region_request(options.region));
    ORO_TRY(const RegionOptions wide, widened_region(options, asked.box, request.radius_m));
    ProgressBar bar(options.quiet);
    ORO_TRY(const auto ground, open_sight_ground(wide, [&](double share, const std::string& what) {
                bar.show(share, "reading " + what);
            }));
    ORO_CHECK(spare_inputs({files.horizon, files.sky_view},
                           {files_of_ground(options.region.paths, ground->region)}));
    const std::string where =
        options.region.bbox.empty() ? "--tile " + options.region.tile : "--bbox " + options.region.bbox;
    ORO_TRY(const HorizonPosts posts, horizon_posts(asked.box, where, ground->ground(), request.directions));
    request.part = posts.part;
    const auto looking = Clock::now();
    PostHorizons found = post_horizons(ground->ground(), posts.grid, request,
                                       [&](double share) { bar.show(share, "looking around"); });
    const double looking_s = seconds_since(looking);
    ORO_CHECK(ground->ground().health());
    bar.show(1.0, "writing");
    const HorizonSums sums = sums_of_horizons(found);
    const RegionGrid& grid = ground->grids->grid(posts.grid);
    ORO_CHECK(write_rasters(options, files, grid, request, found));
    bar.clear();
    say_horizon_notes(options, *ground, grid, request);
    tell_horizons(options, files, grid, request, sums, ground->region, looking_s);
    return {};
}

}  // namespace oro
