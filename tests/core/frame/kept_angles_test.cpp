// Tables of many rows and columns at a time, of angles that are kept, are those of one post at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/frame/column_terms.h"
#include "core/frame/frame_tables.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/page.h"

namespace oro {
namespace {

constexpr int quads_of_page = static_cast<int>(gpu::page_quads);

PostGrid grid_of(double per_deg, std::int64_t north, std::int64_t west, int rows, int columns) {
    PostGrid grid;
    grid.lat = {per_deg, 0.0, north, -1, rows};
    grid.lon = {per_deg, 0.0, west, 1, columns};
    return grid;
}

// The words of shaders/shared.h's RowTerms on WGS84, one row at a time.
gpu::RowTerms row_by_itself(const PostGrid& grid, std::int64_t row, const Geodetic& eye) {
    const double lat_deg = row_lat_deg(grid, row);
    const SineCosine lat = sine_cosine_deg(lat_deg), at_eye = sine_cosine_deg(eye.lat_deg);
    const double normal_m = prime_vertical_radius_m(lat_deg), at_eye_m = prime_vertical_radius_m(eye.lat_deg);
    const double reference_m = reference_height_m(eye);
    const double rho_m = (at_eye_m + eye.h_m) * at_eye.cosine;
    const double z_m = (at_eye_m * (1.0 - wgs84_e2) + eye.h_m) * at_eye.sine;
    const double P = (normal_m + reference_m) * lat.cosine;
    const double Z = (normal_m * (1.0 - wgs84_e2) + reference_m) * lat.sine - z_m;
    const auto cosine = static_cast<float>(lat.cosine);
    return {static_cast<float>(P - rho_m),
            cosine,
            static_cast<float>(lat.sine),
            static_cast<float>(P),
            static_cast<float>(Z),
            cosine,
            cosine};
}

gpu::ColumnTerms column_by_itself(const PostGrid& grid, std::int64_t column, const Geodetic& eye) {
    const bool twin = column == grid.columns() - 1 && grid.wraps_longitude();
    double east_deg = grid.lon.at_deg(twin ? 0 : column) - eye.lon_deg;
    if (!(std::abs(east_deg) < 180.0)) east_deg = std::remainder(east_deg, 360.0);
    return column_terms(east_deg);
}

template <class T>
bool has_same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

class EyeInMotion {
  public:
    explicit EyeInMotion(unsigned seed) : random_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    Geodetic next(const PostGrid& grid) {
        if (random_() % 10 == 0 || eye_.h_m == 0.0)
            eye_ = {between(grid.south_deg(), grid.north_deg()), between(grid.west_deg(), grid.east_deg()),
                    std::pow(10.0, between(0.0, 7.0))};
        eye_.lat_deg += 1e-4 * between(-1.0, 1.0);
        eye_.lon_deg += 1e-4 * between(-1.0, 1.0);
        eye_.h_m += between(-3.0, 3.0);
        return eye_;
    }

  private:
    std::mt19937_64 random_;
    Geodetic eye_{};
};

// Pages of all levels in any order, of eyes in motion, by one memory.
void expect_tables_of_pages(const PostGrid& grid, unsigned seed, int eyes) {
    EyeInMotion motion(seed);
    KeptAngles kept(grid);
    int posts = 0;
    for (int i = 0; i < eyes; ++i) {
        const Geodetic eye = motion.next(grid);
        FrameTables tables(grid, eye, Earth::ellipsoid, &kept);
        std::vector<std::pair<PageIndex, gpu::FramePage>> pages;
        for (int j = 0; j < 6; ++j) {
            const int level = motion.below(level_count(grid));
            const PageLayout layout = level_grid(grid, level).pages();
            const PageIndex page{motion.below(layout.rows), motion.below(layout.columns), level};
            pages.emplace_back(page, gpu::FramePage{});
            tables.place(page, pages.back().second);
        }
        const std::vector<gpu::RowTerms> rows = tables.take_rows();
        const std::vector<gpu::ColumnTerms> columns = tables.take_columns();
        for (const auto& [page, placed] : pages) {
            const LevelGrid level = level_grid(grid, page.level);
            for (int post = 0; post <= quads_of_page; ++post) {
                const std::int64_t row = post_beyond(level.row, page.row * quads_of_page + post);
                const std::int64_t column = post_beyond(level.column, page.column * quads_of_page + post);
                ASSERT_TRUE(has_same_bits(rows[placed.row_terms + static_cast<unsigned>(post)],
                                          row_by_itself(grid, row, eye)))
                    << "seed " << seed << ", eye " << i << ", row " << row;
                ASSERT_TRUE(has_same_bits(columns[placed.column_terms + static_cast<unsigned>(post)],
                                          column_by_itself(grid, column, eye)))
                    << "seed " << seed << ", eye " << i << ", column " << column;
                ++posts;
            }
        }
    }
    std::printf("seed %u: %d rows and as many columns\n", seed, posts);
}

TEST(KeptAngles, TablesOfPagesAreThoseOfOnePostAtATime) {
    expect_tables_of_pages(grid_of(1200.0, 1200 * 48, 1200 * 6, 3000, 4100), 5111, 300);
}

TEST(KeptAngles, TablesRoundTheEarthAreThoseOfOnePostAtATime) {
    expect_tables_of_pages(grid_of(4.0, 4 * 90, -4 * 180, 4 * 180 + 1, 4 * 360 + 1), 5112, 200);
}

// Some rows and columns of a region, as clusters want them.
TEST(KeptAngles, TablesOfSpansAreThoseOfOnePostAtATime) {
    constexpr unsigned seed = 5113;
    const PostGrid grid = grid_of(1200.0, 1200 * 47, 1200 * 8, 1201, 1500);
    EyeInMotion motion(seed);
    KeptAngles kept(grid);
    for (int i = 0; i < 60; ++i) {
        const Geodetic eye = motion.next(grid);
        std::vector<FrameTables::Span> spans[2];
        std::vector<char> is_in[2] = {std::vector<char>(1201), std::vector<char>(1500)};
        for (int axis = 0; axis < 2; ++axis)
            for (int j = motion.below(8); j > 0; --j) {
                const int first = motion.below(1200), last = std::min(first + motion.below(200), 1200);
                spans[axis].push_back({first, last});
                std::fill(is_in[axis].begin() + first, is_in[axis].begin() + last + 1, char{1});
            }
        FrameTables tables(grid, eye, Earth::ellipsoid, &kept);
        tables.place_spans(spans[0], spans[1]);
        const std::vector<gpu::RowTerms> rows = tables.take_rows();
        const std::vector<gpu::ColumnTerms> columns = tables.take_columns();
        ASSERT_EQ(rows.size(), 1201U);
        ASSERT_EQ(columns.size(), 1500U);
        for (std::size_t row = 0; row < rows.size(); ++row)
            ASSERT_TRUE(has_same_bits(rows[row], is_in[0][row] != 0
                                                     ? row_by_itself(grid, static_cast<int>(row), eye)
                                                     : gpu::RowTerms{}))
                << "seed " << seed << ", eye " << i << ", row " << row;
        for (std::size_t column = 0; column < columns.size(); ++column)
            ASSERT_TRUE(has_same_bits(
                columns[column], is_in[1][column] != 0 ? column_by_itself(grid, static_cast<int>(column), eye)
                                                       : gpu::ColumnTerms{}))
                << "seed " << seed << ", eye " << i << ", column " << column;
    }
}

}  // namespace
}  // namespace oro
