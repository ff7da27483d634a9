// Sheets: rulers at their places, and the same lines and text as SVG and as pixels.
#include "apps/panorama/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "apps/panorama/rulers.h"

namespace oro {
namespace {

Sheet ruled(const Cylinder& around, const Rulers& rulers, const std::string& reported = "eye") {
    const auto face = TextFace::open();
    EXPECT_TRUE(face.ok());
    Sheet sheet;
    sheet.width_px = around.width_px;
    sheet.scene_top_px = 40;
    sheet.scene_rows_px = around.height_px();
    sheet.height_px = sheet.scene_top_px + sheet.scene_rows_px + rulers.strip_px();
    EXPECT_TRUE(put_rulers(rulers, around, *face, reported, "data", sheet).ok());
    return sheet;
}

std::vector<std::string> of_kind(const Sheet& sheet, const std::string& kind) {
    std::vector<std::string> all;
    for (const SheetText& text : sheet.texts) {
        if (text.kind == kind) all.push_back(text.text);
    }
    return all;
}

TEST(Rulers, HaveRoundFigures) {
    const Cylinder around = cylinder_around(330.0, 90.0, -11.0, 4.0, 900);  // 10 px a degree
    const Rulers rulers = rulers_of(around, 11.0);
    EXPECT_EQ(rulers.azimuth_step_deg, 5.0);
    EXPECT_EQ(rulers.azimuth_tick_deg, 1.0);
    EXPECT_EQ(rulers.elevation_step_deg, 5.0);
    const Sheet sheet = ruled(around, rulers);
    const auto azimuths = of_kind(sheet, "azimuth");
    ASSERT_EQ(azimuths.size(), 19U);
    EXPECT_EQ(azimuths.front(), "330°");
    EXPECT_EQ(azimuths[6], "0°");
    EXPECT_EQ(azimuths.back(), "60°");
    EXPECT_EQ(of_kind(sheet, "wind"), (std::vector<std::string>{"NNW", "N", "NNE", "NE"}));
    EXPECT_EQ(of_kind(sheet, "elevation"),
              (std::vector<std::string>{"-10°", "-10°", "-5°", "-5°", "0°", "0°"}));
    for (const SheetText& text : sheet.texts) {
        if (text.text == "N") {
            EXPECT_NEAR(text.at_px.x, 300.0, 1e-9);
        }
        if (text.text == "-5°") {
            // 572.958 px a radian, tan 5 = 0.0874887; level is row 40 of the scene, which begins at 40.
            EXPECT_NEAR(text.at_px.y, 80.0 + 50.127, 0.001);
        }
    }
}

TEST(Rulers, TellNothingThatHasNoRoom) {
    const Cylinder around = cylinder_around(0.0, 10.0, -1.0, 1.0, 150);
    const Sheet sheet = ruled(around, rulers_of(around, 11.0), std::string(200, 'x'));
    EXPECT_TRUE(of_kind(sheet, "eye").empty());
    EXPECT_EQ(of_kind(sheet, "attribution").size(), 1U);
}

TEST(SheetSvg, HasLinesAndTextAsTheyAre) {
    Sheet sheet;
    sheet.width_px = 60;
    sheet.height_px = 50;
    sheet.scene_top_px = 30;
    sheet.scene_rows_px = 10;
    sheet.paper = {255, 255, 255};
    sheet.lines.push_back({{20.5, 5.0}, {20.5, 28.0}, 1.0, {0, 0, 0}});
    sheet.texts.push_back({"Ża <&> جبل \"q\"",
                           {40.0, 28.0},
                           SheetText::Anchor::begin,
                           -90.0,
                           12.0,
                           50.0,
                           {1, 2, 3},
                           {},
                           "name"});
    const std::vector<std::uint8_t> scene(std::size_t{3} * 60 * 10, 90);
    const auto svg = sheet_svg(sheet, scene, "a & b", "c");
    ASSERT_TRUE(svg.ok());
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg->c_str()));
    const pugi::xml_node root = document.child("svg");
    EXPECT_STREQ(root.child("title").child_value(), "a & b");
    EXPECT_STREQ(root.child("text").child_value(), "Ża <&> جبل \"q\"");
    EXPECT_NEAR(root.child("line").attribute("x1").as_double(), 20.5, 0.001);
    EXPECT_NEAR(root.child("line").attribute("y2").as_double(), 28.0, 0.001);
    // Upwards: the base line is right of the capitals' middle by half of 0.729 em.
    EXPECT_NEAR(root.child("text").attribute("x").as_double(), 40.0 + 0.5 * 0.729 * 12.0, 0.001);
    EXPECT_NEAR(root.child("text").attribute("y").as_double(), 28.0, 0.001);
    EXPECT_EQ(std::string(root.child("image").attribute("xlink:href").value()).substr(0, 26),
              "data:image/png;base64,iVBO");
    // A line of one pixel covers its column whole.
    const std::vector<InkedText> lines = inked_lines(sheet);
    ASSERT_FALSE(lines.empty());
    int whole = 0;
    for (const InkedText& line : lines) {
        for (int y = 0; y < line.mask.height_px; ++y) {
            for (int x = 0; x < line.mask.width_px; ++x) {
                const int ink = line.mask.ink[static_cast<std::size_t>(y * line.mask.width_px + x)];
                const bool on_line =
                    line.mask.x_px + x == 20 && line.mask.y_px + y >= 5 && line.mask.y_px + y < 28;
                if (on_line) whole += ink == 255 ? 1 : 0;
                if (line.mask.x_px + x != 20) {
                    EXPECT_EQ(ink, 0);
                }
            }
        }
    }
    EXPECT_EQ(whole, 23);
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    const auto texts = inked_texts(sheet, *face);
    ASSERT_TRUE(texts.ok());
    // Its ink begins at its foot and goes up.
    const TextMask& mask = texts->front().mask;
    EXPECT_LE(mask.y_px + mask.height_px, 28 + 80);
    EXPECT_LT(mask.y_px, 0);
}

}  // namespace
}  // namespace oro
