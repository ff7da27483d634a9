// Vector files in archives: KML whose files link to each other, and others that are packed alone.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/geo/vectors/written_zip.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::written_zip;
using test::ZipEntry;

// The points of a file, "LAYER NAME LAT LON" with ; between them, and its notes behind |; or its error.
std::string said_of(const std::string& file) {
    const auto read = read_vectors(file);
    if (!read.ok()) return "error: " + read.error().what;
    std::string all;
    for (const VectorLayer& layer : read->layers)
        for (const VectorShape& shape : layer.shapes) {
            const VectorPlace& place = shape.paths.front().front();
            char text[60];
            std::snprintf(text, sizeof text, " %.4f %.4f", place.lat_deg, place.lon_deg);
            all +=
                (all.empty() ? "" : "; ") + layer.name + " " + std::string(layer.text(shape, "name")) + text;
        }
    for (const std::string& note : read->notes) all += " | " + note.substr(file.size());
    return all;
}

std::string kml_point(const std::string& name, const std::string& place) {
    return "<Placemark><name>" + name + "</name><Point><coordinates>" + place +
           "</coordinates></Point></Placemark>";
}

std::string kml_link(const std::string& href) {
    return "<NetworkLink><Link><href>" + href + "</href></Link></NetworkLink>";
}

// What `ogr2ogr -f LIBKML p.kmz p.geojson` of GDAL 3.6 writes.
TEST(KmzLinks, LinksWithinAKmzAreFollowed) {
    const std::string doc = R"(<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2">
  <Document id="root_doc">
    <NetworkLink>
      <Link>
        <href>layers/p.kml</href>
      </Link>
    </NetworkLink>
  </Document>
</kml>)",
                      layer = R"(<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2">
  <Document id="p">
    <name>p</name>
    <Placemark id="p.1">
      <name>Peak</name>
      <Point><coordinates>-84.27,36.6,0</coordinates></Point>
    </Placemark>
  </Document>
</kml>)";
    EXPECT_EQ(said_of(written_zip("p.kmz", {{"doc.kml", doc}, {"layers/", ""}, {"layers/p.kml", layer}})),
              "p Peak 36.6000 -84.2700");
    // Paths begin at the file with the link; names are written with escapes, or as they are.
    EXPECT_EQ(
        said_of(written_zip(
            "a.kmz",
            {{"doc.kml", test::kml(kml_point("A", "8,46") + kml_link("./in/b%20c.kml#d") +
                                   kml_link("<![CDATA[in/50 %.kml]]>"))},
             {"in/b c.kml", test::kml("<name>L</name>" + kml_point("B", "9,47") + kml_link("deep/e.kml"))},
             {"in/50 %.kml", kml_point("C", "10,48")},
             {"in/deep/e.kml", test::kml(kml_point("E", "11,49"))},
             {"in/nobody.kml", test::kml(kml_point("F", "12,50"))}})),
        " A 46.0000 8.0000; L B 47.0000 9.0000; 50 % C 48.0000 10.0000;  E 49.0000 11.0000 | : 1 .kml in "
        "it is not read, since nothing links to it: in/nobody.kml");
}

TEST(KmzLinks, ACycleIsReadOnce) {
    EXPECT_EQ(said_of(written_zip("a.kmz", {{"doc.kml", test::kml(kml_link("a.kml") + kml_link("doc.kml") +
                                                                  kml_point("D", "8,46"))},
                                            {"a.kml", test::kml(kml_link("doc.kml") + kml_link("a.kml") +
                                                                kml_link("b.kml") + kml_point("A", "9,47"))},
                                            {"b.kml", test::kml(kml_link("a.kml"))}})),
              " D 46.0000 8.0000;  A 47.0000 9.0000");
}

TEST(KmzLinks, OneOutOfTheArchiveIsLeftOut) {
    std::string links;
    for (const char* const href :
         {"../b.kml", "/b.kml", "deep/../../b.kml", "%2e%2e/b.kml", "..\\b.kml", "http://127.0.0.1:1/b.kml",
          "file:///b.kml", "none.kml", "c.png", "", "in/a.kml"})
        links += "\n" + kml_link(href);
    const std::string file = written_zip("a.kmz", {{"in/a.kml", test::kml(kml_point("A", "8,46") + links)},
                                                   {"b.kml", test::kml(kml_point("B", "9,47"))},
                                                   {"in/c.png", "x"}});
    EXPECT_EQ(said_of(file),
              " A 46.0000 8.0000 | : left out 11 links to other files, which are not followed, the first in "
              "line 2 | : 1 .kml in it is not read, since nothing links to it: b.kml");
    // A note of a file that is linked names it.
    EXPECT_EQ(
        said_of(written_zip("a.kmz",
                            {{"doc.kml", test::kml(kml_link("b.kml"))},
                             {"b.kml", test::kml(kml_point("B", "9,47") + "\n" + kml_link("../c.kml"))}})),
        " B 47.0000 9.0000 | /b.kml: left out 1 link to another file, which is not followed, in line 2");
    EXPECT_EQ(said_of(written_zip("a.kmz", {{"doc.kml", test::kml(kml_link("b.kml"))},
                                            {"b.kml", test::kml(kml_link("../c.kml"))}})),
              "error: holds no points, lines or polygons; left out: 1 link to another file, which is not "
              "followed, in line 1");
}

