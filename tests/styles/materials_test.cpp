// Ground of materials: what noise does to pictures, and what it leaves alone.
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

constexpr int picture_px = 128;

class MaterialPictures : public test::StyleTest {
  protected:
    // Ground that rises towards the north by `rise`, with square cells, 1,200 m high in its middle.
    static Region slope(double spacing_m, double rise) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(
            46.5, 8.0, spacing_m, 129, [&](int row, int) { return 1200.0 + rise * spacing_m * (64 - row); });
        return region;
    }

    // `natural` in the light of noon, without shadows and water.
    static gpu::FrameStyle natural(const Region& region, const SunDirection& sun = {180.0, 60.0}) {
        View view;
        view.style = (test::bundled_data() / "styles" / "natural.json").string();
        view.sun = sun;
        const auto style = load_style(view, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle frame = style->frame;
        frame.shadows = frame.sky_openness = 0;
        frame.water.on = 0;
        return frame;
    }

    // Straight down, so that a pixel has px_m of ground.
    static Camera down(const Region& region, double px_m) {
        const HeightField& field = region.grids[0].field;
        Camera camera = test::straight_down(field, px_m, picture_px, picture_px);
        camera.eye.h_m = 1200.0 + 1000.0 * px_m;
        camera.vertical_fov_deg = 2.0 * std::atan(0.5 * picture_px / 1000.0) * 180.0 / std::numbers::pi;
        return camera;
    }

    std::vector<std::uint8_t> picture(const Region& region, const Camera& camera,
                                      const gpu::FrameStyle& frame) {
        Style style{};
        style.frame = frame;
        auto found = drawn(region, camera, style, true);
        EXPECT_TRUE(found.has_value());
        return found ? std::move(found->rgba) : std::vector<std::uint8_t>(4 * picture_px * picture_px);
    }

    static std::array<double, 3> mean(const std::vector<std::uint8_t>& rgba) {
        std::array<double, 3> sum{};
        for (std::size_t i = 0; i < rgba.size(); ++i)
            if (i % 4 < 3) sum[i % 4] += 4.0 * rgba[i] / static_cast<double>(rgba.size());
        return sum;
    }
    // The light that a code stands for, as pictures are developed (shaders/shade/daylight.glsl: shown), and
    // the other way: light has a mean, of which codes would say less the more contrast there is.
    static double light_of(double code) {
        const double value = code / 255.0;
        double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        if (light > 0.35) light = 0.35 - 0.65 * std::log(1.0 - std::min((light - 0.35) / 0.65, 0.999));
        return 0.22 * std::pow(light / 0.22, 1.0 / 1.15);
    }
    static double code_of(double light) {
        double value = 0.22 * std::pow(light / 0.22, 1.15);
        if (value > 0.35) value = 0.35 + 0.65 * (1.0 - std::exp(-(value - 0.35) / 0.65));
        return 255.0 * (value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055);
    }
    static std::array<double, 3> mean_light(const std::vector<std::uint8_t>& rgba) {
        std::array<double, 3> sum{};
        for (std::size_t i = 0; i < rgba.size(); ++i)
            if (i % 4 < 3) sum[i % 4] += 4.0 * light_of(rgba[i]) / static_cast<double>(rgba.size());
        return sum;
    }
    // Root mean square of the codes from their mean.
    static double contrast(const std::vector<std::uint8_t>& rgba) {
        const std::array<double, 3> middle = mean(rgba);
        double sum = 0.0;
        for (std::size_t i = 0; i < rgba.size(); ++i)
            if (i % 4 < 3) sum += std::pow(rgba[i] - middle[i % 4], 2);
        return std::sqrt(sum / (0.75 * static_cast<double>(rgba.size())));
    }
};

