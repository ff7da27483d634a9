#include "core/lod/ground_means.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/packing.hpp>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/level_grid.h"

namespace oro {

namespace {

// Ground is shaded from slopes that are smooth at and between posts. What squares of several posts know of
// their spread is of such slopes: those of the posts beside weigh half by Horn's formula, more for what is
// between posts. By trial. Source: B. K. P. Horn, Hill shading and the reflectance map, Proceedings of the
// IEEE 69(1), 1981.
constexpr float neighbour_weight = 0.8F;

constexpr int band_levels = 5;  // that a band of rows makes of its own posts

// As std::lround(), which is a call: of what a float holds with its halves.
std::int32_t rounded(float value) {
    const auto whole = static_cast<std::int32_t>(value);
    const float rest = value - static_cast<float>(whole);
    return whole + (rest >= 0.5F ? 1 : 0) - (rest <= -0.5F ? 1 : 0);
}

// How the ground rises at a row's posts, from their three rows, by loops without a branch: down, to the
// south, and right, to the east, in steps over two spacings and the weights of them all. `unknown`: posts
// that are void, or beside one.
struct RowSlopes {
    std::vector<float> down, right;
    std::vector<std::int32_t> unknown;
};

float rise_between(std::int32_t before, std::int32_t after) {
    // Where one is void the number does not count, but has to be one.
    return 0.5F * static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(after) -
                                                               static_cast<std::uint32_t>(before)));
}

// Of `count` posts with one before and one after them, put from number `at` on.
void measure_slopes(const std::int32_t* north, const std::int32_t* here, const std::int32_t* south, int count,
                    float weight, int at, RowSlopes& slopes) {
    float* const down = slopes.down.data() + at;
    float* const right = slopes.right.data() + at;
    std::int32_t* const unknown = slopes.unknown.data() + at;
    const auto is_none = [](std::int32_t steps) {
        return static_cast<std::int32_t>(steps == void_height_steps);
    };
    for (int c = 0; c < count; ++c) {
        float rise = rise_between(north[c], south[c]);
        rise += weight * rise_between(north[c - 1], south[c - 1]);
        rise += weight * rise_between(north[c + 1], south[c + 1]);
        down[c] = rise;
    }
    for (int c = 0; c < count; ++c) {
        float rise = rise_between(here[c - 1], here[c + 1]);
        rise += weight * rise_between(north[c - 1], north[c + 1]);
        rise += weight * rise_between(south[c - 1], south[c + 1]);
        right[c] = rise;
    }
    for (int c = 0; c < count; ++c)
        unknown[c] = is_none(north[c - 1]) | is_none(north[c]) | is_none(north[c + 1]) |
                     is_none(here[c - 1]) | is_none(here[c]) | is_none(here[c + 1]) | is_none(south[c - 1]) |
                     is_none(south[c]) | is_none(south[c + 1]);
}

// All bits, or none. (By masks: of a choice GCC 12 makes no vector code.)
std::uint32_t where(bool holds) {
    return static_cast<std::uint32_t>(-static_cast<std::int32_t>(holds));
}

// A number as glm::packHalf2x16() packs it, without a branch: to the nearest, halves away from 0. Within what
// a half can hold.
std::uint32_t half_of(float value) {
    constexpr std::uint32_t least_normal = 0x38800000U;  // 2^-14
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16U & 0x8000U, size = bits & 0x7fffffffU;
    const auto small =
        static_cast<std::uint32_t>(rounded(std::min(std::bit_cast<float>(size) * 16777216.0F, 2048.0F)));
    const std::uint32_t normal = ((size + 0x1000U) >> 13U) - (112U << 10U);
    const std::uint32_t is_small = where(size < least_normal);
    return sign | (small & is_small) | (normal & ~is_small);
}

// Columns of sums of squares, number by number.
struct SumColumns {
    const float *x, *y, *z, *xx, *xy, *yy, *h_m, *hh_m2, *posts;
};

}  // namespace

