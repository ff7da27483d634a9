#include "geo/posts/resampling_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/parallel.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/triangle_heights.h"

namespace oro {
namespace {

constexpr int part_side = 64;
// All of up to so many posts are compared; of more at least so many. Fewer where PROJ is asked for each.
constexpr double all_of_posts = 4.0e6, some_of_posts = 1.0e6;
constexpr double all_of_costly_posts = 1.0e5;

bool holds(const PostWindow& window, int row, int column) {
    return row >= window.row && row < window.row + window.rows && column >= window.column &&
           column < window.column + window.columns;
}

// The first number from `first` on that is a whole multiple of step.
int first_of(int first, int step) {
    return (first + step - 1) / step * step;
}

int count_of(int first, int end, int step) {
    return first >= end ? 0 : (end - first - 1) / step + 1;
}

// Parts of a window, as lattices of every step-th post of the file.
std::vector<PostLattice> parts_of(const PostWindow& window, int step) {
    std::vector<PostLattice> parts;
    const int row = first_of(window.row, step), column = first_of(window.column, step);
    const int rows = count_of(row, window.row + window.rows, step);
    const int columns = count_of(column, window.column + window.columns, step);
    for (int r = 0; r < rows; r += part_side) {
        for (int c = 0; c < columns; c += part_side)
            parts.push_back({row + r * step, column + c * step, std::min(part_side, rows - r),
                             std::min(part_side, columns - c), step});
    }
    return parts;
}

std::vector<PartRange> ranges_of(const PostBlock& block) {
    constexpr float none = std::numeric_limits<float>::infinity();
    std::vector<PartRange> ranges;
    for (const PostLattice& part : parts_of(block.window, 1)) {
        PartRange range{part, none, -none};
        for (int r = part.row; r < part.row + part.rows; ++r) {
            for (int c = part.column; c < part.column + part.columns; ++c) {
                const float height = block.at(r, c);
                if (is_void(height)) continue;
                range.lowest = std::min(range.lowest, height);
                range.highest = std::max(range.highest, height);
            }
        }
        if (range.lowest <= range.highest) ranges.push_back(range);
    }
    return ranges;
}

}  // namespace

ResamplingError::ResamplingError(const Source& source, const PostGrid& grid, const std::vector<float>& H_m,
                                 PostPlaces places)
    : grid_(&grid), H_m_(&H_m), places_(std::move(places)) {
    const double posts = static_cast<double>(source.report.rows) * source.report.columns;
    if (posts > all_of_posts) step_ = static_cast<int>(std::sqrt(posts / some_of_posts));
    if (!source.vertical_crs.empty() && posts > all_of_costly_posts) step_ = std::max(step_, 4);
}

Result<ResamplingError> ResamplingError::create(const Source& source, const PostGrid& grid,
                                                const std::vector<float>& H_m) {
    ORO_TRY(PostPlaces places, PostPlaces::create(source));
    return ResamplingError(source, grid, H_m, std::move(places));
}

void ResamplingError::begin(const GridRect& rect) {
    own_.push_back({rect, std::vector<bool>(static_cast<std::size_t>(rect.rows) *
                                            static_cast<std::size_t>(rect.columns))});
}

void ResamplingError::laid(int row, std::span<const float> heights, std::span<const float> beyond) {
    const GridRect& rect = own_.back().rect;
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_->columns()) +
                              static_cast<std::size_t>(rect.first_column);
    const std::size_t own =
        static_cast<std::size_t>(row - rect.first_row) * static_cast<std::size_t>(rect.columns);
    for (std::size_t c = 0; c < heights.size(); ++c) {
        own_.back().posts[own + c] = !is_void(heights[c]) && (*H_m_)[first + c] == heights[c];
        if (!is_void(beyond[c])) beyond_.push_back({row, rect.first_column + static_cast<int>(c), beyond[c]});
    }
}

