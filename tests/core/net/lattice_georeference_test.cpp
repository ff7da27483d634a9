// Nets of posts: places, the way back, and what cannot be one.
#include "core/net/lattice_georeference.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <cmath>
#include <random>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/page_on_net.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

double apart_m(const PostPlace& a, const PostPlace& b) {
    return glm::length(ecef_from_geodetic({a.lat_deg, a.lon_deg, 0.0}).m -
                       ecef_from_geodetic({b.lat_deg, b.lon_deg, 0.0}).m);
}

const test::PlaneOfPosts planes[] = {{700, 900, {46.5, 8.0}, 25.0, 0.0},
                                     {900, 600, {-33.9, 151.2}, 10.0, 33.0},
                                     {500, 500, {89.99, 0.0}, 30.0, 0.0},
                                     {400, 3000, {0.0, 179.99}, 200.0, -120.0},
                                     {64, 48, {-90.0, 0.0}, 1000.0, 71.0}};

// Against the formula itself; the way back to a ten-millionth of a post.
TEST(LatticeGeoreference, FollowsItsFormulaBothWays) {
    constexpr unsigned seed = 611;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const test::PlaneOfPosts& plane : planes) {
        const auto net = test::net_of(plane);
        ASSERT_TRUE(net);
        double worst_m = 0.0, worst_back = 0.0, worst_truth = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const double row = unit(random) * (plane.rows - 1), column = unit(random) * (plane.columns - 1);
            const PostPlace there = plane.place_of(row, column), placed = net->place_at(row, column);
            worst_m = std::max(worst_m, apart_m(there, placed));
            const PostNumber back = net->post_at(placed.lat_deg, placed.lon_deg),
                             truly = plane.post_of(there.lat_deg, there.lon_deg);
            worst_back = std::max({worst_back, std::abs(back.row - row), std::abs(back.column - column)});
            worst_truth = std::max({worst_truth, std::abs(truly.row - row), std::abs(truly.column - column)});
        }
        std::printf("seed %u, %dx%d posts round %g,%g: %.1e m off, %.1e of a post on the way back\n", seed,
                    plane.rows, plane.columns, plane.middle.lat_deg, plane.middle.lon_deg, worst_m,
                    worst_back);
        EXPECT_LE(worst_m, LatticeGeoreference::largest_error_m);
        EXPECT_LE(worst_back, 1.0e-7);
        EXPECT_LE(worst_truth, 1.0e-6) << "or the test's own formula is not one";
    }
}

TEST(LatticeGeoreference, KnowsWhatLiesOutside) {
    const test::PlaneOfPosts& plane = planes[0];
    const auto net = test::net_of(plane);
    const auto inside = [&](double lat_deg, double lon_deg) {
        const PostNumber post = net->post_at(lat_deg, lon_deg);
        return post.row >= 0.0 && post.column >= 0.0 && post.row <= plane.rows - 1 &&
               post.column <= plane.columns - 1;
    };
    EXPECT_TRUE(inside(46.5, 8.0));
    EXPECT_FALSE(inside(46.5, 8.2));
    EXPECT_FALSE(inside(46.6, 8.0));
    EXPECT_FALSE(inside(-46.5, -172.0));
    EXPECT_FALSE(inside(0.0, 8.0));
    EXPECT_FALSE(inside(90.0, 0.0));
    EXPECT_FALSE(inside(46.5, 98.0));
    const auto& box = net->box();
    // 12.5 by 9 km around the middle, by the radii there.
    EXPECT_NEAR(box.north_deg, 46.5 + 349.5 * 25.0 / 6371000.0 * 57.29578, 2.0e-4);
    EXPECT_NEAR(box.east_deg - box.west_deg, 2.0 * 449.5 * 25.0 / (6371000.0 * 0.688355) * 57.29578, 2.0e-3);
}

TEST(LatticeGeoreference, HoldsThePoleInItsBox) {
    const auto& box = test::net_of(planes[2])->box();
    EXPECT_EQ(box.north_deg, 90.0);
    EXPECT_NEAR(box.east_deg - box.west_deg, 360.0, 1.0e-9);
    const auto over_antimeridian = test::net_of(planes[3])->box();
    EXPECT_GT(over_antimeridian.east_deg, 180.0);
    EXPECT_LT(over_antimeridian.east_deg - over_antimeridian.west_deg, 10.0);
}