// What GroundMeans::packed() gives of each of `count` squares, bit by bit.
ORO_WIDE void pack_normals(const SumColumns& sums, std::size_t count, std::uint32_t* normals,
                           std::uint32_t* spreads) {
    for (std::size_t i = 0; i < count; ++i) {
        const float all = sums.posts[i], posts = all + static_cast<float>(all == 0.0F);
        const std::uint32_t is_any = where(all != 0.0F);
        const float x = sums.x[i] / posts, y = sums.y[i] / posts;
        const auto east = static_cast<std::uint32_t>(rounded(x * gpu::means_normal_steps)),
                   north = static_cast<std::uint32_t>(rounded(y * gpu::means_normal_steps));
        const std::int32_t up = rounded(sums.z[i] / posts * gpu::means_normal_steps);
        const std::uint32_t normal =
            (east & 0x7ffU) | (north & 0x7ffU) << 11U | static_cast<std::uint32_t>(up > 1 ? up : 1) << 22U;
        const float squared_x = sums.xx[i] / posts - x * x, squared_y = sums.yy[i] / posts - y * y;
        const float along_x = std::sqrt(squared_x > 0.0F ? squared_x : 0.0F),
                    along_y = std::sqrt(squared_y > 0.0F ? squared_y : 0.0F), both = along_x * along_y;
        const float found = (sums.xy[i] / posts - x * y) / (both + static_cast<float>(!(both > 1.0e-6F)));
        const float correlation =
            std::bit_cast<float>(std::bit_cast<std::uint32_t>(found) & where(both > 1.0e-6F));
        const float most_x = along_x < 1.0F ? along_x : 1.0F, most_y = along_y < 1.0F ? along_y : 1.0F;
        const float above = correlation > -1.0F ? correlation : -1.0F, most = above < 1.0F ? above : 1.0F;
        const std::uint32_t spread =
            static_cast<std::uint32_t>(rounded(most_x * gpu::means_spread_steps)) |
            static_cast<std::uint32_t>(rounded(most_y * gpu::means_spread_steps)) << 11U |
            static_cast<std::uint32_t>(rounded(most * gpu::means_correlation_steps)) << 22U;
        normals[i] = normal & is_any;
        spreads[i] = spread & is_any;
    }
}
ORO_WIDE void pack_heights(const SumColumns& sums, std::size_t count, std::uint32_t* heights) {
    constexpr float most_m = 65000.0F;  // of a half
    for (std::size_t i = 0; i < count; ++i) {
        const float all = sums.posts[i], posts = all + static_cast<float>(all == 0.0F);
        const std::uint32_t is_any = where(all != 0.0F);
        const float h_m = sums.h_m[i] / posts, squared = sums.hh_m2[i] / posts - h_m * h_m;
        const float spread_m = std::sqrt(squared > 0.0F ? squared : 0.0F);
        const float above = h_m > -most_m ? h_m : -most_m;
        const std::uint32_t height =
            half_of(above < most_m ? above : most_m) | half_of(spread_m < most_m ? spread_m : most_m) << 16U;
        heights[i] = height & is_any;
    }
}
// Sums of neighbours of a row, two and two, in the order in which GroundMeans::Sums are added; then, where
// there is another row, of its.
ORO_WIDE void add_pairs(const float* upper, const float* lower, std::size_t count, float* sums) {
    for (std::size_t i = 0; i < count; ++i) sums[i] = 0.0F + upper[2 * i] + upper[2 * i + 1];
    for (std::size_t i = 0; lower != nullptr && i < count; ++i)
        sums[i] = sums[i] + lower[2 * i] + lower[2 * i + 1];
}

// Sums over the posts of a square.
struct GroundMeans::Sums {
    float x{}, y{}, z{};     // of unit normals: east, north, up
    float xx{}, xy{}, yy{};  // of their products
    float h_m{};
    float hh_m2{};
    float posts{};

    void add(const Sums& other) {
        x += other.x;
        y += other.y;
        z += other.z;
        xx += other.xx;
        xy += other.xy;
        yy += other.yy;
        h_m += other.h_m;
        hh_m2 += other.hh_m2;
        posts += other.posts;
    }
};

