// How far one sees by --visibility: what drawn pixels of the ground let through of its own light, against
// Koschmieder's law.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>

#include "apps/view/style.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// A basin, all of it below sea level: there the air of styles is as dense as at sea level everywhere.
constexpr double floor_h_m = -430.0, eye_above_m = 400.0;
constexpr int picture_side_px = 16;

// As a camera develops it (shaders/shade/daylight.glsl), and sRGB: the code of light from outside, and back.
double developed_code(double radiance, double exposure) {
    double light = 0.22 * std::pow(std::max(radiance * exposure, 0.0) / 0.22, 1.15);
    if (light > 0.35) light = 0.35 + 0.65 * (1.0 - std::exp(-(light - 0.35) / 0.65));
    return 255.0 * (light > 0.0031308 ? 1.055 * std::pow(light, 1.0 / 2.4) - 0.055 : 12.92 * light);
}
double radiance_of_code(double code, double exposure) {
    double low = 0.0, high = 100.0 / exposure;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (developed_code(middle, exposure) < code ? low : high) = middle;
    }
    return low;
}

// What the law leaves of the light of ground, 3.912 being -ln 0.02.
struct Through {
    double visibility_km;
    double from_above;  // of 400 m
    struct {
        double km;
        double share;
    } at[3];
};
constexpr std::array<Through, 3> by_the_law{
    {{10.0, 0.85515, {{2.5, 0.37606}, {5.0, 0.14142}, {10.0, 0.02000}}},
     {30.0, 0.94918, {{5.0, 0.52100}, {15.0, 0.14142}, {30.0, 0.02000}}},
     {100.0, 0.98447, {{10.0, 0.67624}, {20.0, 0.45731}, {40.0, 0.20913}}}}};

class Visibility : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        field_ = test::made_field(47.05, 8.0, 600.0, 330, 60,
                                  [](double, double) { return static_cast<float>(floor_h_m); });
        scene_.emplace(*gpu_, pages_in_memory(field_, 1.0, 2), RasterPath::compute, picture_side_px,
                       picture_side_px);
    }
    void TearDown() override {
        scene_.reset();
        GpuTest::TearDown();
    }

    // Even ground of one colour in a style with air, and what a user says of the air.
    [[nodiscard]] gpu::FrameStyle style_of(const char* colour, double visibility_km) const {
        const std::filesystem::path file = test::scratch_folder() / "style.json";
        std::ofstream(file)
            << R"({"tints": [{"H_m": -1000, "colour": ")" << colour
            << R"("}], "sun": {"azimuth_deg": 90, "elevation_deg": 60}, "ambient": 0.2, "no_data": "#000000",
                                  "relief": 1, "air": {"visibility_km": 150, "ground_albedo": 0.25,
                                  "exposure": 1}})";
        View view;
        view.style = file.string();
        view.visibility_km = visibility_km;
        const auto style = load_style(view, field_);
        EXPECT_TRUE(style.ok()) << style.error().line();
        return style.ok() ? style->frame : gpu::FrameStyle{};
    }

    // The mean green of the picture's two middle rows, and how bright the picture is.
    struct GreenOfPicture {
        double code, exposure;
    };
    GreenOfPicture drawn(double pitch_deg, const gpu::FrameStyle& style, bool is_sky = false) {
        if (style.air.on == 0) return {0.0, 1.0};  // was told
        Camera camera{{46.55, 8.05, floor_h_m + eye_above_m},
                      {0.0, pitch_deg, 0.0},
                      0.05,
                      picture_side_px,
                      picture_side_px};
        const test::DrawnFrame frame = scene_->draw(camera, 0.1, style);
        radius_m_ = static_cast<double>(frame.plan.grids[0].constants.earth_radius_m);
        const auto air = scene_->renderer().read_air();
        const auto rgba = scene_->renderer().read_picture(picture_side_px, picture_side_px);
        const auto depths = scene_->renderer().read_depths(picture_side_px, picture_side_px);
        EXPECT_TRUE(air.ok() && rgba.ok() && depths.ok());
        if (!air.ok() || !rgba.ok() || !depths.ok()) return {0.0, 1.0};
        double sum = 0.0;
        for (std::size_t i = 7 * picture_side_px; i < std::size_t{9} * picture_side_px; ++i) {
            EXPECT_EQ((*depths)[i] == 0.0F, is_sky) << "pixel " << i;
            sum += (*rgba)[4 * i + 1];
        }
        return {sum / (2 * picture_side_px),
                static_cast<double>((*air)[3 * std::size_t{gpu::air_exposure_at}])};
    }
    // Black ground, and white.
    struct Pair {
        GreenOfPicture black, white;
        [[nodiscard]] double of_ground() const {
            return radiance_of_code(white.code, white.exposure) -
                   radiance_of_code(black.code, black.exposure);
        }
    };
    Pair both(double pitch_deg, double visibility_km) {
        const GreenOfPicture black = drawn(pitch_deg, style_of("#000000", visibility_km));
        return {black, drawn(pitch_deg, style_of("#bcbcbc", visibility_km))};
    }

    // Towards ground so far away.
    [[nodiscard]] double pitch_deg(double far_m) const {
        const double eye = radius_m_ + floor_h_m + eye_above_m, ground = radius_m_ + floor_h_m;
        return -std::asin((eye * eye + far_m * far_m - ground * ground) / (2.0 * eye * far_m)) * 180.0 /
               std::numbers::pi;
    }

    HeightField field_;
    std::optional<test::DrawnScene> scene_;
    double radius_m_{6.37e6};
};