// Patches and grain take from the one place what they give to the other.
TEST_F(MaterialPictures, HaveTheTablesMeanColour) {
    for (const double px_m : {20.0, 40.0, 2000.0}) {
        const Region region = slope(1.5 * px_m, 0.0);
        gpu::FrameStyle of_one = natural(region);
        const gpu::Material meadow = of_one.materials.of[gpu::material_meadow];
        for (gpu::Material& material : of_one.materials.of) {
            material = meadow;
            // Patches are kilometres wide, grain up to 400 m: of less ground the mean is that of its patch.
            if (px_m < 100.0) material.patches = gpu::vec3(0.0F);
        }
        gpu::FrameStyle flat = of_one;
        for (gpu::Material& material : flat.materials.of) {
            material.patches = gpu::vec3(0.0F);
            material.grain = 0.0F;
        }
        const Camera camera = down(region, px_m);
        const auto with = picture(region, camera, of_one), without = picture(region, camera, flat);
        const std::array<double, 3> one = mean(with), other = mean(without);
        std::printf(
            "%g m a pixel: %.2f %.2f %.2f, without noise %.2f %.2f %.2f; contrast %.2f and %.2f codes\n",
            px_m, one[0], one[1], one[2], other[0], other[1], other[2], contrast(with), contrast(without));
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(one[i], other[i], 1.0) << "codes, " << px_m << " m a pixel";
        if (px_m < 100.0) {
            // Half of it is forest, whose grain is that of crowns: less of it is left at such pixels.
            EXPECT_GT(contrast(with), contrast(without) + 3.5) << px_m << " m a pixel";
        }
    }
}

// A wall of rock, whose relief takes from the one place what it gives to the other: it is as light in the
// mean as without, whatever the sun. Seen level, as walls are. Seven pictures side by side, 768 m each: of
// one alone the colour's own grain, whose waves are up to 400 m long, is 1.4 to 2.0 codes off by each of the
// suns alike.
TEST_F(MaterialPictures, HaveRockReliefThatMakesNoLight) {
    constexpr double rise = 1.2, distance_m = 2500.0, wide_m = picture_px * 6.0;
    constexpr int pictures = 7;
    const Region region = slope(90.0, rise);
    for (const SunDirection& sun :
         {SunDirection{180.0, 30.0}, SunDirection{180.0, 65.0}, SunDirection{250.0, 40.0}}) {
        gpu::FrameStyle with = natural(region, sun);
        const gpu::Material rock = with.materials.of[gpu::material_rock];
        for (gpu::Material& material : with.materials.of) {
            material = rock;
            material.patches = gpu::vec3(0.0F);
        }
        gpu::FrameStyle without = with;
        for (gpu::Material& material : without.materials.of) material.grain = 0.0F;
        std::array<double, 3> one{}, other{};
        for (int i = 0; i < pictures; ++i) {
            // Six metres a pixel, the wall's middle in the picture's.
            Camera camera = down(region, 1.0);
            camera.attitude = {0.0, 0.0, 0.0};
            camera.eye.h_m = 1200.0;
            const auto degree_m = test::metres_per_degree(46.5, 1200.0);
            camera.eye.lat_deg -= distance_m / degree_m.lat;
            camera.eye.lon_deg += (i - pictures / 2) * wide_m / degree_m.lon;
            camera.vertical_fov_deg = 2.0 * std::atan(0.5 * wide_m / distance_m) * 180.0 / std::numbers::pi;
            const auto relief = picture(region, camera, with), smooth = picture(region, camera, without);
            EXPECT_GT(contrast(relief), contrast(smooth) + 6.0) << "codes";
            for (std::size_t c = 0; c < 3; ++c) {
                one[c] += mean_light(relief)[c] / pictures;
                other[c] += mean_light(smooth)[c] / pictures;
            }
        }
        std::printf("sun %.0f,%.0f: %.2f %.2f %.2f, without relief %.2f %.2f %.2f\n", sun.azimuth_deg,
                    sun.elevation_deg, code_of(one[0]), code_of(one[1]), code_of(one[2]), code_of(other[0]),
                    code_of(other[1]), code_of(other[2]));
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(code_of(one[c]), code_of(other[c]), 1.0) << "codes";
    }
}

