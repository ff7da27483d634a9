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
#include <random>

#include "core/page.h"
#include "tests/core/world_field.h"

namespace oro {
namespace {

constexpr std::uint32_t posts = gpu::page_posts;

glm::vec3 place_in_page(const gpu::PageBlock& block, std::uint32_t row, std::uint32_t column) {
    const gpu::RowTerms& t = block.rows[row];
    const gpu::ColumnTerms& u = block.columns[column];
    const float dh = block.dh[(row + 1) * gpu::height_stride + column + 1];
    const float r = t.P + dh * t.C;
    return {(t.R + dh * t.C) - r * u.V, r * u.W, t.Z + dh * t.S};
}

// The worst distance of a page's posts from where GeographicLib puts them. The page is page_m high, and as
// wide or (near a pole) a quarter of the way round.
double worst_error_m(double lat_deg, double page_m, std::mt19937_64& random, int samples) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double per_deg = std::round(128.0 * 111132.0 / page_m);
    const auto north = static_cast<std::int64_t>(std::floor(lat_deg * per_deg));
    const double base_m = -9000.0 + 16000.0 * unit(random);
    HeightField field = test::world_field(
        per_deg, north, 0, 129, 129, [&](double, double) { return base_m + 4000.0 * (unit(random) - 0.5); });
    field.grid.lon.posts_per_deg = std::max(128.0 / 90.0, per_deg * sine_cosine_deg(lat_deg).cosine);
    field.grid.lon.first =
        static_cast<std::int64_t>((unit(random) * 360.0 - 180.0) * field.grid.lon.posts_per_deg);
    field.undulation.lat = {1.0, 0.0, 90, -1, 2};
    field.undulation.lon = {1.0, 0.0, -180, 1, 1};
    field.undulation.N_m = {37.25F, 37.25F};
    auto block = std::make_unique<gpu::PageBlock>();
    const PageSummary page = build_page(field, region_shape(field, 1.0), {0, 0}, *block);
    double worst_m = 0.0;
    for (int i = 0; i < samples; ++i) {
        const auto row = static_cast<std::uint32_t>(unit(random) * posts);
        const auto column = static_cast<std::uint32_t>(unit(random) * posts);
        const int field_row = static_cast<int>(row);
        const int field_column = static_cast<int>(column);
        glm::dvec3 truth;
        GeographicLib::Geocentric::WGS84().Forward(
            field.grid.lat.at_deg(field_row), field.grid.lon.at_deg(field_column),
            field.h_at_post_m(field_row, field_column), truth.x, truth.y, truth.z);
        const glm::dvec3 got =
            page.origin_ecef.m + page.ecef_from_page * glm::dvec3(place_in_page(*block, row, column));
        worst_m = std::max(worst_m, glm::length(got - truth));
        // The rim's own form, high + low: only the height's step of 2^-11 m is left.
        if (row != 0 && row != posts - 1 && column != 0 && column != posts - 1) continue;
        const gpu::BorderPost& rim = block->borders[gpu::border_index_cpu(row, column)];
        EXPECT_LT(glm::length(glm::dvec3(rim.high) + glm::dvec3(rim.low) - truth),
                  0.5 * height_step_m + 1e-6);
    }
    return worst_m;
}

TEST(Placement, Float32IsWithinAMillimetreOfGeographicLib) {
    const unsigned seed = 3;
    std::mt19937_64 random(seed);
    std::printf(
        "seed %u; the worst of 40,000 posts on 20 pages each, heights to 2 km above and below the page's\n",
        seed);
    std::printf("%-22s %10s %10s\n", "latitude", "4 km", "12 km");
    for (const double lat_deg :
         {0.05, 20.0, 46.5, 60.0, 75.0, 88.0, 89.9, 89.99, -0.01, -33.0, -70.0, -89.8}) {
        std::printf("%-22.2f", lat_deg);
        for (const auto& [page_m, tolerance_m] : {std::pair{4000.0, 1e-3}, {12000.0, 2e-3}}) {
            double worst_m = 0.0;
            for (int i = 0; i < 20; ++i) {
                worst_m = std::max(worst_m, worst_error_m(lat_deg, page_m, random, 2000));
            }
            std::printf(" %7.3f mm", worst_m * 1e3);
            EXPECT_LT(worst_m, tolerance_m) << lat_deg << " " << page_m;
        }
        std::printf("\n");
    }
}

}  // namespace
}  // namespace oro