// The sums of some posts of a row, number by number, and one post more that has none.
struct GroundMeans::PostRow {
    explicit PostRow(int columns) {
        const std::size_t count = static_cast<std::size_t>(columns) + 1;
        for (std::vector<float>* const part : {&x, &y, &z, &xx, &xy, &yy, &h_m, &hh_m2, &posts})
            part->assign(count, 0.0F);
        slopes.down.assign(count, 0.0F);
        slopes.right.assign(count, 0.0F);
        slopes.unknown.assign(count, 1);
    }
    void put(int column, const Sums& sums) {
        const auto at = static_cast<std::size_t>(column);
        x[at] = sums.x;
        y[at] = sums.y;
        z[at] = sums.z;
        xx[at] = sums.xx;
        xy[at] = sums.xy;
        yy[at] = sums.yy;
        h_m[at] = sums.h_m;
        hh_m2[at] = sums.hh_m2;
        posts[at] = sums.posts;
    }
    [[nodiscard]] Sums at(int column) const {
        const auto i = static_cast<std::size_t>(column);
        return {x[i], y[i], z[i], xx[i], xy[i], yy[i], h_m[i], hh_m2[i], posts[i]};
    }
    std::vector<float> x, y, z, xx, xy, yy, h_m, hh_m2, posts;
    RowSlopes slopes;
    // The squares of two rows of posts; lower: null where there is none.
    void add_rows(const PostRow& upper, const PostRow* lower, std::size_t count);
    // The first of them, packed.
    void pack(std::size_t count, gpu::MeansSquare* squares) const;

    // Of `count` posts from column `first` on, put from number `at` on, none of them at the region's rim:
    // what GroundMeans::post() gives of each, bit by bit, where neither it nor one beside it is void.
    void measure(const GroundMeans& means, int row, int first, int count, int at, float weight);
};

void GroundMeans::PostRow::measure(const GroundMeans& means, int row, int first, int count, int at,
                                   float weight) {
    const std::int32_t* const here = means.heights_.row(row) + first;
    measure_slopes(means.heights_.row(row - 1) + first, here, means.heights_.row(row + 1) + first, count,
                   weight, at, slopes);
    const RowScale& scale = means.rows_[static_cast<std::size_t>(row)];
    const float whole = 1.0F + weight + weight;
    const float down_per_step = scale.down_per_m / whole, right_per_step = scale.right_per_m / whole;
    const float* const downs = slopes.down.data() + at;
    const float* const rights = slopes.right.data() + at;
    float *const to_x = x.data() + at, *const to_y = y.data() + at, *const to_z = z.data() + at;
    for (int c = 0; c < count; ++c) {
        const float down = downs[c] * down_per_step, right = rights[c] * right_per_step;
        const float length = std::sqrt(down * down + right * right + 1.0F);
        to_x[c] = -right / length;
        to_y[c] = down / length;
        to_z[c] = 1.0F / length;
    }
    float *const to_xx = xx.data() + at, *const to_xy = xy.data() + at, *const to_yy = yy.data() + at;
    for (int c = 0; c < count; ++c) {
        to_xx[c] = to_x[c] * to_x[c];
        to_xy[c] = to_x[c] * to_y[c];
        to_yy[c] = to_y[c] * to_y[c];
    }
    const auto step_m = static_cast<float>(height_step_m);
    const float exaggeration = means.exaggeration_;
    float *const to_h_m = h_m.data() + at, *const to_hh_m2 = hh_m2.data() + at;
    for (int c = 0; c < count; ++c) {
        to_h_m[c] = static_cast<float>(here[c]) * step_m / exaggeration;
        to_hh_m2[c] = to_h_m[c] * to_h_m[c];
    }
    std::fill_n(posts.data() + at, count, 1.0F);
}

void GroundMeans::PostRow::add_rows(const PostRow& upper, const PostRow* lower, std::size_t count) {
    for (const auto part : {&PostRow::x, &PostRow::y, &PostRow::z, &PostRow::xx, &PostRow::xy, &PostRow::yy,
                            &PostRow::h_m, &PostRow::hh_m2, &PostRow::posts})
        add_pairs((upper.*part).data(), lower == nullptr ? nullptr : (lower->*part).data(), count,
                  (this->*part).data());
}

void GroundMeans::PostRow::pack(std::size_t count, gpu::MeansSquare* squares) const {
    std::array<std::uint32_t, gpu::means_stride> normals, heights, spreads;
    assert(count <= normals.size());
    const SumColumns sums{x.data(),  y.data(),   z.data(),     xx.data(),   xy.data(),
                          yy.data(), h_m.data(), hh_m2.data(), posts.data()};
    pack_normals(sums, count, normals.data(), spreads.data());
    pack_heights(sums, count, heights.data());
    for (std::size_t i = 0; i < count; ++i) squares[i] = {normals[i], heights[i], spreads[i]};
}

