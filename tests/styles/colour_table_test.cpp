// Colour tables in text against gdaldem color-relief, and what is wrong in them.
#include "apps/styles/colour_table.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

constexpr double post_m = 30.0;

// Heights rise by 4 m a post to the east and 1.3 m to the south: all of the tables below, and beyond.
double ramp_m(int row, int column) {
    return 1200.0 + 4.0 * column + 1.3 * row;
}

class ColourTables : public test::StyleTest {
  protected:
    void SetUp() override {
        test::StyleTest::SetUp();
        region_.grids[0].field = test::square_field(46.5, 8.0, post_m, 160, ramp_m);
        raster_ = test::local_raster(region_.grids[0].field, post_m, post_m);
    }

    // Largest difference of a byte, at pixels within 0.1 m of a post's height.
    void hold(const char* what, const std::string& text) {
        SCOPED_TRACE(what);
        const std::filesystem::path table = test::scratch_folder() / "table.txt";
        std::ofstream(table) << text;
        const auto bands = test::gdaldem(raster_, "color-relief", table.c_str());
        ASSERT_GE(bands.size(), 3U);
        const Camera camera = test::straight_down(region_.grids[0].field, post_m, 150.0, 900);
        const auto style = style_of(text, ".txt", camera, region_.grids[0].field);
        ASSERT_TRUE(style.ok()) << style.error().line();
        const auto picture = drawn(region_, camera, *style);
        ASSERT_TRUE(picture);
        int compared = 0;
        double worst = 0.0;
        for (std::size_t pixel = 0; pixel < picture->points.size(); ++pixel) {
            const DrawnPoint& point = picture->points[pixel];
            if (point.background()) continue;
            const int row = static_cast<int>(std::lround(point.row)),
                      column = static_cast<int>(std::lround(point.column));
            if (std::abs(4.0 * (point.column - column) + 1.3 * (point.row - row)) > 0.1) continue;
            ++compared;
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst,
                                 std::abs(picture->rgba[4 * pixel + c] - double{bands[c].at(row, column)}));
        }
        std::printf("%s: %d pixels at posts, off by up to %.0f of 255\n", what, compared, worst);
        EXPECT_GT(compared, 10000);
        EXPECT_LE(worst, 1.0) << "of 255";
    }

    Region region_{std::vector<RegionGrid>(1)};
    std::filesystem::path raster_;
};

TEST_F(ColourTables, AreReadAndMixedAsGdaldemDoes) {
    hold("numbers, names, comments",
         "# heights\n1300 10 20 200\n1500,250,30,20\n/ more\n1600:0:255:0:128\n1750\tyellow\n\n");
    hold("percentages and a background", "nv 255 0 255\n0% 0 0 0\n50% 200 100 0 255\n100% 255 255 255\n");
    hold("not in order, with a sign and a power", "+1.7e3 255 255 255\n1250.5 0 0 90\n1400 90 200 40\n");
    // Between posts' heights, all of which are multiples of 0.1 m.
    hold("a step", "1200 0 0 0\n1500.05 255 0 0\n1500.05 0 0 255\n1900 255 255 255\n");
    hold("one colour", "1500 12 34 56\n");
}

TEST_F(ColourTables, KnowGdaldemsNamesOfColours) {
    for (const char* name : {"white", "black", "red", "green", "blue", "yellow", "magenta", "cyan", "aqua",
                             "grey", "gray", "orange", "brown", "purple", "violet", "indigo"}) {
        const std::string text = std::string("1500 ") + name + "\n";
        const std::filesystem::path table = test::scratch_folder() / "table.txt";
        std::ofstream(table) << text;
        const auto bands = test::gdaldem(raster_, "color-relief", table.c_str());
        ASSERT_GE(bands.size(), 3U) << name;
        const auto style = style_of_colour_table(text, "t", [] { return HeightRange{}; });
        ASSERT_TRUE(style.ok()) << style.error().line();
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(255.0F * style->tints[0].colour[c], bands[static_cast<std::size_t>(c)].at(5, 5),
                        0.01F)
                << name;
    }
}

// The codes of a table's colour at a height, as the shader mixes stops: it takes the first that is above.
std::array<int, 3> colour_at(const gpu::FrameStyle& style, float H_m) {
    gpu::uint above = 0;
    while (above < style.tint_count && !(H_m < style.tints[above].at)) ++above;
    const gpu::TintStop &high = style.tints[std::min(above, style.tint_count - 1)],
                        &low = style.tints[above == 0 ? 0 : above - 1];
    const float share = high.at > low.at ? std::clamp((H_m - low.at) / (high.at - low.at), 0.0F, 1.0F) : 0.0F;
    std::array<int, 3> codes{};
    for (int c = 0; c < 3; ++c)
        codes[static_cast<std::size_t>(c)] = static_cast<int>(
            std::lround(255.0F * (low.colour[c] + share * (high.colour[c] - low.colour[c]))));
    return codes;
}

using MapCodes = std::array<int, 3>;
constexpr MapCodes no_class{244, 243, 238}, blue{43, 131, 186}, green{171, 221, 164}, yellow{255, 255, 191},
    red{215, 25, 28};

