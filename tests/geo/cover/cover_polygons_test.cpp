// Land cover as polygons: which code a place has, and what is refused.
#include "geo/cover/cover_polygons.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "geo/cover/cover_map.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

struct Box {
    double west, south, east, north;
    [[nodiscard]] bool holds(double lat_deg, double lon_deg) const {
        return lon_deg > west && lon_deg < east && lat_deg > south && lat_deg < north;
    }
    // Nearer to an edge than so many degrees.
    [[nodiscard]] bool is_near(double lat_deg, double lon_deg, double deg) const {
        const Box outer{west - deg, south - deg, east + deg, north + deg};
        const Box inner{west + deg, south + deg, east - deg, north - deg};
        return outer.holds(lat_deg, lon_deg) && !inner.holds(lat_deg, lon_deg);
    }
};

std::string ring(const Box& box) {
    char text[300];
    std::snprintf(text, sizeof text, "[[%.6f,%.6f],[%.6f,%.6f],[%.6f,%.6f],[%.6f,%.6f],[%.6f,%.6f]]",
                  box.west, box.south, box.east, box.south, box.east, box.north, box.west, box.north,
                  box.west, box.south);
    return text;
}

std::string feature(const std::string& properties, const std::string& rings) {
    return R"({"type": "Feature", "properties": {)" + properties +
           R"(}, "geometry": {"type": "Polygon", "coordinates": [)" + rings + "]}}";
}

std::string written(const std::vector<std::string>& features) {
    const std::string file = (test::scratch_folder() / "cover.geojson").string();
    std::ofstream out(file);
    out << R"({"type": "FeatureCollection", "features": [)";
    for (std::size_t i = 0; i < features.size(); ++i) out << (i ? "," : "") << features[i];
    out << "]}";
    return file;
}

std::shared_ptr<const CoverMap> map_of_polygons(const std::string& file) {
    auto source = open_cover_source(file);
    EXPECT_TRUE(source.ok()) << source.error().line();
    if (!source.ok()) return nullptr;
    CoverTable table{"any", "any", {0}, {}};
    for (const int code : {111, 311, 512})
        table.classes.push_back(
            {.codes = {code}, .name = std::to_string(code), .materials = {Material::meadow}});
    std::vector<CoverSource> sources;
    sources.push_back(std::move(source).value());
    auto map = CoverMap::of(std::move(sources), {}, &table);
    EXPECT_TRUE(map.ok()) << map.error().line();
    return map.ok() ? std::move(map).value() : nullptr;
}

// Random places farther from all edges than half of a cell of 5 m: 6 m are 0.00008 degrees of longitude here.
TEST(CoverPolygons, HaveTheCodesOfTheirPlaces) {
    const Box wood{8.0, 46.5, 8.04, 46.52}, glade{8.01, 46.505, 8.02, 46.51}, lake{8.03, 46.51, 8.05, 46.53},
        silent{8.06, 46.5, 8.07, 46.51};
    const std::string file =
        written({feature(R"("code_18": "311", "value": 7)", ring(wood) + "," + ring(glade)),
                 feature(R"("code_18": "512")", ring(lake)), feature(R"("name": "no code")", ring(silent))});
    const auto map = map_of_polygons(file);
    ASSERT_TRUE(map);
    std::mt19937 random(7);
    std::printf("seed 7\n");
    std::size_t asked = 0, woods = 0, lakes = 0;
    for (int i = 0; i < 4000; ++i) {
        const double lat_deg = 46.49 + 0.05 * static_cast<double>(random()) / 4294967296.0;
        const double lon_deg = 7.99 + 0.09 * static_cast<double>(random()) / 4294967296.0;
        constexpr double near_deg = 0.00008;
        if (wood.is_near(lat_deg, lon_deg, near_deg) || glade.is_near(lat_deg, lon_deg, near_deg) ||
            lake.is_near(lat_deg, lon_deg, near_deg))
            continue;
        const int expected = lake.holds(lat_deg, lon_deg)                                     ? 512
                             : wood.holds(lat_deg, lon_deg) && !glade.holds(lat_deg, lon_deg) ? 311
                                                                                              : no_cover_code;
        const auto code = map->code_at(lat_deg, lon_deg);
        ASSERT_TRUE(code.ok()) << code.error().line();
        EXPECT_EQ(*code, expected) << lat_deg << ", " << lon_deg;
        ++asked;
        woods += expected == 311 ? 1U : 0U;
        lakes += expected == 512 ? 1U : 0U;
    }
    EXPECT_GT(asked, 3000U);
    EXPECT_GT(woods, 300U);
    EXPECT_GT(lakes, 100U);
    EXPECT_NE(map->notes().front().find("are drawn as cells of 5 m"), std::string::npos)
        << map->notes().front();
}