TEST(KmzLinks, SixtyFourFilesAreReadBesideTheFirst) {
    std::string links;
    std::vector<ZipEntry> entries{{"doc.kml", ""}};
    for (int i = 0; i < 70; ++i) {
        const std::string name = std::to_string(i) + ".kml";
        links += kml_link(name);
        entries.emplace_back(name, test::kml(kml_point("A", "8,46")));
    }
    entries.front() = ZipEntry("doc.kml", test::kml(links));
    const auto read = read_vectors(written_zip("a.kmz", entries));
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->layers.size(), 64U);
    ASSERT_EQ(read->notes.size(), 1U);
    EXPECT_EQ(read->notes.front().substr(read->file.size()),
              ": links to more than 64 files in it, which is the limit: 6 are not read, the first by name is "
              "64.kml");
}

// The first of two files of one name was read without a word.
TEST(KmzLinks, TwoFilesOfOneNameAreRefused) {
    EXPECT_EQ(
        said_of(written_zip("a.kmz", {{"doc.kml", test::kml(kml_point("A", "8,46"))},
                                      {"doc.kml", test::kml(kml_point("B", "9,47"))}})),
        "error: holds 2 files of the name doc.kml, and which of them counts is not clear: unpack it and "
        "name the file");
    EXPECT_EQ(said_of(written_zip("a.kmz", {{"b.kml", test::kml("")},
                                            {"c.kml", test::kml(kml_point("B", "9,47"))},
                                            {"d.kml", test::kml(kml_point("B", "9,47"))}})),
              "error: holds no points, lines or polygons; left out: 2 .kml in it are not read, since nothing "
              "links to them, the first is c.kml");
}

TEST(KmzLinks, WhatIsWrongWithAFileThatIsLinkedNamesIt) {
    const std::string doc = test::kml(kml_link("b.kml"));
    EXPECT_EQ(said_of(written_zip("a.kmz", {{"doc.kml", doc}, {"b.kml", "<kml>\n<Document>"}})),
              "error: b.kml: is no whole XML: line 2: an element is closed that is not open, or one is never "
              "closed");
    ZipEntry broken{"b.kml", doc};
    broken.crc ^= 1U;
    EXPECT_EQ(said_of(written_zip("a.kmz", {{"doc.kml", doc}, broken})),
              "error: b.kml cannot be unpacked: it is damaged");
}

// An entry that Deflate packs: 12 MiB of blanks behind a text.
ZipEntry packed_with_blanks(const std::string& name, const std::string& text) {
    const std::string whole = text + std::string(std::size_t{12} << 20U, ' ');
    ZipEntry entry(name, whole);
    entry.method = 8;
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY), Z_OK);
    std::string packed(deflateBound(&stream, static_cast<uLong>(whole.size())), '\0');
    std::string from = whole;
    stream.next_in = reinterpret_cast<Bytef*>(from.data());
    stream.avail_in = static_cast<uInt>(from.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    entry.bytes = packed;
    return entry;
}

// Each of them may be unpacked, and not all.
TEST(KmzLinks, TheFilesTogetherAreNoBomb) {
    const ZipEntry doc = packed_with_blanks("doc.kml", test::kml(kml_point("A", "8,46") + kml_link("b.kml"))),
                   other = packed_with_blanks("b.kml", test::kml(kml_point("B", "9,47")));
    EXPECT_EQ(said_of(written_zip("a.kmz", {other})), " B 47.0000 9.0000");
    EXPECT_EQ(said_of(written_zip("a.kmz", {doc, other})),
              "error: holds b.kml, which with the files before it would unpack to more than 200 times the "
              "archive's length: it is not unpacked");
}

// The files of a dataset that lie beside its first one, in an archive's folder.
std::vector<ZipEntry> entries_beside(const std::string& file, const std::string& folder,
                                     const std::vector<std::string>& endings) {
    std::vector<ZipEntry> entries;
    for (const std::string& ending : endings) {
        const fs::path path = fs::path(file).replace_extension(ending);
        std::ifstream in(path, std::ios::binary);
        entries.emplace_back(folder + path.filename().string(),
                             std::string{std::istreambuf_iterator<char>(in), {}});
    }
    return entries;
}