bool ResamplingError::is_own(int row, int column) const {
    return std::ranges::any_of(own_, [&](const Own& own) {
        const GridRect& rect = own.rect;
        const int r = row - rect.first_row, c = column - rect.first_column;
        return r >= 0 && r < rect.rows && c >= 0 && c < rect.columns &&
               own.posts[static_cast<std::size_t>(r) * static_cast<std::size_t>(rect.columns) +
                         static_cast<std::size_t>(c)];
    });
}

bool ResamplingError::in_region(const LatLon& place) const {
    if (!(place.lat_deg >= grid_->south_deg() && place.lat_deg <= grid_->north_deg())) return false;
    const double column = grid_->column_at(place.lon_deg);
    return column >= -rim_slack_posts && column <= grid_->columns() - 1 + rim_slack_posts;
}

// Of a cell; nothing while posts that decide may still come.
std::optional<Diagonal> ResamplingError::diagonal_at(int row, int column, bool is_whole) const {
    const int rows = grid_->rows(), columns = grid_->columns(),
              turn = grid_->wraps_longitude() ? columns - 1 : 0;
    bool may_come = false;
    const Diagonal diagonal = diagonal_of(
        [&](int r, int c) {
            c = c < 0 ? c + turn : c >= columns ? c - turn : c;
            if (r < 0 || r >= rows || c < 0 || c >= columns) return no_decisive_steps;
            const float H_m = (*H_m_)[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                                      static_cast<std::size_t>(c)];
            // The rows at poles, and the first and last meridian round the Earth, are not yet as they will
            // be.
            may_come = may_come || is_void(H_m) || r == 0 || r == rows - 1 || c == 0 || c == columns - 1;
            return decisive_steps(H_m);
        },
        row, column);
    if (may_come && !is_whole) return std::nullopt;
    return diagonal;
}

// What the surface has at a place, as far as it is laid, or in the end.
ResamplingError::Shown ResamplingError::shown_at(const LatLon& place, bool is_whole) const {
    const int rows = grid_->rows(), columns = grid_->columns();
    double y = grid_->lat.index_at(place.lat_deg), x = grid_->lon.index_at(place.lon_deg);
    if (!(x >= 0.0 && x <= columns - 1)) x = grid_->column_at(place.lon_deg);
    if (!(y >= -rim_slack_posts && y <= rows - 1 + rim_slack_posts && x >= -rim_slack_posts &&
          x <= columns - 1 + rim_slack_posts))
        return {Ground::none, 0.0};
    y = std::clamp(y, 0.0, rows - 1.0);
    x = std::clamp(x, 0.0, columns - 1.0);
    const int row = std::min(static_cast<int>(y), rows - 2),
              column = std::min(static_cast<int>(x), columns - 2);
    // The rows at poles, and the first and last meridian of a region round the Earth, are not yet as they
    // will be.
    if (!is_whole && (row == 0 || row == rows - 2 || column == 0 || column == columns - 2))
        return {Ground::open, 0.0};
    const double down = y - row, right = x - column;
    struct Corner {
        int row, column;
        double share;
    };
    const std::optional<Diagonal> diagonal = diagonal_at(row, column, is_whole);
    if (!diagonal) return {Ground::open, 0.0};
    std::array corners{
        Corner{row, column, 1.0 - std::max(down, right)}, Corner{row + 1, column + 1, std::min(down, right)},
        Corner{down >= right ? row + 1 : row, down >= right ? column : column + 1, std::abs(down - right)}};
    if (*diagonal == Diagonal::sw_ne) {
        const bool west = down + right <= 1.0;
        corners = {Corner{row + 1, column, west ? down : 1.0 - right},
                   Corner{row, column + 1, west ? right : 1.0 - down},
                   Corner{west ? row : row + 1, west ? column : column + 1, std::abs(1.0 - down - right)}};
    }
    // A post on a post of the region needs no other.
    constexpr double no_share = 1e-9;
    Shown shown{Ground::own, 0.0};
    for (const Corner& corner : corners) {
        if (corner.share < no_share) continue;
        const float H_m = (*H_m_)[static_cast<std::size_t>(corner.row) * static_cast<std::size_t>(columns) +
                                  static_cast<std::size_t>(corner.column)];
        if (is_void(H_m)) return {Ground::open, 0.0};
        if (!is_own(corner.row, corner.column)) shown.ground = Ground::others;
        shown.H_m += corner.share * static_cast<double>(H_m);
    }
    return shown;
}

