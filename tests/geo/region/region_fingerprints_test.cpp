// Fingerprints of sources and regions: of the posts, not of the files that hold them.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <string>

#include "geo/region/region_fingerprints.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::opened;
using test::request_for;

double hill(int row, int column) {
    return 300 + row * 7 % 400 + column * 5 % 300;
}

struct PostFingerprints {
    std::uint64_t source{}, region{}, geoid{};
    bool operator==(const PostFingerprints&) const = default;
};

PostFingerprints post_fingerprints(const RegionRequest& request) {
    std::string reason;
    const auto region = opened(request, &reason);
    EXPECT_TRUE(region) << reason;
    if (!region) return {};
    EXPECT_EQ(region->posts_hash, posts_hash(region->field));
    EXPECT_EQ(region->sources.size(), 1U);
    return {region->sources[0].posts_hash.value_or(0), region->posts_hash, region->geoid_fingerprint};
}

TEST(RegionFingerprints, AreThoseOfThePostsInEachContainer) {
    const fs::path folder = test::scratch_folder();
    fs::create_directory(folder / "zip");
    const std::string tile = test::write_hgt(folder / "N46E008.hgt", 1201, hill);
    const PostFingerprints usual = post_fingerprints(request_for({tile}));
    EXPECT_NE(usual.source, 0U);
    const std::string packed = (folder / "zip" / "any.zip").string();
    ASSERT_NE(test::write_bytes("/vsizip/" + packed + "/N46E008.hgt", test::hgt_bytes(1201, hill)), "");
    EXPECT_EQ(post_fingerprints(request_for({packed})), usual) << "a .zip";
    test::Raster raster;
    raster.rows = raster.columns = 1201;
    raster.cell_corners = test::posts_from(8.0, 47.0, 1200);
    for (const GDALDataType type : {GDT_Int16, GDT_Int32, GDT_Float32, GDT_Float64}) {
        raster.type = type;
        EXPECT_EQ(post_fingerprints(request_for({test::write_raster(folder / "other.tif", raster, hill)})),
                  usual)
            << type;
    }
    raster.points = true;
    EXPECT_EQ(post_fingerprints(request_for({test::write_raster(folder / "points.tif", raster, hill)})),
              usual);
}

TEST(RegionFingerprints, AreOthersForOtherPosts) {
    const fs::path folder = test::scratch_folder();
    const auto fingerprint = [&](const char* name, const test::HeightOfPost& height) {
        return post_fingerprints(request_for({test::write_hgt(folder / name, 1201, height)}));
    };
    const PostFingerprints usual = fingerprint("N46E008.hgt", hill);
    const PostFingerprints raised =
        fingerprint("N46E008.hgt", [](int r, int c) { return hill(r, c) + (r == 600 && c == 3); });
    EXPECT_NE(raised.source, usual.source);
    EXPECT_NE(raised.region, usual.region);
    EXPECT_EQ(raised.geoid, usual.geoid) << "the same place has the same N";
    const PostFingerprints elsewhere = fingerprint("N46E009.hgt", hill);
    EXPECT_NE(elsewhere.source, usual.source) << "the same heights elsewhere";
    EXPECT_NE(elsewhere.geoid, usual.geoid);
    const PostFingerprints voids =
        fingerprint("N46E008.hgt", [](int r, int c) { return r == 5 ? -32768 : hill(r, c); });
    EXPECT_NE(voids.source, usual.source);
}

// Two neighbours: what one brings does not depend on the other.
TEST(RegionFingerprints, OfOneSourceAreItsOwn) {
    const fs::path folder = test::scratch_folder();
    const std::string west = test::write_hgt(folder / "N46E008.hgt", 1201, hill);
    const std::string east = test::write_hgt(folder / "N46E009.hgt", 1201, hill);
    const auto both = opened(request_for({west, east}));
    ASSERT_TRUE(both);
    ASSERT_EQ(both->sources.size(), 2U);
    EXPECT_EQ(both->sources[0].posts_hash, post_fingerprints(request_for({west})).source);
    EXPECT_EQ(both->sources[1].posts_hash, post_fingerprints(request_for({east})).source);
}

TEST(RegionFingerprints, OfABoxAreThoseOfItsPosts) {
    const fs::path folder = test::scratch_folder();
    RegionRequest request = request_for({test::write_hgt(folder / "N46E008.hgt", 1201, hill)});
    const PostFingerprints whole = post_fingerprints(request);
    request.box = BoundingBox{8.2, 46.2, 8.4, 46.4};
    const PostFingerprints part = post_fingerprints(request);
    EXPECT_NE(part.region, whole.region);
    // What lies outside the box is another, what lies in it is not.
    const auto outside = [](int r, int c) { return r < 100 ? 7.0 : hill(r, c); };
    request.paths = {test::write_hgt(folder / "N46E008.hgt", 1201, outside)};
    EXPECT_EQ(post_fingerprints(request), part);
}

// What it costs: nothing that is felt beside reading a tile.
TEST(RegionFingerprints, CostLittle) {
    HeightField field;
    field.grid = {{1200, 0, 47 * 1200, -1, 1201}, {1200, 0, 8 * 1200, 1, 1201}};
    field.H_m.resize(field.grid.post_count());
    std::mt19937 random(11);
    for (float& H_m : field.H_m) H_m = static_cast<float>(random() % 4000);
    double best_ms = 1e9;
    for (int i = 0; i < 20; ++i) {
        const auto start = std::chrono::steady_clock::now();
        SourceFingerprint fingerprint;
        fingerprint.begin(field.grid, 0, 0, 1201, 1201);
        for (std::size_t row = 0; row < 1201; ++row)
            fingerprint.add(std::span(field.H_m).subspan(row * 1201, 1201));
        const std::uint64_t sum = fingerprint.value() + posts_hash(field);
        EXPECT_NE(sum, 0U);
        best_ms = std::min(
            best_ms,
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    std::printf("a tile's posts and a region's of as many: %.2f ms\n", best_ms);
    EXPECT_LT(best_ms, 40.0) << "some 1 ms on an idle machine; sanitizers take longer";
}

}  // namespace
}  // namespace oro
