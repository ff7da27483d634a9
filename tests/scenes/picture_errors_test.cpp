// Must hold: at every drawn pixel the ground is within tau of where it truly is, on the picture; and so are
// what is seen, every edge and the skyline.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/base/parallel.h"
#include "core/measure/picture_errors.h"
#include "core/truth/view_set.h"
#include "geo/region/region.h"
#include "render/frame/depth_picture.h"
#include "tests/scenes/real_tiles.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/height_storage.h"
#include "tests/support/net_terrain.h"
#include "tests/support/real_views.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int width_px = 256, height_px = 144;
constexpr std::array taus_px{0.5, 1.0, 2.0, 4.0};

// All that was measured with one tau.
struct Measured {
    std::vector<float> displacement_m, displacement_px, surface_px, seen_px, skyline_px;
    std::uint64_t drawn{}, beyond_data{}, in_one_only{}, violations{}, triangles{};

    void add(const DepthPicture& picture, const PictureErrors& errors) {
        const auto append = [](std::vector<float>& all, const std::vector<float>& some) {
            std::copy_if(some.begin(), some.end(), std::back_inserter(all),
                         [](float value) { return value != not_measured; });
        };
        append(displacement_m, errors.ground.displacement_m);
        append(displacement_px, errors.ground.displacement_px);
        append(surface_px, errors.ground.surface_px);
        append(seen_px, errors.seen.px);
        append(skyline_px, errors.skyline.px);
        drawn += errors.ground.drawn;
        beyond_data += errors.ground.beyond_data;
        in_one_only += errors.skyline.in_one_only;
        triangles += picture.report.counts.triangles_drawn;
    }
};

void print_row(const char* what, const ErrorSummary& of) {
    std::printf("  %-16s %12.5f %12.5f %12.5f %12.6f  (%llu)\n", what, of.largest, of.p9999, of.p99, of.mean,
                static_cast<unsigned long long>(of.count));
}

class ErrorsOfPictures : public test::GpuTest {
  protected:
    std::array<Measured, taus_px.size()> measured;

    void say_violation(const char* name, int view, const Camera& camera, double tau_px,
                       const PictureErrors& errors) {
        ADD_FAILURE() << name << ", view " << view << ": displacement "
                      << errors.ground.summary_displacement_px.largest << " px, seen "
                      << errors.seen.summary_px.largest << " px, skyline "
                      << errors.skyline.summary_px.largest << " px at tau " << tau_px << "; eye "
                      << camera.eye.lat_deg << "," << camera.eye.lon_deg << " h " << camera.eye.h_m
                      << " heading " << camera.attitude.heading_deg << " pitch " << camera.attitude.pitch_deg
                      << " roll " << camera.attitude.roll_deg << " fov " << camera.vertical_fov_deg;
    }

    void look(const char* name, const HeightField& field, int views) {
        auto made = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {std::uint64_t{512} << 20U, 0},
                                  test::asked_heights());
        ASSERT_TRUE(made.ok()) << made.error().line();
        Scene scene = std::move(made).value();
        const TrueSurface surface(field, 1.0, thread_count());
        DepthPainter painter(*gpu_, RasterPath::compute);
        const std::vector<Camera> cameras =
            made_cameras(test::real_view_seed, field, views, width_px, height_px);
        for (int view = 0; view < views; ++view) {
            const Camera& camera = cameras[static_cast<std::size_t>(view)];
            const Sight sight = sight_from(camera.eye);
            const TruePicture truth(surface, sight, camera, thread_count());
            for (std::size_t i = 0; i < taus_px.size(); ++i) {
                DepthPictureOptions options;
                options.tau_px = taus_px[i];
                const auto picture = painter.draw(scene, camera, {}, options);
                ASSERT_TRUE(picture.ok()) << picture.error().line();
                ASSERT_TRUE(picture->settled);
                const PictureErrors errors =
                    picture_errors(truth, picture->points, picture->skylines(), thread_count());
                measured[i].add(*picture, errors);
                // Whatever is measured, by any of the four.
                if (errors.largest_px() <= taus_px[i] + errors.slack_px) continue;
                ++measured[i].violations;
                say_violation(name, view, camera, taus_px[i], errors);
            }
        }
    }

    void print_all(const char* of, int views) {
        std::printf("%s, seed %llu, %d views of %d x %d px\n", of,
                    static_cast<unsigned long long>(test::real_view_seed), views, width_px, height_px);
        for (std::size_t i = 0; i < taus_px.size(); ++i) {
            const Measured& all = measured[i];
            std::printf("tau %.1f px         %12s %12s %12s %12s\n", taus_px[i], "largest", "99.99 %", "99 %",
                        "mean");
            print_row("displacement, m", summary_of(std::span<const float>(all.displacement_m)));
            print_row("displacement, px", summary_of(std::span<const float>(all.displacement_px)));
            print_row("surface, px", summary_of(std::span<const float>(all.surface_px)));
            print_row("seen, px", summary_of(std::span<const float>(all.seen_px)));
            print_row("skyline, px", summary_of(std::span<const float>(all.skyline_px)));
            std::printf(
                "  %llu pixels of ground, %llu of them over no data; %llu columns with ground in one only; "
                "%llu triangles\n",
                static_cast<unsigned long long>(all.drawn), static_cast<unsigned long long>(all.beyond_data),
                static_cast<unsigned long long>(all.in_one_only),
                static_cast<unsigned long long>(all.triangles));
            EXPECT_EQ(all.violations, 0U) << "views at tau " << taus_px[i];
            EXPECT_GT(all.displacement_px.size(), static_cast<std::size_t>(views) * width_px * height_px / 4)
                << "or the test sees the sky";
            EXPECT_LE(all.beyond_data, all.drawn / 100);
        }
    }

    // Views of a folder of real data.
    void look_over(const char* folder, const char* tiles, int views) {
        const auto region = test::open_tiles(folder, tiles);
        ASSERT_TRUE(region.ok()) << region.error().line();
        look(folder, region->grids[0].field, views);
    }
};

TEST_F(ErrorsOfPictures, OfMadeTerrainIsWithinTau) {
    const int views = (test::view_count(15) + 4) / 5;
    look("made terrain", test::rough_field(47.0, 8.0, 700, 900), views);
    print_all("made terrain", views);
}

// Posts that lie on nets: turned, and over a pole.
TEST_F(ErrorsOfPictures, OnNetsIsWithinTau) {
    const int views = (test::view_count(15) + 4) / 5;
    look("a turned net", test::net_field({700, 900, {46.5, 8.0}, 80.0, 27.0}, test::patchy_H_m, 40.0F),
         views);
    look("a net over the pole", test::net_field({700, 700, {89.9, 40.0}, 90.0, 0.0}, test::patchy_H_m),
         views);
    print_all("nets", 2 * views);
}

TEST_F(ErrorsOfPictures, OfRealTerrainIsWithinTau) {
    const int views = test::view_count(15);
    for (std::size_t i = 0; i < test::real_regions.size(); ++i) {
        const test::RealRegion& region = test::real_regions[i];
        if (!test::real_data(region.folder)) GTEST_SKIP() << "needs " << region.folder;
        look_over(region.folder, region.tiles, test::views_of(i, views));
    }
    print_all("alps, himalaya, poland", views);
}

}  // namespace
}  // namespace oro
