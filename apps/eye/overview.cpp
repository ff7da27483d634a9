#include "apps/eye/overview.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "apps/command_line/refusals.h"
#include "apps/view/view_limits.h"
#include "core/earth/framing.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// Posts all over the drawn surface, at most some 64 x 64 of them.
std::vector<Ecef> inner_points(const HeightField& field, double exaggeration) {
    std::vector<Ecef> points;
    const int row_step = std::max(1, field.grid.rows() / 64),
              column_step = std::max(1, field.grid.columns() / 64);
    for (int row = 0; row < field.grid.rows(); row += row_step) {
        for (int column = 0; column < field.grid.columns(); column += column_step) {
            if (!is_void(field.H_at_post_m(row, column)))
                points.push_back(post_ecef(field, row, column, exaggeration));
        }
    }
    return points;
}

// The first post with data of every row and column (of every few where they are many), from both of its ends.
void add_rim_points(const HeightField& field, double exaggeration, std::vector<Ecef>& points) {
    const auto add_ends = [&](int lines, int posts, auto post_of) {
        const int step = std::max(1, lines / 1024);
        for (int line = 0; line < lines;
             line = line + 1 == lines ? lines : std::min(line + step, lines - 1)) {
            const auto add_first = [&](int from, int towards) {
                for (int i = from; i >= 0 && i < posts; i += towards) {
                    const auto [row, column] = post_of(line, i);
                    if (is_void(field.H_at_post_m(row, column))) continue;
                    points.push_back(post_ecef(field, row, column, exaggeration));
                    return;
                }
            };
            add_first(0, 1);
            add_first(posts - 1, -1);
        }
    };
    add_ends(field.grid.rows(), field.grid.columns(), [](int row, int column) {
        return std::pair{row, column};
    });
    add_ends(field.grid.columns(), field.grid.rows(), [](int column, int row) {
        return std::pair{row, column};
    });
}

struct Middle {
    Geodetic place;
    double radius_m;  // of a sphere around the mean of all points that holds them
};

Middle middle_of(const std::vector<Ecef>& points) {
    glm::dvec3 mean(0.0);
    for (const Ecef& point : points) mean += point.m / static_cast<double>(points.size());
    double radius_m = 0.0;
    for (const Ecef& point : points) radius_m = std::max(radius_m, glm::length(point.m - mean));
    // Of a region all around the Earth the middle is the Earth's.
    return {glm::length(mean) > 1e6 ? geodetic_from_ecef({mean}) : Geodetic{0.0, 0.0, 0.0}, radius_m};
}

// How far down an overview looks: as a guide does from a summit, and steeper the more the Earth is curved,
// which would hide the far side and put it behind more air.
double down_deg(double radius_m) {
    constexpr double small_m = 1e5, large_m = 1.5e6, oblique_deg = 40.0, steep_deg = 89.9;
    const double share = std::clamp((radius_m - small_m) / (large_m - small_m), 0.0, 1.0);
    return oblique_deg + (steep_deg - oblique_deg) * share;
}

// Where the eye stands decides how an oblique picture is turned for its horizon to be level, and the other
// way round; a picture from far above has no horizon, and is turned by its middle.
void frame(Camera& camera, const Middle& middle, double heading_deg, double pitch_deg,
           const std::vector<Ecef>& points) {
    const double roll_deg = camera.attitude.roll_deg;
    camera.eye = middle.place;
    camera.attitude = {heading_deg, pitch_deg, roll_deg};
    glm::dmat3 axes = glm::transpose(camera.view_from_ecef());
    const bool oblique = std::abs(pitch_deg) < 75.0;
    for (int i = 0; i < (oblique ? 8 : 1); ++i) {
        camera.eye = geodetic_from_ecef(eye_that_frames(camera, glm::transpose(axes), points, overview_margin,
                                                        std::max(1.0, 0.1 * middle.radius_m)));
        camera.attitude = oblique ? attitude_of_direction(camera.eye, -axes[2])
                                  : attitude_of_axes(camera.eye, -axes[2], axes[0]);
        if (!oblique) break;
        camera.attitude.roll_deg = roll_deg;
        axes = glm::transpose(camera.view_from_ecef());
    }
}

// Whether a camera's picture shows a point.
bool is_in_frame(const Camera& camera, const glm::dmat3& view_from_ecef, const glm::dvec3& eye_m,
                 const Ecef& point) {
    const glm::dvec3 seen = view_from_ecef * (point.m - eye_m);
    const glm::dvec2 tangent = camera.half_fov_tangent();
    return seen.z < 0.0 && std::abs(seen.x) <= -seen.z * tangent.x && std::abs(seen.y) <= -seen.z * tangent.y;
}

// Few posts that tell most pictures of a place from one of all at once.
std::vector<Ecef> corner_points(const HeightField& field, double exaggeration) {
    std::vector<Ecef> points;
    const int last_row = field.grid.rows() - 1, last_column = field.grid.columns() - 1;
    for (const int row : {0, last_row})
        for (const int column : {0, last_column})
            if (!is_void(field.H_at_post_m(row, column)))
                points.push_back(post_ecef(field, row, column, exaggeration));
    return points;
}

}  // namespace

bool is_whole_in_view(const View& view, const Region& region) {
    if (view.map || view.panorama) return false;
    const Camera& camera = view.camera;
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye_m = ecef_from_geodetic(camera.eye).m;
    const auto shows = [&](const std::vector<Ecef>& points) {
        return std::ranges::all_of(
            points, [&](const Ecef& point) { return is_in_frame(camera, view_from_ecef, eye_m, point); });
    };
    std::vector<const Region*> grids{&region};
    for (const Region& other : region.beside) grids.push_back(&other);
    for (const Region* const grid : grids)
        if (!shows(corner_points(grid->field, view.exaggeration))) return false;
    std::vector<Ecef> rim;
    for (const Region* const grid : grids) add_rim_points(grid->field, view.exaggeration, rim);
    return !rim.empty() && shows(rim);
}

Result<void> see_whole_region(View& view, const ViewOptions& options, const Region& region) {
    std::vector<Ecef> points = inner_points(region.field, view.exaggeration);
    std::vector<Ecef> rim;
    add_rim_points(region.field, view.exaggeration, rim);
    for (const Region& other : region.beside) {
        const std::vector<Ecef> more = inner_points(other.field, view.exaggeration);
        points.insert(points.end(), more.begin(), more.end());
        add_rim_points(other.field, view.exaggeration, rim);
    }
    if (rim.empty()) return Error{ErrorKind::no_data, "region", "every post is void"};
    const Middle middle = middle_of(points.empty() ? rim : points);
    points.insert(points.end(), rim.begin(), rim.end());
    if (!options.vertical_fov_deg) view.camera.vertical_fov_deg = overview_fov_deg;
    frame(view.camera, middle, options.heading_deg.value_or(0.0),
          options.pitch_deg.value_or(-down_deg(middle.radius_m)), points);
    const double h_m = view.camera.eye.h_m;
    if (view_limits::eye_h_m.hold(h_m)) return {};
    char text[120];
    std::snprintf(text, sizeof text, "the whole region would be seen from h %g m, not between %g and %g", h_m,
                  view_limits::eye_h_m.low, view_limits::eye_h_m.high);
    char fov[40];
    std::snprintf(fov, sizeof fov, "%.15g", view.camera.vertical_fov_deg);
    return refused("--fov", fov, text);
}

}  // namespace oro
