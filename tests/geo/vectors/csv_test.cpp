// Tables of places: which columns are taken, what their numbers are, and what is left out.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
using test::written;

// The points of a file with their names: "NAME LAT LON HEIGHT", with ; between them; or its error.
std::string points_of(const std::string& file) {
    const auto read = read_vectors(file);
    if (!read.ok()) return "error: " + read.error().what;
    std::string all;
    for (const VectorLayer& layer : read->layers)
        for (const VectorShape& shape : layer.shapes) {
            const VectorPlace& place = shape.paths.front().front();
            char text[120];
            std::snprintf(text, sizeof text, " %.4f %.4f %.1f", place.lat_deg, place.lon_deg, place.height_m);
            all += (all.empty() ? "" : "; ") + std::string(layer.text(shape, "name")) + text;
        }
    return all;
}

// What the notes of a file say, without its name, with | between them.
std::string notes_of(const std::string& file) {
    const auto read = read_vectors(file);
    if (!read.ok()) return "error: " + read.error().what;
    std::string all;
    for (const std::string& note : read->notes)
        all += (all.empty() ? "" : " | ") + note.substr(file.size() + 2);
    return all;
}

TEST(Csv, ColumnsAreKnownByTheirUsualNames) {
    const std::string two = "A 46.5000 8.2500 1234.5";
    for (const char* const text : {
             "name,lat,lon,ele\nA,46.5,8.25,1234.5\n",
             "Longitude;Latitude;Name;Altitude\n8.25;46.5;A;1234.5\n",
             "name\tLAT\tLNG\tz\r\nA\t46.5\t8.25\t1234.5\r\n",
             "#lat (deg),lon [deg],elevation,name\n\n46.5,8.25,1234.5,A",
             "id|decimalLatitude|decimalLongitude|alt|name\n7|46.5|8.25|1234.5|A\n",
             "sep=;\nname;lat_wgs84;lon_wgs84;ele\nA;46.5;8.25;1234.5\n",
             "\xef\xbb\xbfname,lat,lon,ele\n\"A\",\"46.5\",\" 8.25 \",1234.5\n",
             "WKT,name\n\"POINT Z (8.25 46.5 1234.5)\",A\n",
         })
        EXPECT_EQ(points_of(written("a.csv", text)), two) << text;
    // The ending of its name does not count.
    EXPECT_EQ(points_of(written("a.txt", "name,lat,lon,ele\nA,46.5,8.25,1234.5\n")), two);
    std::string wide = "\xff\xfe";
    for (const char c : std::string("name,lat,lon,ele\nA,46.5,8.25,1234.5\n")) wide += c, wide += '\0';
    EXPECT_EQ(points_of(written("a.csv", wide)), two);
}

// EPSG:2056 (LV95): its origin, the old observatory of Bern, is E 2,600,000 N 1,200,000, and by swisstopo's
// formulas 46.951083 N 7.438632 E of WGS84.
TEST(Csv, MetresNeedACoordinateReferenceSystem) {
    const std::string bern = "Bern 46.9511 7.4386 ";
    EXPECT_EQ(points_of(written("a.csv", "name,E,N,crs\nBern,2600000,1200000,EPSG:2056\n")), bern + "nan");
    EXPECT_EQ(points_of(written("a.csv", "name,x,y,z,EPSG\nBern,2600000.0,1200000.0,553.5,2056\n")),
              bern + "553.5");
    EXPECT_EQ(points_of(written("a.csv", "WKT,name\nSRID=2056;POINT(2600000 1200000),Bern\n")), bern + "nan");
    EXPECT_EQ(points_of(written("a.csv", "name,Easting,Northing\nBern,2600000,1200000\n")),
              "error: its columns Easting and Northing state no coordinate reference system, so where they "
              "lie is unknown: give it a column crs (EPSG:2056), or a .prj beside it under the same name, or "
              "call them lon and lat where they are degrees");
    EXPECT_EQ(points_of(written("a.csv", "x,y,crs\n1,2,EPSG:999999\n")),
              "error: names a coordinate reference system that PROJ does not know (EPSG:999999)");
    // Two of them in one table.
    EXPECT_EQ(points_of(written("a.csv", "name,x,y,crs\nBern,2600000,1200000,2056\nA,8.25,46.5,4326\n")),
              bern + "nan; A 46.5000 8.2500 nan");
}

