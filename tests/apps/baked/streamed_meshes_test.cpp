// A baked mesh that is drawn by clusters is read group by group: the picture, and what is found of it, are
// those of the same file without its groups, which is read whole.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/container.h"
#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/mended_container.h"
#include "tests/support/older_mesh_file.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::ChunkType;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;
using oro::test::write_bytes;

// A rough hill of 10,368 triangles, 1 km wide.
std::string obj_of_hill() {
    constexpr int n = 73;
    std::string text;
    char line[100];
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = i / (n - 1.0), y = k / (n - 1.0);
            std::snprintf(
                line, sizeof line, "v %.9f %.9f %.4f\n", -84.18 + 0.011 * x, 36.60 + 0.009 * y,
                560.0 + 30.0 * std::sin(9.0 * x) * std::cos(7.0 * y) + 0.9 * std::sin(91.0 * i * k));
            text += line;
        }
    for (int i = 0; i + 1 < n; ++i)
        for (int k = 0; k + 1 < n; ++k) {
            const int at = 1 + i * n + k;
            std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", at, at + n, at + 1, at + 1, at + n,
                          at + n + 1);
            text += line;
        }
    return text;
}

class StreamedMeshes : public ::testing::Test {
  protected:
    void SetUp() override {
        write_bytes(mesh_, obj_of_hill());
        bake({"--mesh-file", mesh_, "--mesh-crs", "EPSG:4326"});
    }
    void bake(const Words& mesh) const {
        const Outcome done = run_orograph(joined({"bake", bundled(), "--out", baked_, "-q"}, mesh));
        ASSERT_EQ(done.exit_code, 0) << done.err;
        write_bytes(whole_, oro::test::older_mesh_file(baked_, false));
        write_bytes(older_, oro::test::older_mesh_file(baked_, true));
    }
    // What is said of both files' pictures, taken in the same way.
    [[nodiscard]] std::array<json, 2> said_of_both(const Words& how) const {
        std::array<json, 2> said;
        for (std::size_t i = 0; i < 2; ++i) {
            const Outcome drawn = shot(i == 0 ? baked_ : whole_, i == 0 ? one_ : other_, how);
            EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
            said[i] = drawn.exit_code == 0 ? json::parse(drawn.out) : json::object();
        }
        return said;
    }
    // Both files' pictures, and what is found of them.
    void expect_same_pictures(const Words& how) const {
        auto [a, b] = said_of_both(how);
        ASSERT_TRUE(a.contains("meshes"));
        for (json* const one : {&a, &b}) (*one)["meshes"].erase("graph_s");
        for (const char* const key : {"meshes", "triangles", "destination", "eye"})
            EXPECT_EQ(a[key], b[key]) << key;
        EXPECT_EQ(oro::test::pixels_of(one_).rgb, oro::test::pixels_of(other_).rgb);
    }
    [[nodiscard]] Outcome shot(const std::string& data, const std::string& out, const Words& more) const {
        return run_orograph(
            joined({"shot", data, "--at", "36.5965,-84.176", "--above", "250", "--heading", "0", "--size",
                    "200x150", "--style", "plain", "-q", "--out", out, "--overwrite", "--json"},
                   more));
    }
    const fs::path folder_ = oro::test::scratch_folder();
    const std::string mesh_ = (folder_ / "hill.obj").string(), baked_ = (folder_ / "hill.oro").string(),
                      whole_ = (folder_ / "whole.oro").string(), older_ = (folder_ / "older.oro").string(),
                      one_ = (folder_ / "one.png").string(), other_ = (folder_ / "other.png").string();
};

TEST_F(StreamedMeshes, ArePicturesOfTheWholeMesh) {
    for (const Words& how :
         {Words{"--mesh", "clusters"}, Words{"--mesh", "clusters", "--tau", "4", "--pitch", "-20"},
          Words{"--mesh-level", "2"}, Words{"--show", "groups", "--tau", "2"}})
        expect_same_pictures(how);
}