void ResamplingError::Tally::add(double own_H_m, double shown_H_m, const LatLon& place) {
    const double off_m = shown_H_m - own_H_m;
    ++compared;
    squares_m2 += off_m * off_m;
    if (worst && std::abs(off_m) <= std::abs(*worst->shown_H_m - worst->own_H_m)) return;
    worst = PostShown{place.lat_deg, place.lon_deg, own_H_m, shown_H_m};
}

void ResamplingError::Tally::add(const Tally& other) {
    compared += other.compared;
    hidden += other.hidden;
    squares_m2 += other.squares_m2;
    open.insert(open.end(), other.open.begin(), other.open.end());
    const auto size_m = [](const PostShown& post) { return std::abs(*post.shown_H_m - post.own_H_m); };
    if (other.worst && (!worst || size_m(*other.worst) > size_m(*worst))) worst = other.worst;
}

Result<ResamplingError::Tally> ResamplingError::compare_part(const PostBlock& block, const PostLattice& part,
                                                             const ToH& to_H) const {
    Tally tally;
    std::vector<LatLon> places;
    places_.of(part, places);
    for (int r = 0; r < part.rows; ++r) {
        for (int c = 0; c < part.columns; ++c) {
            const int row = part.row + r * part.step, column = part.column + c * part.step;
            float height = block.at(row, column);
            const LatLon& place =
                places[static_cast<std::size_t>(r) * static_cast<std::size_t>(part.columns) +
                       static_cast<std::size_t>(c)];
            if (is_void(height) || std::isnan(place.lat_deg)) continue;
            if (std::ranges::any_of(seen_, [&](const PostWindow& one) { return holds(one, row, column); }))
                continue;
            const Shown shown = shown_at(place, false);
            if (shown.ground == Ground::none) continue;
            if (to_H) ORO_CHECK(to_H(place.lat_deg, {&place.lon_deg, 1}, {&height, 1}));
            if (shown.ground == Ground::open) tally.open.push_back({place, height});
            if (shown.ground == Ground::others) ++tally.hidden;
            if (shown.ground == Ground::own) tally.add(static_cast<double>(height), shown.H_m, place);
        }
    }
    return tally;
}

// The highest post in the region, or (sign -1) the lowest: part by part, from the one with the highest post
// on, until no other part has a higher one.
Result<void> ResamplingError::find_extreme(const PostBlock& block, const std::vector<PartRange>& ranges,
                                           float upwards, const ToH& to_H,
                                           std::optional<OwnPost>& found) const {
    struct Part {
        float highest;
        PostLattice posts;
    };
    std::vector<Part> parts;
    for (const PartRange& range : ranges)
        parts.push_back({upwards > 0.0F ? range.highest : -range.lowest, range.posts});
    std::ranges::stable_sort(parts, std::ranges::greater{}, &Part::highest);
    std::optional<float> best;
    OwnPost at{};
    for (const Part& part : parts) {
        if (best && part.highest <= *best) break;
        std::vector<LatLon> places;
        places_.of(part.posts, places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto columns = static_cast<std::size_t>(part.posts.columns);
            const float height = block.at(part.posts.row + static_cast<int>(i / columns),
                                          part.posts.column + static_cast<int>(i % columns));
            if (is_void(height) || (best && upwards * height <= *best) || !in_region(places[i])) continue;
            best = upwards * height;
            at = {places[i], height};
        }
    }
    if (!best) return {};
    if (to_H) ORO_CHECK(to_H(at.place.lat_deg, {&at.place.lon_deg, 1}, {&at.H_m, 1}));
    if (!found || upwards * at.H_m > upwards * found->H_m) found = at;
    return {};
}