// Fiji's end of the world: one polygon on either side of 180 degrees.
TEST(CoverPolygons, LieOverTheAntimeridian) {
    const auto map =
        map_of_polygons(written({feature(R"("code": 111)", ring({179.99, -17.0, 180.0, -16.98})),
                                 feature(R"("code": 311)", ring({-180.0, -17.0, -179.99, -16.98}))}));
    ASSERT_TRUE(map);
    EXPECT_EQ(*map->code_at(-16.99, 179.995), 111);
    EXPECT_EQ(*map->code_at(-16.99, -179.995), 311);
    EXPECT_EQ(*map->code_at(-16.99, -179.98), no_cover_code);
}

// Cells are some 5 km here; all places are farther than that from edges.
TEST(CoverPolygons, AreWiderThanHalfOfTheEarth) {
    // A belt of 300 degrees in steps of 100, with a hole of 40; another polygon far from its first place.
    const std::string belt =
        "[[-150,10],[-50,10],[50,10],[150,10],[150,20],[50,20],[-50,20],[-150,20],[-150,10]]";
    const auto map =
        map_of_polygons(written({feature(R"("code": 111)", belt + "," + ring({100, 12, 140, 18})),
                                 feature(R"("code": 311)", ring({160, 10, 170, 20}))}));
    ASSERT_TRUE(map);
    for (const double lon_deg : {-149.0, -100.0, 0.0, 31.0, 99.0, 141.0, 149.0})
        EXPECT_EQ(*map->code_at(15.0, lon_deg), 111) << lon_deg;
    for (const double lon_deg : {101.0, 120.0, 139.0, 151.0, 171.0, 179.0, -179.0, -151.0})
        EXPECT_EQ(*map->code_at(15.0, lon_deg), no_cover_code) << lon_deg;
    EXPECT_EQ(*map->code_at(15.0, 165.0), 311);
}

// A coast that goes once round the pole, as files of Antarctica have it without a detour over the pole.
TEST(CoverPolygons, GoRoundAPole) {
    const auto map = map_of_polygons(
        written({feature(R"("code": 111)", "[[-120,-70],[0,-66],[120,-70],[180,-72],[-120,-70]]")}));
    ASSERT_TRUE(map);
    for (const double lon_deg : {-170.0, -119.0, -1.0, 60.0, 121.0, 179.0}) {
        EXPECT_EQ(*map->code_at(-80.0, lon_deg), 111) << lon_deg;
        EXPECT_EQ(*map->code_at(-60.0, lon_deg), no_cover_code) << lon_deg;
    }
}

TEST(CoverPolygons, WhatIsNoneIsRefused) {
    const auto refusal = [](const std::string& file) {
        const auto source = open_cover_source(file);
        EXPECT_FALSE(source.ok());
        return source.ok() ? "" : source.error().what;
    };
    const Box box{8.0, 46.5, 8.01, 46.51};
    EXPECT_NE(refusal(written({feature(R"("landuse": "forest")", ring(box))})).find("they have landuse"),
              std::string::npos);
    EXPECT_EQ(refusal(written({feature(R"("class": "forest")", ring(box))})),
              "its field class is 'forest', which is no code of a class: a whole number from 0 on");
    EXPECT_NE(refusal(written({feature(R"("code": 1.5)", ring(box))})).find("'1.5'"), std::string::npos);
    EXPECT_NE(refusal(written({feature(R"("code": -3)", ring(box))})).find("'-3'"), std::string::npos);
    EXPECT_EQ(refusal(written({R"({"type": "Feature", "properties": {"code": 1},
        "geometry": {"type": "Point", "coordinates": [8, 46]}})"})),
              "holds no polygons of land cover");
}

}  // namespace
}  // namespace oro
