// The narrowest and widest views, the smallest and largest pictures, and the smallest steps.
#include <GeographicLib/Geocentric.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/truth/oracle.h"
#include "render/frame/depth_picture.h"
#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/stage.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {
namespace {

constexpr const char* pictures_group = "Pictures and steps";

class ExtremePictures : public Extremes {};

TEST_F(ExtremePictures, FieldsOfView) {
    Stage stage(*gpu_, rough_field(46.9, 8.1, 300, 300));
    const Geodetic eye{46.66, 8.22, stage.ground_h_m(46.66, 8.22) + 600.0};
    const Geodetic target{46.85, 8.24, stage.ground_h_m(46.85, 8.24)};
    struct Look {
        const char* row;
        double fov_deg;
    };
    for (const Look& look :
         {Look{"field of view 0.05 degree", 0.05}, Look{"field of view 1 degree", 1.0},
          Look{"field of view 45 degrees", 45.0}, Look{"field of view 120 degrees", 120.0}}) {
        Camera camera = strip_camera(eye, attitude_towards(eye, target), look.fov_deg);
        const std::string seen = std::string(look.row) + ", what is seen";
        for (const double roll_deg : {0.0, 90.0, 200.0}) {
            camera.attitude.roll_deg = roll_deg;
            check_view(stage, camera, RasterPath::compute, pictures_group, look.row, seen.c_str(), 29);
        }
    }
}

TEST_F(ExtremePictures, Sizes) {
    Stage stage(*gpu_, rough_field(46.9, 8.1, 300, 300));
    DepthPainter painter(*gpu_, RasterPath::compute);
    struct Size {
        const char* row;
        int width_px, height_px;
        double fov_deg;
        int tiles;
    };
    for (const Size& size : {Size{"1 x 1 px", 1, 1, 45.0, 1}, Size{"1 x 16,384 px", 1, 16384, 60.0, 4},
                             Size{"16,384 x 16 px", 16384, 16, 0.1, 4}, Size{"4,097 x 3 px", 4097, 3, 0.1, 2},
                             Size{"3 x 5 px", 3, 5, 120.0, 1}}) {
        Camera camera;
        camera.eye = {46.7, 8.22, stage.ground_h_m(46.7, 8.22) + 300.0};
        camera.attitude = {30.0, -25.0, 0.0};
        camera.vertical_fov_deg = size.fov_deg;
        camera.width_px = size.width_px;
        camera.height_px = size.height_px;
        DepthPictureOptions options;
        options.tau_px = 0.0;
        options.skyline = false;
        const auto picture = painter.draw(stage.scene(), camera, {}, options);
        ASSERT_TRUE(picture.ok()) << picture.error().line();
        EXPECT_EQ(picture->tiles, size.tiles);
        const GroundErrors error = stage.ground(camera, picture->points);
        EXPECT_GT(error.drawn, 0U);
        measured(pictures_group, size.row, error.summary_displacement_px.largest, error.summary_displacement_px.count);
        const auto agreement =
            stage.agreement(camera, picture->depths, size.width_px * size.height_px > 1000 ? 13 : 1);
        measured(pictures_group, std::string(size.row) + ", what is seen", static_cast<double>(agreement.wrong),
                 agreement.pixels);
    }
}

// Must hold (jitter): an eye on the equator, 6,378 km from the Earth's centre, moves 1,000 times by a
// millimetre; each post is drawn where exact geometry puts it.
class Jitter : public Extremes {
  protected:
    static constexpr int posts = 33;  // a side
    static constexpr int steps = 1000;

    struct Noise {
        double worst_px{}, worst_step_px{};
        std::uint64_t places{};
    };