// By other visibilities of the table the pixel would have another colour by far.
template <class CodeBy>
void expect_no_other(const Through& one, double share, double drawn, double far_codes,
                     const CodeBy& code_by) {
    for (const Through& other : by_the_law) {
        if (other.visibility_km == one.visibility_km) continue;
        const double wrong = std::pow(share, one.visibility_km / other.visibility_km);
        EXPECT_GT(std::abs(drawn - code_by(wrong)), far_codes)
            << one.visibility_km << " km are seen as " << other.visibility_km;
    }
}

// Of ground that is as bright everywhere a pixel shows what the law leaves of its light, and what the air
// adds: the colour of black ground. What it sends out is seen from straight above. Black ground has the
// contrast to the sky above the horizon that the law leaves; both are of tables that are within 2 %.
TEST_F(Visibility, LeavesOfContrastsWhatKoschmiederSays) {
    constexpr double white_codes = 1.0, black_codes = 2.5;
    for (const Through& one : by_the_law) {
        const GreenOfPicture sky = drawn(0.05, style_of("#000000", one.visibility_km), true);
        const double of_sky = radiance_of_code(sky.code, sky.exposure);
        const double sent = both(-90.0, one.visibility_km).of_ground() / one.from_above;
        for (const auto& [km, share] : one.at) {
            const Pair there = both(pitch_deg(1000.0 * km), one.visibility_km);
            const double added = radiance_of_code(there.black.code, there.black.exposure);
            const auto white_by = [&](double through) {
                return developed_code(added + sent * through, there.white.exposure);
            };
            const auto black_by = [&](double contrast) {
                return developed_code(of_sky * (1.0 - contrast), there.black.exposure);
            };
            std::printf(
                "%3.0f km, ground %4.1f km away: white %.1f, by the law %.1f; black %.1f, by it %.1f; sky "
                "%.1f\n",
                one.visibility_km, km, there.white.code, white_by(share), there.black.code, black_by(share),
                sky.code);
            EXPECT_NEAR(there.white.code, white_by(share), white_codes) << one.visibility_km << ", " << km;
            EXPECT_NEAR(there.black.code, black_by(share), black_codes) << one.visibility_km << ", " << km;
            EXPECT_LT(there.white.code, 250.0) << "too bright to tell";
            // Where all but nothing is let through there is little to tell.
            expect_no_other(one, share, there.white.code, share > 0.1 ? 20.0 : 3.0, white_by);
            if (share > 0.1) expect_no_other(one, share, there.black.code, 10.0, black_by);
        }
    }
}

}  // namespace
}  // namespace oro
