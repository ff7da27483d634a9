// What users see of a region's clusters: levels of the graph, and pictures that explain it.
#include <cstdlib>

#include "tests/apps/baked/clusters_baking.h"
#include "tests/apps/picture_pixels.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::ClustersDrawn;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::view_in;
using oro::test::Words;

// Coarser with each level, the coarsest beyond the last; drawn again from its picture to the same pixels.
TEST_F(ClustersDrawn, OneLevelOfTheGraph) {
    const auto triangles = [&](const Words& more) { return shot(more)["triangles"]["drawn"].get<int>(); };
    const int full = triangles({"--tau", "0"}), none = triangles({"--mesh-level", "0"});
    EXPECT_EQ(none, full) << "level 0 is the original";
    int last = none;
    for (const char* level : {"2", "5", "9"}) {
        const int drawn = triangles({"--mesh-level", level});
        EXPECT_LT(drawn, last) << level;
        EXPECT_GT(drawn, 0);
        last = drawn;
    }
    const json said = shot({"--mesh-level", "80"});
    EXPECT_LE(said["triangles"]["drawn"], last);
    EXPECT_EQ(said["mesh_level"], 80);
    EXPECT_EQ(json::parse(view_in(picture_))["mesh_level"], 80);
    const fs::path again = folder / "again.png";
    ASSERT_EQ(run_orograph({"shot", "--view", picture_, "--out", again, "-q"}).exit_code, 0);
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"],
              json::parse(view_in(picture_))["fingerprints"]["pixels"]);
    const Outcome measured = run_orograph({"compare", picture_});
    EXPECT_EQ(measured.exit_code, 0) << measured.err;
    EXPECT_NE(measured.err.find("--mesh-level 80) promises nothing"), std::string::npos) << measured.err;
    // An error in pixels takes its place.
    ASSERT_EQ(run_orograph({"shot", "--view", picture_, "--tau", "1", "--out", again, "-q", "--overwrite"})
                  .exit_code,
              0);
    EXPECT_FALSE(json::parse(view_in(again)).contains("mesh_level"));
}

TEST_F(ClustersDrawn, BothWaysDrawTheSameLevel) {
    const json mesh = shot({"--mesh-level", "4", "--pipeline", "mesh"}),
               compute = shot({"--mesh-level", "4", "--pipeline", "compute"});
    EXPECT_EQ(mesh["triangles"]["drawn"], compute["triangles"]["drawn"]);
    EXPECT_EQ(mesh["meshlets"]["drawn"], compute["meshlets"]["drawn"]);
}

// As a picture on a plane is: nearly the same pixels from other triangles, and drawn again by its view.
TEST_F(ClustersDrawn, PanoramasToo) {
    const auto draw = [&](const fs::path& from, const fs::path& to, const Words& more) {
        return object_said_by(
            joined(Words{"panorama", from, "--at", "36.53,-84.35", "--above", "300", "--width", "600",
                         "--elevation", "-20,5", "--out", to, "-q", "--json"},
                   more));
    };
    const fs::path clusters = folder / "clusters.png", blocks = folder / "blocks.png";
    const json by_clusters = draw(out_, clusters, {}), by_blocks = draw(out_, blocks, {"--mesh", "grid"});
    EXPECT_NE(by_clusters["triangles"], by_blocks["triangles"]);
    EXPECT_EQ(json::parse(view_in(clusters))["mesh"], "clusters");
    EXPECT_FALSE(json::parse(view_in(blocks)).contains("mesh"));
    const Pixels a = pixels_of(clusters), b = pixels_of(blocks);
    ASSERT_EQ(a.rgb.size(), b.rgb.size());
    double difference = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) difference += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
    EXPECT_LT(difference / static_cast<double>(a.rgb.size()), 3.0);
    EXPECT_GT(difference, 0.0);
    const fs::path again = folder / "again.png", plain = folder / "plain.png";
    ASSERT_EQ(run_orograph({"panorama", "--view", clusters, "--out", again, "-q"}).exit_code, 0);
    EXPECT_TRUE(pixels_of(again).rgb == a.rgb);
    const fs::path without = baked();
    draw(without, plain, {});
    EXPECT_TRUE(pixels_of(plain).rgb == b.rgb) << "blocks are those of a file without clusters";
    expect_refusal(run_orograph({"panorama", without, "--at", "36.53,-84.35", "--mesh", "clusters", "--out",
                                 folder / "none.png"}),
                   2, {"--mesh clusters", "bake it with --mesh clusters"});
}

