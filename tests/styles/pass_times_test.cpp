// Times of a frame's passes: each pass of shading has one, together they are what shading took, and who asks
// for them gets the picture of who does not.
#include <cstdint>
#include <string>
#include <vector>

#include "tests/styles/grown_frame.h"

namespace oro {
namespace {

class TimesOfPasses : public test::CulledGrowth {
  protected:
    struct Timed {
        FrameReport report;
        std::vector<std::uint8_t> rgba;
    };
    static constexpr std::uint32_t width_px = 160, height_px = 100;

    // A slope of needle trees from 40 m above it.
    Timed drawn(bool time_passes, RasterPath path) {
        const HeightField field = made_hills();
        auto scene = grown_scene(field, test::needle_cover, gpu::materials_with_trees, 1.0);
        EXPECT_TRUE(scene);
        if (!scene) return {};
        Camera camera;
        camera.eye = {46.48, 8.04, 1240.0};
        camera.attitude = {0.0, -12.0, 0.0};
        camera.width_px = width_px;
        camera.height_px = height_px;
        FrameRendererOptions options;
        options.extent = {width_px, height_px};
        options.path = path;
        options.time_passes = time_passes;
        FrameRenderer renderer = test::made_renderer(*gpu_, options);
        auto plan = scene->settled_plan({camera, test::whole_picture(camera), 1.0});
        EXPECT_TRUE(plan.ok());
        if (!plan.ok()) return {};
        auto report = renderer.draw(std::move(plan).value(), natural_style(field, gpu::materials_with_trees),
                                    0, 1, scene->drapes());
        EXPECT_TRUE(report.ok()) << report.error().line();
        auto rgba = renderer.read_picture(width_px, height_px);
        EXPECT_TRUE(rgba.ok());
        if (!report.ok() || !rgba.ok()) return {};
        return {std::move(report).value(), std::move(rgba).value()};
    }

    // What is drawn by a way, and its times.
    void expect_times_of_shading(RasterPath path) {
        const Timed timed = drawn(true, path);
        std::vector<std::string> names;
        double sum_s = 0.0;
        for (const PassTime& one : timed.report.passes) {
            names.push_back(one.pass);
            EXPECT_GE(one.s, 0.0) << one.pass;
            sum_s += one.s;
        }
        EXPECT_EQ(names, (std::vector<std::string>{"air", "shadows and sky", "sites in view",
                                                   "what stands there", "small crowns", "large crowns",
                                                   "ground of one place", "ground of several places",
                                                   "far forests", "colours of trees and grass", "mirrors",
                                                   "edges of the ground", "outlines of trees and grass"}));
        // But for the timestamps themselves, and what begins before the first and ends after the last.
        EXPECT_LE(sum_s, 1.001 * timed.report.shade_s);
        EXPECT_GE(sum_s, 0.5 * timed.report.shade_s);
        const Timed other = drawn(false, path);
        EXPECT_TRUE(other.report.passes.empty());
        EXPECT_EQ(timed.rgba, other.rgba);
    }
};

TEST_F(TimesOfPasses, AreThoseOfShading) {
    expect_times_of_shading(RasterPath::compute);
}
TEST_F(TimesOfPasses, AreThoseOfShadingByMeshShaders) {
    expect_times_of_shading(RasterPath::mesh);
}

}  // namespace
}  // namespace oro
