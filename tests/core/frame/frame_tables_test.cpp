// A frame's tables: the same post has the same bits in every page and level, and so one place.
#include "core/frame/frame_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "tests/core/terrain/placed_posts.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

constexpr int quads = static_cast<int>(gpu::page_quads);

template <class T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}
// The bits that a post got first, and whether it ever gets others.
template <class T>
bool same_as_first(std::optional<T>& first, const T& now) {
    if (!first) first = now;
    return same_bits(*first, now);
}

std::vector<PageIndex> all_pages(const PostGrid& grid) {
    std::vector<PageIndex> pages;
    for (int level = 0; level < level_count(grid); ++level) {
        const PageLayout layout = level_grid(grid, level).pages();
        for (int i = 0; i < layout.rows * layout.columns; ++i)
            pages.push_back({i / layout.columns, i % layout.columns, level});
    }
    return pages;
}

HeightField region_of(double per_deg, std::int64_t north, std::int64_t west, int rows, int columns) {
    std::mt19937_64 random(61);
    HeightField field = test::world_field(per_deg, north, west, rows, columns, [&](double, double) {
        return 0.01 * static_cast<double>(random() % 500000);
    });
    field.undulation.lat = {1.0, 0.0, 90, -1, 181};
    field.undulation.lon = {1.0, 0.0, -180, +1, 541};
    for (int i = 0; i < 181 * 541; ++i) field.undulation.N_m.push_back(static_cast<float>(i % 89));
    return field;
}

struct Placed {
    std::size_t pages{};
    std::size_t posts{};         // however often
    std::size_t shared_posts{};  // again
};

// Places every post of every page and level, and expects what was got before.
void expect_one_place(const HeightField& field, const Geodetic& eye, Placed& placed) {
    const PostGrid& grid = field.grid;
    const DrawnHeights heights = drawn_heights(field, 1.0, 2);
    const std::int32_t reference = height_steps(reference_height_m(eye));
    std::vector<PageIndex> pages = all_pages(grid);
    std::shuffle(pages.begin(), pages.end(), std::mt19937_64(7));
    FrameTables tables(grid, eye);
    std::vector<gpu::FramePage> frame(pages.size());
    for (std::size_t i = 0; i < pages.size(); ++i) tables.place(pages[i], frame[i]);
    const std::vector<gpu::RowTerms> rows = tables.take_rows();
    const std::vector<gpu::ColumnTerms> columns = tables.take_columns();
    std::vector<std::optional<gpu::RowTerms>> row_terms(static_cast<std::size_t>(grid.rows()));
    std::vector<std::optional<gpu::ColumnTerms>> column_terms(static_cast<std::size_t>(grid.columns()));
    std::vector<std::optional<gpu::vec3>> places(grid.post_count());
    for (std::size_t n = 0; n < pages.size(); ++n) {
        const PageIndex& page = pages[n];
        const LevelGrid level = level_grid(grid, page.level);
        const PageHeights page_steps = page_heights(grid, heights, page);
        for (int i = 0; i <= quads && page.row * quads + i <= level.row.quads; ++i) {
            const int row = level.row.region_post(page.row * quads + i);
            const gpu::RowTerms& t = rows.at(frame[n].row_terms + static_cast<std::size_t>(i));
            ASSERT_TRUE(same_as_first(row_terms[static_cast<std::size_t>(row)], t)) << row;
            for (int j = 0; j <= quads && page.column * quads + j <= level.column.quads; ++j) {
                // Round the Earth the last column's posts are the first one's.
                int column = level.column.region_post(page.column * quads + j);
                if (grid.wraps_longitude() && column == grid.columns() - 1) column = 0;
                const gpu::ColumnTerms& u = columns.at(frame[n].column_terms + static_cast<std::size_t>(j));
                ASSERT_TRUE(same_as_first(column_terms[static_cast<std::size_t>(column)], u)) << column;
                const gpu::vec3 at = test::place_from_eye(
                    t, u, reference, page_steps.steps[static_cast<std::size_t>((i + 1) * 131 + j + 1)]);
                std::optional<gpu::vec3>& first =
                    places[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                           static_cast<std::size_t>(column)];
                placed.shared_posts += first ? 1 : 0;
                ASSERT_TRUE(same_as_first(first, at)) << page.level << ": " << row << " " << column;
                ++placed.posts;
            }
        }
    }
    placed.pages += pages.size();
    for (const int row : {0, grid.rows() - 1}) {
        if (std::abs(row_lat_deg(grid, row)) != 90.0) continue;
        const auto* of_row =
            &places[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns())];
        // All columns of a pole's row are one point (0 and -0 are one).
        const int last = grid.columns() - (grid.wraps_longitude() ? 2 : 1);
        for (int column = 1; column <= last; ++column) ASSERT_EQ(*of_row[column], *of_row[0]) << column;
    }
}