// A row's posts one by one and together: the same bits.
TEST(LatticeGeoreference, GivesAPostOnePlace) {
    const auto net = test::net_of(planes[1]);
    std::vector<glm::dvec3> row(600);
    for (const int number : {0, 1, 449, 899}) {
        net->normals_of_row(number, 0, row);
        for (int column = 0; column < 600; ++column) {
            glm::dvec3 one;
            net->normals_of_row(number, column, {&one, 1});
            ASSERT_EQ(one, row[static_cast<std::size_t>(column)]);
            ASSERT_LT(glm::length(one - net->normal_at(number, column)), 1.0e-15);
        }
    }
}

TEST(LatticeGeoreference, KnowsHowItsRowsLie) {
    const auto net = test::net_of(planes[1]);
    const LatticeGeoreference::LatticeFrame local_frame = net->local_frame_at(449.5, 299.5);
    // 10 m on a sphere of 6,371,000 m; on the ellipsoid by its radii there, along rows turned by 33 degrees.
    const double turn = radians_from_deg(33.0).rad, angle = 10.0 / 6371000.0;
    const double east = prime_vertical_radius_m(-33.9), north = meridian_radius_m(-33.9);
    EXPECT_NEAR(local_frame.column_m, angle * std::hypot(east * std::cos(turn), north * std::sin(turn)),
                1.0e-6);
    EXPECT_NEAR(local_frame.row_m, angle * std::hypot(east * std::sin(turn), north * std::cos(turn)), 1.0e-6);
    EXPECT_NEAR(local_frame.turn_rad, std::atan2(north * std::sin(turn), east * std::cos(turn)), 1.0e-6);
}

// No net: mirrored, folded, with a jump.
TEST(LatticeGeoreference, RefusesWhatIsNone) {
    const auto fit = [](const std::function<PostPlace(double, double)>& place) {
        const auto net = LatticeGeoreference::fit(
            100, 100, [&](std::span<const PostNumber> posts, std::span<PostPlace> places) -> Result<void> {
                for (std::size_t i = 0; i < posts.size(); ++i)
                    places[i] = place(posts[i].row, posts[i].column);
                return {};
            });
        return net.ok() ? "" : net.error().what;
    };
    EXPECT_EQ(fit([](double row, double column) {
                  return PostPlace{46.0 - 0.001 * row, 8.0 + 0.001 * column};
              }),
              "");
    EXPECT_EQ(fit([](double row, double column) {
                  return PostPlace{46.0 + 0.001 * row, 8.0 + 0.001 * column};
              }),
              "its rows and columns are mirrored or have a fold");
    EXPECT_EQ(fit([](double row, double column) {
                  return PostPlace{46.0 - 1e-5 * (row - 50.0) * (row - 50.0), 8.0 + 0.001 * column};
              }),
              "its rows and columns are mirrored or have a fold");
    EXPECT_EQ(fit([](double row, double column) {
                  return PostPlace{46.0 - 0.001 * row - (row > 37.3 ? 0.0004 : 0.0), 8.0 + 0.001 * column};
              }),
              "its places on the Earth do not follow smoothly from row and column: they jump");
}