// How squares come of posts: in bands of rows, from the finest level on.
struct GroundMeans::Bands {
    GroundMeans& means;

    void add_levels(int threads);

  private:
    // The posts of a row from one column on: by vector code where that can be.
    static void put_row(const GroundMeans& means, int row, int first, int count, float weight,
                        PostRow& posts);
    friend class GroundMeans;
    static Sums of_posts(int row, int column, const GroundMeans& means, const PostRow& upper,
                         const PostRow& lower);
    static void put_page_of_posts(const GroundMeans& means, const PageIndex& index, gpu::PageMeans& page);
    template <class Square>
    static Sums of_squares(int row, int column, const Level& finer, const Square& square);
    void add_band(int band, int top, std::vector<Sums>& sums_of_top);
    void add_level(int number, std::vector<Sums>& below);
};

void GroundMeans::Bands::put_row(const GroundMeans& means, int row, int first, int count, float weight,
                                 PostRow& posts) {
    const PostGrid& grid = means.grid_;
    const bool has_rows = !grid.net && row > 0 && row + 1 < grid.rows();
    // Those with a post on each side.
    const int from = std::max(first, 1), to = std::min(first + count, grid.columns() - 1);
    if (has_rows && to > from) posts.measure(means, row, from, to - from, from - first, weight);
    for (int i = 0; i < count; ++i) {
        const bool is_known = has_rows && first + i >= from && first + i < to &&
                              posts.slopes.unknown[static_cast<std::size_t>(i)] == 0;
        if (!is_known) posts.put(i, means.post(row, first + i, weight));
    }
    posts.put(count, {});
}
void GroundMeans::Bands::add_levels(int threads) {
    const int last = static_cast<int>(means.levels_.size()) - 1, top = std::min(band_levels, last);
    if (top == 0) return;
    const Level& of_top = means.levels_[static_cast<std::size_t>(top)];
    std::vector<Sums> below(static_cast<std::size_t>(of_top.rows) * static_cast<std::size_t>(of_top.columns));
    in_parallel(of_top.rows, threads, [&](int band) { add_band(band, top, below); });
    for (int level = top + 1; level <= last; ++level) add_level(level, below);
}

// Four posts make a square of level 1.
GroundMeans::Sums GroundMeans::Bands::of_posts(int row, int column, const GroundMeans& means,
                                               const PostRow& upper, const PostRow& lower) {
    Sums sums;
    sums.add(upper.at(2 * column));
    sums.add(upper.at(2 * column + 1));
    if (2 * row + 1 >= means.grid_.rows()) return sums;
    sums.add(lower.at(2 * column));
    sums.add(lower.at(2 * column + 1));
    return sums;
}

// Four squares of the level below make one.
template <class Square>
GroundMeans::Sums GroundMeans::Bands::of_squares(int row, int column, const Level& finer,
                                                 const Square& square) {
    Sums sums;
    for (int part = 0; part < 4; ++part) {
        const int of_row = 2 * row + part / 2, of_column = 2 * column + part % 2;
        if (of_row < finer.rows && of_column < finer.columns) sums.add(square(of_row, of_column));
    }
    return sums;
}