TEST(FrameTables, APostHasTheSameBitsInEveryPageAndLevel) {
    const HeightField regions[] = {
        region_of(2.3, 207, -100, 415, 829),             // the whole Earth, in odd spacings
        region_of(1200.0, 47 * 1200, 215900, 420, 400),  // across the antimeridian
        region_of(3600.0, 90 * 3600, -7, 300, 259),      // from a pole
        region_of(300.0 / 360.0, -40, -150, 36, 301),    // round the Earth, to the other pole but for a post
    };
    ASSERT_TRUE(regions[0].grid.wraps_longitude());
    ASSERT_TRUE(regions[3].grid.wraps_longitude());
    const Geodetic eyes[] = {{46.5, 8.1, 2000.0},     {47.0, 180.0, 900.0},      {46.9, -179.95, 3.6e7},
                             {90.0, 0.0, 4000.0},     {-90.0, 77.0, 5.0e5},      {89.99, -123.4, 3000.0},
                             {-12.3, 533.25, -430.0}, {0.0, -100.0 / 2.3, 3.8e8}};
    Placed placed;
    for (const HeightField& region : regions) {
        for (const Geodetic& eye : eyes) {
            ASSERT_NO_FATAL_FAILURE(expect_one_place(region, eye, placed))
                << region.grid.lat.posts_per_deg << " from " << eye.lat_deg << " " << eye.lon_deg;
        }
    }
    std::printf("%zu pages, %zu posts, of which %zu were placed before with the same bits\n", placed.pages,
                placed.posts, placed.shared_posts);
    EXPECT_GT(placed.shared_posts, 1500000U);
}

// The comparison can fail: without the rule for twins, odd spacings give the two columns other bits.
TEST(FrameTables, TwinColumnsWouldDifferByThemselves) {
    const HeightField field = region_of(2.3, 207, -100, 415, 829);
    const auto V = [](double turn_deg) {
        const double half_sine = sine_cosine_deg(0.5 * turn_deg).sine;
        return static_cast<float>(2.0 * half_sine * half_sine);
    };
    int differ = 0;
    for (int i = 0; i < 1000; ++i) {
        const double eye_lon_deg = field.grid.lon.at_deg(0) + 1.0e-7 * i;
        differ += V(std::remainder(field.grid.lon.at_deg(0) - eye_lon_deg, 360.0)) !=
                          V(std::remainder(field.grid.lon.at_deg(828) - eye_lon_deg, 360.0))
                      ? 1
                      : 0;
    }
    EXPECT_GT(differ, 0);
}

TEST(FrameTables, PagesShareTheirRowsAndColumns) {
    const HeightField field = region_of(1200.0, 47 * 1200, 8 * 1200, 420, 400);
    FrameTables tables(field.grid, {46.0, 8.0, 1000.0});
    std::set<std::uint32_t> rows, columns;
    std::vector<gpu::FramePage> level_0;
    for (const PageIndex& index : all_pages(field.grid)) {
        gpu::FramePage page{};
        tables.place(index, page);
        EXPECT_EQ(page.first_row, static_cast<unsigned>(index.row * 128) << index.level);
        EXPECT_EQ(page.first_column, static_cast<unsigned>(index.column * 128) << index.level);
        EXPECT_EQ(page.row_terms % 129, 0U);
        EXPECT_EQ(page.column_terms % 129, 0U);
        rows.insert(page.row_terms);
        columns.insert(page.column_terms);
        if (index.level == 0) level_0.push_back(page);
    }
    // 4 x 4, 2 x 2 and 1 page.
    EXPECT_EQ(rows.size(), 7U);
    EXPECT_EQ(columns.size(), 7U);
    EXPECT_EQ(level_0[0].row_terms, level_0[3].row_terms);
    EXPECT_EQ(level_0[1].column_terms, level_0[13].column_terms);
    EXPECT_EQ(tables.take_rows().size(), 7U * 129U);
    EXPECT_EQ(tables.take_columns().size(), 7U * 129U);
}