// A file of an older program, whose groups are told each alone: the same pixels, and --check takes it.
TEST_F(StreamedMeshes, OfAnOlderFileAreTheSamePictures) {
    EXPECT_GT(fs::file_size(older_), fs::file_size(baked_) + 30000);
    for (const Words& how : {Words{"--mesh", "clusters"}, Words{"--mesh-level", "2"}}) {
        ASSERT_EQ(shot(baked_, one_, how).exit_code, 0);
        ASSERT_EQ(shot(older_, other_, how).exit_code, 0);
        EXPECT_EQ(oro::test::pixels_of(one_).rgb, oro::test::pixels_of(other_).rgb);
    }
    const Outcome checked = run_orograph({"info", older_, "--check"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

// What asks the true mesh reads where its lines may meet it: the same figures. What is drawn of it is off by
// no more than is said, both ways; and not by nothing.
TEST_F(StreamedMeshes, AreMeasuredAsTheWholeMeshIs) {
    auto said = said_of_both({"--mesh", "clusters", "--tau", "2", "--verify"});
    for (json& one : said)
        for (const char* const key : {"file", "picture", "time_s"}) one["error"].erase(key);
    EXPECT_EQ(said[0]["error"], said[1]["error"]);
    ASSERT_TRUE(said[0]["error"].contains("meshes")) << said[0]["error"];
    const json &meshes = said[0]["error"]["meshes"], &cut = said[0]["meshes"];
    for (const char* const way : {"drawn", "missed"}) {
        const double largest_m = meshes[std::string(way) + "_m"]["max"],
                     largest_px = meshes[std::string(way) + "_px"]["max"];
        EXPECT_GT(largest_px, 0.2) << way;
        EXPECT_LE(largest_m, cut["error_m"].get<double>() + 0.01) << way << ", m";
        EXPECT_LE(largest_px, cut["error_px"].get<double>() + 0.06) << way << ", px";
    }
}

// Level 0 is not drawn from so far; damaged, it is one line, and no picture, where it is.
TEST_F(StreamedMeshes, DamagedAreRefusedWhereTheyAreDrawn) {
    const oro::Chunk chunk = oro::test::chunk_of(baked_, ChunkType::mesh_payloads);
    std::string bytes = bytes_of(baked_);
    bytes[static_cast<std::size_t>(chunk.offset) + 40] ^= 8;
    write_bytes(baked_, bytes);
    const Words far{"--mesh", "clusters", "--tau", "40", "--pitch", "60"};
    const Outcome drawn = shot(baked_, one_, far);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    fs::remove(one_);
    expect_refusal(shot(baked_, one_, {"--mesh-level", "0"}), failed,
                   {"hill.oro", "level 0 below group 0 of the mesh"});
    EXPECT_FALSE(fs::exists(one_));
    const Outcome checked = run_orograph({"info", baked_, "--check"});
    EXPECT_EQ(checked.exit_code, failed) << checked.out;
}

// Records whose checksum was made right after a change are refused by what they say, or found by --check.
TEST_F(StreamedMeshes, ThatLieAreRefused) {
    const oro::Chunk chunk = oro::test::chunk_of(baked_, ChunkType::mesh_records);
    const std::string bytes = bytes_of(baked_);
    for (const double share : {0.001, 0.2, 0.5, 0.9}) {
        std::string changed = bytes;
        changed[static_cast<std::size_t>(chunk.offset) +
                static_cast<std::size_t>(share * static_cast<double>(chunk.bytes))] ^= 16;
        write_bytes(baked_, changed);
        expect_refusal(shot(baked_, one_, {"--mesh", "clusters"}), failed, {"hill.oro", "checksum"});
        write_bytes(baked_, oro::test::mended(changed));
        const Outcome checked = run_orograph({"info", baked_, "--check"});
        EXPECT_EQ(checked.exit_code, failed) << share << checked.out;
    }
}

// 400 houses of 8 to 26 m, 70 m apart, as footprints.
std::string geojson_of_town() {
    std::string text;
    char line[400];
    for (int i = 0; i < 20; ++i)
        for (int k = 0; k < 20; ++k) {
            const double west = -84.185 + 0.0008 * i + 0.00002 * (k % 3), south = 36.598 + 0.00063 * k,
                         east = west + 0.0002 + 0.00002 * (i % 4), north = south + 0.0001 + 0.00002 * (k % 5);
            std::snprintf(
                line, sizeof line,
                R"(%s{"type":"Feature","properties":{"height":%d,"name":"house %d"},"geometry":)"
                R"({"type":"Polygon","coordinates":[[[%.7f,%.7f],[%.7f,%.7f],[%.7f,%.7f],[%.7f,%.7f],)"
                R"([%.7f,%.7f]]]}})",
                text.empty() ? "" : ",", 8 + (i * 5 + k * 7) % 19, 20 * i + k, west, south, east, south, east,
                north, west, north, west, south);
            text += line;
        }
    return R"({"type":"FeatureCollection","features":[)" + text + "]}";
}

// A town, whose graph is built over the ground.
class StreamedTown : public StreamedMeshes {
  protected:
    void SetUp() override {
        const std::string houses = (folder_ / "houses.geojson").string();
        write_bytes(houses, geojson_of_town());
        bake({"--mesh-file", houses, "--building-height", "height"});
    }
};

TEST_F(StreamedTown, IsDrawnAsTheWholeMeshIs) {
    ASSERT_TRUE(oro::Container::open(baked_).value()->find(ChunkType::mesh_records, 0));
    expect_same_pictures({"--mesh", "clusters", "--tau", "8"});
    // Most houses are on the ground there.
    const json coarse = json::parse(shot(baked_, one_, {"--mesh-level", "5"}).out)["meshes"];
    EXPECT_EQ(coarse["of_triangles"], 4000);
    EXPECT_LT(coarse["triangles"], 1000);
    const Outcome checked = run_orograph({"info", baked_, "--check"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

TEST_F(StreamedTown, IsDrawnAsTheWholeMeshIsInOtherWays) {
    for (const Words& how :
         {Words{"--mesh", "clusters"}, Words{"--mesh-level", "3"}, Words{"--show", "clusters", "--tau", "20"},
          Words{"--mesh", "clusters", "--exaggeration", "2"}})
        expect_same_pictures(how);
}

// Of houses that are on the ground, and are not drawn, what is missed is their distance from the ground.
TEST_F(StreamedTown, IsMeasuredWhereItIsDroppedOntoTheGround) {
    const Outcome drawn = shot(baked_, one_, {"--mesh-level", "5", "--pitch", "-15", "--verify"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const json said = json::parse(drawn.out), &meshes = said["error"]["meshes"];
    const double missed_m = meshes["missed_m"]["max"];
    EXPECT_GT(missed_m, 4.0) << "m: half of the lowest house";
    EXPECT_LE(missed_m, said["meshes"]["error_m"].get<double>() + 0.01) << "m";
}

// The cells of the ground are the last bytes of the records. Changed, with checksums made right: one line, or
// the mesh is read whole; --check finds it.
TEST_F(StreamedTown, WhoseGroundLiesIsRefusedOrReadWhole) {
    const oro::Chunk chunk = oro::test::chunk_of(baked_, ChunkType::mesh_records);
    const std::string bytes = bytes_of(baked_);
    const Words how{"--mesh", "clusters", "--tau", "8"};
    ASSERT_EQ(shot(whole_, other_, how).exit_code, 0);
    for (const int from_end : {1, 6, 12, 20}) {
        std::string changed = bytes;
        changed[static_cast<std::size_t>(chunk.offset + chunk.bytes) - static_cast<std::size_t>(from_end)] ^=
            4;
        write_bytes(baked_, changed);
        expect_refusal(shot(baked_, one_, how), failed, {"hill.oro", "checksum"});
        write_bytes(baked_, oro::test::mended(changed));
        const Outcome drawn = shot(baked_, one_, how);
        if (drawn.exit_code == 0) {
            EXPECT_EQ(oro::test::pixels_of(one_).rgb, oro::test::pixels_of(other_).rgb) << from_end;
        } else {
            expect_refusal(drawn, failed, {"hill.oro", "ground"});
        }
        EXPECT_EQ(run_orograph({"info", baked_, "--check"}).exit_code, failed) << from_end;
    }
}

}  // namespace