std::string bern_shapefile(const std::string& name) {
    return test::vector_dataset(name, "ESRI Shapefile", 2056, {{"POINT (2600000 1200000)", "Bern"}});
}

// By swisstopo's formulas E 2,600,000 N 1,200,000 of EPSG:2056 is 46.951083 N 7.438632 E.
TEST(ZippedVectors, AShapefileIsRead) {
    const std::string shp = bern_shapefile("a.shp");
    std::vector<ZipEntry> entries = entries_beside(shp, "data/", {".shp", ".shx", ".dbf", ".prj"});
    const std::string zip = written_zip("b.zip", entries);
    const auto read = read_vectors(zip);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(said_of(zip), "a Bern 46.9511 7.4386");
    EXPECT_EQ(read->files, std::vector<std::string>{zip});
    // Capital letters, what macOS adds, and texts beside it are fine.
    entries[2].name = "data/a.DBF";
    entries.insert(entries.begin(), {{"__MACOSX/data/._a.shp", "x"}, {"data/codes.csv", "a,b\n1,2\n"}});
    EXPECT_EQ(said_of(written_zip("b.zip", entries)), "a Bern 46.9511 7.4386");
    EXPECT_EQ(said_of(written_zip("b.zip", entries_beside(shp, "", {".shp", ".shx", ".prj"}))),
              "a  46.9511 7.4386 | : is a shapefile without its .dbf: its shapes are read, their names and "
              "other fields are not there");
}

TEST(ZippedVectors, OtherFormatsAreRead) {
    const std::string point = test::collection(test::feature("Point", "[8,46]", R"("name":"A")"));
    EXPECT_EQ(said_of(written_zip("a.zip", {{"readme.txt", "x"}, {"in/b.geojson", point}})),
              "b A 46.0000 8.0000");
    EXPECT_EQ(said_of(written_zip("a.zip", {{"b.json", point}})), "b A 46.0000 8.0000");
    EXPECT_EQ(said_of(written_zip("a.zip", {{"b.gpx", test::gpx("<wpt lat=\"46\" lon=\"8\"/>")}})),
              "waypoints  46.0000 8.0000");
    EXPECT_EQ(said_of(written_zip(
                  "a.zip", {{"in/b.csv", "name,E,N\nBern,2600000,1200000\n"}, {"in/b.prj", "EPSG:2056"}})),
              "b Bern 46.9511 7.4386 | : its coordinates are in the coordinate reference system of the .prj "
              "beside it");
    for (const auto& [name, driver] : {std::pair{"b.gpkg", "GPKG"}, {"b.fgb", "FlatGeobuf"}}) {
        const std::string file =
            test::vector_dataset(name, driver, 2056, {{"POINT (2600000 1200000)", "Bern"}});
        const auto entries = entries_beside(file, "in/", {fs::path(name).extension().string()});
        EXPECT_EQ(said_of(written_zip("a.zip", entries)).substr(0, 30), "shapes Bern 46.9511 7.4386") << name;
    }
}

TEST(ZippedVectors, WhatIsNoOneFileIsTold) {
    const std::string shp = bern_shapefile("a.shp");
    EXPECT_EQ(
        said_of(written_zip("a.zip", entries_beside(shp, "", {".shp", ".shx", ".dbf"}))),
        "error: a.shp: is a shapefile without its .prj, which says in which coordinate reference system "
        "its places are: put it beside the .shp, under the same name");
    EXPECT_EQ(
        said_of(written_zip("a.zip", {{"a.shp", "x"}, {"b/c.SHP", "x"}, {"d.gpkg", "x"}, {"e.fgb", "x"}})),
        "error: is packed and holds 4 vector files (a.shp, b/c.SHP, d.gpkg ...): unpack it and name one "
        "of them");
    EXPECT_EQ(said_of(written_zip("a.zip", {{"../a.shp", "x"}})),
              "error: holds ../a.shp, whose name leads out of the archive: it is not opened");
    std::vector<ZipEntry> entries = entries_beside(shp, "", {".shp", ".shx", ".dbf", ".prj"});
    entries[2].crc ^= 1U;
    EXPECT_EQ(said_of(written_zip("a.zip", entries)), "error: a.dbf cannot be unpacked: it is damaged");
    entries = entries_beside(shp, "", {".shp", ".shx", ".dbf", ".prj"});
    entries[0] = ZipEntry("a.shp", entries[0].bytes.substr(0, 110));
    EXPECT_EQ(said_of(written_zip("a.zip", entries)),
              "error: a.shp: its .shp is cut: it should have 128 bytes, and has 110");
}

}  // namespace
}  // namespace oro