// Radii of the ellipsoid: a = 6,378,137 m, b = 6,356,752.314 m. Source: NIMA TR8350.2, third edition,
// table 3.1.
TEST(FrameTables, Literals) {
    // Posts from the pole to 38 N and from 0 to 128 E, a degree apart.
    PostGrid grid{{1.0, 0.0, 90, -1, 129}, {1.0, 0.0, 0, 1, 129}};
    gpu::FramePage page{};
    FrameTables on_equator(grid, {0.0, 0.0, 0.0});
    on_equator.place({}, page);
    std::vector<gpu::RowTerms> rows = on_equator.take_rows();
    EXPECT_EQ(rows[0].R, -6378137.0F);
    EXPECT_EQ(rows[0].C, 0.0F);
    EXPECT_EQ(rows[0].S, 1.0F);
    EXPECT_EQ(rows[0].P, 0.0F);
    EXPECT_FLOAT_EQ(rows[0].Z, 6356752.314F);
    EXPECT_EQ(rows[90].R, 0.0F);
    EXPECT_EQ(rows[90].C, 1.0F);
    EXPECT_EQ(rows[90].S, 0.0F);
    EXPECT_EQ(rows[90].P, 6378137.0F);
    EXPECT_EQ(rows[90].Z, 0.0F);
    std::vector<gpu::ColumnTerms> columns = on_equator.take_columns();
    EXPECT_EQ(columns[0].V, 0.0F);
    EXPECT_EQ(columns[0].W, 0.0F);
    EXPECT_FLOAT_EQ(columns[60].V, 0.5F);
    EXPECT_FLOAT_EQ(columns[60].W, 0.8660254F);
    EXPECT_EQ(columns[90].V, 1.0F);
    EXPECT_EQ(columns[90].W, 1.0F);
    // Heights are relative to the eye's whole metres: 1,000 m up the post below is 0.4 m off.
    FrameTables above(grid, {0.0, 0.0, 1000.4});
    above.place({}, page);
    EXPECT_NEAR(above.take_rows()[90].R, -0.4F, 1e-6F);
    // Another whole turn of the eye is no other place.
    FrameTables turned(grid, {0.0, 720.0, 0.0});
    turned.place({}, page);
    const std::vector<gpu::ColumnTerms> again = turned.take_columns();
    for (std::size_t i = 0; i < again.size(); ++i) EXPECT_TRUE(same_bits(again[i], columns[i]));

    EXPECT_EQ(reference_height_m({0.0, 0.0, 0.4}), 0.0);
    EXPECT_EQ(reference_height_m({0.0, 0.0, 1234.5}), 1235.0);
    EXPECT_EQ(reference_height_m({0.0, 0.0, -430.6}), -431.0);
    EXPECT_EQ(reference_height_m({0.0, 0.0, 3.8e8}), 524000.0);
    EXPECT_EQ(reference_height_m({0.0, 0.0, -6.0e6}), -524000.0);
}

// A region without pages that are asked for.
class NoPages : public RegionPages {
  public:
    explicit NoPages(const HeightField& field, double exaggeration)
        : RegionPages({field.grid, field.undulation, region_shape(field, exaggeration), 0}) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex&) const override { return PageRecord{}; }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override { return {}; }
};

// As undulation_at of shaders/shade/surface.glsl.
double undulation_at(const gpu::UndulationTable& table, const std::vector<float>& N_m, gpu::vec2 post) {
    const gpu::vec2 size(table.rows, table.columns);
    const gpu::vec2 node = glm::clamp(table.first + post * table.per_post, gpu::vec2(0.0F), size - 1.0F);
    const glm::uvec2 low(glm::min(glm::floor(node), glm::max(size - 2.0F, gpu::vec2(0.0F))));
    const glm::uvec2 high = glm::min(low + 1U, glm::uvec2(size) - 1U);
    const gpu::vec2 share = node - gpu::vec2(low);
    const auto at = [&](glm::uint row, glm::uint column) { return N_m[row * table.columns + column]; };
    const float north = glm::mix(at(low.x, low.y), at(low.x, high.y), share.y);
    const float south = glm::mix(at(high.x, low.y), at(high.x, high.y), share.y);
    return static_cast<double>(glm::mix(north, south, share.x));
}

TEST(FrameConstants, UndulationIsFoundFromARegionsPosts) {
    for (const double west_deg : {-179.0, 8.0, 179.0, -180.5 + 360.0}) {
        for (const double turn_deg : {-360.0, 0.0, 360.0}) {
            HeightField field = test::world_field(1200.0, 47 * 1200, std::llround(west_deg * 1200.0), 300,
                                                  300, [](double, double) { return 0.0; });
            // Nodes that hold the region, in whatever whole turn.
            const auto first = std::llround(std::floor((west_deg + turn_deg) * 4.0));
            field.undulation.lat = {4.0, 0.0, 47 * 4, -1, 3};
            field.undulation.lon = {4.0, 0.0, first, +1, 3};
            field.undulation.N_m = {40.0F, 44.0F, 30.0F, -20.0F, -60.0F, 10.0F, 7.0F, 9.0F, 80.0F};
            const gpu::UndulationTable table =
                frame_constants(NoPages(field, 1.0), Camera{}, Tile{}, 1.0).undulation;
            EXPECT_EQ(table.rows, 3U);
            EXPECT_EQ(table.columns, 3U);
            for (int i = 0; i < 300 * 300; i += 7) {
                const int row = i / 300, column = i % 300;
                // 8 mm a post at the steepest; floats of some hundred posts.
                ASSERT_NEAR(undulation_at(table, field.undulation.N_m, gpu::vec2(row, column)),
                            field.undulation.at_m(field.grid.lat.at_deg(row), field.grid.lon.at_deg(column)),
                            2e-4)
                    << west_deg << " " << turn_deg;
            }
        }
    }
    HeightField without =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 3, 3, [](double, double) { return 0.0; });
    EXPECT_EQ(frame_constants(NoPages(without, 1.0), Camera{}, Tile{}, 1.0).undulation.rows, 0U);
}

