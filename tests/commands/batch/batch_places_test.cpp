// Places of tables and vector files: what the fields are called, whatever their file calls them.
#include "apps/batch/batch_places.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/test_data.h"

namespace oro {
namespace {

// The fields of the first place of a file of that name and text: "lat=36.55 lon=-84.25 number=1".
std::string first_fields_in(const std::string& name, const std::string& text) {
    const std::filesystem::path file = test::scratch_folder() / name;
    std::ofstream(file, std::ios::binary) << text;
    const auto read = read_places(file.string());
    if (!read.ok()) return "error: " + read.error().what;
    std::string all;
    for (const auto& [field, value] : read->front().fields)
        all += (all.empty() ? "" : " ") + field + "=" + value;
    return all;
}

TEST(BatchPlaces, ColumnsOfDegreesHaveTheirUsualNames) {
    EXPECT_EQ(first_fields_in("a.csv", "Name,Latitude,Longitude\nA,36.55,-84.25\n"),
              "Latitude=36.55 Longitude=-84.25 Name=A lat=36.55 lon=-84.25 name=A number=1");
    EXPECT_EQ(first_fields_in("a.csv", "LAT;lng;Above (m)\n36.55; -84.25 ;30\n"),
              "Above (m)=30 LAT=36.55 above=30 lat=36.55 lng= -84.25  lon=-84.25 number=1");
    EXPECT_EQ(first_fields_in("a.csv", "decimalLatitude,note\n36.55,x\n"),
              "decimalLatitude=36.55 lat=36.55 note=x number=1");
}

// What a table calls so itself is not another column.
TEST(BatchPlaces, ColumnsOfTheVeryNameCountFirst) {
    EXPECT_EQ(first_fields_in("a.csv", "latitude,lat,Name,name,longitude,lon\n1,36.55,B,A,2,-84.25\n"),
              "Name=B lat=36.55 latitude=1 lon=-84.25 longitude=2 name=A number=1");
    EXPECT_EQ(first_fields_in("a.csv", "Latitude,lat\n36.55\n"), "Latitude=36.55 lat= number=1");
}

TEST(BatchPlaces, NamesOfPointsAreInAnyLetters) {
    EXPECT_EQ(first_fields_in("a.geojson", R"({"type": "Feature", "properties": {"NAME": "A", "Above": 30},
                  "geometry": {"type": "Point", "coordinates": [-84.25, 36.55]}})"),
              "Above=30 NAME=A above=30 lat=36.550000000 lon=-84.250000000 name=A number=1");
}

}  // namespace
}  // namespace oro
