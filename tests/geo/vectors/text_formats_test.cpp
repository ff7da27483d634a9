// KML, GPX and GeoJSON as people's programs write them: what is odd and readable is read, what is no place is
// left out and counted, with the line where it stands first.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/geo/vectors/written_zip.h"

namespace oro {
namespace {
using test::collection;
using test::feature;
using test::written;

// What a file gives, in a line: "line 8 46, 9 47; point 1 2 | note".
std::string line_of(const std::string& file) {
    const auto read = read_vectors(file);
    if (!read.ok()) return "error: " + read.error().what;
    std::string all;
    for (const VectorLayer& layer : read->layers) {
        for (const VectorShape& shape : layer.shapes) {
            all += all.empty() ? "" : "; ";
            all += shape.kind == VectorKind::point  ? "point"
                   : shape.kind == VectorKind::line ? "line"
                                                    : "polygon";
            for (const auto& path : shape.paths) {
                for (const VectorPlace& place : path) {
                    char text[80];
                    std::snprintf(text, sizeof text, "%s%.6g %.6g", &place == path.data() ? " " : ", ",
                                  place.lon_deg, place.lat_deg);
                    all += text;
                }
            }
        }
    }
    for (const std::string& note : read->notes) all += " | " + note.substr(file.size() + 2);
    return all;
}

std::string kml_of(const std::string& geometry) {
    return test::kml("<Placemark><name>p</name>" + geometry + "</Placemark>");
}

// The first four ended the program by a signal, or refused the file, with GDAL 3.6's LIBKML.
TEST(KmlFile, TracksModelsAndTheirCollectionsAreRead) {
    const std::string two = "<gx:coord>8.01 46.96 0</gx:coord><gx:coord>8.03 46.98 0</gx:coord>",
                      when = "<when>2010-05-28T02:02:09Z</when>", line = "line 8.01 46.96, 8.03 46.98";
    EXPECT_EQ(line_of(written("a.kml", kml_of("<gx:Track>" + two + "</gx:Track>"))), line);
    EXPECT_EQ(line_of(written("a.kml", kml_of("<gx:Track>" + when + two + "</gx:Track>"))), line);
    EXPECT_EQ(
        line_of(written("a.kml", kml_of("<gx:MultiTrack><gx:Track>" + two + "</gx:Track></gx:MultiTrack>"))),
        line);
    EXPECT_EQ(
        line_of(written(
            "a.kml",
            kml_of("<MultiGeometry><Model><Location><longitude>8.02</longitude><latitude>46.97</latitude>"
                   "<altitude>0</altitude></Location></Model></MultiGeometry>"))),
        "point 8.02 46.97");
    // KML 2.3 (OGC 12-007r2) has them without a prefix.
    EXPECT_EQ(line_of(written(
                  "a.kml", kml_of("<Track><altitudeMode>absolute</altitudeMode>" + when +
                                  "<coord>10.10 45.80 322</coord><coord>10.20 45.80 322</coord></Track>"))),
              "line 10.1 45.8, 10.2 45.8");
    EXPECT_EQ(
        line_of(written("a.kml", kml_of("<gx:Track><gx:coord>8.01</gx:coord><gx:coord>8.03 46.98</gx:coord>" +
                                        two + "</gx:Track>"))),
        "line 8.03 46.98, 8.01 46.96, 8.03 46.98 | left out 1 place of a line without a latitude or without "
        "a "
        "longitude, in line 1");
}

TEST(KmlFile, GeometriesFoldersAndOverlaysAreRead) {
    EXPECT_EQ(line_of(written("a.kml", kml_of("<LineString><coordinates>8.1, 46.1, 5  8.2 , 46.2\n8.3,46.3,"
                                              "</coordinates></LineString>"))),
              "line 8.1 46.1, 8.2 46.2, 8.3 46.3");
    EXPECT_EQ(
        line_of(written(
            "a.kml",
            kml_of("<Polygon><outerBoundaryIs><LinearRing><coordinates>8,46 9,46 9,47 8,46</coordinates>"
                   "</LinearRing></outerBoundaryIs><innerBoundaryIs><LinearRing><coordinates>8.5,46.1 "
                   "8.6,46.1 8.6,46.2 8.5,46.1</coordinates></LinearRing></innerBoundaryIs></Polygon>"))),
        "polygon 8 46, 9 46, 9 47 8.5 46.1, 8.6 46.1, 8.6 46.2");
    EXPECT_EQ(
        line_of(written("a.kml",
                        test::kml("<Folder><Folder><GroundOverlay><LatLonBox><north>47</north><south>46"
                                  "</south><east>9</east><west>8</west></LatLonBox></GroundOverlay></Folder>"
                                  "</Folder><Placemark><Camera><longitude>8</longitude><latitude>46"
                                  "</latitude></Camera></Placemark>"))),
        "point 8 46; polygon 9 47, 9 46, 8 46, 8 47");
    EXPECT_EQ(
        line_of(written("a.kml", "<Placemark><Point><coordinates>8,46</coordinates></Point></Placemark>")),
        "point 8 46");
}

TEST(KmlFile, WhatStandsWhereNothingBelongsIsCounted) {
    const std::string point = "<Placemark><Point><coordinates>8,46</coordinates></Point></Placemark>";
    EXPECT_EQ(line_of(written(
                  "a.kml", test::kml(point + "\n<coordinates>1,2 3,4</coordinates><Style><Point><coordinates>"
                                             "5,6</coordinates></Point></Style>"))),
              "point 8 46 | left out 3 places that stand where KML has none, the first in line 2");
    EXPECT_EQ(line_of(written(
                  "a.kml", test::kml(point + "<NetworkLink><Link><href>b.kml</href></Link></NetworkLink>"))),
              "point 8 46 | left out 1 link to another file, which is not followed, in line 1");
    EXPECT_EQ(
        line_of(written("a.kml", kml_of("<Point><coordinates>8,01 46,96</coordinates></Point>"))),
        "error: holds no points, lines or polygons; left out: 1 point of more than one place, in line 1");
}

TEST(KmlFile, IsReadFromAKmz) {
    const std::string text = kml_of("<Point><coordinates>8,46</coordinates></Point>"),
                      other = kml_of("<Point><coordinates>9,47</coordinates></Point>");
    EXPECT_EQ(
        line_of(test::written_zip("a.kmz", {{"files/x.png", "x"}, {"b.kml", other}, {"doc.kml", text}})),
        "point 8 46 | 1 .kml in it is not read, since nothing links to it: b.kml");
    EXPECT_EQ(line_of(test::written_zip("a.kmz", {{"in/b.kml", other}})), "point 9 47");
    EXPECT_EQ(line_of(test::written_zip("a.zip", {{"a.txt", "x"}})),
              "error: is packed and holds no .kml, .shp, .gpkg, .fgb, .geojson, .topojson, .gpx or .csv: "
              "unpack it and name what is in it");
    test::ZipEntry locked{"doc.kml", text};
    locked.flags = 1;
    EXPECT_EQ(line_of(test::written_zip("a.kmz", {locked})),
              "error: doc.kml is locked with a password: unpack it, and name the file");
    test::ZipEntry rare{"doc.kml", text};
    rare.method = 9;
    EXPECT_EQ(
        line_of(test::written_zip("a.kmz", {rare})),
        "error: doc.kml is packed by Deflate64, and only Deflate is read: unpack it, and name the file");
    test::ZipEntry broken{"doc.kml", text};
    broken.crc ^= 1U;
    EXPECT_EQ(line_of(test::written_zip("a.kmz", {broken})),
              "error: doc.kml cannot be unpacked: it is damaged");
}

// A 2.7 km track became one of 216 km: what is no number was read as far as it was one.
TEST(GpxFile, CoordinatesThatAreNoNumbersAreLeftOutAndCounted) {
    const auto track = [](const std::string& lat) {
        return written("a.gpx",
                       test::gpx("<trk><trkseg>\n<trkpt lat=\"46.95\" lon=\"8.0\"/><trkpt lat=\"46.96\" "
                                 "lon=\"8.01\"/>\n<trkpt lat=\"" +
                                 lat +
                                 "\" lon=\"8.02\"/>\n<trkpt lat=\"46.98\" lon=\"8.03\"/><trkpt "
                                 "lat=\"46.99\" lon=\"8.04\"/></trkseg></trk>"));
    };
    const std::string rest =
        "line 8 46.95, 8.01 46.96; line 8.03 46.98, 8.04 46.99 | left out 1 place of a line ";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"46,97", "that is no number, in line 3: '46,97'"},
        {"north", "that is no number, in line 3: 'north'"},
        {"46.9.7", "that is no number, in line 3: '46.9.7'"},
        {"46.97N", "that is no number, in line 3: '46.97N'"},
        {"0x2e", "that is no number, in line 3: '0x2e'"},
        {"", "without a latitude or without a longitude, in line 3"},
        {" ", "without a latitude or without a longitude, in line 3: ' '"},
        {"nan", "that is no finite number, in line 3: 'nan'"},
        {"-INF", "that is no finite number, in line 3: '-INF'"},
        {"1e400", "that is no finite number, in line 3: '1e400'"},
        {"95", "with a latitude beyond 90 degrees, in line 3"},
    };
    for (const auto& [lat, says] : cases) EXPECT_EQ(line_of(track(lat)), rest + says) << lat;
    EXPECT_EQ(line_of(track(" +46.97 ")), "line 8 46.95, 8.01 46.96, 8.02 46.97, 8.03 46.98, 8.04 46.99");
    EXPECT_EQ(
        line_of(written(
            "a.gpx", test::gpx("<wpt lon=\"8\"/><wpt lat=\"46\" lon=\"8\"/><trkpt lat=\"1\" lon=\"2\"/>"))),
        "point 8 46 | left out 1 point without a latitude or without a longitude, in line 1 | left out 1 "
        "place "
        "that stands where GPX has none");
    EXPECT_EQ(line_of(written("a.gpx", test::gpx("<wpt lat=\"46\" lon=\"8\"><ele>1 200,5</ele></wpt>"))),
              "point 8 46 | left out 1 height that is no number, in line 1");
}

