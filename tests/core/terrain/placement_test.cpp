// The placement formula in float32 (DESIGN 4), evaluated on the CPU from the tables that the GPU gets,
// against GeographicLib in double.
#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <random>

#include "core/frame/frame_tables.h"
#include "core/frame/placement_promise.h"
#include "core/terrain/page.h"
#include "tests/core/terrain/placed_posts.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr double lowest_eye_m = -430.0;
constexpr double highest_eye_m = 9000.0;

glm::dvec3 true_ecef_m(const Geodetic& place) {
    glm::dvec3 at;
    GeographicLib::Geocentric::WGS84().Forward(place.lat_deg, place.lon_deg, place.h_m, at.x, at.y, at.z);
    return at;
}

// A page's posts where GeographicLib puts them, and their heights as the GPU gets them.
struct Page {
    HeightField field;
    std::unique_ptr<PageHeights> heights;

    explicit Page(HeightField of)
        : field(std::move(of)),
          heights(std::make_unique<PageHeights>(
              page_heights(field.grid, field.undulation, 1.0, page_elevations(field, {}), {}))) {}

    [[nodiscard]] glm::dvec3 truth_m(int row, int column) const {
        return true_ecef_m(
            {field.grid.lat.at_deg(row), field.grid.lon.at_deg(column), field.h_at_post_m(row, column)});
    }
    [[nodiscard]] std::int32_t steps(int row, int column) const {
        return heights
            ->steps[static_cast<std::size_t>((row + 1) * static_cast<int>(gpu::height_stride) + column + 1)];
    }
};

// A frame of that page alone.
class Frame {
  public:
    Frame(const Page& page, const Geodetic& eye)
        : page_(page),
          eye_m_(true_ecef_m(eye)),
          ecef_from_eye_(test::ecef_from_eye(eye)),
          reference_steps_(height_steps(reference_height_m(eye))) {
        FrameTables tables(page.field.grid, eye);
        gpu::FramePage placed{};
        tables.place({}, placed);
        rows_ = tables.take_rows();
        columns_ = tables.take_columns();
    }
    [[nodiscard]] double distance_m(int row, int column) const {
        return glm::distance(page_.truth_m(row, column), eye_m_);
    }
    [[nodiscard]] double error_m(int row, int column) const {
        const gpu::vec3 placed = test::place_from_eye(rows_[static_cast<std::size_t>(row)],
                                                      columns_[static_cast<std::size_t>(column)],
                                                      reference_steps_, page_.steps(row, column));
        return glm::distance(eye_m_ + ecef_from_eye_ * glm::dvec3(placed), page_.truth_m(row, column));
    }

  private:
    const Page& page_;
    glm::dvec3 eye_m_;
    glm::dmat3 ecef_from_eye_;
    std::int32_t reference_steps_;
    std::vector<gpu::RowTerms> rows_;
    std::vector<gpu::ColumnTerms> columns_;
};

// A page that is page_m high, and as wide or (near a pole) a quarter of the way round, with heights anywhere
// in a layer.
Page random_page(double lat_deg, double page_m, double base_m, double relief_m, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double per_deg = std::round(128.0 * 111132.0 / page_m);
    const auto north = std::max(static_cast<std::int64_t>(std::floor(lat_deg * per_deg)),
                                static_cast<std::int64_t>(-90.0 * per_deg) + posts - 1);
    HeightField field = test::world_field(per_deg, north, 0, posts, posts,
                                          [&](double, double) { return base_m + relief_m * unit(random); });
    // The posts of a pole's row are one place, and so have one height.
    for (const int row : {0, posts - 1}) {
        if (std::abs(field.grid.lat.at_deg(row)) < 90.0) continue;
        const auto first = field.H_m.begin() + row * posts;
        std::fill(first, first + posts, *first);
    }
    field.grid.lon.posts_per_deg = std::max(128.0 / 90.0, per_deg * sine_cosine_deg(lat_deg).cosine);
    field.grid.lon.first =
        static_cast<std::int64_t>((unit(random) * 360.0 - 180.0) * field.grid.lon.posts_per_deg);
    field.undulation.lat = {1.0, 0.0, 90, -1, 2};
    field.undulation.lon = {1.0, 0.0, -180, 1, 1};
    field.undulation.N_m = {37.25F, 37.25F};
    return Page(std::move(field));
}

// The same with heights that an eye can be at.
Page random_ground(double lat_deg, double page_m, std::mt19937_64& random) {
    const double relief_m = std::min(4000.0, 0.5 * page_m);
    const double room_m = highest_eye_m - lowest_eye_m - relief_m;
    const double base_m = lowest_eye_m + room_m * std::uniform_real_distribution<double>(0.0, 1.0)(random);
    return random_page(lat_deg, page_m, base_m, relief_m, random);
}

constexpr double latitudes_deg[] = {0.05,  20.0, 46.5,  60.0,  75.0,  88.0,  89.9,
                                    89.99, 90.0, -0.01, -33.0, -70.0, -89.8, -89.99};
