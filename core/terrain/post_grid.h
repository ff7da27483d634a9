// The one grid of elevation posts that a region is made of, and the heights on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/net/lattice_georeference.h"

namespace oro {

// Posts along one axis of a region, evenly spaced in degrees. A post's angle depends on its *index in the
// world*, not on where the region starts, so a post has the same bits in every region that holds it.
struct GridAxis {
    double posts_per_deg{1.0};  // > 0; for SRTM3 1200, for SRTM1 3600
    double phase_deg{0.0};      // angle of the post with world index 0
    std::int64_t first{0};      // world index of the region's post number 0
    int step{1};   // +1: angles grow with the post's number (longitude); -1: they fall (latitude)
    int count{0};  // posts in the region, at least 1 (2 make a surface)

    [[nodiscard]] double spacing_deg() const { return 1.0 / posts_per_deg; }
    // Angle of post i (also beyond the ends). Error: one rounding.
    [[nodiscard]] double at_deg(std::int64_t i) const {
        return phase_deg + static_cast<double>(first + step * i) / posts_per_deg;
    }
    // The (fractional) post number at an angle; the inverse of at_deg.
    [[nodiscard]] double index_at(double angle_deg) const {
        return ((angle_deg - phase_deg) * posts_per_deg - static_cast<double>(first)) * step;
    }
};

// Rows run from north to south, columns from west to east. Longitudes may run past 180 where a region crosses
// the antimeridian (first column in [-180, 180)); a region is at most 360 degrees wide, and one that wide has
// the same meridian in its first and last column.
// Or the posts are those of a source with a CRS of its own: then `net` says where they lie, rows run as south
// does from east, and of the axes only the counts mean anything.
struct PostGrid {
    GridAxis lat;
    GridAxis lon;
    std::shared_ptr<const LatticeGeoreference> net{};  // null: posts lie on latitudes and longitudes

    [[nodiscard]] int rows() const { return lat.count; }
    [[nodiscard]] int columns() const { return lon.count; }
    // Box of all posts.
    [[nodiscard]] double north_deg() const { return net ? net->box().north_deg : lat.at_deg(0); }
    [[nodiscard]] double south_deg() const { return net ? net->box().south_deg : lat.at_deg(lat.count - 1); }
    [[nodiscard]] double west_deg() const { return net ? net->box().west_deg : lon.at_deg(0); }
    [[nodiscard]] double east_deg() const { return net ? net->box().east_deg : lon.at_deg(lon.count - 1); }
    [[nodiscard]] std::size_t post_count() const {
        return static_cast<std::size_t>(rows()) * static_cast<std::size_t>(columns());
    }
    // Column number of a longitude: that of the whole turn which falls into the grid, or the nearest to it.
    [[nodiscard]] double column_at(double lon_deg) const;
    // Fractional numbers of the post at a place, as lat.index_at and column_at give them.
    [[nodiscard]] PostNumber post_at(double lat_deg, double lon_deg) const;
    // The place at a fractional row and column; its longitude may be in any whole turn.
    [[nodiscard]] PostPlace place_at(double row, double column) const;
    // Angles, at the Earth's centre, from a post to the next, along rows and along columns; the largest in
    // the grid where it has a net, and there of all places as if they lay on the equator.
    [[nodiscard]] double row_step_rad() const;
    [[nodiscard]] double column_step_rad() const;
    // True for a region 360 degrees wide: its last column is its first.
    [[nodiscard]] bool wraps_longitude() const;
};
// The grid of all posts of a net.
PostGrid grid_on_net(std::shared_ptr<const LatticeGeoreference> net);

// The height of a post that has none. Not a height that any source can hold, and no NaN, so that none can
// reach the GPU.
inline constexpr float void_height_m = -std::numeric_limits<float>::max();
[[nodiscard]] constexpr bool is_void(float height_m) {
    return height_m == void_height_m;
}

// The geoid's undulation N over a region, on nodes of its own, bilinear between them: exactly the surface
// that PROJ gives for a gridded geoid when the nodes include those of its grid. An empty field is N = 0
// everywhere.
struct UndulationField {
    GridAxis lat;  // step -1
    GridAxis lon;  // step +1
    std::vector<float> N_m;

