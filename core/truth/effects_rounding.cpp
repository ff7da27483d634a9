// What rounding makes of posts, predicted by doing it.
#include <algorithm>
#include <array>
#include <glm/mat3x3.hpp>

#include "core/terrain/drawn_heights.h"
#include "core/truth/effects.h"

namespace oro {

// What float32 makes of the posts around each sample, worked out in float as a GPU does: rounding is no
// chance. A matrix may be multiplied from its first column or from its last: `backwards`.
EffectSize EffectPrediction::in_float32(Precision precision, bool backwards) const {
    const PostGrid& grid = surface_.field().grid;
    const glm::mat3 rotation(view_from_ecef_);
    const glm::vec3 translation(-(view_from_ecef_ * sight_.eye.m));
    const auto offset_m = [&](int row, int column, double otherwise_m) {
        const Geodetic post{row_lat_deg(grid, row), grid.lon.at_deg(column),
                            surface_.post_h_m(row, column).value_or(otherwise_m)};
        const glm::vec3 at(ecef_from_geodetic(post).m);
        if (precision == Precision::rounded_posts) return glm::dvec3(at) - sight_.eye.m;
        const glm::vec3 turned = backwards ? (rotation[2] * at.z + rotation[1] * at.y) + rotation[0] * at.x
                                           : (rotation[0] * at.x + rotation[1] * at.y) + rotation[2] * at.z;
        return glm::dvec3(turned + translation) * view_from_ecef_;
    };
    return displaced(samples_, [&](const Sample& sample) {
        glm::dvec3 offset(0.0);
        for (const PostShare& post : shares_of(sample))
            offset += post.share * offset_m(post.row, post.column, sample.point.h_m);
        return std::optional(sight_.refraction.apparent_m(offset));
    });
}

// The posts of a sample's triangle, and how much each counts there.
std::array<EffectPrediction::PostShare, 3> EffectPrediction::shares_of(const Sample& sample) const {
    const PostGrid& grid = surface_.field().grid;
    const double down = grid.lat.index_at(sample.point.lat_deg) - sample.row;
    const double right = grid.column_at(sample.point.lon_deg) - sample.column;
    const double north_west = 1.0 - std::max(down, right), south_east = std::min(down, right);
    return {{{sample.row, sample.column, north_west},
             {sample.row + 1, sample.column + 1, south_east},
             {sample.row + (sample.south_west ? 1 : 0), sample.column + (sample.south_west ? 0 : 1),
              1.0 - north_west - south_east}}};
}

// Rounding of heights is no chance either: whole metres of H have all the same rest where N hardly changes.
EffectSize EffectPrediction::in_sixteen_bits() const {
    const PostGrid& grid = surface_.field().grid;
    const auto off_m = [&](int row, int column) {
        // As it is drawn: without a geoid, if that is how pages have it.
        const double h_m = surface_.post_h_m(row, column).value_or(0.0) -
                           left_out_N_m(row_lat_deg(grid, row), grid.lon.at_deg(column));
        return world_.sixteen.steps(world_.sixteen.code(height_steps(h_m))) * height_step_m - h_m;
    };
    return displaced(samples_, [&](const Sample& sample) {
        Geodetic point = sample.point;
        for (const PostShare& post : shares_of(sample))
            point.h_m += post.share * off_m(post.row, post.column);
        return std::optional(sight_.refraction.apparent_m(ecef_from_geodetic(point).m - sight_.eye.m));
    });
}

}  // namespace oro