// A page that reaches to the pole, where one of this size would lie beyond it.
double page_on_the_earth_m(double lat_deg, double page_m) {
    return std::min(page_m, (90.0 + lat_deg) * 111132.0);
}

struct Post {
    int row;
    int column;
};
Post random_post(std::mt19937_64& random) {
    return {static_cast<int>(random() % posts), static_cast<int>(random() % posts)};
}

// Somewhere in any direction from a post, in whatever longitude it is written; nothing where no eye is asked
// for.
std::optional<Geodetic> eye_near(const glm::dvec3& post_m, double distance_m, double highest_m,
                                 std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const glm::dvec3 any(normal(random), normal(random), normal(random));
    Geodetic eye = geodetic_from_ecef(Ecef{post_m + any / glm::length(any) * distance_m});
    if (eye.h_m < lowest_eye_m || eye.h_m > highest_m) return std::nullopt;
    if (random() % 4 == 0) eye.lon_deg += 360.0;
    return eye;
}

struct Worst {
    double error_m{};
    int posts{};
    int over_pole{};  // of these, on the other side of it
};

// Of posts within reach_m of eyes that are themselves that near to a post.
void place_posts_nearby(const Page& page, double reach_m, std::mt19937_64& random, Worst& worst) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        const Post near = random_post(random);
        const std::optional<Geodetic> eye =
            eye_near(page.truth_m(near.row, near.column), reach_m * unit(random), highest_eye_m, random);
        if (!eye) continue;
        const Frame frame(page, *eye);
        for (int j = 0; j < 200; ++j) {
            const Post post = j == 0 ? near : random_post(random);
            if (frame.distance_m(post.row, post.column) > reach_m) continue;
            worst.error_m = std::max(worst.error_m, frame.error_m(post.row, post.column));
            ++worst.posts;
            const double turn_deg =
                std::remainder(page.field.grid.lon.at_deg(post.column) - eye->lon_deg, 360.0);
            worst.over_pole += std::abs(turn_deg) > 90.0 ? 1 : 0;
        }
    }
}

// Pages around the eye: it is in their middle, and 2 km above and below are the highest and lowest posts.
TEST(Placement, Float32IsWithinAMillimetreOfGeographicLib) {
    const unsigned seed = 3;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::printf(
        "seed %u; the worst of 40,000 posts on 20 pages each, heights to 2 km above and below the eye\n",
        seed);
    std::printf("%-22s %10s %10s\n", "latitude", "4 km", "12 km");
    for (const double lat_deg : latitudes_deg) {
        std::printf("%-22.2f", lat_deg);
        for (const auto& [size_m, tolerance_m] : {std::pair{4000.0, 1e-3}, {12000.0, 2e-3}}) {
            double worst_m = 0.0;
            for (int i = 0; i < 20; ++i) {
                const double eye_h_m = -9000.0 + 16000.0 * unit(random);
                const Page page = random_page(lat_deg, page_on_the_earth_m(lat_deg, size_m), eye_h_m - 2000.0,
                                              4000.0, random);
                const GridAxis& lat = page.field.grid.lat;
                const Frame frame(page, {lat.at_deg(64), page.field.grid.lon.at_deg(64), eye_h_m});
                for (int j = 0; j < 2000; ++j) {
                    const Post post = random_post(random);
                    worst_m = std::max(worst_m, frame.error_m(post.row, post.column));
                }
            }
            std::printf(" %7.3f mm", worst_m * 1e3);
            EXPECT_LT(worst_m, tolerance_m) << lat_deg << " " << size_m;
        }
        std::printf("\n");
    }
}

// All posts within a distance of the eye, wherever it is.
TEST(Placement, HoldsForAllThatIsNear) {
    const unsigned seed = 3;
    std::mt19937_64 random(seed);
    std::printf(
        "seed %u; the worst of the posts of 20 pages within 4 km and 12 km of eyes at %.0f .. %.0f m\n", seed,
        lowest_eye_m, highest_eye_m);
    std::printf("%-10s %10s %8s %10s %8s\n", "latitude", "4 km", "posts", "12 km", "posts");
    int over_pole = 0;
    for (const double lat_deg : latitudes_deg) {
        std::printf("%-10.2f", lat_deg);
        for (const double reach_m : {placement_near_reach_m, 12000.0}) {
            const double tolerance_m = placement_error_m(reach_m);
            Worst worst;
            for (int i = 0; i < 20; ++i)
                place_posts_nearby(random_ground(lat_deg, page_on_the_earth_m(lat_deg, reach_m), random),
                                   reach_m, random, worst);
            std::printf(" %7.3f mm %8d", worst.error_m * 1e3, worst.posts);
            EXPECT_LT(worst.error_m, tolerance_m) << lat_deg << " " << reach_m;
            EXPECT_GT(worst.posts, 10000);
            over_pole += worst.over_pole;
        }
        std::printf("\n");
    }
    std::printf("%d of them on the other side of a pole\n", over_pole);
    EXPECT_GT(over_pole, 10000);
}

