// Shapefiles and FlatGeobuf, whole, in parts and cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/geo/vectors/written_zip.h"
#include "tests/support/asked_count.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::vector_dataset;
using test::written;

std::string bytes_in(const fs::path& file) {
    std::ifstream from(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
}

std::string error_in(const std::string& file) {
    const auto read = read_vectors(file);
    return read.ok() ? "is read" : read.error().what;
}

// By swisstopo's formulas E 2,600,000 N 1,200,000 of EPSG:2056 is 46.951083 N 7.438632 E; a tenth of a second
// is 3 m.
void expect_bern(const std::string& file, const std::string& name) {
    const auto read = read_vectors(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    ASSERT_EQ(read->layers.size(), 1U);
    const VectorLayer& layer = read->layers.front();
    ASSERT_EQ(layer.shapes.size(), 1U);
    const VectorPlace& place = layer.shapes.front().paths.front().front();
    EXPECT_NEAR(place.lat_deg, 46.951083, 3e-5);
    EXPECT_NEAR(place.lon_deg, 7.438632, 3e-5);
    EXPECT_EQ(layer.text(layer.shapes.front(), "name"), name);
}

TEST(Shapefile, IsReadWithItsNamesAndItsCoordinateReferenceSystem) {
    const std::string file =
        vector_dataset("a.shp", "ESRI Shapefile", 2056, {{"POINT (2600000 1200000)", "Bern"}});
    expect_bern(file, "Bern");
    const auto read = read_vectors(file);
    EXPECT_TRUE(read->notes.empty());
    EXPECT_GE(read->files.size(), 4U);
    const std::string holes = vector_dataset(
        "b.shp", "ESRI Shapefile", 4326,
        {{"POLYGON ((8 46,8 47,9 47,9 46,8 46),(8.2 46.2,8.4 46.2,8.4 46.4,8.2 46.2))", "lake"}});
    const auto lake = read_vectors(holes);
    ASSERT_TRUE(lake.ok()) << lake.error().line();
    EXPECT_EQ(lake->layers.front().shapes.front().paths.size(), 2U);
}

// A .dbf of another survey with the same number of records has other names: it is a part of what was read.
TEST(Shapefile, ItsFingerprintIsThatOfAllItsFiles) {
    const std::string file = vector_dataset("a.shp", "ESRI Shapefile", 4326, {{"POINT (8 46)", "A"}});
    const auto before = read_vectors(file);
    ASSERT_TRUE(before.ok()) << before.error().line();
    const fs::path dbf = fs::path(file).replace_extension(".dbf");
    std::string bytes = bytes_in(dbf);
    bytes.replace(bytes.rfind('A'), 1, "B");
    std::ofstream(dbf, std::ios::binary) << bytes;
    const auto after = read_vectors(file);
    ASSERT_TRUE(after.ok()) << after.error().line();
    EXPECT_NE(before->fingerprint, after->fingerprint);
}

TEST(Shapefile, PartsThatAreMissingAreToldInOneLine) {
    const std::string file =
        vector_dataset("a.shp", "ESRI Shapefile", 2056, {{"POINT (2600000 1200000)", "Bern"}});
    const auto part = [&](const char* ending) { return fs::path(file).replace_extension(ending); };
    EXPECT_EQ(error_in(part(".shx").string()), "is a part of a shapefile: name its .shp");
    EXPECT_EQ(error_in(part(".dbf").string()), "is a part of a shapefile: name its .shp");
    EXPECT_EQ(error_in(part(".prj").string()), "is a part of a shapefile: name its .shp");

    fs::rename(part(".dbf"), part(".kept"));
    const auto read = read_vectors(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->notes,
              std::vector<std::string>{
                  file + ": is a shapefile without its .dbf: its shapes are read, their names and "
                         "other fields are not there"});
    fs::rename(part(".kept"), part(".DBF"));  // capital letters are fine
    expect_bern(file, "Bern");

    fs::rename(part(".prj"), part(".kept"));
    EXPECT_EQ(
        error_in(file),
        "is a shapefile without its .prj, which says in which coordinate reference system its places are: "
        "put it beside the .shp, under the same name");
    fs::rename(part(".kept"), part(".prj"));
    fs::remove(part(".shx"));
    EXPECT_EQ(error_in(file),
              "is a shapefile without its .shx, which says where each shape stands: put it "
              "beside the .shp, under the same name");
    EXPECT_FALSE(fs::exists(part(".shx")));  // nothing is written beside it
}

TEST(Shapefile, PartsThatDoNotBelongTogetherAreTold) {
    const std::string file =
        vector_dataset("a.shp", "ESRI Shapefile", 4326, {{"POINT (8 46)", "A"}, {"POINT (9 47)", "B"}});
    const std::string other = vector_dataset("b.shp", "ESRI Shapefile", 4326, {{"POINT (8 46)", "C"}});
    fs::copy_file(fs::path(other).replace_extension(".dbf"), fs::path(file).replace_extension(".dbf"),
                  fs::copy_options::overwrite_existing);
    const auto read = read_vectors(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->notes, std::vector<std::string>{
                               file + ": its .shx counts 2 shapes and its .dbf 1 records: the two may not "
                                      "belong together"});
}

// A .shx and a .dbf that agree, of one shape of a .shp with two: the other was left out without a word. A
// .shp has a header of 100 bytes, and 28 for each point with its header of 8.
TEST(Shapefile, ShapesThatTheIndexDoesNotListAreTold) {
    const std::string file =
        vector_dataset("a.shp", "ESRI Shapefile", 4326, {{"POINT (8 46)", "A"}, {"POINT (9 47)", "B"}});
    const std::string other = vector_dataset("b.shp", "ESRI Shapefile", 4326, {{"POINT (8 46)", "A"}});
    for (const char* const ending : {".dbf", ".shx"})
        fs::copy_file(fs::path(other).replace_extension(ending), fs::path(file).replace_extension(ending),
                      fs::copy_options::overwrite_existing);
    const auto read = read_vectors(file);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->notes,
              std::vector<std::string>{
                  file + ": its .shp has 156 bytes, and its .shx lists 128 of them: the two may not "
                         "belong together, and shapes may be left out"});
}

// Cut at any byte each of its files is an error, and no file is silently shorter.
TEST(Shapefile, CutAtAnyByteIsAnError) {
    const std::string file = vector_dataset(
        "a.shp", "ESRI Shapefile", 4326, {{"LINESTRING (8 46,9 46)", "A"}, {"LINESTRING (8 47,9 47)", "B"}});
    for (const char* const ending : {".shp", ".shx", ".dbf"}) {
        const fs::path part = fs::path(file).replace_extension(ending);
        const std::string whole = bytes_in(part);
        // The last byte of a .dbf is a mark of its end, which nobody needs.
        const std::size_t most = whole.size() - (std::string(ending) == ".dbf" ? 1 : 0);
        for (std::size_t bytes = 0; bytes < most; ++bytes) {
            std::ofstream(part, std::ios::binary).write(whole.data(), static_cast<std::streamsize>(bytes));
            const std::string said = error_in(file);
            EXPECT_NE(said, "is read") << ending << " of " << bytes << " bytes";
            EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        }
        std::ofstream(part, std::ios::binary) << whole;
    }
    EXPECT_EQ(error_in(file), "is read");
}

// Features that the header does not count were left out without a word. GDAL writes the count, 2 here, as
// eight bytes.
TEST(FlatGeobuf, FeaturesThatItsHeaderDoesNotCountAreRefused) {
    const std::string file =
        vector_dataset("a.fgb", "FlatGeobuf", 4326, {{"POINT (8 46)", "A"}, {"POINT (9 47)", "B"}});
    EXPECT_EQ(error_in(file), "is read");
    const std::string whole = bytes_in(file);
    std::ofstream(file, std::ios::binary | std::ios::app) << "more";
    EXPECT_EQ(error_in(file),
              "goes on for 4 bytes behind the 2 features that its header counts: is the count too small?");
    EXPECT_EQ(
        error_in(test::written_zip("a.zip", {{"a.fgb", whole + "more"}})),
        "a.fgb: goes on for 4 bytes behind the 2 features that its header counts: is the count too small?");
    EXPECT_EQ(error_in(test::written_zip("a.zip", {{"a.fgb", whole}})), "is read");
}

TEST(FlatGeobuf, IsReadWithItsNamesAndItsCoordinateReferenceSystem) {
    expect_bern(vector_dataset("a.fgb", "FlatGeobuf", 2056, {{"POINT (2600000 1200000)", "Bern"}}), "Bern");
    EXPECT_EQ(
        error_in(vector_dataset("b.fgb", "FlatGeobuf", 0, {{"POINT (2600000 1200000)", "Bern"}})),
        "layer 'shapes': states no coordinate reference system, so where it lies is unknown; give it one "
        "(ogr2ogr -a_srs)");
}

TEST(FlatGeobuf, CutAtAnyByteIsAnError) {
    const std::string file = vector_dataset(
        "a.fgb", "FlatGeobuf", 4326, {{"LINESTRING (8 46,9 46)", "A"}, {"LINESTRING (8 47,9 47)", "B"}});
    const std::string whole = bytes_in(file);
    for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
        const std::string cut = written("c.fgb", whole.substr(0, bytes));
        const std::string said = error_in(cut);
        EXPECT_NE(said, "is read") << bytes << " of " << whole.size() << " bytes";
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
}

// What a damaged file gives is in place, or it is an error of one line. No signal ends the program, and none
// takes longer than the limit of reading.
void expect_sound(const std::string& file) {
    const auto read = read_vectors(file, 5.0);
    if (!read.ok()) {
        EXPECT_EQ(read.error().line().find('\n'), std::string::npos) << read.error().line();
        return;
    }
    for (const VectorLayer& layer : read->layers)
        for (const VectorShape& shape : layer.shapes) {
            ASSERT_LT(shape.record, layer.records.size());
            for (const auto& path : shape.paths)
                for (const VectorPlace& place : path) {
                    ASSERT_LE(std::abs(place.lat_deg), 90.0);
                    ASSERT_LE(std::abs(place.lon_deg), 180.0);
                }
        }
}

// OROGRAPH_DAMAGED_VECTORS=N damages so many files instead of 150, OROGRAPH_DAMAGED_SEED=N from
// another seed.
TEST(DamagedVectors, AreReadWithoutHarm) {
    const std::uint64_t files = test::asked_number("OROGRAPH_DAMAGED_VECTORS", 150),
                        seed = test::asked_number("OROGRAPH_DAMAGED_SEED", 3);
    std::cout << files << " files, seed " << seed << "\n";
    std::mt19937_64 random(seed);
    const auto below = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const std::vector<std::pair<std::string, std::string>> shapes{
        {"POLYGON ((8 46,8 47,9 47,9 46,8 46),(8.2 46.2,8.4 46.2,8.4 46.4,8.2 46.2))", "lake"},
        {"MULTIPOLYGON (((1 2,1 3,2 3,1 2)),((5 6,5 7,6 7,5 6)))", "two"},
        {"POLYGON ((-1 -2,-1 3,2 3,-1 -2))", "Ü"}};
    const std::string shp = vector_dataset("a.shp", "ESRI Shapefile", 2056, shapes),
                      fgb = vector_dataset("a.fgb", "FlatGeobuf", 4326, shapes);
    std::vector<fs::path> parts{fgb};
    for (const char* const ending : {".shp", ".shx", ".dbf", ".prj"})
        parts.push_back(fs::path(shp).replace_extension(ending));
    for (std::uint64_t i = 0; i < files; ++i) {
        const fs::path& part = parts[below(parts.size())];
        const std::string whole = bytes_in(part);
        std::string damaged = whole;
        for (std::size_t bytes = 1 + below(4); bytes > 0; --bytes)
            // Half of them among the first, where lengths and offsets stand.
            damaged[below(below(2) == 0 ? std::min<std::size_t>(damaged.size(), 120) : damaged.size())] =
                static_cast<char>(below(2) == 0 ? below(256) : std::array{0, 255, 127, 128}[below(4)]);
        std::ofstream(part, std::ios::binary) << damaged;
        expect_sound(part == parts.front() ? fgb : shp);
        std::ofstream(part, std::ios::binary) << whole;
        if (HasFailure()) FAIL() << "file " << i << " of seed " << seed << ", " << part.filename();
    }
}

TEST(KmzFile, ABombIsNotUnpackedAndNoNameLeadsOut) {
    const std::string text =
        test::kml("<Placemark><Point><coordinates>9,47</coordinates></Point></Placemark>");
    EXPECT_EQ(error_in(test::written_zip("a.kmz", {{"../../doc.kml", text}})),
              "holds ../../doc.kml, whose name leads out of the archive: it is not opened");
    EXPECT_EQ(error_in(test::written_zip("a.kmz", {{"/doc.kml", text}})),
              "holds /doc.kml, whose name leads out of the archive: it is not opened");
    // Only its list says that it has 100 MiB, which is what a bomb looks like before it is unpacked.
    test::ZipEntry bomb{"doc.kml", text};
    bomb.stated_bytes = 100U << 20U;
    EXPECT_EQ(
        error_in(test::written_zip("a.kmz", {bomb})),
        "holds doc.kml, which would unpack to more than 200 times the archive's length: it is not unpacked");
}

}  // namespace
}  // namespace oro