// The squares over 2^top rows of posts, of level 1 to `top`, of which there is one row.
void GroundMeans::Bands::add_band(int band, int top, std::vector<Sums>& sums_of_top) {
    std::vector<Sums> below, sums;
    const int posts = means.levels_.front().columns;
    PostRow upper(posts), lower(posts);
    for (int number = 1; number <= top; ++number) {
        Level& level = means.levels_[static_cast<std::size_t>(number)];
        const Level& finer = means.levels_[static_cast<std::size_t>(number) - 1];
        const int first = band << (top - number);
        const int rows = std::min(1 << (top - number), level.rows - first);
        const auto columns = static_cast<std::size_t>(level.columns);
        sums.resize(static_cast<std::size_t>(rows) * columns);
        const auto of_band = [&](int row, int column) -> const Sums& {
            return below[static_cast<std::size_t>(row - 2 * first) * static_cast<std::size_t>(finer.columns) +
                         static_cast<std::size_t>(column)];
        };
        for (int row = first; row < first + rows; ++row) {
            if (number == 1) {
                put_row(means, 2 * row, 0, posts, neighbour_weight, upper);
                if (2 * row + 1 < means.grid_.rows())
                    put_row(means, 2 * row + 1, 0, posts, neighbour_weight, lower);
            }
            Sums* const to = sums.data() + static_cast<std::size_t>(row - first) * columns;
            for (int column = 0; column < level.columns; ++column)
                to[column] = number == 1 ? of_posts(row, column, means, upper, lower)
                                         : of_squares(row, column, finer, of_band);
            if (number < means.first_kept_) continue;
            gpu::MeansSquare* const squares = level.squares.data() + static_cast<std::size_t>(row) * columns;
            for (int column = 0; column < level.columns; ++column) squares[column] = packed(to[column]);
        }
        std::swap(below, sums);
    }
    std::ranges::copy(below, sums_of_top.begin() +
                                 static_cast<std::ptrdiff_t>(static_cast<std::size_t>(band) * below.size()));
}

// A level above those of bands, from the sums of the one below it, which then are its own.
void GroundMeans::Bands::add_level(int number, std::vector<Sums>& below) {
    Level& level = means.levels_[static_cast<std::size_t>(number)];
    const Level& finer = means.levels_[static_cast<std::size_t>(number) - 1];
    std::vector<Sums> sums(level.squares.size());
    for (int row = 0; row < level.rows; ++row)
        for (int column = 0; column < level.columns; ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                                   static_cast<std::size_t>(column);
            sums[at] = of_squares(row, column, finer, [&](int of_row, int of_column) -> const Sums& {
                return below[static_cast<std::size_t>(of_row) * static_cast<std::size_t>(finer.columns) +
                             static_cast<std::size_t>(of_column)];
            });
            level.squares[at] = packed(sums[at]);
        }
    below = std::move(sums);
}