TEST(GpxFile, FieldsAreThoseOfItsElementsAndExtensions) {
    const auto read = read_vectors(written(
        "a.gpx",
        test::gpx(
            "<wpt lat=\"46\" lon=\"8\"><ele>1.25e3</ele><name> Hut &amp; pass </name><link href=\"h\"><text>t"
            "</text></link><extensions><ogr:peak>1</ogr:peak><x:a><x:b>c</x:b></x:a></extensions></wpt>")));
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorLayer& layer = read->layers.front();
    const VectorShape& shape = layer.shapes.front();
    EXPECT_EQ(layer.name, "waypoints");
    EXPECT_EQ(layer.text(shape, "name"), "Hut & pass");
    EXPECT_EQ(layer.text(shape, "ele"), "1250");
    EXPECT_EQ(layer.text(shape, "link1_href"), "h");
    EXPECT_EQ(layer.text(shape, "link1_text"), "t");
    EXPECT_EQ(layer.text(shape, "peak"), "1");
    EXPECT_EQ(layer.text(shape, "x_a_x_b"), "c");
}

TEST(GeoJsonFile, CoordinatesThatAreNoNumbersAreLeftOutAndCounted) {
    const std::string rest = "line 1 1, 2 2; line 4 4, 5 5 | left out 1 place of a line ";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"[\"3,1\",3]", "that is no number, in line 2: '\"3,1\"'"},
        {"[null,3]", "that is no number, in line 2: 'null'"},
        {"null", "that is no number, in line 2: 'null'"},
        {"[3]", "without a latitude or without a longitude, in line 2"},
        {"[]", "without a latitude or without a longitude, in line 2"},
        {"[NaN,3]", "that is no finite number, in line 2: 'NaN'"},
        {"[3,1e400]", "that is no finite number, in line 2: '1e400'"},
        {"[3,1.2.3]", "that is no number, in line 2: '1.2.3'"},
    };
    for (const auto& [place, says] : cases)
        EXPECT_EQ(line_of(written("a.geojson", collection(feature("LineString", "[[1,1],[2,2],\n" + place +
                                                                                    ",[4,4],[5,5]]")))),
                  rest + says)
            << place;
    const std::string good = feature("Point", "[8,46]");
    EXPECT_EQ(
        line_of(written("a.geojson",
                        collection(good + "," + feature("LineString", "[8,46]") + ",\n" +
                                   feature("Circle", "[8,46]") + "," + feature("Polygon", "[[1,2],[3,4]]")))),
        "point 8 46 | left out 2 geometries whose coordinates do not fit their type, the first in line 1: "
        "'LineString' | left out 1 geometry of a kind that is not known here, in line 2: 'Circle'");
    // What Python writes for a number that is none.
    EXPECT_EQ(
        line_of(written("a.geojson", collection(feature("Point", "[8,46]", "\"ele\":NaN,\"x\":-Infinity")))),
        "point 8 46");
}

