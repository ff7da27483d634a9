// Files with the names of many places.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "apps/search/gazetteer.h"
#include "apps/search/gazetteer_reading.h"
#include "tests/support/test_data.h"

namespace {
using namespace oro;

std::string written(const std::string& name, const std::string& text) {
    const std::filesystem::path file = oro::test::scratch_folder() / name;
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
}

// A line of GeoNames' dump: 19 fields.
std::string geonames(const std::string& name, const std::string& lat, const std::string& lon,
                     const std::string& kind, const std::string& code, const std::string& population,
                     const std::string& elevation, const std::string& dem) {
    return "2660253\t" + name + "\t" + name + "\tOther,Names\t" + lat + "\t" + lon + "\t" + kind + "\t" +
           code + "\tCH\t\tBE\t242\t572\t\t" + population + "\t" + elevation + "\t" + dem +
           "\tEurope/Zurich\t2016-02-25\n";
}

TEST(Gazetteer, ADumpOfGeoNames) {
    const auto read = read_gazetteer(
        written("CH.txt", geonames("Eiger", "46.57758", "8.00529", "T", "MT", "0", "3967", "3913") +
                              geonames("Zürich", "47.36667", "8.55", "P", "PPLA", "341730", "", "408") +
                              geonames("Aletschgletscher", "46.5", "8.03", "H", "GLCR", "0", "", "-9999")));
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_TRUE(read->notes.empty());
    ASSERT_EQ(read->places.size(), 3U);
    const SearchPlace &eiger = read->places[0], &zurich = read->places[1], &ice = read->places[2];
    EXPECT_EQ(eiger.name, "Eiger");
    EXPECT_EQ(eiger.lat_deg, 46.57758);
    EXPECT_EQ(eiger.lon_deg, 8.00529);
    EXPECT_EQ(eiger.H_m, 3967.0);
    EXPECT_EQ(static_cast<int>(eiger.kind), static_cast<int>(PlaceClass::summit));
    EXPECT_EQ(zurich.name, "Zürich");
    EXPECT_EQ(zurich.H_m, 408.0) << "dem where there is no elevation";
    EXPECT_EQ(zurich.population, 341730.0);
    EXPECT_EQ(static_cast<int>(zurich.kind), static_cast<int>(PlaceClass::settlement));
    EXPECT_FALSE(ice.H_m);
    EXPECT_EQ(static_cast<int>(ice.kind), static_cast<int>(PlaceClass::other));
}

TEST(Gazetteer, ATableByItsHeading) {
    for (const std::string text :
         {"\xEF\xBB\xBFName,Latitude,Longitude,Ele,Class\r\n\"Eiger, Ostegg\",46.5,8.25,\"2,710\",peak\r\n",
          "class;lon;lat;name;elevation\npeak;8.25;46.5;Eiger, Ostegg;2710 m\n",
          "\n\nname\tlat\tlng\tnatural\tele\nEiger, Ostegg\t46.5\t8.25\tpeak\t2710",
          "name;gps_latitude;GPS longitude;altitude;type\nEiger, Ostegg;46.5;8.25;2710;peak\n",
          "decimalLatitude;decimalLongitude;name;y;x;height;place\n46.5;8.25;Eiger, Ostegg;1;2;2710;peak\n",
          "title;y;x;height;natural\nEiger, Ostegg;46.5;8.25;2710;peak\n"}) {
        const auto read = read_gazetteer(written("table.csv", text));
        ASSERT_TRUE(read.ok()) << read.error().line();
        ASSERT_EQ(read->places.size(), 1U) << text;
        EXPECT_EQ(read->places[0].name, "Eiger, Ostegg");
        EXPECT_EQ(read->places[0].lat_deg, 46.5);
        EXPECT_EQ(read->places[0].lon_deg, 8.25);
        EXPECT_EQ(read->places[0].H_m, 2710.0);
        EXPECT_EQ(static_cast<int>(read->places[0].kind), static_cast<int>(PlaceClass::summit));
    }
}

TEST(Gazetteer, PointsOfGeoJson) {
    const auto read = read_gazetteer(written("peaks.geojson", R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"name": "Eiger", "natural": "peak", "ele": "3967"},
         "geometry": {"type": "Point", "coordinates": [8.005, 46.577]}},
        {"type": "Feature", "properties": {"name": "Hut", "tourism": "alpine_hut"},
         "geometry": {"type": "Point", "coordinates": [8.1, 46.6]}},
        {"type": "Feature", "properties": {"natural": "peak"},
         "geometry": {"type": "Point", "coordinates": [8.2, 46.7]}}]})"));
    ASSERT_TRUE(read.ok()) << read.error().line();
    ASSERT_EQ(read->places.size(), 2U);
    EXPECT_EQ(read->places[0].name, "Eiger");
    EXPECT_EQ(read->places[0].H_m, 3967.0);
    EXPECT_EQ(static_cast<int>(read->places[0].kind), static_cast<int>(PlaceClass::summit));
    EXPECT_EQ(static_cast<int>(read->places[1].kind), static_cast<int>(PlaceClass::other));
}