TEST(Placement, FromAfarTheErrorIsAShareOfTheDistance) {
    const unsigned seed = 4;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::printf("seed %u; worst error as a share of the distance (less 1 mm)\n", seed);
    std::printf("%-24s %10s %8s\n", "distance", "error", "posts");
    const double bands_m[] = {12.0e3, 50.0e3, 500.0e3, 4.0e6, 36.0e6, 3.844e8};
    for (std::size_t band = 0; band + 1 < std::size(bands_m); ++band) {
        double worst = 0.0;
        int placed = 0;
        for (int i = 0; i < 400; ++i) {
            const double lat_deg = i % 10 == 0 ? 89.999 : 179.0 * unit(random) - 89.0;
            const Page page = random_ground(lat_deg, 4000.0, random);
            for (int j = 0; j < 20; ++j) {
                const Post near = random_post(random);
                const double distance_m =
                    bands_m[band] * std::pow(bands_m[band + 1] / bands_m[band], unit(random));
                const std::optional<Geodetic> eye =
                    eye_near(page.truth_m(near.row, near.column), distance_m, 4.0e8, random);
                if (!eye) continue;
                const Frame frame(page, *eye);
                for (int k = 0; k < 20; ++k) {
                    const Post post = k == 0 ? near : random_post(random);
                    const double error_m = frame.error_m(post.row, post.column);
                    worst = std::max(worst,
                                     (error_m - placement_near_m) / frame.distance_m(post.row, post.column));
                    ++placed;
                }
            }
        }
        std::printf("%8.0f .. %6.0f km %15.2e %8d\n", bands_m[band] * 1e-3, bands_m[band + 1] * 1e-3, worst,
                    placed);
        EXPECT_LT(worst, placement_far_share);
        EXPECT_GT(placed, 30000);
    }
}

// Eyes over a pole see posts of all longitudes, and eyes beside the antimeridian those beyond it, near by.
TEST(Placement, HoldsOverThePolesAndAcrossTheAntimeridian) {
    double worst_m = 0.0;
    int placed = 0;
    // 129 x 129 posts of 36 m, a tenth of the way round.
    for (const double pole_deg : {90.0, -90.0}) {
        for (const double west_deg : {-180.0, -30.0, 90.0, 170.0}) {
            HeightField field = test::world_field(
                3200.0, pole_deg > 0.0 ? 90 * 3200 : -90 * 3200 + 128, 0, posts, posts,
                [](double lat_deg, double) { return 2800.0 - 9000.0 * (90.0 - std::abs(lat_deg)); });
            field.grid.lon = {128.0 / 36.0, west_deg, 0, 1, posts};
            const Page page(std::move(field));
            for (const double h_m : {2800.0, 2802.0, 3700.0}) {
                for (const double eye_lat_deg : {90.0, 89.9999, 89.995}) {
                    const Frame frame(page, {std::copysign(eye_lat_deg, pole_deg), 12.5, h_m});
                    for (int i = 0; i < posts * posts; ++i) {
                        if (frame.distance_m(i / posts, i % posts) > 4000.0) continue;
                        worst_m = std::max(worst_m, frame.error_m(i / posts, i % posts));
                        ++placed;
                    }
                }
            }
        }
    }
    std::printf("over the poles: %.3f mm of %d posts\n", worst_m * 1e3, placed);
    EXPECT_LT(worst_m, 1.0e-3);
    EXPECT_GT(placed, 100000);

    worst_m = 0.0;
    placed = 0;
    for (const double lat_deg : {0.0, 47.0, -66.5}) {
        // Posts from 179.99 E to 179.997 W, and the same from 180.01 W to 179.997 W.
        for (const double west_deg : {179.99, -180.01}) {
            HeightField field = test::world_field(
                10000.0, std::llround(lat_deg * 10000.0), 0, posts, posts,
                [](double, double lon_deg) { return 1000.0 + 1.0e5 * std::abs(std::sin(lon_deg)) * 0.01; });
            field.grid.lon = {10000.0, west_deg, 0, 1, posts};
            const Page page(std::move(field));
            for (const double eye_lon_deg : {179.99, -179.99, 180.0, -180.0, 180.01, -179.99 + 360.0}) {
                const Frame frame(page, {lat_deg - 0.005, eye_lon_deg, 1500.0});
                for (int i = 0; i < posts * posts; ++i) {
                    ASSERT_LT(frame.distance_m(i / posts, i % posts), 4000.0);
                    worst_m = std::max(worst_m, frame.error_m(i / posts, i % posts));
                    ++placed;
                }
            }
        }
    }
    std::printf("across the antimeridian: %.3f mm of %d posts\n", worst_m * 1e3, placed);
    EXPECT_LT(worst_m, 1.0e-3);
}

}  // namespace
}  // namespace oro
