// From the options of a map to its view.
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/maps/ortho_map.h"
#include "apps/options/view_limits.h"
#include "apps/view/view_option_table.h"
#include "geo/together/cut_regions.h"

namespace oro {
Result<void> check_map_options(const ShotOptions& options) {
    const ViewOptions& view = options.view;
    if (!options.ortho) {
        if (options.crs || options.resolution)
            return refused(options.crs ? "--crs" : "--resolution", "", "says nothing without --ortho");
        return {};
    }
    if (!options.view_file.empty())
        return refused("--ortho", "", "not together with --view, which says itself whether it is a map");
    if (const char* const option = first_given(view_option_table(), view, is_of_eye))
        return refused(option, "",
                       "not together with --ortho: a map is seen from straight above, and has no eye");
    const char* const of_eye =
        first_given_of(view_option_table(), view,
                       {"--earth", "--refraction", "--air", "--precision", "--tolerance", "--edges", "--show",
                        "--names", "--overlay", "--graticule", "--detail"});
    if (of_eye != nullptr || options.verify || options.layers)
        return refused(of_eye != nullptr ? of_eye
                       : options.verify  ? "--verify"
                                         : "--layers",
                       "", "not together with --ortho: it is for pictures from an eye");
    if (view.size && options.resolution)
        return refused("--resolution", "", either_words("--resolution", "--size"));
    if (options.resolution && !(*options.resolution > 0.0 && std::isfinite(*options.resolution)))
        return refused("--resolution", "", "must be more than 0");
    return {};
}

Result<void> make_map(View& view, const ShotOptions& options, const Region& region) {
    MapRequest request{options.crs, options.resolution, {}};
    if (options.view.size) request.size_px = {{view.camera.width_px, view.camera.height_px}};
    std::vector<const PostGrid*> grids;
    for (const RegionGrid& one : region.grids) grids.push_back(&one.field.grid);
    ORO_TRY(view.map, map_frame(request, grids));
    const MapFrame& map = *view.map;
    ORO_TRY(MapPlaces places, MapPlaces::of(map));
    const PostGrid& grid = region.grids.front().field.grid;
    const auto middle = places.at(0.5 * map.width_px, 0.5 * map.height_px)
                            .value_or(MapPlace{0.5 * (grid.north_deg() + grid.south_deg()),
                                               0.5 * (grid.west_deg() + grid.east_deg())});
    const auto above = places.at(0.5 * map.width_px, 0.5 * map.height_px - 1.0).value_or(middle);
    const Geodetic at{middle.lat_deg, normalised_lon_deg(middle.lon_deg), 0.0};
    const glm::dvec3 upwards =
        ecef_from_geodetic({above.lat_deg, above.lon_deg, 0.0}).m - ecef_from_geodetic(at).m;
    const double pixel_m = std::max(1.0e-3, glm::length(upwards));
    Camera& camera = view.camera;
    camera.width_px = map.width_px;
    camera.height_px = map.height_px;
    camera.vertical_fov_deg = 2.0;
    // So far away that the map's middle has the map's scale.
    const double away_m = 0.5 * pixel_m * map.height_px / camera.half_fov_tangent().y;
    camera.eye = {at.lat_deg, at.lon_deg, std::min(away_m, view_limits::eye_h_m.high)};
    camera.attitude = {attitude_of_direction(at, upwards / pixel_m).heading_deg, -90.0, 0.0};
    view.model = {};
    // Drawn heights decide where contour lines run, also on level ground.
    if (!options.view.tau_px && !options.view.accuracy) view.tau_px = 0.1;
    aim_sun(view.sun, at);
    return {};
}

}  // namespace oro
