#include "apps/maps/ortho_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"

namespace oro {
namespace {

// Of the ground's finer pixel side: then 3.2e-7 of the distance, to which posts are placed, is 0.01 of it.
constexpr double eye_away_px = 30000.0;
constexpr double least_away_m = 500.0;

struct PixelFrame {
    Geodetic middle;   // on the ellipsoid
    double right_m{};  // a pixel's sides on the ground
    double down_m{};
    double heading_deg{};  // of the map's up
};

std::optional<PixelFrame> pixel_frame(const MapSquare& square, MapPlaces& places) {
    const double x = square.x_px + 0.5 * square.width_px, y = square.y_px + 0.5 * square.height_px;
    const auto middle = places.at(x, y), right = places.at(x + 1.0, y), up = places.at(x, y - 1.0);
    if (!middle || !right || !up) return std::nullopt;
    const auto on_ellipsoid = [](const MapPlace& place) {
        return ecef_from_geodetic({place.lat_deg, place.lon_deg, 0.0}).m;
    };
    PixelFrame frame;
    frame.middle = {middle->lat_deg, normalised_lon_deg(middle->lon_deg), 0.0};
    const glm::dvec3 here = on_ellipsoid(*middle), upwards = on_ellipsoid(*up) - here;
    frame.right_m = glm::length(on_ellipsoid(*right) - here);
    frame.down_m = glm::length(upwards);
    if (!(frame.right_m > 0.0 && frame.down_m > 0.0)) return std::nullopt;
    frame.heading_deg = attitude_of_direction(frame.middle, upwards / frame.down_m).heading_deg;
    return frame;
}

void find_ground(MapPlaces& places, const TrueGround& ground, bool voids_are_sea, MapSquare& square) {
    std::vector<std::vector<std::optional<MapPlace>>> rows(static_cast<std::size_t>(square.height_px));
    for (int y = 0; y < square.height_px; ++y)
        places.row(square.x_px, square.y_px + y, square.width_px, rows[static_cast<std::size_t>(y)]);
    in_parallel(square.height_px, thread_count(), [&](int y) {
        for (int x = 0; x < square.width_px; ++x) {
            const auto& place = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
            if (!place) continue;
            if (const auto h_m = map_ground_h_m(ground, *place, voids_are_sea))
                square.ground[square.number(x, y)] =
                    ecef_from_geodetic({place->lat_deg, place->lon_deg, *h_m});
        }
    });
}

// Where the camera sees the square's ground, as tangents; the widest of them.
glm::dvec2 project(MapSquare& square) {
    const glm::dmat3 view_from_ecef = square.camera.view_from_ecef();
    const glm::dvec3 eye = square.camera.eye_ecef().m;
    glm::dvec2 widest(0.0);
    for (std::size_t i = 0; i < square.ground.size(); ++i) {
        if (!square.ground[i]) continue;
        const glm::dvec3 at = view_from_ecef * (square.ground[i]->m - eye);
        square.at_px[i] = glm::dvec2(at.x, at.y) / -at.z;
        widest = glm::max(widest, glm::abs(square.at_px[i]));
    }
    return widest;
}

}  // namespace

std::optional<double> map_ground_h_m(const TrueGround& ground, const MapPlace& place, bool voids_are_sea) {
    std::optional<double> sea_h_m;
    for (std::size_t grid = 0; grid < ground.grids(); ++grid) {
        const TrueSurface& surface = ground.surface(grid);
        const PostGrid& posts = surface.field().grid;
        const auto [row, column] = posts.post_at(place.lat_deg, place.lon_deg);
        const bool inside =
            row >= 0.0 && column >= 0.0 && row <= posts.rows() - 1.0 && column <= posts.columns() - 1.0;
        if (!inside) continue;
        const auto h_m = surface.h_at_m(row, column);
        if (h_m && ground.shows(grid, place.lat_deg, place.lon_deg)) return h_m;
        if (!h_m && voids_are_sea) sea_h_m = surface.field().undulation.at_m(place.lat_deg, place.lon_deg);
    }
    return sea_h_m;
}

MapSquare map_square(const MapSquare& where, MapPlaces& places, const TrueGround& ground, bool voids_are_sea,
                     int finer) {
    MapSquare square = where;
    const auto pixels =
        static_cast<std::size_t>(square.width_px) * static_cast<std::size_t>(square.height_px);
    square.ground.assign(pixels, std::nullopt);
    square.at_px.assign(pixels, glm::dvec2(0.0));
    square.camera = {};
    square.camera.width_px = square.camera.height_px = 0;
    const auto frame = pixel_frame(square, places);
    if (!frame) return square;
    find_ground(places, ground, voids_are_sea, square);
    double top_h_m = -1.0e9;
    for (const auto& at : square.ground)
        if (at) top_h_m = std::max(top_h_m, geodetic_from_ecef(*at).h_m);
    if (top_h_m < -1.0e8) return square;
    const double side_m = std::min(frame->right_m, frame->down_m),
                 away_m = std::max(least_away_m, eye_away_px * side_m);
    square.camera.eye = {frame->middle.lat_deg, frame->middle.lon_deg, top_h_m + away_m};
    square.camera.attitude = {frame->heading_deg, -90.0, 0.0};
    square.camera.width_px = square.camera.height_px = 1;
    const glm::dvec2 widest = project(square);
    // Room for the neighbours of what is sampled; and no narrower than a camera may be.
    constexpr double margin_px = 6.0, narrowest_px = 64.0;
    const double px_per_tangent = away_m * finer / side_m;
    const auto side_px = [&](double tangent) {
        return 2 * static_cast<int>(std::ceil(std::max(tangent * px_per_tangent + margin_px, narrowest_px)));
    };
    square.camera.width_px = side_px(widest.x);
    square.camera.height_px = side_px(widest.y);
    square.camera.vertical_fov_deg =
        2.0 * deg_from_radians(Radians{std::atan(0.5 * square.camera.height_px / px_per_tangent)});
    const glm::dvec2 middle_px(0.5 * square.camera.width_px, 0.5 * square.camera.height_px);
    for (glm::dvec2& at : square.at_px) at = middle_px + glm::dvec2(at.x, -at.y) * px_per_tangent;
    square.right_px = {finer * frame->right_m / side_m, 0.0};
    square.down_px = {0.0, finer * frame->down_m / side_m};
    return square;
}

}  // namespace oro
