#include "geo/meshes/ground_below.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/terrain/cell_diagonal.h"

namespace oro {
namespace {

using PostRing = std::vector<PostNumber>;

// Of one field, while a polygon is walked along.
class LowestOfField {
  public:
    explicit LowestOfField(const HeightField& field) : field_(field) {}

    void corner(double row, double column) {
        const double north = std::clamp(std::floor(row), 0.0, field_.grid.rows() - 2.0),
                     west = std::clamp(std::floor(column), 0.0, field_.grid.columns() - 2.0);
        const double down = row - north, right = column - west;
        constexpr double slack = 1.0e-9;
        if (!(down >= -slack && right >= -slack && down <= 1.0 + slack && right <= 1.0 + slack)) return;
        const int r = static_cast<int>(north), c = static_cast<int>(west);
        const Diagonal diagonal = cell_diagonal(field_, r, c);
        const bool is_west = west_of_diagonal(diagonal, down, right) >= 0.0;
        std::array<std::array<double, 2>, 2> H_m{};
        for (const auto& [south, east] : cell_corners(diagonal, is_west)) {
            const float post_m = field_.H_at_post_m(r + south, c + east);
            if (is_void(post_m)) return;
            H_m[static_cast<std::size_t>(south)][static_cast<std::size_t>(east)] =
                static_cast<double>(post_m);
        }
        const CellPlane plane = cell_plane(diagonal, is_west, H_m[0][0], H_m[0][1], H_m[1][0], H_m[1][1]);
        take(plane.at_corner + down * plane.change_down + right * plane.change_right);
    }

    // A side crosses rows, columns and diagonals of both kinds: that of the other kind does no harm.
    void side(const PostNumber& from, const PostNumber& to) {
        const auto crossings = [&](double begin, double end) {
            const double low = std::ceil(std::min(begin, end)), high = std::floor(std::max(begin, end));
            constexpr double most_cells = 1.0e5;  // of one side; beyond the grid nothing is asked
            if (high - low > most_cells) return;
            for (double number = low; number <= high; ++number) {
                if (end == begin) break;
                const double share = (number - begin) / (end - begin);
                corner(std::lerp(from.row, to.row, share), std::lerp(from.column, to.column, share));
            }
        };
        corner(from.row, from.column);
        crossings(from.row, to.row);
        crossings(from.column, to.column);
        crossings(from.row - from.column, to.row - to.column);
        crossings(from.row + from.column, to.row + to.column);
    }

    // Posts within, row by row, between every second crossing of the rings.
    void inside(const std::vector<PostRing>& rings) {
        double least = rings.front().front().row, most = least;
        for (const PostNumber& at : rings.front())
            least = std::min(least, at.row), most = std::max(most, at.row);
        const int first = std::max(0, static_cast<int>(std::ceil(std::max(least, -1.0)))),
                  last = static_cast<int>(std::floor(std::min(most, field_.grid.rows() - 1.0)));
        std::vector<double> columns;
        for (int row = first; row <= last; ++row) {
            columns.clear();
            for (const PostRing& ring : rings) {
                for (std::size_t i = 0; i < ring.size(); ++i) {
                    const PostNumber &a = ring[i], &b = ring[(i + 1) % ring.size()];
                    if ((a.row <= row) == (b.row <= row)) continue;
                    columns.push_back(std::lerp(a.column, b.column, (row - a.row) / (b.row - a.row)));
                }
            }
            std::ranges::sort(columns);
            for (std::size_t i = 0; i + 1 < columns.size(); i += 2) posts(row, columns[i], columns[i + 1]);
        }
    }

    [[nodiscard]] std::optional<double> lowest() const { return lowest_; }

  private:
    void posts(int row, double from, double to) {
        const int first = static_cast<int>(std::ceil(std::max(from, 0.0))),
                  last = static_cast<int>(std::floor(std::min(to, field_.grid.columns() - 1.0)));
        for (int column = first; column <= last; ++column) {
            const float H_m = field_.H_at_post_m(row, column);
            if (!is_void(H_m)) take(static_cast<double>(H_m));
        }
    }
    void take(double H_m) { lowest_ = std::min(lowest_.value_or(H_m), H_m); }

    const HeightField& field_;
    std::optional<double> lowest_;
};

}  // namespace

std::optional<double> lowest_ground_H_m(const std::vector<std::vector<VectorPlace>>& rings,
                                        std::span<const HeightField* const> fields) {
    for (const HeightField* const field : fields) {
        std::vector<PostRing> at;
        for (const auto& ring : rings) {
            PostRing& posts = at.emplace_back();
            for (const VectorPlace& place : ring)
                posts.push_back(field->grid.post_at(place.lat_deg, place.lon_deg));
        }
        if (at.empty() || at.front().empty()) return std::nullopt;
        LowestOfField lowest(*field);
        for (const PostRing& ring : at)
            for (std::size_t i = 0; i < ring.size(); ++i) lowest.side(ring[i], ring[(i + 1) % ring.size()]);
        lowest.inside(at);
        if (lowest.lowest()) return lowest.lowest();
    }
    return std::nullopt;
}

}  // namespace oro
