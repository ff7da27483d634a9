// The compute path hands triangles on in lists of a fixed size. Those that find no room are drawn all the
// same, and where they cannot be, the frame is an error. For triangles of blocks and of clusters.
#include <map>
#include <optional>

#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/drawn/occlusion_pairs.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

enum class FullListsOf { blocks, clusters };

class FullLists : public test::GpuTest, public ::testing::WithParamInterface<FullListsOf> {
  protected:
    static constexpr int width_px = 203, height_px = 117;

    FullLists() {
        if (GetParam() == FullListsOf::clusters) terrain_.emplace(field_);
    }

    FrameRenderer renderer(const ListRoom& room) {
        FrameRendererOptions options;
        options.extent = {width_px, height_px};
        options.path = RasterPath::compute;
        options.shades = false;
        options.keep_triangles = true;    // ids are read
        options.shares_triangles = true;  // or a processor would list next to nothing
        options.occlusion = OcclusionUse::off;
        options.list_room = room;
        return test::made_renderer(*gpu_, options);
    }
    Scene scene() {
        auto made = Scene::create(*gpu_, pages_in_memory(field_, 1.0, 2), {std::uint64_t{256} << 20U, 0});
        EXPECT_TRUE(made.ok()) << made.error().line();
        if (terrain_) test::draw_by_clusters(*gpu_, *terrain_, *made);
        return std::move(made).value();
    }
    // Of eyes 0.5 m to 20 km above the ground.
    std::vector<FramePlan> plans(Scene& scene) const {
        const test::EyeGround where{46.82, 46.97, 8.03, 8.22, [this](double lat_deg, double lon_deg) {
                                        return *ground_h_m(field_, lat_deg, lon_deg);
                                    }};
        std::mt19937 random(91);
        std::vector<FramePlan> made;
        for (int i = 0; i < 10; ++i) {
            const Camera camera = test::eyes_in_motion(where, random, width_px, height_px).first;
            auto plan = scene.settled_plan({camera, Tile{0, 0, width_px, height_px, {0.5, 0.5}}, 1.0});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            made.push_back(std::move(plan).value());
        }
        return made;
    }
    static std::vector<std::uint32_t> ids(FrameRenderer& renderer, const FramePlan& plan) {
        const auto report = renderer.draw(plan, {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        auto read = renderer.read_ids(width_px, height_px);
        EXPECT_TRUE(read.ok()) << read.error().line();
        return std::move(read).value();
    }
    // Triangles that show in more pixels than so many: their boxes have more, too.
    static std::size_t triangles_above_px(const std::vector<std::uint32_t>& ids, int count_px) {
        std::map<std::uint32_t, int> pixels;
        for (const std::uint32_t id : ids) ++pixels[id];
        pixels.erase(0U);  // the background
        return static_cast<std::size_t>(
            std::ranges::count_if(pixels, [&](const auto& one) { return one.second > count_px; }));
    }
    // How many triangles a frame's error tells of; none without one.
    static std::uint64_t lost_triangles(const Result<FrameReport>& report) {
        if (report.ok()) return 0;
        const std::string line = report.error().line();
        EXPECT_NE(line.find("more than the compute path can clip"), std::string::npos) << line;
        EXPECT_NE(line.find("--pipeline mesh"), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        const std::size_t digits = line.find_first_of("0123456789");
        return digits == std::string::npos ? 0 : std::stoull(line.substr(digits));
    }

    HeightField field_ = test::rough_field(47.0, 8.0, 240, 300);
    std::optional<test::ClusterTerrain> terrain_;
};

TEST_P(FullLists, PicturesAreThoseOfListsWithRoom) {
    Scene drawn = scene();
    ListRoom of_triangles, of_squares;
    of_triangles.boxes = 7;
    of_triangles.large = 3;
    of_squares.boxes = 1;
    of_squares.tasks = 40;
    FrameRenderer roomy = renderer({}), few_triangles = renderer(of_triangles),
                  few_squares = renderer(of_squares);
    int full = 0, full_of_large = 0;
    for (const FramePlan& plan : plans(drawn)) {
        const std::vector<std::uint32_t> wanted = ids(roomy, plan);
        EXPECT_EQ(ids(few_triangles, plan), wanted);
        EXPECT_EQ(ids(few_squares, plan), wanted);
        // All above 64 px are handed on, those above 1,024 px as large ones (shaders/raster/draw_alone.glsl).
        if (triangles_above_px(wanted, 64) > of_triangles.boxes + of_triangles.large) ++full;
        if (triangles_above_px(wanted, 1024) > of_triangles.large) ++full_of_large;
    }
    EXPECT_GE(full, 2);
    EXPECT_GE(full_of_large, 1);
}

// Triangles that must be cut can be drawn by no other step. Large ones come to that list where theirs is
// full.
TEST_P(FullLists, WhatCannotBeClippedIsAnError) {
    Scene drawn = scene();
    ListRoom none, none_for_large;
    none.clips = none_for_large.clips = none_for_large.large = 0;
    FrameRenderer roomy = renderer({}), without = renderer(none), without_large = renderer(none_for_large);
    std::uint64_t lost = 0, lost_with_large = 0;
    int drawn_without = 0;
    for (const FramePlan& plan : plans(drawn)) {
        const std::vector<std::uint32_t> wanted = ids(roomy, plan);
        const auto report = without.draw(plan, {});
        lost += lost_triangles(report);
        lost_with_large += lost_triangles(without_large.draw(plan, {}));
        if (!report.ok()) continue;
        ++drawn_without;
        EXPECT_EQ(ids(without, plan), wanted);
    }
    EXPECT_GT(lost, 0U);
    EXPECT_GT(drawn_without, 0);
    EXPECT_GT(lost_with_large, lost) << "or no list of large triangles was full";
}

INSTANTIATE_TEST_SUITE_P(Triangles, FullLists, ::testing::Values(FullListsOf::blocks, FullListsOf::clusters),
                         [](const auto& of) {
                             return std::string(of.param == FullListsOf::blocks ? "blocks" : "clusters");
                         });

}  // namespace
}  // namespace oro
