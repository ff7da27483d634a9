#include "apps/view/place_camera.h"

#include <algorithm>
#include <cmath>

#include "apps/eye/ground_points.h"
#include "apps/eye/standpoint.h"
#include "apps/view/overview.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

// From one post to the next, about.
double spacing_m(const PostGrid& grid) {
    return wgs84_a_m * std::max(grid.row_step_rad(), 1e-12);
}

const HeightField& field_at(const Region& region, double lat_deg, double lon_deg) {
    return grid_at(region, lat_deg, lon_deg).field;
}

Error no_ground(const Place& place, const Region& region, const std::string& name, const char* where) {
    return {ErrorKind::no_data, name,
            std::string("no elevation data ") + where +
                where_data_are(field_at(region, place.lat_deg, place.lon_deg).grid, place.lat_deg,
                               place.lon_deg)};
}

Error nothing_sees(const AskedLine& asked, const std::string& name) {
    if (asked.pitch_deg.value_or(0.0) > 0.0)
        return {
            ErrorKind::usage, name,
            "with a --pitch above 0 the eye would be below the place, and ground is between them: give one "
            "below 0, or --above METRES to stand there"};
    const std::string given = asked.heading_deg && asked.pitch_deg ? "this --heading and --pitch"
                              : asked.pitch_deg                    ? "this --pitch"
                                                                   : "this --heading";
    return {ErrorKind::usage, name,
            "ground hides the place from every eye that looks at it with " + given +
                ": leave that out, or give --above METRES to stand there"};
}

struct TriedCamera {
    Camera camera;
    bool sees{};
    double foreground{};  // foreground_share(), of one that sees
};

// What a camera's picture may lack of its foreground. Where the data end, or have a hole, less ground is
// shown.
constexpr double enough_foreground = 0.88;

// The first camera of those along the lines that are worth a trial whose eye sees a place, over ground as far
// as its picture reaches; else the one with the most ground of those that see it; else the last. Of a framed
// cell (is_whole) the picture reaches beyond its ground anyway.
template <class CameraAlong>
TriedCamera first_that_sees(const Geodetic& place, const AskedLine& asked, const Region& region,
                            double exaggeration, bool is_whole, CameraAlong camera_along) {
    const GroundHeightAt ground = [&](double lat_deg, double lon_deg) {
        return ground_h_m(field_at(region, lat_deg, lon_deg), lat_deg, lon_deg, exaggeration);
    };
    const double step_m = 0.5 * spacing_m(field_at(region, place.lat_deg, place.lon_deg).grid);
    TriedCamera best;
    for (const LineOfSight& line : lines_to_try(asked)) {
        TriedCamera tried{camera_along(line), false, 0.0};
        tried.sees = is_line_free(tried.camera.eye, place, step_m, ground);
        if (tried.sees) tried.foreground = is_whole ? 1.0 : foreground_share(tried.camera, place, ground);
        if (!best.sees || tried.foreground > best.foreground) best = tried;
        if (best.sees && best.foreground > enough_foreground) break;
    }
    return best;
}

// Half of the shorter side of a grid's extent.
double half_extent_m(const PostGrid& grid, double lat_deg) {
    const double column_rad = grid.column_step_rad() * (grid.net ? 1.0 : sine_cosine_deg(lat_deg).cosine);
    return 0.5 * wgs84_a_m *
           std::min((grid.rows() - 1) * grid.row_step_rad(), (grid.columns() - 1) * column_rad);
}

Result<Camera> camera_framing(const Camera& camera, const Place& place, AskedLine asked, const Region& region,
                              double exaggeration, const std::string& name) {
    const GroundPoints ground = ground_points(region, exaggeration, &*place.cell);
    ORO_CHECK(region.health());
    if (ground.all.empty()) return no_ground(place, region, name, "in this cell");
    asked.usual_pitch_deg = overview_pitch_deg(ground.radius_m);
    const auto along = [&](const LineOfSight& line) {
        return camera_on_points(camera, ground.middle, ground.radius_m, line, ground.all, overview_margin);
    };
    const auto middle_h_m = ground_h_m(field_at(region, place.lat_deg, place.lon_deg), place.lat_deg,
                                       place.lon_deg, exaggeration);
    // Of a cell it is the whole that is asked for: what its middle hides behind is ground of it, too.
    if (!middle_h_m || asked.pitch_deg) return along(lines_to_try(asked).front());
    return first_that_sees({place.lat_deg, place.lon_deg, *middle_h_m}, asked, region, exaggeration, true,
                           along)
        .camera;
}

}  // namespace

bool is_framed(const Place& place, const Region& region) {
    if (!place.cell) return false;
    constexpr double least_posts = 4.0;
    const double side_rad = radians_from_deg(place.cell->north_deg - place.cell->south_deg).rad;
    return side_rad >= least_posts * field_at(region, place.lat_deg, place.lon_deg).grid.row_step_rad();
}

Result<Camera> camera_showing(const Camera& camera, const Place& place, const AskedLine& asked,
                              const Region& region, double exaggeration, const std::string& name) {
    if (is_framed(place, region)) return camera_framing(camera, place, asked, region, exaggeration, name);
    const HeightField& field = field_at(region, place.lat_deg, place.lon_deg);
    const auto h_m = standing_h_m(region, field, exaggeration, place.lat_deg, place.lon_deg);
    ORO_CHECK(field.health());
    if (!h_m) return no_ground(place, region, name, "there to look at");
    constexpr double least_m = 20.0, most_m = 2.0e6;
    // A region that is smaller than that is all there is to show.
    const double around_m =
        std::min(posts_around_place * spacing_m(field.grid), half_extent_m(field.grid, place.lat_deg));
    const double radius_m = std::clamp(around_m, least_m, most_m);
    const Geodetic there{place.lat_deg, place.lon_deg, *h_m};
    const TriedCamera tried =
        first_that_sees(there, asked, region, exaggeration, false, [&](const LineOfSight& line) {
            return camera_on_place(camera, there, line, radius_m, overview_margin);
        });
    ORO_CHECK(region.health());
    // From almost straight above a place is seen, however narrow its valley.
    if (!tried.sees && (asked.heading_deg || asked.pitch_deg)) return nothing_sees(asked, name);
    return tried.camera;
}

}  // namespace oro