// What is drawn belongs to the ground: an eye that goes sixteen pixels on sees it moved by sixteen pixels.
TEST_F(MaterialPictures, StayWhereTheyAre) {
    const Region region = slope(30.0, 0.3);
    const gpu::FrameStyle style = natural(region);
    const Camera here = down(region, 1.0);
    Camera there = here;
    constexpr int moved_px = 16;
    // A sixteenth of the picture's width of ground, at the height of the ground; the eye's circle is larger.
    there.eye.lon_deg += moved_px / test::metres_per_degree(46.5, 1200.0).lon;
    const auto one = picture(region, here, style), other = picture(region, there, style);
    double sum = 0.0, still = 0.0, count = 0.0;
    for (int row = 8; row < picture_px - 8; ++row) {
        for (int column = 8; column < picture_px - moved_px - 8; ++column) {
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int of) {
                    return static_cast<std::size_t>(4 * (picture_px * row + of) + c);
                };
                sum += std::abs(other[at(column)] - one[at(column + moved_px)]);
                still += std::abs(other[at(column)] - one[at(column)]);
                count += 1.0;
            }
        }
    }
    std::printf("%.2f codes from where it was, %.2f if it had not moved\n", sum / count, still / count);
    EXPECT_LT(sum / count, 2.0) << "codes; rays go through other parts of the pixels";
    EXPECT_GT(still / count, 2.0 * sum / count) << "or there is nothing to see";
}

// No octave is shorter than two pixels: between its pixels a picture is what they say.
TEST_F(MaterialPictures, AreSampledFinelyEnough) {
    const Region region = slope(30.0, 0.3);
    const gpu::FrameStyle style = natural(region);
    const Camera here = down(region, 1.0);
    Camera there = here;
    there.eye.lon_deg += 0.5 / test::metres_per_degree(46.5, 1200.0).lon;
    const auto one = picture(region, here, style), other = picture(region, there, style);
    double sum = 0.0, count = 0.0;
    for (int row = 8; row < picture_px - 8; ++row) {
        for (int column = 8; column < picture_px - 8; ++column) {
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int of) {
                    return static_cast<std::size_t>(4 * (picture_px * row + of) + c);
                };
                sum += std::abs(other[at(column)] - 0.5 * (one[at(column)] + one[at(column + 1)]));
                count += 1.0;
            }
        }
    }
    std::printf("half a pixel on: %.2f codes\n", sum / count);
    EXPECT_LE(sum / count, 2.0) << "codes";
}

// Tilled ground of 2 degrees is in parcels: pixels beside each other are of one parcel and alike, and the
// picture has their contrasts. They belong to the ground and end where it is steep.
TEST_F(MaterialPictures, HaveParcelsOnTilledGround) {
    constexpr double px_m = 12.0;
    constexpr int moved_px = 16;
    const auto of_crops = [&](const Region& region) {
        gpu::FrameStyle style = natural(region);
        gpu::Material crops = style.materials.of[gpu::material_crops];
        crops.grain = 0.0F;
        crops.patches = gpu::vec3(0.0F);
        for (gpu::Material& material : style.materials.of) material = crops;
        return style;
    };
    std::array<double, 2> contrasts{};
    for (const bool is_steep : {false, true}) {
        const Region region = slope(30.0, is_steep ? 0.30 : 0.03);
        const gpu::FrameStyle style = of_crops(region);
        Camera camera = down(region, px_m);
        const auto one = picture(region, camera, style);
        // Of each row: all of it is equally high.
        for (std::size_t row = 0; row < picture_px; ++row) {
            double sum = 0.0, squares = 0.0;
            for (std::size_t column = 0; column < picture_px; ++column) {
                const double value = one[4 * (picture_px * row + column) + 1];
                sum += value / picture_px;
                squares += value * value / picture_px;
            }
            contrasts[is_steep ? 1 : 0] += std::sqrt(std::max(squares - sum * sum, 0.0)) / picture_px;
        }
        camera.eye.lon_deg += moved_px * px_m / test::metres_per_degree(46.5, 1200.0).lon;
        const auto other = picture(region, camera, style);
        double moved = 0.0, count = 0.0;
        for (std::size_t i = 0; i < one.size(); ++i) {
            const std::size_t column = i / 4 % picture_px, row = i / 4 / picture_px;
            if (row < 8 || row >= picture_px - 8 || column < 8 || column >= picture_px - moved_px - 8)
                continue;
            moved += std::abs(other[i] - one[i + 4 * moved_px]);
            count += 1.0;
        }
        EXPECT_LT(moved / count, 1.0) << "codes from where it was";
    }
    std::printf("contrast of parcels %.2f codes, %.2f where it is steep\n", contrasts[0], contrasts[1]);
    EXPECT_GT(contrasts[0], 3.0) << "codes";
    EXPECT_LT(contrasts[1], 1.0) << "codes";
}