// Held against all columns: from west to east they go eastwards but for one step.
TEST(FrameConstants, TellWhereTheFlatEarthIsCut) {
    constexpr unsigned seed = 435;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> turn_deg(-720.0, 720.0);
    const auto flat = [](double, double) { return 0.0; };
    const HeightField round_the_earth = test::world_field(4.0, 8, -720, 9, 1441, flat);
    const HeightField half_of_it = test::world_field(4.0, 8, 100, 9, 721, flat);
    int without = 0;
    for (int i = 0; i < 400; ++i) {
        const HeightField& field = i % 2 == 0 ? round_the_earth : half_of_it;
        // Each fourth eye is on a column's own meridian, or opposite to one.
        const double lon_deg = i % 8 < 2 ? 0.25 * std::round(4.0 * turn_deg(random)) : turn_deg(random);
        const Geodetic eye{1.0, lon_deg, 100.0};
        std::set<unsigned> cuts;
        const auto offset_m = [&](std::int64_t column) {
            return model_offset_m(Earth::flat, {0.0, lon_deg, 0.0},
                                  {0.0, field.grid.lon.at_deg(column), 0.0});
        };
        const glm::dvec3 east = ecef_from_enu(0.0, lon_deg)[0];
        for (int column = 0; column + 1 < field.grid.columns(); ++column) {
            const bool twin = column + 2 == field.grid.columns() && field.grid.wraps_longitude();
            if (glm::dot(east, offset_m(twin ? 0 : column + 1) - offset_m(column)) < 0.0)
                cuts.insert(static_cast<unsigned>(column));
        }
        const unsigned cut = cut_column(field.grid, eye, Earth::flat);
        ASSERT_LE(cuts.size(), 1U);
        ASSERT_EQ(cut, cuts.empty() ? gpu::no_column : *cuts.begin()) << lon_deg;
        without += cuts.empty() ? 1 : 0;
        EXPECT_EQ(cut_column(field.grid, eye, Earth::sphere), gpu::no_column);
    }
    EXPECT_GT(without, 50);
    EXPECT_LT(without, 150);
    // 38.758 E is opposite to 141.242 W: the 875th post from 180 W is at 38.75 E.
    EXPECT_EQ(cut_column(round_the_earth.grid, {25.7, -141.242, 53.0}, Earth::flat), 875U);
}

TEST(FrameConstants, AreThoseOfTheEyeAndTheRegion) {
    const HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 310, 290, [](double, double) { return 500.0; });
    Camera camera;
    camera.eye = {46.8, 8.1 + 360.0, 2000.25};
    camera.attitude = {200.0, -12.0, 7.0};
    camera.width_px = 640;
    camera.height_px = 480;
    const gpu::FrameConstants constants =
        frame_constants(NoPages(field, 2.5), camera, {100, 50, 320, 200, {0.5, 0.5}}, 1.5);
    EXPECT_EQ(constants.reference_steps, 2000 * 2048);
    EXPECT_EQ(constants.eye_h_m, 2000.25F);
    EXPECT_EQ(constants.last_row, 309U);
    EXPECT_EQ(constants.last_column, 289U);
    EXPECT_EQ(constants.exaggeration, 2.5F);
    EXPECT_EQ(constants.width_px, 320U);
    EXPECT_EQ(constants.height_px, 200U);
    EXPECT_EQ(constants.tau_px, 1.5F);
    EXPECT_EQ(constants.sample_count, 1U);
    // Gaussian radius at 46.8 N: sqrt(M N), 6,379.5 km. Source: Torge & Müller, Geodesy, 4th ed. 2012.
    EXPECT_NEAR(constants.earth_radius_m, 6379.5e3F, 100.0F);
    // The eye's meridian frame: from an offset in it to the view, as from ECEF.
    const glm::dvec3 offset(-300.0, 4000.0, 250.0);
    const glm::dvec3 truth = camera.view_from_ecef() * (test::ecef_from_eye(camera.eye) * offset);
    EXPECT_LT(glm::distance(glm::dvec3(constants.view_from_eye * gpu::vec3(offset)), truth), 1e-3);
    const glm::dvec3 up = camera.view_from_ecef() * ecef_from_enu(46.8, 8.1)[2];
    EXPECT_LT(glm::distance(glm::dvec3(constants.up_view), up), 1e-6);
}

}  // namespace
}  // namespace oro