// QGIS 3 (QgsColorRampShader::shade): the colour of the first class that is not below the height.
TEST(ColourTableText, ClassesOfQgisHoldUpToTheirHeight) {
    const std::string table =
        "# QGIS Generated Color Map Export File\nINTERPOLATION:DISCRETE\n250,43,131,186,255,<= 250\n"
        "400,171,221,164,255,250 - 400\n550,255,255,191,255,400 - 550\n";
    const auto style =
        style_of_colour_table(table + "inf,215,25,28,255,> 550\n", "t", [] { return HeightRange{}; });
    ASSERT_TRUE(style.ok()) << style.error().line();
    for (const auto& [H_m, codes] : {std::pair{-100.0F, blue},
                                     {250.0F, blue},
                                     {250.01F, green},
                                     {399.0F, green},
                                     {400.0F, green},
                                     {401.0F, yellow},
                                     {550.0F, yellow},
                                     {551.0F, red},
                                     {9000.0F, red}})
        EXPECT_EQ(colour_at(*style, H_m), codes) << H_m;
    // Without a class above all, what is higher has no colour.
    const auto open = style_of_colour_table(table, "t", [] { return HeightRange{}; });
    ASSERT_TRUE(open.ok()) << open.error().line();
    EXPECT_EQ(colour_at(*open, 550.0F), yellow);
    EXPECT_EQ(colour_at(*open, 551.0F), no_class);
}

TEST(ColourTableText, QgisMixesColoursAndHasExactOnes) {
    const auto mixed = style_of_colour_table(
        "\nINTERPOLATION:INTERPOLATED\n250,43,131,186,255,250\n400,171,221,164,255,400\ninf,215,25,28,255,> "
        "400\n",
        "t", [] { return HeightRange{}; });
    ASSERT_TRUE(mixed.ok()) << mixed.error().line();
    EXPECT_EQ(colour_at(*mixed, 250.0F), blue);
    EXPECT_EQ(colour_at(*mixed, 325.0F), (MapCodes{107, 176, 175}));  // the mean
    EXPECT_EQ(colour_at(*mixed, 5000.0F), green);                     // no share of what is infinitely far
    const auto exact =
        style_of_colour_table("INTERPOLATION:EXACT\n250,43,131,186,255,250\n251,171,221,164,255,251\n", "t",
                              [] { return HeightRange{}; });
    ASSERT_TRUE(exact.ok()) << exact.error().line();
    for (const auto& [H_m, codes] : {std::pair{249.99F, no_class},
                                     {250.0F, blue},
                                     {250.01F, no_class},
                                     {251.0F, green},
                                     {252.0F, no_class}})
        EXPECT_EQ(colour_at(*exact, H_m), codes) << H_m;
}

TEST(ColourTableText, FaultsAreToldWithTheirLine) {
    struct Bad {
        std::string text, says;
    };
    std::string long_table;
    for (int i = 0; i <= static_cast<int>(gpu::tint_stops_max); ++i)
        long_table += std::to_string(i) + " red\n";
    const std::array bad{
        Bad{"0 red\n10 pink\n", "t.txt, line 2: no colour is called 'pink'"},
        Bad{"0 red\nten 1 2 3\n", "t.txt, line 2: 'ten' is no height in metres"},
        Bad{"0 1 2 256\n", "t.txt, line 1: '256' is no number from 0 to 255"},
        Bad{"101% red\n", "'101%' is no percentage from 0 to 100"},
        Bad{"5\n", "t.txt, line 1: there is no colour"},
        Bad{"# nothing\nnv red\n", "t.txt: no line holds a height and a colour"},
        Bad{"nan red\n", "'nan' is no height in metres"}, Bad{"# COLOR_MODEL = RGB\n", "a palette of GMT"},
        // Latin-1, which no terminal shows; a bell and an escape; a file that is no text.
        Bad{"0 gr\xfcn\n", "no colour is called 'gr\uFFFDn'"},
        Bad{"5\x1b[2J\a red\n", "'5\uFFFD[2J\uFFFD' is no height in metres"},
        Bad{std::string("0 ") + std::string(5000, 'x') + "\n",
            "no colour is called '" + std::string(60, 'x') + "...'"},
        Bad{"0 " + std::string(59, 'x') + "\u00e9\u00e9\n",
            "no colour is called '" + std::string(59, 'x') + "...'"},
        Bad{"INTERPOLATION:NEAREST\n0 red\n",
            "t.txt, line 1: INTERPOLATION is INTERPOLATED, DISCRETE or EXACT, not 'NEAREST'"},
        Bad{"-inf red\n", "'-inf' is no height in metres"},
        Bad{"INTERPOLATION:DISCRETE\n" + long_table, "257 heights; a style has room for 128"},
        Bad{long_table, "257 heights; a style has room for 256"}};
    for (const Bad& one : bad) {
        const auto style = style_of_colour_table(one.text, "t.txt", [] { return HeightRange{}; });
        ASSERT_FALSE(style.ok()) << one.says;
        EXPECT_NE(style.error().line().find(one.says), std::string::npos) << style.error().line();
    }
}

}  // namespace
}  // namespace oro