// A high plain across 28.7 degrees north, of which the style has deserts: 390 km of it, from far above.
// Found: they ended along the parallel, but for speckles.
TEST_F(MaterialPictures, DesertsHaveNoBorderAlongAParallel) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(
        28.7, 84.0, 3000.0, 129, [](int row, int column) { return 3700.0 + (row + column) % 2; });
    gpu::FrameStyle style = natural(region);
    style.air.on = 1;
    Camera camera = down(region, 3000.0);
    const auto seen = picture(region, camera, style);
    // Stripes of eight columns: how many of a stripe's rows are more red than green, in pixels.
    std::vector<double> borders;
    for (int first = 4; first + 8 <= picture_px - 4; first += 8) {
        double dry = 0.0;
        for (int row = 4; row < picture_px - 4; ++row) {
            for (int column = first; column < first + 8; ++column) {
                const auto at = static_cast<std::size_t>(4 * (picture_px * row + column));
                dry += seen[at] > seen[at + 1] ? 0.125 : 0.0;
            }
        }
        borders.push_back(dry);
    }
    double sum = 0.0, squares = 0.0;
    for (const double border : borders) {
        sum += border;
        squares += border * border;
    }
    const double count = static_cast<double>(borders.size()), mean = sum / count;
    const double km = 3.0 * std::sqrt(squares / count - mean * mean);
    std::printf("dry rows %.1f of %d; the border winds by %.1f km r.m.s.\n", mean, picture_px - 8, km);
    EXPECT_GT(mean, 20.0);
    EXPECT_LT(mean, 100.0);
    EXPECT_GT(km, 15.0);
}

// A lake, against the sun. Found: 17 % of the picture was one white, up to a hard edge.
TEST_F(MaterialPictures, LakesGlitterInManyTones) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 60.0, 129, [](int, int) { return 400.0; });
    gpu::FrameStyle style = natural(region, {0.0, 30.0});
    style.water.on = 1;
    Camera camera = down(region, 1.0);
    camera.eye.lat_deg -= 1400.0 / test::metres_per_degree(46.5, 400.0).lat;
    camera.eye.h_m = 400.0 + 700.0;
    camera.attitude = {0.0, -28.0, 0.0};
    camera.vertical_fov_deg = 40.0;
    const auto seen = picture(region, camera, style);
    double white = 0.0, bright = 0.0, rough = 0.0, count = 0.0;
    int most = 0;
    for (std::size_t i = 1; i + 16 < seen.size(); i += 4) {
        most = std::max<int>(most, seen[i]);
        white += seen[i] >= 253 ? 1.0 : 0.0;
        if (seen[i] < 170) continue;
        bright += 1.0;
        // Four pixels on.
        rough += std::pow(static_cast<double>(seen[i]) - seen[i + 16], 2);
        count += 1.0;
    }
    const double pixels = picture_px * picture_px, rms = std::sqrt(rough / std::max(count, 1.0));
    std::printf("green up to %d; white %.3f of all, bright %.3f, which differs by %.1f codes r.m.s.\n", most,
                white / pixels, bright / pixels, rms);
    EXPECT_GE(most, 190) << "or there is no path of light";
    EXPECT_GT(bright / pixels, 0.02);
    EXPECT_LT(white / pixels, 0.01);
    EXPECT_GT(rms, 6.0) << "codes";
}

