// The sun of a view: by time or as a direction, and how much light it gives.
#include "apps/light/sun.h"

#include <gtest/gtest.h>

#include <string>

#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/light/sun_position.h"

namespace {

TEST(Sun, ByTimeItStandsWhereTheAlmanacHasIt) {
    // Reda & Andreas, NREL/TP-560-34302, revised 2008, appendix A.5: azimuth 194.34024, zenith 50.11162 with
    // 820 hPa and 11 degrees; this program's air at that height bends by 0.0002 degree more.
    std::optional<oro::SunDirection> sun =
        oro::SunDirection{0.0, 0.0, *oro::parse_time("--sun-time", "2003-10-17T12:30:30-07:00")};
    oro::aim_sun(sun, {39.742476, -105.1786, 1830.14});
    EXPECT_NEAR(sun->azimuth_deg, 194.34024, 0.001);
    EXPECT_NEAR(sun->elevation_deg, 90.0 - 50.11162, 0.001);
}

TEST(Sun, DirectionsStayWhereTheyAre) {
    std::optional<oro::SunDirection> sun = oro::SunDirection{270.0, -3.0};
    oro::aim_sun(sun, {46.0, 8.0, 0.0});
    EXPECT_EQ(sun->azimuth_deg, 270.0);
    EXPECT_EQ(sun->elevation_deg, -3.0);
    std::optional<oro::SunDirection> none;
    oro::aim_sun(none, {46.0, 8.0, 0.0});
    EXPECT_FALSE(none.has_value());
}

TEST(Sun, OfYearsThatAreLessExactThatIsTold) {
    const auto note_at = [](const char* time) {
        return oro::note_of_year(oro::SunDirection{0.0, 0.0, *oro::parse_time("--sun-time", time)});
    };
    EXPECT_EQ(note_at("1900-01-01T00:00Z"), "");
    EXPECT_EQ(note_at("2100-12-31T23:59:59Z"), "");
    EXPECT_NE(note_at("1899-12-31T23:59:59Z"), "");
    EXPECT_EQ(note_at("2101-01-01T00:00Z"), note_at("1066-10-14T12:00Z"));
    EXPECT_EQ(oro::note_of_year(oro::SunDirection{90.0, 20.0}), "");
    EXPECT_EQ(oro::note_of_year(std::optional<oro::SunDirection>()), "");
}

// Found: a sun 3 degrees below the horizon lit mountains fully.
TEST(Sun, BelowTheHorizonItGivesNoDirectLight) {
    EXPECT_EQ(oro::direct_light({270.0, 30.0}), 1.0);
    EXPECT_EQ(oro::direct_light({270.0, 0.0}), 1.0);
    EXPECT_EQ(oro::direct_light({270.0, -0.001}), 0.0);
    EXPECT_EQ(oro::direct_light({270.0, -90.0}), 0.0);
    const oro::SunTime time{"", 0};
    EXPECT_EQ(oro::direct_light({270.0, 0.3, time}), 1.0);
    EXPECT_NEAR(oro::direct_light({270.0, 0.0, time}), 0.5, 1e-15);
    EXPECT_EQ(oro::direct_light({270.0, -0.3, time}), 0.0);
    oro::gpu::FrameStyle style{};
    oro::light_by({90.0, -3.0}, style);
    EXPECT_EQ(style.sun_hidden, 1.0F);
    EXPECT_NEAR(style.sun_enu.x, 0.99863F, 1e-5F);
    oro::light_by({90.0, 3.0}, style);
    EXPECT_EQ(style.sun_hidden, 0.0F);
}

TEST(Sun, ItsTimeIsInTheViewAsItWasGiven) {
    oro::View view;
    view.camera.eye = {46.67, 8.06, 2540.0};
    view.sun = oro::SunDirection{0.0, 0.0, *oro::parse_time("--sun-time", "2026-06-21T05:30+02:00")};
    oro::aim_sun(view.sun, view.camera.eye);
    const std::string text = oro::view_to_json(view, false);
    EXPECT_NE(text.find(R"("time":"2026-06-21T05:30+02:00"})"), std::string::npos) << text;
    const auto read = oro::view_from_json(text, "test");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(oro::view_to_json(*read, false), text);
    ASSERT_TRUE(read->sun && read->sun->time);
    EXPECT_EQ(read->sun->time->utc_s, 1782012600);
    EXPECT_EQ(read->sun->elevation_deg, view.sun->elevation_deg);
    std::string broken = text;
    broken.replace(broken.find("T05:30+02:00"), 12, "T25:30+02:00");
    const auto refused = oro::view_from_json(broken, "test");
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().line().find(
                  "the sun's 'time' is '2026-06-21T25:30+02:00', which is no time of the calendar"),
              std::string::npos)
        << refused.error().line();
}

// Views of before there were times hold none, and keep their text.
TEST(Sun, DirectionsAreWrittenAsBefore) {
    oro::View view;
    view.sun = oro::SunDirection{270.0, -3.5};
    EXPECT_NE(oro::view_to_json(view, false).find(R"("sun":{"azimuth_deg":270.0,"elevation_deg":-3.5},)"),
              std::string::npos);
}

}  // namespace