    // A place between two nodes of an axis: number of the first, and the share of the second.
    struct Between {
        int first;
        double share;
    };
    [[nodiscard]] Between row_between(double lat_deg) const;
    [[nodiscard]] Between column_between(double lon_deg) const;
    // N in metres at a row and a column, the same bits as at_m; for many places of one row. Not for an empty
    // field.
    [[nodiscard]] double at_m(const Between& row, const Between& column) const;
    // N in metres at a place; places beyond the nodes take the nearest value (in whichever whole turn of the
    // longitude is nearest). Error: 8 um of rounding.
    [[nodiscard]] double at_m(double lat_deg, double lon_deg) const;
    // What N is not below or above between two latitudes and two longitudes, in metres; (0, 0) of an empty
    // field.
    [[nodiscard]] std::pair<float, float> range_m(double north_deg, double south_deg, double west_deg,
                                                  double east_deg) const;
};

struct HeightRange {
    float lowest_m;
    float highest_m;
    std::size_t voids;
};

// Posts that are read when they are asked for; from any thread.
class PostSource {
  public:
    virtual ~PostSource() = default;
    // H of a post of the grid, void_height_m where there is none, and where it cannot be read: then health()
    // tells so.
    [[nodiscard]] virtual float H_m(int row, int column) const = 0;
    // The first error that stood in the way of a post, from whichever thread it was asked for; it stays.
    [[nodiscard]] virtual Result<void> health() const = 0;
    // H_m() of posts of a row, from a column on; all are of the grid.
    virtual void row_H_m(int row, int first_column, std::span<float> H_m) const {
        for (std::size_t i = 0; i < H_m.size(); ++i)
            H_m[i] = this->H_m(row, first_column + static_cast<int>(i));
    }
    // What H of no cell is below or above, of 128 x 128 cells: those of a page of level 0. Nothing where all
    // posts would have to be looked at for it.
    struct Range {
        double lowest_H_m, highest_H_m;
    };
    [[nodiscard]] virtual std::optional<Range> range_of_page(int page_row, int page_column) const {
        static_cast<void>(page_row), static_cast<void>(page_column);
        return std::nullopt;
    }
};

// The true surface of a scene: orthometric heights H on a post grid, and the undulation N that lifts them
// onto the ellipsoid (h = H + N). Each cell is two triangles, split by a diagonal
// (core/terrain/cell_diagonal.h); between posts H is linear over those triangles in geodetic coordinates.
struct HeightField {
    PostGrid grid;
    std::vector<float> H_m;  // row by row, rows() * columns(); void_height_m where there is none
    // Where the posts are not in memory: H_m is empty, and these stand for it; range is then known, too.
    std::shared_ptr<const PostSource> posts;
    std::optional<HeightRange> range;
    UndulationField undulation;
    // N of each post where the grid has a net, as N_on_net_m() has it: to look it up by place takes long.
    // Empty where the posts are not in memory, and where N is 0 everywhere.
    std::vector<float> N_of_posts_m;

    [[nodiscard]] float H_at_post_m(int row, int column) const {
        if (posts) return posts->H_m(row, column);
        return H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                   static_cast<std::size_t>(column)];
    }
    // Whether every post that was asked for so far could be read. A post that could not be read counts as
    // void, so that an answer about the surface is one only when this is asked afterwards: before it is
    // shown, and before anything that it decides is written. Always well where the posts are in memory.
    [[nodiscard]] Result<void> health() const { return posts ? posts->health() : Result<void>(); }
    // N at a post.
    [[nodiscard]] double N_at_post_m(int row, int column) const;
    // Height above the ellipsoid of a post that is not void.
    [[nodiscard]] double h_at_post_m(int row, int column) const;
    // H of the surface at a place, or void_height_m outside the region and on triangles with a void post.
    [[nodiscard]] float H_at_m(double lat_deg, double lon_deg) const;
    // H of the surface in double, before it is rounded to 0.5 mm.
    // masked: by post, 1 where it is cut out, and so decides no diagonal (core/terrain/cell_diagonal.h).
    [[nodiscard]] std::optional<double> surface_H_m(double lat_deg, double lon_deg,
                                                    const std::vector<char>* masked = nullptr) const;
};

// N at the place of a net's post with that normal, in whichever way it is asked for: rounded to float.
float N_on_net_m(const UndulationField& undulation, const glm::dvec3& normal);
// N of all posts of a net in metres; empty where N is 0 everywhere.
std::vector<float> N_of_net_m(const LatticeGeoreference& net, const UndulationField& undulation, int threads);

// Lowest and highest H and the number of void posts; 0..0 when all are void.
HeightRange height_range(const HeightField& field);

}  // namespace oro
