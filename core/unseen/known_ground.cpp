#include "core/unseen/known_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

constexpr int most_blocks = 128;
// A place on the edge of the region may come out this many posts beyond it.
constexpr double edge_slack_posts = 1.0e-6;

// Sides of a grid on latitudes and longitudes stand for those of a part that are within two posts of them:
// the grid's posts need not lie on the part's rim.
DegreeBox with_sides_of(const PostGrid& grid, DegreeBox part) {
    constexpr double posts = 2.0;
    const double lat_deg = posts * grid.lat.spacing_deg(), lon_deg = posts * grid.lon.spacing_deg();
    const auto take = [](double& side, double of_grid, double slack_deg) {
        if (std::abs(std::remainder(side - of_grid, 360.0)) <= slack_deg) side = of_grid;
    };
    take(part.west_deg, grid.west_deg(), lon_deg);
    take(part.east_deg, grid.east_deg(), lon_deg);
    take(part.south_deg, grid.south_deg(), lat_deg);
    take(part.north_deg, grid.north_deg(), lat_deg);
    return part;
}

}  // namespace

DegreeCell degree_cell_at(double lat_deg, double lon_deg) {
    const int lat = std::clamp(static_cast<int>(std::floor(lat_deg)), -90, 89);
    const int lon = static_cast<int>(std::floor(normalised_lon_deg(lon_deg)));
    return {lat, lon >= 180 ? lon - 360 : lon};
}

KnownGround::KnownGround(const HeightField& field, std::span<const DegreeCell> missing, bool has_rims,
                         const std::optional<DegreeBox>& part)
    : grid_(field.grid), part_(part), missing_(missing.begin(), missing.end()) {
    if (part_ && !grid_.net) part_ = with_sides_of(grid_, *part_);
    parallels_deg_ = {grid_.south_deg(), grid_.north_deg()};
    meridians_deg_ = {grid_.west_deg(), grid_.east_deg()};
    // The whole degrees of missing cells, each once.
    std::set<int> parallels, meridians;
    for (const DegreeCell& cell : missing_) {
        parallels.insert({cell.lat_deg, cell.lat_deg + 1});
        meridians.insert({cell.lon_deg, cell.lon_deg + 1});
    }
    parallels_deg_.insert(parallels_deg_.end(), parallels.begin(), parallels.end());
    meridians_deg_.insert(meridians_deg_.end(), meridians.begin(), meridians.end());
    if (has_rims) find_rims(field);
}

std::vector<std::uint8_t> KnownGround::blocks_with_voids(const HeightField& field) const {
    std::vector<std::uint8_t> blocks(static_cast<std::size_t>(block_rows_) *
                                     static_cast<std::size_t>(block_columns_));
    for (int row = 0; row < grid_.rows(); ++row) {
        for (int column = 0; column < grid_.columns(); ++column) {
            if (!is_void(field.H_at_post_m(row, column))) continue;
            // A post on the line between two blocks is a corner of quads of both.
            for (const int r : {row - 1, row}) {
                for (const int c : {column - 1, column}) {
                    const int block_row = std::clamp(r / posts_a_block_, 0, block_rows_ - 1);
                    const int block_column = std::clamp(c / posts_a_block_, 0, block_columns_ - 1);
                    blocks[static_cast<std::size_t>(block_row) * static_cast<std::size_t>(block_columns_) +
                           static_cast<std::size_t>(block_column)] = 1;
                }
            }
        }
    }
    return blocks;
}

// At the region's edge, or with a missing cell in it or beside it.
bool KnownGround::meets_nothing(int block_row, int block_column) const {
    const bool at_west_or_east = block_column == 0 || block_column == block_columns_ - 1;
    if (block_row == 0 || block_row == block_rows_ - 1 || (at_west_or_east && !grid_.wraps_longitude()))
        return true;
    if (missing_.empty()) return false;
    for (const int row : {-1, posts_a_block_ + 1}) {
        for (const int column : {-1, posts_a_block_ + 1}) {
            const std::int64_t at_row = std::int64_t{block_row} * posts_a_block_ + row,
                               at_column = std::int64_t{block_column} * posts_a_block_ + column;
            if (missing_.contains(degree_cell_at(grid_.lat.at_deg(at_row), grid_.lon.at_deg(at_column))))
                return true;
        }
    }
    return false;
}

void KnownGround::find_rims(const HeightField& field) {
    const int quads = std::max(grid_.rows(), grid_.columns()) - 1;
    posts_a_block_ = std::max(1, (quads + most_blocks - 1) / most_blocks);
    block_rows_ = std::max(1, (grid_.rows() - 2) / posts_a_block_ + 1);
    block_columns_ = std::max(1, (grid_.columns() - 2) / posts_a_block_ + 1);
    const std::vector<std::uint8_t> with_voids = blocks_with_voids(field);
    beyond_rims_.assign(with_voids.size(), 0);
    const auto number = [&](int row, int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(block_columns_) +
               static_cast<std::size_t>(column);
    };
    std::vector<std::pair<int, int>> open;
    const auto take = [&](int row, int column) {
        if (row < 0 || row >= block_rows_ || column < 0 || column >= block_columns_) return;
        const std::size_t block = number(row, column);
        if (with_voids[block] == 0 || beyond_rims_[block] != 0) return;
        beyond_rims_[block] = 1;
        open.emplace_back(row, column);
    };
    for (int row = 0; row < block_rows_; ++row) {
        for (int column = 0; column < block_columns_; ++column) {
            if (with_voids[number(row, column)] != 0 && meets_nothing(row, column)) take(row, column);
        }
    }
    while (!open.empty()) {
        const auto [row, column] = open.back();
        open.pop_back();
        for (const int r : {row - 1, row, row + 1}) {
            for (const int c : {column - 1, column, column + 1}) take(r, c);
        }
    }
    for (int row = 1; row < block_rows_; ++row)
        parallels_deg_.push_back(grid_.lat.at_deg(std::int64_t{row} * posts_a_block_));
    for (int column = 1; column < block_columns_; ++column)
        meridians_deg_.push_back(grid_.lon.at_deg(std::int64_t{column} * posts_a_block_));
}

bool KnownGround::is_beyond_part(double lat_deg, double lon_deg) const {
    if (!part_) return false;
    if (lat_deg < part_->south_deg || lat_deg > part_->north_deg) return true;
    const auto turned_deg = [](double angle_deg) {
        return angle_deg - 360.0 * std::floor(angle_deg / 360.0);
    };
    const double wide_deg = part_->east_deg - part_->west_deg;
    if (wide_deg >= 360.0) return false;
    return turned_deg(lon_deg - part_->west_deg) > turned_deg(wide_deg);
}

bool KnownGround::holds(double lat_deg, double lon_deg) const {
    const auto [row, column] = grid_.post_at(lat_deg, lon_deg);
    if (!(row >= -edge_slack_posts && row <= grid_.rows() - 1 + edge_slack_posts)) return false;
    if (!(column >= -edge_slack_posts && column <= grid_.columns() - 1 + edge_slack_posts)) return false;
    if (!missing_.empty() && missing_.contains(degree_cell_at(lat_deg, lon_deg))) return false;
    if (posts_a_block_ == 0) return true;
    const int block_row = std::clamp(static_cast<int>(row) / posts_a_block_, 0, block_rows_ - 1);
    const int block_column = std::clamp(static_cast<int>(column) / posts_a_block_, 0, block_columns_ - 1);
    return beyond_rims_[static_cast<std::size_t>(block_row) * static_cast<std::size_t>(block_columns_) +
                        static_cast<std::size_t>(block_column)] == 0;
}

}  // namespace oro
