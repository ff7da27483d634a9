// What rounding makes of posts and pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "core/effects/effects.h"
#include "core/frame/placement_promise.h"
#include "core/terrain/drawn_heights.h"

namespace oro {

namespace {

// Half a unit in the last place of a float, relative.
constexpr double float_rounding = 1.0 / 16777216.0;

// Half a step of float32 at a number of this size; neighbours across a power of two included.
double half_step(double value) {
    return std::ldexp(1.0, std::ilogb(1.001 * std::abs(value) + 1000.0) - 24);
}

// No post moves farther when its coordinates are rounded to float32. A ground point moves with its posts.
double rounding_m(const glm::dvec3& ecef_m) {
    return glm::length(glm::dvec3(half_step(ecef_m.x), half_step(ecef_m.y), half_step(ecef_m.z)));
}

// Nor when a float32 matrix takes them to the eye: each of its elements is rounded, and each product; the
// sums of the three, in whatever order; the translation.
double transform_m(const glm::dmat3& rotation, const glm::dvec3& ecef_m, const glm::dvec3& eye_m) {
    constexpr double unit = 1.0 / 16777216.0;
    glm::dvec3 off_m(0.0);
    const glm::dvec3 translation_m = rotation * eye_m;
    for (int row = 0; row < 3; ++row) {
        double terms_m = 0.0;
        for (int column = 0; column < 3; ++column)
            terms_m += std::abs(rotation[column][row] * ecef_m[column]);
        off_m[row] = unit * (4.0 * terms_m + 2.0 * std::abs(translation_m[row]));
    }
    return glm::length(off_m);
}

}  // namespace

// What drawing rounds off, by no more than is known beforehand; nothing for other effects.
std::optional<EffectSize> EffectPrediction::known_bound(EffectKind kind) const {
    const auto cell_m = [&](const Sample& sample) {
        const PostGrid& posts = grid(sample);
        return wgs84_a_m * std::hypot(posts.row_step_rad(), posts.column_step_rad());
    };
    // Along the sight line nothing moves on the picture.
    const auto along_m = [](const Sample& sample) { return 4.0 * float_rounding * sample.distance_m; };
    constexpr double corner_px = std::numbers::sqrt2 / 256.0;
    const auto corner_m = [&](const Sample& sample) {
        const double z_m = std::max(near_plane_m, -(view_from_ecef_ * sample.apparent_m).z);
        return corner_px / pixels_per_tangent_ * z_m * std::hypot(1.0, sample.slope);
    };
    EffectSize size;
    switch (kind) {
        case EffectKind::steps_f32:
            return lifted([](const Sample&) { return 0.5 * height_step_m; });
        // A ground point moves with the corners of its triangle.
        case EffectKind::placement: {
            const auto off_m = [&](const Sample& sample) {
                return placement_far_share * (sample.distance_m + cell_m(sample));
            };
            return anywhere(off_m, off_m);
        }
        case EffectKind::depth:
            size = anywhere(along_m, along_m);
            size.worst_px = size.typical_px = 0.0;
            return size;
        // Two corners of a triangle may move apart by a step along each axis.
        case EffectKind::pixel_grid:
            size = anywhere(corner_m, corner_m);
            if (!empty()) size.worst_px = size.typical_px = corner_px;
            return size;
        case EffectKind::flat_cells:
            return in_flat_cells();
        default:
            return std::nullopt;
    }
}

// Bounds are derived; what is usual is worked out in float as a GPU does it.
EffectSize EffectPrediction::in_float32(Precision precision) const {
    const bool naive = precision == Precision::naive;
    const auto bound_m = [&](const Sample& sample) {
        const glm::dvec3 ecef_m = ecef_from_geodetic(sample.point).m;
        return rounding_m(ecef_m) + (naive ? transform_m(view_from_ecef_, ecef_m, sight_.eye.m) : 0.0);
    };
    const glm::mat3 rotation(view_from_ecef_);
    const glm::vec3 translation(-(view_from_ecef_ * sight_.eye.m));
    const auto usual_m = [&](const Sample& sample) {
        const glm::dvec3 ecef_m = ecef_from_geodetic(sample.point).m;
        const glm::vec3 at(ecef_m);
        if (!naive) return glm::length(glm::dvec3(at) - ecef_m);
        const glm::vec3 turned = (rotation[0] * at.x + rotation[1] * at.y) + rotation[2] * at.z;
        return glm::length(glm::dvec3(turned + translation) * view_from_ecef_ - (ecef_m - sight_.eye.m));
    };
    return anywhere(bound_m, usual_m);
}

// The posts of a sample's triangle, and how much each counts there.
std::array<EffectPrediction::PostShare, 3> EffectPrediction::shares_of(const Sample& sample) const {
    const PostNumber post = grid(sample).post_at(sample.point.lat_deg, sample.point.lon_deg);
    const double down = post.row - sample.row, right = post.column - sample.column;
    const Diagonal diagonal = surface(sample).diagonal_at(sample.row, sample.column);
    std::array<PostShare, 3> shares{};
    const CellCorners corners = cell_corners(diagonal, sample.west);
    for (std::size_t i = 0; i < 3; ++i) {
        // What a height of 1 at this post and 0 at the others makes there.
        const auto at = [&](int r, int c) { return corners[i] == std::array{r, c} ? 1.0 : 0.0; };
        const CellPlane plane = cell_plane(diagonal, sample.west, at(0, 0), at(0, 1), at(1, 0), at(1, 1));
        shares[i] = {sample.row + corners[i][0], sample.column + corners[i][1],
                     plane.at_corner + down * plane.change_down + right * plane.change_right};
    }
    return shares;
}

// At most half a step. What is usual is no chance: whole metres of H have all the same rest where N hardly
// changes.
EffectSize EffectPrediction::in_sixteen_bits() const {
    const auto off_m = [&](const Sample& sample, int row, int column) {
        const PostGrid& posts = grid(sample);
        const HeightQuantization& sixteen = world_.grids[sample.grid].sixteen;
        // As it is drawn: without a geoid, if that is how pages have it.
        const PostPlace place = posts.net ? posts.net->place_at(row, column)
                                          : PostPlace{row_lat_deg(posts, row), posts.lon.at_deg(column)};
        const double h_m = surface(sample).post_h_m(row, column).value_or(0.0) -
                           left_out_N_m(sample.grid, place.lat_deg, place.lon_deg);
        return sixteen.steps(sixteen.code(height_steps(h_m))) * height_step_m - h_m;
    };
    const EffectSize usual = lifted([&](const Sample& sample) {
        double off = 0.0;
        for (const PostShare& post : shares_of(sample))
            off += post.share * off_m(sample, post.row, post.column);
        return std::abs(off);
    });
    EffectSize size =
        lifted([&](const Sample& sample) { return world_.grids[sample.grid].sixteen.error_m(); });
    size.typical_m = usual.typical_m;
    size.typical_px = usual.typical_px;
    return size;
}

}  // namespace oro
