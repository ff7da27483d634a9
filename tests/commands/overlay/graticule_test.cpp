// Lines of latitude and longitude, or of a CRS, over what a picture shows.
#include "apps/overlay/graticule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oro {
namespace {

CoordinateRange all_of(double low, double high) {
    return {low, high, low, high};
}

std::string labels_of(const std::vector<GraticuleLine>& lines) {
    std::string all;
    for (const GraticuleLine& line : lines) all += (all.empty() ? "" : " ") + line.label;
    return all;
}

TEST(Graticule, RangesLeaveFewFarPlacesOut) {
    std::vector<double> values;
    for (int i = 0; i <= 100; ++i) values.push_back(i == 100 ? 1000.0 : i);
    const CoordinateRange range = range_of(values);
    EXPECT_EQ(range.low, 0.0);
    EXPECT_EQ(range.high, 1000.0);
    EXPECT_EQ(range.most_low, 5.0);
    EXPECT_EQ(range.most_high, 95.0);
}

TEST(Graticule, IntervalsAreRound) {
    const auto interval_s = [](double lat_deg, double lon_deg) {
        return graticule_interval_s(all_of(46.0, 46.0 + lat_deg), all_of(8.0, 8.0 + lon_deg));
    };
    EXPECT_EQ(interval_s(1.0, 1.0), 600.0);            // 10': seven lines
    EXPECT_EQ(interval_s(0.1, 0.2), 120.0);            // 2' of the longer way
    EXPECT_EQ(interval_s(40.0, 30.0), 18000.0);        // 5 degrees
    EXPECT_EQ(interval_s(100.0, 360.0), 162000.0);     // 45 degrees
    EXPECT_NEAR(interval_s(1e-4, 1e-4), 0.05, 1e-12);  // 3 m a line on the ground
    EXPECT_EQ(graticule_interval(all_of(2'600'000.0, 2'650'000.0), all_of(1.2e6, 1.21e6)), 10'000.0);
    EXPECT_EQ(graticule_interval(all_of(0.0, 7.9), all_of(0.0, 1.0)), 1.0);
    // A skyline far away does not make the ground before it empty, nor lines without number.
    EXPECT_EQ(graticule_interval({0.0, 100'000.0, 0.0, 7.0}, all_of(0.0, 1.0)), 5000.0);
}

TEST(Graticule, LinesStandAtWholeMultiples) {
    const auto lines = geographic_lines(all_of(46.05, 46.55), all_of(-0.2, 0.2), 600.0);
    EXPECT_EQ(labels_of(lines), "46°10'N 46°20'N 46°30'N 0°10'W 0°00' 0°10'E");
    for (const GraticuleLine& line : lines) ASSERT_EQ(line.shape.paths.size(), 1U);
    EXPECT_EQ(lines[2].shape.paths[0].front().lat_deg, 46.5);
    EXPECT_EQ(lines[2].shape.paths[0].front().lon_deg, -0.2);
    EXPECT_EQ(lines[5].shape.paths[0].back().lon_deg, 600.0 / 3600.0);
    EXPECT_EQ(labels_of(geographic_lines(all_of(-1.5, 1.5), all_of(0.1, 0.2), 3600.0)), "1°S 0° 1°N");
    EXPECT_EQ(labels_of(geographic_lines(all_of(46.0, 46.0006), all_of(8.0001, 8.0002), 1.0)),
              "46°00'00\"N 46°00'01\"N 46°00'02\"N");
    EXPECT_EQ(labels_of(geographic_lines(all_of(46.00001, 46.00003), all_of(8.1, 8.1), 0.05)),
              "46°00'00.05\"N 46°00'00.10\"N 8°06'00.00\"E");
}

TEST(Graticule, GoesOverTheAntimeridianAndRoundTheEarth) {
    const auto lines = geographic_lines(all_of(10.0, 10.4), all_of(179.5, 181.5), 3600.0);
    EXPECT_EQ(labels_of(lines), "10°N 180°E 179°W");
    EXPECT_EQ(lines[1].shape.paths[0].front().lon_deg, 180.0);
    EXPECT_EQ(lines[2].shape.paths[0].front().lon_deg, -179.0);
    // A line goes the shorter way from place to place.
    const auto round = geographic_lines(all_of(10.0, 10.0), all_of(-180.0, 180.0), 36000.0);
    EXPECT_EQ(round.front().label, "10°N");
    EXPECT_EQ(round.front().shape.paths[0].size(), 13U);
    for (const GraticuleLine& line : round)
        for (std::size_t i = 0; i + 1 < line.shape.paths[0].size(); ++i)
            EXPECT_LE(std::abs(std::remainder(
                          line.shape.paths[0][i + 1].lon_deg - line.shape.paths[0][i].lon_deg, 360.0)),
                      30.0 + 1e-9);
}

// The lines of LV95 are where PROJ puts them.
TEST(Graticule, ProjectedLinesLieInTheirCrs) {
    auto crs = CrsPlaces::of("EPSG:2056");
    ASSERT_TRUE(crs.ok());
    const auto lines =
        projected_lines(*crs, all_of(2'640'500.0, 2'643'500.0), all_of(1'158'500.0, 1'159'500.0), 1000.0);
    EXPECT_EQ(labels_of(lines), "E 2641000 E 2642000 E 2643000 N 1159000");
    for (const GraticuleLine& line : lines) {
        ASSERT_EQ(line.shape.paths.size(), 1U);
        EXPECT_EQ(line.shape.paths[0].size(), 33U);
        const VectorPlace& place = line.shape.paths[0][7];
        const auto numbers = crs->coordinates(place.lat_deg, place.lon_deg);
        ASSERT_TRUE(numbers);
        const bool is_easting = line.label.front() == 'E';
        // Both ways leave heights out, so that one is not the other's inverse: 1.1 mm here.
        EXPECT_NEAR((*numbers)[is_easting ? 0 : 1], std::stod(line.label.substr(2)), 0.005);
    }
}

TEST(Graticule, ValuesStandAtTheBorder) {
    const SeenLine across{{{100.0, 50.0}, {400.0, 48.0}, {641.0, 40.0}}, 0},
        apart{{{300.0, 300.0}, {310.0, 300.0}}, 0};
    const glm::dvec2 picture(640.0, 360.0), half(20.0, 8.0);
    const auto place = label_place({&apart, &across}, picture, half, 50.0);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->x, 620.0) << "all of it is in the picture";
    EXPECT_EQ(place->y, 40.0);
    EXPECT_FALSE(label_place({&apart}, picture, half, 50.0)) << "ten pixels of a line";
    EXPECT_FALSE(label_place({}, picture, half, 50.0));
}

}  // namespace
}  // namespace oro
