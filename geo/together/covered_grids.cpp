#include "geo/together/covered_grids.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "geo/region/region_fingerprints.h"
#include "geo/sources/notes.h"

namespace oro {
namespace {

// So many posts of the grid above a rim must lie inside that grid's own. Where rims coincide pieces of ground are
// left along them, so that such grids stay.
constexpr double same_rim_posts = 1.0e-7;
// So many posts inside lie the posts of a rim that is straight in another CRS: it bends less between them.
constexpr double bent_rim_posts = 0.5;

bool box_within(const PostGrid& inner, const PostGrid& outer) {
    const double lat_inset_deg = outer.net ? 1.0e-9 : same_rim_posts * outer.lat.spacing_deg();
    const double lon_inset_deg = outer.net ? 1.0e-9 : same_rim_posts * outer.lon.spacing_deg();
    if (inner.north_deg() > outer.north_deg() - lat_inset_deg ||
        inner.south_deg() < outer.south_deg() + lat_inset_deg)
        return false;
    if (outer.wraps_longitude()) return true;
    return std::ranges::any_of(std::array{-360.0, 0.0, 360.0}, [&](double turn_deg) {
        return inner.west_deg() + turn_deg >= outer.west_deg() + lon_inset_deg &&
               inner.east_deg() + turn_deg <= outer.east_deg() - lon_inset_deg;
    });
}

bool post_is_inside(const PostGrid& inner, const PostGrid& outer, int row, int column) {
    const PostPlace place = inner.place_at(row, column);
    const PostNumber at = outer.post_at(place.lat_deg, place.lon_deg);
    const auto within = [](double number, int posts) {
        return number >= bent_rim_posts && number <= posts - 1 - bent_rim_posts;
    };
    return within(at.row, outer.rows()) && (outer.wraps_longitude() || within(at.column, outer.columns()));
}

bool rim_is_inside(const PostGrid& inner, const PostGrid& outer) {
    const int last_row = inner.rows() - 1, last_column = inner.columns() - 1;
    for (const int row : {0, last_row})
        for (int column = 0; column <= last_column; ++column)
            if (!post_is_inside(inner, outer, row, column)) return false;
    for (const int column : {0, last_column})
        for (int row = 0; row <= last_row; ++row)
            if (!post_is_inside(inner, outer, row, column)) return false;
    return true;
}

struct GridToCover {
    const RegionGrid* grid;
    std::uint64_t print;  // of where its posts lie
};

// Whether the ground of one grid is all under that of another, which wins.
bool is_under(const GridToCover& one, const GridToCover& above) {
    const PostGrid &inner = one.grid->field.grid, &outer = above.grid->field.grid;
    if (one.print == above.print) {
        const bool same_posts = one.grid->posts_hash && one.grid->posts_hash == above.grid->posts_hash;
        return above.grid->voids == 0 || same_posts;
    }
    if (above.grid->voids > 0 || !box_within(inner, outer)) return false;
    return (!inner.net && !outer.net) || rim_is_inside(inner, outer);
}

std::string note_of_covered(std::size_t covered) {
    return covered == 1
               ? "1 grid of posts lies wholly under another one, and is left out"
               : std::to_string(covered) + " grids of posts lie wholly under others, and are left out";
}

}  // namespace

void leave_covered_grids_out(Region& region) {
    std::vector<RegionGrid>& grids = region.grids;
    std::vector<std::size_t> by_rank(grids.size());
    std::iota(by_rank.begin(), by_rank.end(), std::size_t{0});
    std::ranges::stable_sort(by_rank, {}, [&](std::size_t number) { return grids[number].rank; });
    std::vector<GridToCover> seen;
    std::vector<char> covered(grids.size());
    for (const std::size_t number : by_rank) {
        const GridToCover one{&grids[number], grid_fingerprint(grids[number].field.grid)};
        // Grids of one rank have no order, and do not cover each other.
        const bool is_covered = std::ranges::any_of(seen, [&](const GridToCover& above) {
            return above.grid->rank < one.grid->rank && is_under(one, above);
        });
        covered[number] = is_covered ? 1 : 0;
        if (!is_covered) seen.push_back(one);
    }
    std::vector<RegionGrid> left;
    std::vector<std::string> notes;
    for (std::size_t number = 0; number < grids.size(); ++number) {
        if (covered[number] == 0)
            left.push_back(std::move(grids[number]));
        else
            std::ranges::move(grids[number].notes, std::back_inserter(notes));
    }
    if (const std::size_t gone = grids.size() - left.size(); gone > 0) notes.push_back(note_of_covered(gone));
    grids = std::move(left);
    for (const std::string& note : notes) add_note(grids.front().notes, note);
}

}  // namespace oro