// Posts with a height that no block before had.
std::uint64_t ResamplingError::new_posts(const PostBlock& block) const {
    const PostWindow& w = block.window;
    const auto all = static_cast<std::uint64_t>(w.rows) * static_cast<std::uint64_t>(w.columns);
    if (seen_.empty()) return all - block.voids;
    std::uint64_t posts = 0;
    for (int r = w.row; r < w.row + w.rows; ++r) {
        for (int c = w.column; c < w.column + w.columns; ++c)
            posts += !is_void(block.at(r, c)) &&
                     std::ranges::none_of(seen_, [&](const PostWindow& one) { return holds(one, r, c); });
    }
    return posts;
}

Result<void> ResamplingError::compare(const PostBlock& block, const ToH& to_H) {
    if (block.window.rows <= 0 || block.window.columns <= 0) return {};
    posts_ += new_posts(block);
    const std::vector<PostLattice> parts = parts_of(block.window, step_);
    std::vector<Result<Tally>> tallies(parts.size(), Tally{});
    // The way to H remembers where it was asked last: not from several threads.
    in_parallel(static_cast<int>(parts.size()), to_H ? 1 : thread_count(), [&](int i) {
        const auto part = static_cast<std::size_t>(i);
        tallies[part] = compare_part(block, parts[part], to_H);
    });
    for (const Result<Tally>& tally : tallies) {
        if (!tally.ok()) return tally.error();
        so_far_.add(*tally);
    }
    const std::vector<PartRange> ranges = ranges_of(block);
    ORO_CHECK(find_extreme(block, ranges, 1.0F, to_H, highest_));
    ORO_CHECK(find_extreme(block, ranges, -1.0F, to_H, lowest_));
    seen_.push_back(block.window);
    return {};
}

std::optional<PostShown> ResamplingError::compared_post(const std::optional<OwnPost>& post) const {
    if (!post) return std::nullopt;
    PostShown both{post->place.lat_deg, post->place.lon_deg, static_cast<double>(post->H_m), {}};
    const Shown shown = shown_at(post->place, true);
    if (shown.ground == Ground::own || shown.ground == Ground::others) both.shown_H_m = shown.H_m;
    return both;
}

// Heights beyond rims count as this source's where they were taken.
void ResamplingError::take_beyond() {
    for (const Beyond& beyond : beyond_) {
        const std::size_t post =
            static_cast<std::size_t>(beyond.row) * static_cast<std::size_t>(grid_->columns()) +
            static_cast<std::size_t>(beyond.column);
        if ((*H_m_)[post] != beyond.H_m) continue;
        for (Own& own : own_) {
            const int r = beyond.row - own.rect.first_row, c = beyond.column - own.rect.first_column;
            if (r < 0 || r >= own.rect.rows || c < 0 || c >= own.rect.columns) continue;
            own.posts[static_cast<std::size_t>(r) * static_cast<std::size_t>(own.rect.columns) +
                      static_cast<std::size_t>(c)] = true;
        }
    }
    beyond_ = {};
}

Resampling ResamplingError::finish() {
    take_beyond();
    Resampling found;
    found.posts = posts_;
    Tally all = std::move(so_far_);
    const auto look_again = [&](const OwnPost& post) {
        const Shown shown = shown_at(post.place, true);
        if (shown.ground == Ground::own) all.add(static_cast<double>(post.H_m), shown.H_m, post.place);
        return shown.ground;
    };
    for (const OwnPost& post : std::exchange(all.open, {})) {
        const Ground ground = look_again(post);
        all.hidden += ground == Ground::others ? 1 : 0;
        found.unshown += ground == Ground::open ? 1 : 0;
    }
    found.highest = compared_post(highest_);
    found.lowest = compared_post(lowest_);
    // Among every step-th post they are only by chance.
    for (const auto& post : {highest_, lowest_})
        if (step_ > 1 && post) look_again(*post);
    found.compared = all.compared;
    found.hidden = all.hidden;
    found.worst = all.worst;
    if (found.compared > 0) found.rms_m = std::sqrt(all.squares_m2 / static_cast<double>(found.compared));
    own_ = {};
    return found;
}

}  // namespace oro