TEST_F(ClustersDrawn, PanoramasOfOneLevelToo) {
    const fs::path fine = folder / "fine.png", level = folder / "level.png", again = folder / "again.png";
    const auto draw = [&](const fs::path& to, const Words& more) {
        return object_said_by(
            joined(Words{"panorama", out_, "--at", "36.53,-84.35", "--above", "300", "--width", "400",
                         "--elevation", "-20,5", "--out", to, "-q", "--json"},
                   more));
    };
    const json by_tau = draw(fine, {}), by_level = draw(level, {"--mesh-level", "8"});
    EXPECT_TRUE(by_tau["mesh_level"].is_null());
    EXPECT_EQ(by_level["mesh_level"], 8);
    EXPECT_EQ(json::parse(view_in(level))["mesh_level"], 8);
    EXPECT_FALSE(pixels_of(level).rgb == pixels_of(fine).rgb) << "not the cut of tau 1";
    ASSERT_EQ(run_orograph({"panorama", "--view", level, "--out", again, "-q"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(again) == bytes_of(level)) << "a view gives the same bytes";
}

// The same picture, and what groups take of the processor's memory is told.
TEST_F(ClustersDrawn, WithLittleMemoryForTheirGroups) {
    const json much = shot({"--memory", "1000"});
    const Pixels picture = pixels_of(picture_);
    const json little = shot({"--memory", "16"});
    EXPECT_TRUE(pixels_of(picture_).rgb == picture.rgb);
    EXPECT_EQ(little["triangles"]["drawn"], much["triangles"]["drawn"]);
    for (const json& said : {much, little}) {
        EXPECT_GT(said["clusters"]["on_gpu"], 0);
        EXPECT_GT(said["clusters"]["bytes_on_gpu"], 0);
        EXPECT_GT(said["clusters"]["groups_in_memory"], 0);
        EXPECT_GT(said["clusters"]["bytes_in_memory"], 10'000);
    }
    EXPECT_LE(little["clusters"]["bytes_in_memory"], 6'000'000) << "what this eye needs is less";
    EXPECT_TRUE(shot({"--mesh", "grid"})["clusters"].is_null());
}

TEST_F(ClustersDrawn, WhatDoesNotGoTogetherIsRefused) {
    expect_refusal(refused({"--mesh-level", "3", "--tau", "1"}), 2, {"--mesh-level", "--tau"});
    expect_refusal(refused({"--mesh-level", "3", "--accuracy", "survey"}), 2, {"--mesh-level", "--accuracy"});
    expect_refusal(refused({"--mesh-level", "3", "--mesh", "grid"}), 2, {"--mesh-level", "--mesh grid"});
    expect_refusal(refused({"--mesh-level", "81"}), 2, {"--mesh-level"});
    expect_refusal(refused({"--mesh-level", "3", "--earth", "flat"}), 2, {"--mesh-level", "ellipsoid"});
    expect_refusal(refused({"--show", "groups", "--mesh", "grid"}), 2, {"--show groups", "--mesh grid"});
    const fs::path plain = baked();
    for (const Words& more : {Words{"--mesh-level", "3"}, Words{"--show", "clusters"}})
        expect_refusal(
            run_orograph(joined(joined({"shot", plain, "-q", "--out", folder / "x.png"}, eye()), more)), 2,
            {more.front(), "the region has no clusters"});
}

// In a legend each kind says what it is.
TEST_F(ClustersDrawn, PicturesExplainTheGraph) {
    for (const char* show : {"clusters", "groups", "levels", "triangles", "meshlets", "visible"}) {
        const json said = shot({"--show", show});
        EXPECT_GT(said["view"]["legend_px"].get<int>(), 0) << show;
        EXPECT_EQ(json::parse(view_in(picture_))["mesh"], "clusters") << show;
        EXPECT_GT(said["triangles"]["drawn"], 0);
    }
    shot({"--show", "overdraw"});
    EXPECT_FALSE(json::parse(view_in(picture_)).contains("mesh")) << "overdraw is of blocks";
}

}  // namespace