GroundMeans::GroundMeans(const PostGrid& grid, const DrawnHeights& heights, double exaggeration, int threads)
    : grid_(grid),
      heights_(heights),
      exaggeration_(static_cast<float>(exaggeration)),
      wraps_longitude_(grid.wraps_longitude()),
      first_kept_(wraps_longitude_ ? 1 : 2) {
    for (int row = 0; !grid.net && row < grid.rows(); ++row) {
        const double lat_deg = row_lat_deg(grid, row);
        const double down_m = meridian_radius_m(lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad;
        const double right_m = prime_vertical_radius_m(lat_deg) * std::abs(sine_cosine_deg(lat_deg).cosine) *
                               radians_from_deg(grid.lon.spacing_deg()).rad;
        rows_.push_back({static_cast<float>(height_step_m / down_m),
                         static_cast<float>(height_step_m / std::max(right_m, 1.0e-3))});
    }
    if (grid.net) measure_net();
    levels_.push_back({grid.rows(), wraps_longitude_ ? grid.columns() - 1 : grid.columns(), {}});
    for (int level = 1; level < level_count(grid); ++level) {
        const int rows = (levels_.back().rows + 1) / 2, columns = (levels_.back().columns + 1) / 2;
        levels_.push_back({rows, columns, {}});
        if (level < first_kept_) continue;
        levels_.back().squares.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    }
    Bands{*this}.add_levels(threads);
}

void GroundMeans::measure_net() {
    net_columns_ = (grid_.columns() + scale_posts - 2) / scale_posts + 1;
    const int rows = (grid_.rows() + scale_posts - 2) / scale_posts + 1;
    for (int i = 0; i < rows * net_columns_; ++i) {
        const LatticeGeoreference::LatticeFrame local_frame =
            grid_.net->local_frame_at(i / net_columns_ * scale_posts, i % net_columns_ * scale_posts);
        net_scales_.push_back({static_cast<float>(height_step_m / local_frame.row_m),
                               static_cast<float>(height_step_m / local_frame.column_m),
                               static_cast<float>(std::cos(local_frame.turn_rad)),
                               static_cast<float>(std::sin(local_frame.turn_rad))});
    }
}

GroundMeans::NetScale GroundMeans::scale_on_net(int row, int column) const {
    const float down = static_cast<float>(row % scale_posts) / scale_posts,
                right = static_cast<float>(column % scale_posts) / scale_posts;
    const NetScale* const north =
        net_scales_.data() + row / scale_posts * net_columns_ + column / scale_posts;
    const int on = column % scale_posts == 0 ? 0 : 1, below = row % scale_posts == 0 ? 0 : net_columns_;
    const auto mixed = [&](float NetScale::*part) {
        const float upper = north[0].*part + right * (north[on].*part - north[0].*part);
        const float lower = north[below].*part + right * (north[below + on].*part - north[below].*part);
        return upper + down * (lower - upper);
    };
    return {mixed(&NetScale::down_per_m), mixed(&NetScale::right_per_m), mixed(&NetScale::turn_cosine),
            mixed(&NetScale::turn_sine)};
}

std::int32_t GroundMeans::steps(int row, int column) const {
    if (row < 0 || row >= grid_.rows()) return void_height_steps;
    if (wraps_longitude_) column = (column + grid_.columns() - 1) % (grid_.columns() - 1);
    if (column < 0 || column >= grid_.columns()) return void_height_steps;
    return heights_.at(row, column);
}

// From the post before to the one after, in steps: rows apart or columns apart. The post itself must not be
// void.
float GroundMeans::rise(int row, int column, int rows, int columns) const {
    const std::int32_t here = steps(row, column), before = steps(row - rows, column - columns),
                       after = steps(row + rows, column + columns);
    const bool no_before = before == void_height_steps, no_after = after == void_height_steps;
    const float whole = static_cast<float>((no_after ? here : after) - (no_before ? here : before));
    return no_before == no_after ? 0.5F * whole : whole;
}

GroundMeans::Sums GroundMeans::post(int row, int column, float neighbour_share) const {
    const std::int32_t here = steps(row, column);
    if (here == void_height_steps) return {};
    float down = rise(row, column, 1, 0), right = rise(row, column, 0, 1), down_whole = 1.0F,
          right_whole = 1.0F;
    for (int side = -1; neighbour_share > 0.0F && side <= 1; side += 2) {
        if (steps(row, column + side) != void_height_steps) {
            down += neighbour_share * rise(row, column + side, 1, 0);
            down_whole += neighbour_share;
        }
        if (steps(row + side, column) != void_height_steps) {
            right += neighbour_share * rise(row + side, column, 0, 1);
            right_whole += neighbour_share;
        }
    }
    if (grid_.net) {
        // Rows and columns are turned from south and east.
        const NetScale scale = scale_on_net(row, column);
        const float along = right * scale.right_per_m / right_whole,
                    back = down * scale.down_per_m / down_whole;
        right = along * scale.turn_cosine + back * scale.turn_sine;
        down = back * scale.turn_cosine - along * scale.turn_sine;
    } else {
        const RowScale& scale = rows_[static_cast<std::size_t>(row)];
        down *= scale.down_per_m / down_whole;
        right *= scale.right_per_m / right_whole;
    }
    const float length = std::sqrt(down * down + right * right + 1.0F);
    const float h_m = static_cast<float>(here) * static_cast<float>(height_step_m) / exaggeration_;
    const float x = -right / length, y = down / length;
    return {x, y, 1.0F / length, x * x, x * y, y * y, h_m, h_m * h_m, 1.0F};
}

// See shaders/shared.h, PageMeans.
gpu::MeansSquare GroundMeans::packed(const Sums& sums) {
    if (sums.posts == 0.0F) return {};
    const auto part = [&](float sum) { return rounded(sum / sums.posts * gpu::means_normal_steps); };
    const auto x = static_cast<std::uint32_t>(part(sums.x)), y = static_cast<std::uint32_t>(part(sums.y));
    const auto z = static_cast<std::uint32_t>(std::max(part(sums.z), 1));
    const float h_m = sums.h_m / sums.posts;
    const float spread_m = std::sqrt(std::max(0.0F, sums.hh_m2 / sums.posts - h_m * h_m));
    constexpr float most_m = 65000.0F;  // of a half
    return {(x & 0x7ffU) | (y & 0x7ffU) << 11U | z << 22U,
            glm::packHalf2x16({std::clamp(h_m, -most_m, most_m), std::min(spread_m, most_m)}),
            packed_spread(sums)};
}

std::uint32_t GroundMeans::packed_spread(const Sums& sums) {
    const float x = sums.x / sums.posts, y = sums.y / sums.posts;
    const float along_x = std::sqrt(std::max(0.0F, sums.xx / sums.posts - x * x));
    const float along_y = std::sqrt(std::max(0.0F, sums.yy / sums.posts - y * y));
    const float both = along_x * along_y;
    const float correlation = both > 1.0e-6F ? (sums.xy / sums.posts - x * y) / both : 0.0F;
    const auto steps = [](float part, float count) { return rounded(std::clamp(part, -1.0F, 1.0F) * count); };
    return static_cast<std::uint32_t>(steps(along_x, gpu::means_spread_steps)) |
           static_cast<std::uint32_t>(steps(along_y, gpu::means_spread_steps)) << 11U |
           static_cast<std::uint32_t>(steps(correlation, gpu::means_correlation_steps)) << 22U;
}

std::size_t GroundMeans::kept_squares() const {
    std::size_t count = 0;
    for (const Level& level : levels_) count += level.squares.size();
    return count;
}

// A page of level 0 or 1, of a region that does not go round the Earth, from its posts. Single posts are
// sharper than those that squares are made of.
void GroundMeans::Bands::put_page_of_posts(const GroundMeans& means, const PageIndex& index,
                                           gpu::PageMeans& page) {
    constexpr int apron = static_cast<int>(gpu::means_apron), stride = static_cast<int>(gpu::means_stride);
    const Level& level = means.levels_[static_cast<std::size_t>(index.level)];
    const int first_row = index.row * static_cast<int>(gpu::page_quads) - apron;
    const int first_column = index.column * static_cast<int>(gpu::page_quads) - apron;
    const int from = std::max(0, -first_column), to = std::min(stride, level.columns - first_column);
    if (from >= to) return;
    const int first_post = (first_column + from) << index.level;
    const int posts = std::min((to - from) << index.level, means.levels_.front().columns - first_post);
    PostRow upper(posts), lower(posts), sums(to - from);
    const auto count = static_cast<std::size_t>(to - from);
    for (int i = std::max(0, -first_row); i < std::min(stride, level.rows - first_row); ++i) {
        gpu::MeansSquare* const squares = page.squares + i * stride + from;
        const int row = first_row + i;
        if (index.level == 0) {
            put_row(means, row, first_post, posts, 0.0F, upper);
            upper.pack(count, squares);
            continue;
        }
        put_row(means, 2 * row, first_post, posts, neighbour_weight, upper);
        const bool has_lower = 2 * row + 1 < means.grid_.rows();
        if (has_lower) put_row(means, 2 * row + 1, first_post, posts, neighbour_weight, lower);
        sums.add_rows(upper, has_lower ? &lower : nullptr, count);
        sums.pack(count, squares);
    }
}

void GroundMeans::page(const PageIndex& index, gpu::PageMeans& means) const {
    constexpr int apron = static_cast<int>(gpu::means_apron), stride = static_cast<int>(gpu::means_stride);
    const Level& level = levels_[static_cast<std::size_t>(index.level)];
    const int first_row = index.row * static_cast<int>(gpu::page_quads) - apron;
    const int first_column = index.column * static_cast<int>(gpu::page_quads) - apron;
    std::ranges::fill(means.squares, gpu::MeansSquare{});
    if (index.level < first_kept_ && !wraps_longitude_) {
        Bands::put_page_of_posts(*this, index, means);
        return;
    }
    // Round the Earth columns go on at the other side.
    const int from = wraps_longitude_ ? 0 : std::max(0, -first_column);
    const int to = wraps_longitude_ ? stride : std::min(stride, level.columns - first_column);
    for (int i = std::max(0, -first_row); i < std::min(stride, level.rows - first_row); ++i) {
        const int row = first_row + i;
        gpu::MeansSquare* const squares = means.squares + i * stride;
        for (int j = from; j < to; ++j) {
            const int column =
                wraps_longitude_ ? (first_column + j + level.columns) % level.columns : first_column + j;
            squares[j] =
                index.level == 0
                    ? packed(post(row, column, 0.0F))
                    : level.squares[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                                    static_cast<std::size_t>(column)];
        }
    }
}

}  // namespace oro
