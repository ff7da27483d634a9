// TopoJSON: arcs that are put together, and what is wrong with them.
#include <gtest/gtest.h>

#include <string>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
using test::written;

// "KIND NAME lat lon, lat lon" of all shapes, with | between them; or the error. Then the notes.
std::string all_of(const std::string& text) {
    const std::string file = written("a.topojson", text);
    const auto read = read_vectors(file);
    if (!read.ok()) return "error: " + read.error().what;
    std::string all;
    for (const VectorLayer& layer : read->layers)
        for (const VectorShape& shape : layer.shapes) {
            if (!all.empty()) all += " | ";
            all += layer.name + " " + std::string(layer.text(shape, "name"));
            for (const auto& path : shape.paths) {
                all += " (";
                for (const VectorPlace& place : path) {
                    char words[60];
                    std::snprintf(words, sizeof words, "%s%g %g", &place == path.data() ? "" : ",",
                                  place.lat_deg, place.lon_deg);
                    all += words;
                }
                all += ")";
            }
        }
    for (const std::string& note : read->notes) all += " / " + note.substr(file.size() + 2);
    return all;
}

std::string topology(const std::string& objects, const std::string& arcs, const std::string& more = "") {
    return R"({"type":"Topology",)" + more + R"("objects":{)" + objects + R"(},"arcs":[)" + arcs + "]}";
}

// The example of the specification (TopoJSON Format Specification, 1.1), whose objects are 102 0.5, the line
// from 102 0 to 105 1, and the square with its corner 100 0.
TEST(TopoJson, TheExampleOfTheSpecificationIsRead) {
    const std::string example = topology(
        R"("example":{"type":"GeometryCollection","geometries":[
          {"type":"Point","properties":{"name":"P"},"coordinates":[4000,5000]},
          {"type":"LineString","properties":{"name":"L","n":0},"arcs":[0]},
          {"type":"Polygon","properties":{"name":"S"},"arcs":[[1]]}]})",
        "[[4000,0],[1999,9999],[2000,-9999],[2000,9999]],[[0,0],[0,9999],[2000,0],[0,-9999],[-2000,0]]",
        R"("transform":{"scale":[0.0005000500050005,0.00010001000100010001],"translate":[100,0]},)");
    EXPECT_EQ(all_of(example),
              "example P (0.50005 102) | example L (0 102,1 103,0 104,1 105) | example S (0 100,1 100,1 "
              "101,0 101)");
}

TEST(TopoJson, ArcsAreSharedAndTakenFromBothEnds) {
    // Two triangles with a common side, 8 46 to 9 47.
    EXPECT_EQ(all_of(topology(
                  R"("left":{"type":"Polygon","arcs":[[0,1]]},
                     "right":{"type":"MultiPolygon","arcs":[[[-1,2]]],"id":7},
                     "way":{"type":"MultiLineString","arcs":[[0],[~0]]})",
                  "[[8,46],[9,47]],[[9,47],[8,47],[8,46]],[[8,46],[9,46],[9,47]]")),
              "error: is no whole JSON: line 3: here should be a value, and is '~0'");
    EXPECT_EQ(all_of(topology(
                  R"("left":{"type":"Polygon","arcs":[[0,1]]},
                     "right":{"type":"MultiPolygon","arcs":[[[-1,2]]],"properties":{"name":"R"}},
                     "way":{"type":"MultiLineString","arcs":[[0],[-1]]})",
                  "[[8,46],[9,47]],[[9,47],[8,47],[8,46]],[[8,46],[9,46],[9,47]]")),
              "left  (46 8,47 9,47 8) | right R (47 9,46 8,46 9) | way  (46 8,47 9) | way  (47 9,46 8)");
}

TEST(TopoJson, WhatIsWrongIsLeftOutAndCounted) {
    const std::string arcs = "[[8,46],[9,47]],[[9,47],[9,\"x\"],[9,48],[10,48]]";
    EXPECT_EQ(
        all_of(
            topology(R"("a":{"type":"LineString","arcs":[5]},"b":{"type":"LineString","arcs":[0]})", arcs)),
        "b  (46 8,47 9) / left out 1 geometry with an arc that is not there, in line 1: '5' / left out 1 "
        "arc that no line or polygon has, in line 1");
    EXPECT_EQ(all_of(topology(R"("a":{"type":"LineString","arcs":[0,1]})", arcs)),
              "a  (46 8,47 9) | a  (48 9,48 10) / left out 1 place of a line that is no number, in line 1: "
              "'\"x\"'");
    // Quantized, all places after one count from it.
    EXPECT_EQ(
        all_of(topology(R"("a":{"type":"LineString","arcs":[0]})", "[[80,460],[1,1],[null,1],[1,1]]",
                        R"("transform":{"scale":[0.1,0.1],"translate":[0,0]},)")),
        "a  (46 8,46.1 8.1) / left out 1 place of a line that is no number, in line 1: 'null' / left out 1 "
        "place of a line that counts from one that is no number, in line 1: '[1,1]'");
    EXPECT_EQ(
        all_of(topology(R"("a":{"type":"Curve"},"b":{"type":null},"c":{"type":"Point","coordinates":[8,46]})",
                        "")),
        "c  (46 8) / left out 1 geometry of a kind that is not known here, in line 1: 'Curve' / left out 1 "
        "feature without a geometry, in line 1");
    EXPECT_EQ(all_of(R"({"type":"Topology","arcs":[]})"), "error: is TopoJSON without objects");
    EXPECT_EQ(all_of(topology("", "", R"("transform":{"scale":[1],"translate":[0,0]},)")),
              "error: is TopoJSON whose transform has no scale of two numbers");
    EXPECT_EQ(all_of(topology("", "", R"("transform":{"scale":[1,"a"],"translate":[0,0]},)")),
              "error: is TopoJSON whose transform has the scale '\"a\"', which is no number");
}

// Two thousand rings of one arc of a thousand places are two million places, of 30 kB.
TEST(TopoJson, AnArcThatIsNamedTooOftenIsAnError) {
    std::string arc = "[", lines;
    for (int i = 0; i < 1000; ++i) arc += (i > 0 ? ",[" : "[") + std::to_string(i % 90) + ",46]";
    for (int i = 0; i < 2'000; ++i) lines += i > 0 ? ",[0]" : "[0]";
    EXPECT_EQ(all_of(topology(R"("a":{"type":"Polygon","arcs":[)" + lines + "]}", arc + "]")),
              "error: puts its arcs together to more than 1064000 places, which is the limit");
}

}  // namespace
}  // namespace oro