    void SetUp() override {
        Extremes::SetUp();
        // 3 m between posts, in whole steps of height: what is measured is where they are put.
        field_ = made_field(0.0005, 12.0, 36000.0, posts, posts, [](double lat, double lon) {
            return std::round(rough_H_m(lat, lon) * 0.01F * 2048.0F) / 2048.0F;
        });
        for (int i = 0; i < posts * posts; ++i) {
            glm::dvec3 at;
            GeographicLib::Geocentric::WGS84().Forward(
                field_.grid.lat.at_deg(i / posts), field_.grid.lon.at_deg(i % posts),
                field_.h_at_post_m(i / posts, i % posts), at.x, at.y, at.z);
            truth_.push_back(at);
        }
        camera_.vertical_fov_deg = 45.0;
        camera_.width_px = 16;
        camera_.height_px = 1080;
        // Straight down from 60 m, so that the whole patch is within the picture's height, and stepping to
        // the north-east and up.
        camera_.eye = {0.0005 - 16.0 / 36000.0, 12.0 + 16.0 / 36000.0, field_.h_at_post_m(16, 16) + 60.0};
        camera_.attitude = {20.0, -90.0, 0.0};
    }

    Noise walk(Precision precision) {
        Stage stage(*gpu_, field_);
        FrameRendererOptions options;
        options.extent = {16, 1080};
        options.record_positions = options.record_view = true;
        options.shades = false;
        auto renderer = FrameRenderer::create(*gpu_, options);
        EXPECT_TRUE(renderer.ok()) << renderer.error().line();
        Noise noise;
        std::vector<glm::dvec2> before;
        for (int step = 0; step < steps; ++step) {
            Camera camera = camera_;
            camera.eye.lat_deg += step * 0.0006 / 110574.0;
            camera.eye.lon_deg += step * 0.0006 / 111320.0;
            camera.eye.h_m += step * 0.000529;
            FramePlan plan =
                stage.plan(camera, {0, 0, 16, 1080, {0.5, 0.5}}, 0.0, {Earth::ellipsoid, {}, precision});
            for (gpu::FramePage& page : plan.grids[0].pages) page.cull = 0;
            EXPECT_TRUE(renderer->draw(std::move(plan), {}).ok());
            add(camera, renderer->recorded(std::size_t{129} * posts), before, noise);
        }
        return noise;
    }

  private:
    void add(const Camera& camera, const std::vector<gpu::vec3>& recorded, std::vector<glm::dvec2>& before,
             Noise& noise) const {
        const double px = 0.5 * camera.height_px / camera.half_fov_tangent().y;
        glm::dvec3 eye;
        GeographicLib::Geocentric::WGS84().Forward(camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m,
                                                   eye.x, eye.y, eye.z);
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        const bool first = before.empty();
        before.resize(truth_.size());
        for (std::size_t i = 0; i < truth_.size(); ++i) {
            const glm::dvec3 truth = view_from_ecef * (truth_[i] - eye);
            const glm::dvec3 drawn(recorded[i / posts * 129U + i % posts]);
            const glm::dvec2 off = (glm::dvec2(drawn) / drawn.z - glm::dvec2(truth) / truth.z) * px;
            noise.worst_px = std::max(noise.worst_px, glm::length(off));
            if (!first) noise.worst_step_px = std::max(noise.worst_step_px, glm::length(off - before[i]));
            before[i] = off;
            ++noise.places;
        }
    }

    HeightField field_;
    std::vector<glm::dvec3> truth_;
    Camera camera_;
};

TEST_F(Jitter, OfAThousandSteps) {
    const Noise relative = walk(Precision::relative);
    measured(pictures_group, "1,000 steps of 1 mm", relative.worst_px, relative.places);
    measured(pictures_group, "1,000 steps of 1 mm, from step to step", relative.worst_step_px, relative.places);
}

TEST_F(Jitter, OfNaiveFloats) {
    const Noise naive = walk(Precision::naive);
    measured(pictures_group, "1,000 steps of 1 mm, naive float32", naive.worst_px, naive.places);
}

}  // namespace
}  // namespace oro::test
