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
    for (const auto& [field, value] : read->all.front().fields)
        all += (all.empty() ? "" : " ") + field + "=" + value;
    return all;
}

TEST(BatchPlaces, ColumnsOfDegreesHaveTheirUsualNames) {
    EXPECT_EQ(first_fields_in("a.csv", "Name,Latitude,Longitude\nA,36.55,-84.25\n"),
              "Latitude=36.55 Longitude=-84.25 Name=A lat=36.55 lon=-84.25 name=A number=1");
    EXPECT_EQ(first_fields_in("a.csv", "LAT;lng;Above (m)\n36.55; -84.25 ;30\n"),
              "Above (m)=30 LAT=36.55 above=30 lat=36.55 lng=-84.25 lon=-84.25 number=1");
    EXPECT_EQ(first_fields_in("a.csv", "decimalLatitude,note\n36.55,x\n"),
              "decimalLatitude=36.55 lat=36.55 note=x number=1");
}

// A table is read as vector files are (geo/vectors/csv_records.h): an unclosed quotation mark swallowed the
// places behind it without a word.
TEST(BatchPlaces, TablesAreRefusedByTheirLine) {
    EXPECT_EQ(first_fields_in("a.csv", "name,lat,lon\n\"Mast,36.5,-84\nB,36.6,-84\n"),
              "error: line 2 has a quotation mark without an end: all lines behind it are in one field");
    EXPECT_EQ(
        first_fields_in("a.csv", "name,lat,lon\nA,36.5,-84\nB,36.6,-84,1\n"),
        "error: line 3 has 4 fields, and the first line names 3: a text with a comma needs quotation marks, "
        "and decimal commas need semicolons between fields");
    EXPECT_EQ(first_fields_in("a.csv", "name,lat,note\n\"A\",36.5,\"two\nlines\"\n"),
              "lat=36.5 name=A note=two\nlines number=1");
    std::string wide = "\xff\xfe";
    for (const char c : std::string("name;lat\nA;36.5\n")) wide += c, wide += '\0';
    EXPECT_EQ(first_fields_in("a.csv", wide), "lat=36.5 name=A number=1");
    EXPECT_EQ(
        first_fields_in("a.csv", wide.substr(2)),
        "error: is no text, or UTF-16 without a byte order mark (it holds zero bytes): save it as UTF-8");
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