TEST(GeoJsonFile, BrokenJsonIsToldWithItsLine) {
    const std::string none = "error: is no whole JSON: line ";
    EXPECT_EQ(line_of(written("a.geojson", "{\"type\":\"Point\",\n\"coordinates\":[8,46,]}")),
              none + "2: here should be a value, and is ']'");
    EXPECT_EQ(line_of(written("a.geojson", "{\"type\":\"Point\",\n\"coordinates\":[8 46]}")),
              none + "2: a comma is missing, or a bracket is too many");
    EXPECT_EQ(line_of(written("a.geojson", "{\"type\":\"Point\",\"coordinates\":[8,46]}\n{}")),
              none + "2: more follows after its end");
    EXPECT_EQ(line_of(written("a.geojson", "{\"a\":" + std::string(200, '[') + std::string(200, ']') + "}")),
              none + "1: lists within lists are more than 128 deep");
    EXPECT_EQ(line_of(written("a.geojson", R"({"type":"CovJSON","arcs":[]})")),
              "error: is JSON, but no GeoJSON: its type is 'CovJSON'");
}

// Marks and encodings that editors put before a text: all of one place.
TEST(TextFormats, MarksAndEncodingsAreReadAsTheyAreMeant) {
    const std::string plain = test::gpx("<wpt lat=\"46\" lon=\"8\"><name>H\u00fctte</name></wpt>");
    const auto wide = [](const std::string& text, bool high_first) {
        std::string bytes = high_first ? "\xfe\xff" : "\xff\xfe";
        for (std::size_t i = 0; i < text.size(); ++i) {
            const auto c = static_cast<unsigned char>(text[i]);
            const unsigned code =
                c < 0x80 ? c : ((c & 0x1fU) << 6U) | (static_cast<unsigned char>(text[++i]) & 0x3fU);
            const char low = static_cast<char>(code & 0xffU), high = static_cast<char>(code >> 8U);
            bytes += high_first ? high : low;
            bytes += high_first ? low : high;
        }
        return bytes;
    };
    std::string latin = plain;
    latin.replace(latin.find("\u00fc"), 2, "\xfc");
    std::string declared = latin;
    declared.replace(declared.find("?>"), 2, " encoding=\"windows-1252\"?>");
    for (const std::string& bytes :
         {plain, "\xef\xbb\xbf" + plain, wide(plain, false), wide(plain, true), declared}) {
        const auto read = read_vectors(written("a.gpx", bytes));
        ASSERT_TRUE(read.ok()) << read.error().line();
        const VectorLayer& layer = read->layers.front();
        EXPECT_EQ(layer.text(layer.shapes.front(), "name"), "H\u00fctte");
    }
    const std::string json = feature("Point", "[8,46]");
    EXPECT_EQ(line_of(written("a.geojson", "\xef\xbb\xbf\r\n" + json)), "point 8 46");
    EXPECT_EQ(line_of(written("a.geojson", wide(json, false))), "point 8 46");
    const std::string earth = kml_of("<Point><coordinates>8,46</coordinates></Point>");
    EXPECT_EQ(line_of(written("a.kml", "\xef\xbb\xbf" + earth)), "point 8 46");
    EXPECT_EQ(line_of(written("a.kml", wide(earth, true).substr(2))), "point 8 46");
    EXPECT_EQ(line_of(written("a.kml", wide(earth, false) + "x")),
              "error: is UTF-16 and ends within a character: it is cut");
}

// 200,000 elements within each other, and a million of fields: no recursion, no square of them.
TEST(TextFormats, DeepAndWideFilesAreRead) {
    std::string open, close;
    for (int i = 0; i < 200'000; ++i) open += "<MultiGeometry>", close += "</MultiGeometry>";
    EXPECT_EQ(
        line_of(written("a.kml", kml_of(open + "<Point><coordinates>8,46</coordinates></Point>" + close))),
        "point 8 46");
    open.clear(), close.clear();
    for (int i = 0; i < 200'000; ++i) open += "<Folder>", close += "</Folder>";
    EXPECT_EQ(line_of(written(
                  "a.kml",
                  test::kml(open + "<Placemark><Point><coordinates>8,46</coordinates></Point></Placemark>" +
                            close))),
              "point 8 46");
    std::string fields;
    for (int i = 0; i < 100'000; ++i) fields += (i > 0 ? ",\"f" : "\"f") + std::to_string(i) + "\":1";
    EXPECT_EQ(line_of(written("a.geojson", collection(feature("Point", "[8,46]", fields)))), "point 8 46");
}

}  // namespace
}  // namespace oro