TEST(Csv, AProjectionFileBesideItCounts) {
    const std::filesystem::path folder = test::scratch_folder();
    const auto put = [&](const char* name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
        return (folder / name).string();
    };
    const std::string file = put("b.csv", "name;E;N\nBern;2600000;1200000\n"),
                      prj = put("b.prj", "EPSG:2056\n");
    const auto read = read_vectors(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(points_of(file), "Bern 46.9511 7.4386 nan");
    EXPECT_EQ(read->files, (std::vector<std::string>{file, prj}));
    EXPECT_EQ(notes_of(file), "its coordinates are in the coordinate reference system of the .prj beside it");
    // What it says is a part of what was read.
    put("b.prj", "EPSG:2056 ");
    EXPECT_NE(read_vectors(file)->fingerprint, read->fingerprint);
    // Of a shapefile of the same name it is not this file's.
    put("b.shp", "");
    EXPECT_EQ(points_of(file).substr(0, 24), "error: its columns E and");
}

// F09 of the cases from the field: 45,80 was 45 without a word.
TEST(Csv, DecimalCommasAreReadWhereTheyAreNoMarksAndElseCounted) {
    const std::string semicolons = written("a.csv", "name;lat;lon;ele\nA;45,80;-10,1;1234,5\n");
    EXPECT_EQ(points_of(semicolons), "A 45.8000 -10.1000 1234.5");
    EXPECT_EQ(notes_of(semicolons), "has commas for decimals: '-10,1' is read as -10.1");
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon\nA,\"45,80\",\"10,1\"\n")), "A 45.8000 10.1000 nan");
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon\nA,46.5,8.25\nB,45,80,10,1\n")),
              "error: line 3 has 5 fields, and the first line names 3: a text with a comma needs quotation "
              "marks, and decimal commas need semicolons between fields");
    // The first line has as many fields as such a line.
    EXPECT_EQ(notes_of(written("a.csv", "name,lat,lon,ele,id\nA,45,80,10,1\n")),
              "all its degrees are whole numbers between commas; if commas stand for decimals, part its "
              "fields by semicolons");
    EXPECT_EQ(points_of(written("a.csv", "name;lat;lon;ele\nA;46.5;8.25;\nB;45;8;10;\n")),
              "error: line 3 has 5 fields, and the first line names 4");
    // Of metres it may part thousands.
    const std::string metres =
        written("a.csv", "name;x;y;crs\nA;2600000,5;1200000,25;2056\nB;500,000;200,000;2056\n");
    EXPECT_EQ(points_of(metres), "A 46.9511 7.4386 nan");
    EXPECT_EQ(notes_of(metres),
              "has commas for decimals: '2600000,5' is read as 2600000.5 | left out 1 point that is no "
              "number, in line 3: '500,000'");
    EXPECT_EQ(notes_of(written("a.csv", "lat;lon\n46,5;8,25\n1.234,5;8\n")),
              "has commas for decimals: '8,25' is read as 8.25 | left out 1 point that is no number, in line "
              "3: '1.234,5'");
}

TEST(Csv, WhatHasNoPlaceIsLeftOutAndCounted) {
    EXPECT_EQ(notes_of(written("a.csv", "name,lat,lon\nA,46,8\nB,north,8\nC,46\nD,95,8\nE,nan,8\n")),
              "left out 1 point that is no number, in line 3: 'north' | left out 1 point without a latitude "
              "or without a longitude, in line 4 | left out 1 point with a latitude beyond 90 degrees, in "
              "line 5 | left out 1 point that is no finite number, in line 6: 'nan'");
    EXPECT_EQ(notes_of(written(
                  "a.csv",
                  "WKT;name\nPOINT(8 46);A\nPOINT(8,5 46,3);B\nPOINT(8 46;C\nPOINT(8 46) x;D\nhere;E\n;F\n")),
              "its geometries state no coordinate reference system and are taken for longitudes and "
              "latitudes of WGS84 | left out 4 geometries that are no well-known text, the first in line 3: "
              "'POINT(8,5 46,3)' | left out 1 line without a geometry, in line 7");
    EXPECT_EQ(notes_of(written("a.csv", "lat,lon\n46,8\n47,\"8\n")),
              "error: line 3 has a quotation mark without an end: all lines behind it are in one field");
    EXPECT_EQ(notes_of(written("a.csv", "lat,lon\n")), "error: holds no points, lines or polygons");
}

// A quotation mark that is not closed where it should be ends at the next one, lines later: those in between
// were in one field, and the place had the coordinates of another. RFC 4180, section 2, rule 7: a quotation
// mark within a field is written twice.
TEST(Csv, QuotationMarksThatSwallowLinesAreRefused) {
    EXPECT_EQ(
        points_of(written("a.csv", "name,lat,lon\nA,46,8\n\"B,47,8\n\"C\",48,8\n")),
        "error: line 4 has 'C\"' behind a field in quotation marks: a quotation mark within such a field "
        "is written twice");
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon\r\nA,46,8\r\n\"two\r\nlines\",47,8\r\n\"C,48,8\r\n")),
              "error: line 5 has a quotation mark without an end: all lines behind it are in one field");
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon\rA,46,8\r\"B,47,8\r")),
              "error: line 3 has a quotation mark without an end: all lines behind it are in one field");
    EXPECT_EQ(points_of(written("a.csv", "\"name,lat,lon\nA,46,8\n")),
              "error: line 1 has a quotation mark without an end: all lines behind it are in one field");
    // Blanks may stand there, and a mark within a field that begins without one is text.
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon\n\"A\" , \"46\" ,8\n5\" gun,47,8\n")),
              "A 46.0000 8.0000 nan; 5\" gun 47.0000 8.0000 nan");
}