// Every page and level has the same whole steps for a post; true also of a continent, whose pages reach far.
struct PlacesOnPages {
    int far_pages{}, near_pages{};
};
void check_places(const HeightField& field, PlacesOnPages& pages) {
    const RegionShape shape = region_shape(field, 1.0);
    const DrawnHeights heights = drawn_heights(field, 1.0, 2);
    std::vector<std::array<std::int64_t, 3>> seen(field.H_m.size());
    std::vector<int> times(field.H_m.size());
    double worst_m = 0.0;
    const auto& earth = GeographicLib::Geocentric::WGS84();
    for (int level = 0; level < level_count(field.grid); ++level) {
        const LevelGrid grid = level_grid(field.grid, level);
        for (int p = 0; p < grid.pages().rows * grid.pages().columns; ++p) {
            const PageIndex index{p / grid.pages().columns, p % grid.pages().columns, level};
            auto block = std::make_unique<gpu::PageBlock>();
            const PageHeights of_page = page_heights(field.grid, heights, index);
            const PageSummary page = build_page(field.grid, shape, of_page, index, *block);
            auto places = std::make_unique<gpu::PagePlaces>();
            ASSERT_TRUE(fill_places(field.grid, page, of_page, *places));
            ++(reaches_far(page) ? pages.far_pages : pages.near_pages);
            const LatticePoint origin = lattice_point(page.origin_ecef.m);
            for (int i = 0; i < 129 * 129; ++i) {
                const int row = index.row * 128 + i / 129, column = index.column * 128 + i % 129;
                if (row > grid.row.quads || column > grid.column.quads) continue;
                const auto post = static_cast<std::size_t>(grid.row.region_post(row) * field.grid.columns() +
                                                           grid.column.region_post(column));
                std::array<std::int64_t, 3> at{};
                for (std::size_t axis = 0; axis < 3; ++axis)
                    at[axis] = origin.steps[axis] + places->steps[static_cast<std::size_t>(i) * 3 + axis] +
                               places->middle[axis] +
                               std::int64_t{i / 129 - places->middle_row} * places->row_step[axis] +
                               std::int64_t{i % 129 - places->middle_column} * places->column_step[axis];
                if (times[post]++ > 0) {
                    ASSERT_EQ(seen[post], at);
                }
                seen[post] = at;
            }
        }
    }
    int several = 0;
    for (std::size_t post = 0; post < seen.size(); ++post) {
        ASSERT_GT(times[post], 0);
        several += times[post] > 1 ? 1 : 0;
        const int row = static_cast<int>(post) / field.grid.columns(),
                  column = static_cast<int>(post) % field.grid.columns();
        const PostPlace place = field.grid.net->place_at(row, column);
        glm::dvec3 truth{};
        earth.Forward(place.lat_deg, place.lon_deg, field.h_at_post_m(row, column), truth.x, truth.y,
                      truth.z);
        glm::dvec3 at{};
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = static_cast<double>(seen[post][static_cast<std::size_t>(axis)]) * height_step_m;
        worst_m = std::max(worst_m, glm::length(at - truth));
    }
    EXPECT_GT(several, 30000);
    EXPECT_LE(worst_m, 0.7e-3);
}

TEST(PageOnNet, PostsHaveOnePlaceOnEveryPageAndLevel) {
    PlacesOnPages pages;
    check_places(test::net_field({300, 420, {46.5, 8.0}, 25.0, 12.0}, test::patchy_H_m, 47.5F), pages);
    EXPECT_EQ(pages.far_pages, 0);
}

TEST(PageOnNet, PostsOverKinksDoToo) {
    const test::KinkedPlane kinked{{300, 420, {46.5, 8.0}, 25.0, 12.0}, 150.3, 0.2};
    HeightField field = test::net_field(kinked.plane, test::patchy_H_m, 47.5F);
    field.grid.net = test::kinked_net_of(kinked);
    PlacesOnPages pages;
    check_places(field, pages);
    EXPECT_EQ(pages.far_pages, 0);
}

// 4,500 x 6,300 km, a pole among them: levels of both kinds.
TEST(PageOnNet, PostsOfAContinentDoToo) {
    PlacesOnPages pages;
    check_places(test::net_field({300, 420, {-78.0, 40.0}, 15000.0, 30.0}, test::patchy_H_m, 47.5F), pages);
    std::printf("%d pages reach far, %d do not\n", pages.far_pages, pages.near_pages);
    EXPECT_GT(pages.far_pages, 3);
    EXPECT_GT(pages.near_pages, 3);
}

TEST(PageOnNet, HoldsNoHemisphere) {
    const auto holds = [](int posts, double spacing_m) {
        return fits_one_page(*test::net_of({posts, posts, {46.5, 8.0}, spacing_m, 20.0}));
    };
    EXPECT_TRUE(holds(200, 1000.0));
    EXPECT_TRUE(holds(200, 40000.0));
    EXPECT_FALSE(holds(800, 20000.0));
}

}  // namespace
}  // namespace oro