// Waves are no finer than pixels: between its pixels a picture of water is what they say, straight down and
// along the water, towards the sun.
TEST_F(MaterialPictures, HaveWavesThatAreSampledFinelyEnough) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, [](int, int) { return 1200.0; });
    for (const double px_m : {0.3, 1.0, 5.0, 0.0}) {
        const bool along = px_m == 0.0;
        gpu::FrameStyle style = natural(region, along ? SunDirection{0.0, 15.0} : SunDirection{180.0, 75.0});
        style.water.on = 1;
        Camera here = down(region, along ? 1.0 : px_m), there = here;
        if (along) {
            here.eye.h_m = 1230.0;
            here.attitude = {0.0, -12.0, 0.0};
            here.vertical_fov_deg = 15.0;
            there = here;
            there.attitude.heading_deg += 0.5 * 15.0 / picture_px;
        } else {
            there.eye.lon_deg += 0.5 * px_m / test::metres_per_degree(46.5, 1200.0).lon;
        }
        const auto one = picture(region, here, style), other = picture(region, there, style);
        double sum = 0.0, count = 0.0;
        for (int row = 8; row < picture_px - 8; ++row) {
            for (int column = 8; column < picture_px - 8; ++column) {
                for (int c = 0; c < 3; ++c) {
                    const auto at = [&](int of) {
                        return static_cast<std::size_t>(4 * (picture_px * row + of) + c);
                    };
                    sum += std::abs(other[at(column)] - 0.5 * (one[at(column)] + one[at(column + 1)]));
                    count += 1.0;
                }
            }
        }
        std::printf("water, %s: half a pixel on %.2f codes, contrast %.1f\n",
                    along ? "along it" : std::to_string(px_m).c_str(), sum / count, contrast(one));
        EXPECT_LE(sum / count, 2.0) << "codes, " << px_m;
        EXPECT_GT(contrast(one), 1.0) << "or there is nothing to see";
    }
}

// Where a style has none, nothing is asked for.
TEST_F(MaterialPictures, AreOfNaturalAlone) {
    const Region region = slope(30.0, 0.0);
    for (const auto& entry : std::filesystem::directory_iterator(test::bundled_data() / "styles")) {
        View view;
        view.style = entry.path().string();
        const auto style = load_style(view, region.grids[0].field);
        ASSERT_TRUE(style.ok()) << style.error().line();
        EXPECT_EQ(style->frame.materials.on != 0, entry.path().stem() == "natural") << entry.path();
    }
}

TEST_F(MaterialPictures, RefuseWhatIsAmiss) {
    std::ifstream file(test::bundled_data() / "styles" / "natural.json");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const Region region = slope(30.0, 0.0);
    const auto line_of = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        const std::size_t at = changed.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
        const auto style = style_of(changed, ".json", Camera{}, region.grids[0].field);
        return style.ok() ? std::string() : style.error().line();
    };
    EXPECT_NE(line_of("\"scree\"", "\"gravel\"").find("'scree'"), std::string::npos);
    EXPECT_NE(line_of("\"snow_to_deg\": 48", "\"snow_to_deg\": 148").find("'snow_to_deg'"),
              std::string::npos);
    EXPECT_NE(line_of("\"lat_deg\": [28.7, 40]", "\"lat_deg\": [40, 28.7]").find("'lat_deg' must ascend"),
              std::string::npos);
    EXPECT_NE(line_of("\"grain\": 0.015 }", "\"grain\": 0.015, \"hue\": 1 }").find("hue"), std::string::npos);
}

}  // namespace
}  // namespace oro