TEST(Csv, LinesHaveAsManyFieldsAsTheFirst) {
    EXPECT_EQ(points_of(written("a.csv", "name\tlat\tlon\nA\t46\t8\nB\t47\t8\tmore\n")),
              "error: line 3 has 4 fields, and the first line names 3");
    // What spreadsheets leave out at the end of a line is empty.
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon,ele,note\nA,46,8\nB,47,8\n")),
              "A 46.0000 8.0000 nan; B 47.0000 8.0000 nan");
    // 8.2 was read of 8.2512 where a file was cut.
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon,ele\nA,46,8.25,1200\nB,47,8.2")),
              "error: line 3 is the last one and has 3 of 4 fields and no end: the file is cut");
    EXPECT_EQ(points_of(written("a.csv", "name,lat,lon\nA,46,8\nB,47,8")),
              "A 46.0000 8.0000 nan; B 47.0000 8.0000 nan");
    EXPECT_EQ(points_of(written("a.csv", "name,lat,Lat,lon\nA,46,47,8\n")),
              "error: line 1 names two columns 'lat': which of them counts is not clear");
}

TEST(Csv, Utf16WithoutAMarkIsRefusedByItsName) {
    std::string wide;
    for (const char c : std::string("name,lat,lon\nA,46.5,8.25\n")) wide += c, wide += '\0';
    EXPECT_EQ(
        points_of(written("a.csv", wide)),
        "error: is no text, or UTF-16 without a byte order mark (it holds zero bytes): save it as UTF-8");
    EXPECT_EQ(points_of(written("a.csv", "\xff\xfe" + wide)), "A 46.5000 8.2500 nan");
    std::string other = "\xfe\xff";
    for (const char c : std::string("name;lat;lon\nA;46.5;8.25\n")) other += '\0', other += c;
    EXPECT_EQ(points_of(written("a.csv", other)), "A 46.5000 8.2500 nan");
}

TEST(Csv, FieldsInQuotationMarksHoldMarksAndEndsOfLines) {
    const auto read = read_vectors(
        written("a.csv", "name,note,lat,lon\n\"Piz \"\"A\"\", upper\",\"one\ntwo\",46,8\n\"B\",,47,9\n"));
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorLayer& layer = read->layers.front();
    ASSERT_EQ(layer.shapes.size(), 2U);
    EXPECT_EQ(layer.text(layer.shapes[0], "name"), "Piz \"A\", upper");
    EXPECT_EQ(layer.text(layer.shapes[0], "note"), "one\ntwo");
    EXPECT_EQ(layer.text(layer.shapes[1], "note"), "");
    EXPECT_EQ(layer.name, "a");
    // Coordinates are no fields.
    EXPECT_EQ(layer.fields, (std::vector<std::string>{"name", "note"}));
}

TEST(Csv, LinesAndPolygonsComeAsWellKnownText) {
    const auto read = read_vectors(
        written("a.csv", "name;geom\nway;LINESTRING(8 46,9 46,9 47)\nlake;POLYGON((8 46,9 46,9 47,8 46))\n"));
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->count(VectorKind::line), 1U);
    EXPECT_EQ(read->count(VectorKind::polygon), 1U);
    EXPECT_EQ(read->ring_ends, 1U);
}

TEST(Csv, TextOfOldSpreadsheetsIsWindows1252) {
    const std::string file = written("a.csv", "name;lat;lon\nGr\xfcn\x80;46;8\n");
    EXPECT_EQ(points_of(file), "Grün€ 46.0000 8.0000 nan");
    EXPECT_EQ(notes_of(file), "is no UTF-8 and is read as Windows-1252");
}

TEST(Csv, ATableWithoutCoordinatesSaysWhatItNeeds) {
    const std::string said = points_of(written("a.csv", "a,b\n1,2\n"));
    EXPECT_NE(said.find("its first line names no columns of coordinates: a CSV has lat and lon, or WKT, or x "
                        "and y (E and N) with a coordinate reference system"),
              std::string::npos)
        << said;
}

}  // namespace
}  // namespace oro