TEST(Gazetteer, LinesThatAreNoneAreSaidByTheirNumber) {
    const std::string file = written(
        "bad.csv", "name,lat,lon\nEiger,46.5,8.0\nMönch,46.5\nA,91,8\n,46,8\n\nB,46,x\nC,46,8\nD\xff,46,8\n");
    const auto read = read_gazetteer(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->places.size(), 3U);
    EXPECT_EQ(read->places[2].name, "D\xc3\xbf");
    ASSERT_EQ(read->notes.size(), 2U);
    EXPECT_EQ(read->notes[0], file + ": is no UTF-8 and is read as Windows-1252");
    EXPECT_EQ(read->notes[1], file + ": 4 lines are left out, the first is line 3: its longitude is ''");
    const auto cut = read_gazetteer(written(
        "long.txt", geonames("Eiger", "46.5", "8.0", "T", "MT", "0", "3967", "3913") +
                        geonames(std::string(70000, 'x'), "46.5", "8.0", "T", "MT", "0", "3967", "3913") +
                        geonames("Mönch", "46.5", "8.0", "T", "MT", "0", "4107", "4099")));
    EXPECT_EQ(cut->places.size(), 2U);
    EXPECT_NE(cut->notes.at(0).find("line 2: it is longer than 65,536 bytes"), std::string::npos)
        << cut->notes[0];
    const auto short_line = read_gazetteer(
        written("CH.txt", geonames("Eiger", "46.5", "8.0", "T", "MT", "0", "3967", "3913") + "1\tMönch\n"));
    EXPECT_NE(short_line->notes.at(0).find("line 2: it has 2 fields, not 19"), std::string::npos);
}

TEST(Gazetteer, WhatIsNoneIsOneError) {
    const auto fault = [](const std::string& name, const std::string& text) {
        const std::string file = written(name, text);
        const auto read = read_gazetteer(file);
        EXPECT_FALSE(read.ok()) << text;
        if (read.ok()) return std::string();
        EXPECT_EQ(read.error().where, file);
        return read.error().what;
    };
    EXPECT_EQ(fault("a.csv", ""), "is empty");
    EXPECT_EQ(fault("a.csv", "\n \n"), "is empty");
    EXPECT_NE(fault("a.csv", "just text\n").find("its first line names no column 'name'"), std::string::npos);
    EXPECT_NE(fault("a.csv", "name,x,why\n").find("names no column 'lat'"), std::string::npos);
    EXPECT_EQ(fault("a.csv", "name,lat,lon\n"), "has no line with a place");
    EXPECT_EQ(fault("a.csv", "name,lat,lon\n\"A,46,8\nB,47,8\n"),
              "line 2 has a quotation mark without an end: all lines behind it are in one field");
    EXPECT_EQ(fault("a.csv", "name;lat;lon\nA;46;8;9\n"), "line 2 has 4 fields, and the first line names 3");
    EXPECT_EQ(fault("a.csv", "name,lat,lon\nA,b,c\n"),
              "has no line with a place; line 2: its latitude is 'b'");
    EXPECT_FALSE(read_gazetteer((oro::test::scratch_folder() / "none.txt").string()).ok());
    EXPECT_FALSE(read_gazetteer(oro::test::scratch_folder().string()).ok());
    EXPECT_FALSE(read_gazetteer(written("broken.geojson", "{\"type\": ")).ok());
}

TEST(Gazetteer, OnlyWithinABox) {
    const std::string file =
        written("t.csv", "name,lat,lon\nA,46.5,8.5\nB,47.5,8.5\nC,46.5,179.5\nD,46.5,-179.5\n");
    const auto names = [&](const BoundingBox& box) {
        std::string all;
        const auto read = read_gazetteer(file, box);
        for (const SearchPlace& place : read->places) all += place.name;
        return all;
    };
    EXPECT_EQ(names({8.0, 46.0, 9.0, 47.0}), "A");
    EXPECT_EQ(names({179.0, 46.0, -179.0, 47.0}), "CD");
    EXPECT_EQ(names({0.0, 0.0, 1.0, 1.0}), "");
}

// In the background: names of all files that can be read, and what is wrong with the others.
TEST(GazetteerReading, ReadsSeveralFiles) {
    const std::string one = written("one.csv", "name,lat,lon\nEiger,46.5775,8.005\n"),
                      two = written("two.csv", "name,lat,lon\nEigergletscher,46.57,7.97\nX,y,z\n");
    GazetteerReading reading({one, (oro::test::scratch_folder() / "none.txt").string(), two});
    const GazetteerNames read = reading.wait();
    EXPECT_EQ(read.names.find("eiger", 8).size(), 2U);
    ASSERT_EQ(read.errors.size(), 1U);
    ASSERT_EQ(read.notes.size(), 1U);
    EXPECT_NE(read.notes.front().find("1 line is left out"), std::string::npos) << read.notes.front();
    EXPECT_FALSE(reading.ready()) << "it was taken";
    // Nobody waits for one that is given up.
    GazetteerReading given_up({one, two});
}

}  // namespace
