#include "apps/commands/sight/sight_ground.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_object.h"
#include "apps/view/view.h"
#include "core/sight/observer.h"
#include "geo/canopy/raised_region.h"
#include "geo/opening/open_region.h"
#include "geo/together/covered_grids.h"

namespace oro {

double SightGround::H_m(const Geodetic& point) const {
    return point.h_m - ground().N_m(point.lat_deg, point.lon_deg);
}

std::optional<double> SightGround::above_m(const Geodetic& point) const {
    const std::optional<double> ground_m = ground().h_m(point.lat_deg, point.lon_deg);
    if (!ground_m) return std::nullopt;
    return point.h_m - *ground_m;
}

std::optional<double> SightGround::canopy_m(const Geodetic& place) const {
    if (!canopy) return std::nullopt;
    const auto grid = hiding().grid_at(place.lat_deg, place.lon_deg);
    if (!grid || !canopy_over_ground_m(canopy->region.grids[*grid], place.lat_deg, place.lon_deg))
        return std::nullopt;
    const auto top_m = hiding().h_m(place.lat_deg, place.lon_deg),
               ground_m = ground().h_m(place.lat_deg, place.lon_deg);
    if (!top_m || !ground_m) return std::nullopt;
    return std::max(0.0, *top_m - *ground_m);
}

std::optional<double> SightGround::in_canopy_m(const Geodetic& point) const {
    if (!canopy) return std::nullopt;
    const auto top_m = hiding().h_m(point.lat_deg, point.lon_deg);
    if (!top_m || !(point.h_m < *top_m)) return std::nullopt;
    return *top_m - point.h_m;
}

Result<SightCover> open_sight_cover(const ViewOptions& view) {
    SightCover opened;
    ORO_TRY(CoverChoice cover, cover_choice_from(view.landcover));
    ORO_TRY(const CanopyChoice canopy,
            canopy_choice_from(view.canopy, view.canopy_held, !view.landcover.empty()));
    std::vector<Fingerprints::OfSource> ignored;
    ORO_TRY(opened.cover, open_cover(cover, ignored));
    ORO_TRY(opened.canopy, open_canopy(canopy, opened.cover, ignored));
    opened.held = canopy.held;
    return opened;
}

std::vector<std::string> files_of_cover(const SightCover& cover) {
    std::vector<std::string> files;
    const auto add = [&](const PlacedRaster& raster) {
        files.insert(files.end(), raster.files.begin(), raster.files.end());
    };
    if (cover.cover)
        for (const CoverSource& source : cover.cover->sources()) add(source);
    if (cover.canopy)
        for (const CanopySource& source : cover.canopy->sources()) add(source);
    return files;
}

Result<std::unique_ptr<const SightGround>> open_sight_ground(const RegionOptions& options,
                                                             const Progress& progress,
                                                             const SightCover& cover) {
    ORO_TRY(const RegionRequest request, region_request(options));
    ORO_TRY(Region region, open_region(request, progress));
    return sight_ground_of(std::move(region), cover);
}

Result<std::unique_ptr<const SightGround>> sight_ground_of(Region region, const SightCover& cover) {
    auto ground = std::make_unique<SightGround>();
    ground->region = std::move(region);
    leave_covered_grids_out(ground->region);
    ORO_TRY(ground->grids, RegionGround::of(ground->region, 1.0));
    if (cover.canopy) {
        auto canopy = std::make_unique<SightCanopy>();
        canopy->map = cover.canopy;
        canopy->region = ground->region;
        ORO_CHECK(raise_by_canopy(canopy->region, *canopy->map, cover.held));
        ORO_TRY(canopy->grids, RegionGround::of(canopy->region, 1.0));
        ground->canopy = std::move(canopy);
    }
    return std::unique_ptr<const SightGround>(std::move(ground));
}

Result<void> check_above(const char* option, const std::optional<double>& above_m) {
    if (!above_m || *above_m >= 0.0) return {};
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", *above_m);
    return refused(option, text, "must be 0 or more: nothing is seen from, or in, the ground");
}

Result<Geodetic> point_over_ground(const Standing& standing, const SightGround& ground) {
    ORO_TRY(const Standpoint stood, stand_over_ground(standing, ground));
    return stood.eye;
}

Result<Standpoint> stand_over_ground(const Standing& standing, const SightGround& ground) {
    ORO_TRY(Standpoint stood, stand_over_ground(standing, ground.region, ground.ground()));
    if (!ground.canopy || stood.moved || ground.canopy_m(stood.eye)) return stood;
    // Where nothing grows what hides is the ground; but with a forest nearby its cells may be split along
    // their other diagonals.
    ORO_TRY(const Standpoint open, stand_over_ground(standing, ground.canopy->region, ground.hiding()));
    stood.eye = open.eye;
    return stood;
}

Result<Standpoint> stand_over_ground(const Standing& standing, const Region& region,
                                     const TrueGround& ground) {
    ORO_CHECK(check_above(standing.above_option, standing.above_m));
    ORO_TRY(const Place place, place_at(standing.place_option, standing.place));
    ORO_TRY(Standpoint stood, stand(standing, region));
    Geodetic& point = stood.eye;
    ORO_CHECK(lift_onto_top(standing, region, ground.exaggeration(), point));
    if (!view_limits::sight_h_m.hold(point.h_m)) {
        char text[120];
        std::snprintf(text, sizeof text, "would be at h %g m, not between %g and %g", point.h_m,
                      view_limits::sight_h_m.low, view_limits::sight_h_m.high);
        return refused(standing.place_option, standing.place, text);
    }
    std::optional<double> above_m = ground.h_m(point.lat_deg, point.lon_deg);
    if (above_m) above_m = point.h_m - *above_m;
    // What was put onto the ground may be rounded below it.
    constexpr double rounded_m = 1.0e-6;
    if (above_m && *above_m < -rounded_m) {
        char text[80];
        std::snprintf(text, sizeof text, "lies %.1f m under the ground: give it another height", -*above_m);
        return refused(standing.place_option, standing.place, text);
    }
    if (above_m) point.h_m += std::max(0.0, least_above_m - *above_m);
    return stood;
}

nlohmann::ordered_json point_json(const SightGround& ground, const Geodetic& point) {
    return json_object("lat_deg", point.lat_deg, "lon_deg", point.lon_deg, "h_m", point.h_m, "H_m",
                       ground.H_m(point));
}

}  // namespace oro
