// Where there are data, as far as a region knows: its box, less the whole-degree cells that no source covers,
// less what lies beyond the edges of sources inside it.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/terrain/post_grid.h"

namespace oro {

// A whole degree of latitude and longitude, by its south-west corner: latitude -90 .. 89, longitude -180 ..
// 179.
struct DegreeCell {
    int lat_deg{};
    int lon_deg{};
    auto operator<=>(const DegreeCell&) const = default;
};
// Where there are no data: in which cell, and whether because a part was chosen that ends before.
struct UnseenPlace {
    DegreeCell cell;
    bool is_beyond_part{};
    auto operator<=>(const UnseenPlace&) const = default;
};
// The cell that a place is in; the poles belong to the cells beside them.
DegreeCell degree_cell_at(double lat_deg, double lon_deg);

// A part of the Earth in degrees; west > east crosses the antimeridian.
struct DegreeBox {
    double west_deg{};
    double south_deg{};
    double east_deg{};
    double north_deg{};
};

// Between two neighbouring parallels of parallels_deg() and two neighbouring meridians of meridians_deg()
// there are data everywhere or nowhere.
class KnownGround {
  public:
    // `missing`: cells without any source. `has_rims`: sources end inside the region (a rotated raster, one
    // that is narrower than the others), so that posts outside all of them are void posts of the field. They
    // are told from those that are void in their source by being joined to the region's edge or to a missing
    // cell: blocks of posts (at most 128 along an axis) that hold a void post and are so joined count as
    // without data, whole. That errs towards no data, by a block, and for voids at the very edge. Looks at
    // every post then, else at none.
    // `part`: what was chosen of the data, nothing where all of them were.
    KnownGround(const HeightField& field, std::span<const DegreeCell> missing, bool has_rims,
                const std::optional<DegreeBox>& part = {});

    // True where there are data, or a void post of a source. Any whole turn of the longitude. The edges count
    // as inside.
    [[nodiscard]] bool holds(double lat_deg, double lon_deg) const;
    // True of a place outside the part that was chosen: there may be data, which nobody asked for. A side of
    // the part is where the grid ends, when that is within two posts of it.
    [[nodiscard]] bool is_beyond_part(double lat_deg, double lon_deg) const;
    // The cell of a place without data, and whether it is beyond the chosen part.
    [[nodiscard]] UnseenPlace unseen_at(double lat_deg, double lon_deg) const {
        return {degree_cell_at(lat_deg, lon_deg), is_beyond_part(lat_deg, lon_deg)};
    }
    // In no order; longitudes in any whole turn.
    [[nodiscard]] const std::vector<double>& parallels_deg() const { return parallels_deg_; }
    [[nodiscard]] const std::vector<double>& meridians_deg() const { return meridians_deg_; }

  private:
    void find_rims(const HeightField& field);
    [[nodiscard]] std::vector<std::uint8_t> blocks_with_voids(const HeightField& field) const;
    [[nodiscard]] bool meets_nothing(int block_row, int block_column) const;

    PostGrid grid_;
    std::optional<DegreeBox> part_;
    std::set<DegreeCell> missing_;
    std::vector<double> parallels_deg_;
    std::vector<double> meridians_deg_;
    int posts_a_block_{0};  // 0: sources end nowhere inside
    int block_rows_{0};
    int block_columns_{0};
    std::vector<std::uint8_t> beyond_rims_;  // of each block
};

}  // namespace oro
