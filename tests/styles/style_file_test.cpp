// Style files: those that come with the program, and what is wrong in others.
#include <array>

#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

Result<Style> loaded(const std::string& text) {
    const std::filesystem::path file = test::scratch_folder() / "style.json";
    std::ofstream(file) << text;
    View view;
    view.style = file.string();
    return load_style(view, test::square_field(46.5, 8.0, 30.0, 4, [](int, int) { return 1.0; }));
}

TEST(StyleFiles, ThoseThatComeWithTheProgramAreRead) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::bundled_data() / "styles")) {
        std::ifstream file(entry.path());
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        const auto style = loaded(text);
        ASSERT_TRUE(style.ok()) << style.error().line();
        EXPECT_NE(text.find("\"licence\": \"CC0-1.0"), std::string::npos) << entry.path();
        // Maps have no air; haze and natural have.
        const std::string name = entry.path().stem();
        EXPECT_EQ(style->frame.is_map == 0, name == "haze" || name == "natural") << entry.path();
        EXPECT_EQ(style->frame.air.on == 1, name == "natural") << entry.path();
        ++count;
    }
    EXPECT_GE(count, 8);
}

// An option that has no effect is refused. A view's file names a sea and a rim whatever its style is.
TEST(StyleFiles, WithoutWaterOrVoidsRefuseOptionsForThem) {
    const HeightField field = test::square_field(46.5, 8.0, 30.0, 4, [](int, int) { return 1.0; });
    const auto line_of = [&](const View& view) {
        const auto style = load_style(view, field);
        if (style.ok()) return std::string();
        EXPECT_EQ(style.error().kind, ErrorKind::usage);
        return style.error().line();
    };
    View view;
    for (const char* name : {"haze", "plain", "natural"}) {
        SCOPED_TRACE(name);
        const std::string none = std::string("; ") + name + " has none";
        const bool refuses = std::string(name) != "natural";
        view = {};
        view.style = name;
        view.sea_asked = view.rim_asked = true;
        EXPECT_EQ(line_of(view), "");
        view.sea = Sea::low;
        EXPECT_EQ(line_of(view), refuses ? "--sea low: is for styles with water" + none : "");
        view.sea = Sea::voids;
        EXPECT_EQ(line_of(view), refuses ? "--sea voids: is for styles with water" + none : "");
        view.rim = Rim::none;
        view.sea_asked = false;
        EXPECT_EQ(line_of(view), refuses ? "--rim none: is for styles with voids" + none : "");
        view.rim_asked = false;
        EXPECT_EQ(line_of(view), "");
    }
}

TEST(StyleFiles, FaultsAreToldInOneLine) {
    const std::string tints = R"("tints": [{"H_m": 0, "colour": "#ffffff"}])";
    const std::string map = tints + R"(, "background": "#ffffff")";
    const std::string cover =
        R"("tints": [{"above_snow_line_m": 0, "colour": "#ffffff"}], "colour_by": "cover", "light": "none",
            "background": "#ffffff")";
    const std::string daylight =
        tints + R"(, "sun": {"azimuth_deg": 1, "elevation_deg": 1}, "ambient": 0.2, "relief": 1)";
    struct Bad {
        std::string text, says;
    };
    const std::array bad{
        Bad{R"({)" + map + R"(, "light": "moon"})",
            "'light' is 'moon'; there is: sun, none, hillshade, relief"},
        Bad{R"({)" + map + R"(, "light": "none", "colour_by": "gradient"})",
            "'colour_by' is 'gradient'; there is: height, slope, aspect, cover"},
        Bad{R"({)" + map + R"(, "light": "none", "shine": 1})",
            "a style has no field 'shine'; there is: name, "},
        Bad{R"({)" + map + R"(, "light": "none", "flat": "#ffffff"})", "'flat' is for"},
        Bad{R"({)" + map + R"(, "light": "none", "sky": {}})",
            "'background' is for maps; they have no 'sky'"},
        Bad{R"({"tints": [{"H_m": 0, "colour": "#ffffff", "color": "#000000"}], "background": "#ffffff",
                "light": "none"})",
            "one of 'tints' has no field 'color'"},
        Bad{R"({"tints": [{"slope_deg": 91, "colour": "#ffffff"}], "colour_by": "slope", "background": "#ffffff",
                "light": "none"})",
            "slope_deg"},
        Bad{R"({"tints": [{"aspect_deg": 9, "colour": "#ffffff"}], "colour_by": "aspect", "background": "#ffffff",
                "light": "none"})",
            "'flat' is missing"},
        Bad{R"({)" + map + R"(, "light": "none", "contours": {"colour": "#000000", "width_px": 0}})",
            "width_px"},
        Bad{R"({)" + map + R"(, "light": "none",
                "contours": {"colour": "#000000", "width_px": 1, "labels_px": 5}})",
            "labels_px"},
        Bad{R"({)" + map + R"(, "light": "hillshade", "sun": {"azimuth_deg": 1, "elevation_deg": 1}})",
            "'relief' is missing"},
        Bad{R"({)" + map + R"(, "light": "none", "cover": {}})", "'cover' is for"},
        Bad{R"({)" + cover + R"(, "cover": {"snow_line": [{"lat_deg": 91, "H_m": 0}]}})", "lat_deg"},
        Bad{R"({)" + cover +
                R"(, "cover": {"snow_line": [{"lat_deg": 9, "H_m": 0}, {"lat_deg": 9, "H_m": 1}]}})",
            "'snow_line' must ascend in lat_deg"},
        Bad{R"({)" + cover + R"(, "cover": {"snow_line": [{"lat_deg": 9, "H_m": 0}], "rock": "#000000",
                "rock_from_deg": 40, "rock_to_deg": 40}})",
            "'rock_to_deg' must be above 'rock_from_deg'"},
        Bad{R"({)" + daylight + R"(, "air": {"visibility_km": 300, "ground_albedo": 0.2, "exposure": 1}})",
            "visibility_km"},
        Bad{R"({)" + daylight +
                R"(, "air": {"visibility_km": 50, "ground_albedo": 0.2, "exposure": 1, "fog": 1}})",
            "'air' has no field 'fog'"},
        Bad{R"({)" + daylight + R"(, "air": {}, "haze": {}})", "with 'air' a style has no 'haze'"}};
    for (const Bad& one : bad) {
        const auto style = loaded(one.text);
        ASSERT_FALSE(style.ok()) << one.text;
        const std::string line = style.error().line();
        EXPECT_NE(line.find(one.says), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace oro
