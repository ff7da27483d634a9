// What a baked region says of itself: every field comes back, and what is none is refused in one line.
#include "geo/region/region_description.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <tuple>

#include "geo/sources/source_words.h"

namespace oro {
namespace {

using nlohmann::json;

SourceReport unusual_source(const std::string& path) {
    SourceReport s;
    s.path = path;
    s.format = SourceFormat::srtm3_hgt;
    s.crs = "EPSG:4326 WGS 84";
    s.horizontal_datum = {false,
                          "EPSG:4267 NAD27",
                          "NAD27 to WGS 84 (6)",
                          7.0,
                          true,
                          true,
                          true,
                          {"one.tif", "two"},
                          1.5,
                          2010.0,
                          2020.25};
    s.vertical_datum = {DatumFrom::hgt_format, "", true};
    s.height_unit = {"us-ft", UnitFrom::request};
    s.posts_are = PostsAre::cell_centres;
    s.attribution = "© swisstopo, \"quoted\"\nand on a second line";
    s.rows = 2147483647;
    s.columns = 1;
    s.lat_spacing_deg = 1.0 / 1200.0;
    s.lon_spacing_deg = 0.1;
    s.spacing_m = 92.472563412345678;
    s.box = {179.5, -17.123456789012345, 181.25, -16.0};
    s.lowest_m = -431.25;
    s.highest_m = 8848.86;
    s.voids = 18446744073709551615U;
    s.implausible = 3;
    s.placement = Placement{Fit::every_kth_post, 0.0012, 2, 3};
    s.seams = {1201, 12, 0.30000000000000004};
    s.stored = StoredRange{-32678.0, 8848.859999999999, true};
    const PostShown own{46.1, 181.23456789012345, 8848.86, 8840.1};
    s.resampling = Resampling{407537,
                              406249,
                              3,
                              18446744073709551615U,
                              1.8000000000000003,
                              own,
                              own,
                              PostShown{46.2, 8.1, 190.0, {}}};
    return s;
}

RegionGrid unusual_region() {
    RegionGrid region;
    region.sources = {unusual_source("Höhen/N46E008.hgt"), unusual_source("b c.zip/N47E008.hgt")};
    region.seams = {9007199254740993U, 1, 1e-300};
    region.geoid = "EGM96 (egm96_15.gtx)";
    region.missing_cells = {"N45E008", "S01W001"};
    region.voids = 5;
    region.filled = 7;
    region.void_method = VoidMethod::filled;
    region.notes = {"one", ""};
    return region;
}

std::string refusal(const std::string& text) {
    const auto read = region_from_description(text, "region.oro");
    EXPECT_FALSE(read.ok()) << text.substr(0, 200);
    if (read.ok()) return "";
    EXPECT_EQ(read.error().kind, ErrorKind::failed);
    EXPECT_EQ(read.error().where, "region.oro");
    EXPECT_EQ(read.error().line().find('\n'), std::string::npos);
    return read.error().line();
}

// A region that was baked from a part of a baked one may not tell what lies outside all sources.
TEST(RegionDescription, HolesThatAreNotToldApartAreRead) {
    RegionGrid region;
    region.voids = 30;
    region.outside = 10;
    region.in_missing = 5;
    std::string text = region_description(region);
    auto read = region_from_description(text, "a.oro");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->void_posts(), 15U);
    const std::string part = "\"outside\":10,";
    text.erase(text.find(part), part.size());
    read = region_from_description(text, "a.oro");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_FALSE(read->classifies_voids);
    EXPECT_EQ(read->void_posts(), 25U);
    region.outside = 31;
    EXPECT_FALSE(region_from_description(region_description(region), "a.oro").ok());
}

TEST(RegionDescription, EveryFieldComesBack) {
    const RegionGrid region = unusual_region();
    const std::string text = region_description(region);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    const auto read = region_from_description(text, "region.oro");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(region_description(*read), text);
    ASSERT_EQ(read->sources.size(), 2U);
    const SourceReport expected = unusual_source("Höhen/N46E008.hgt");
    const SourceReport& s = read->sources[0];
    EXPECT_EQ(s.path, expected.path);
    EXPECT_EQ(s.format, expected.format);
    EXPECT_EQ(s.crs, expected.crs);
    EXPECT_EQ(s.vertical_datum.from, expected.vertical_datum.from);
    EXPECT_EQ(s.vertical_datum.name, expected.vertical_datum.name);
    EXPECT_EQ(s.vertical_datum.egm96_stands_in, expected.vertical_datum.egm96_stands_in);
    EXPECT_EQ(s.height_unit.name, expected.height_unit.name);
    EXPECT_EQ(s.height_unit.from, expected.height_unit.from);
    EXPECT_EQ(s.posts_are, expected.posts_are);
    EXPECT_EQ(s.attribution, expected.attribution);
    EXPECT_EQ(s.rows, expected.rows);
    EXPECT_EQ(s.columns, expected.columns);
    EXPECT_EQ(s.lat_spacing_deg, expected.lat_spacing_deg);
    EXPECT_EQ(s.lon_spacing_deg, expected.lon_spacing_deg);
    EXPECT_EQ(s.spacing_m, expected.spacing_m);
    EXPECT_EQ(s.box.west_deg, expected.box.west_deg);
    EXPECT_EQ(s.box.south_deg, expected.box.south_deg);
    EXPECT_EQ(s.box.east_deg, expected.box.east_deg);
    EXPECT_EQ(s.box.north_deg, expected.box.north_deg);
    EXPECT_EQ(s.lowest_m, expected.lowest_m);
    EXPECT_EQ(s.highest_m, expected.highest_m);
    EXPECT_EQ(s.voids, expected.voids);
    EXPECT_EQ(s.implausible, expected.implausible);
    ASSERT_TRUE(s.placement);
    EXPECT_EQ(s.placement->fit, expected.placement->fit);
    EXPECT_EQ(s.placement->moved_by_posts, expected.placement->moved_by_posts);
    EXPECT_EQ(s.placement->lat_part, expected.placement->lat_part);
    EXPECT_EQ(s.placement->lon_part, expected.placement->lon_part);
    EXPECT_EQ(s.seams.shared_posts, expected.seams.shared_posts);
    EXPECT_EQ(horizontal_words(s.horizontal_datum), horizontal_words(expected.horizontal_datum));
    EXPECT_EQ(s.horizontal_datum.missing_grids, expected.horizontal_datum.missing_grids);
    EXPECT_EQ(s.seams.disagreeing_posts, expected.seams.disagreeing_posts);
    EXPECT_EQ(s.seams.largest_difference_m, expected.seams.largest_difference_m);
    EXPECT_EQ(read->seams.shared_posts, region.seams.shared_posts);
    EXPECT_EQ(read->seams.largest_difference_m, region.seams.largest_difference_m);
    EXPECT_EQ(read->geoid, region.geoid);
    EXPECT_EQ(read->missing_cells, region.missing_cells);
    EXPECT_EQ(read->voids, region.voids);
    EXPECT_EQ(read->filled, region.filled);
    EXPECT_EQ(read->void_method, region.void_method);
    EXPECT_EQ(read->notes, region.notes);
}

TEST(RegionDescription, WhatWasMeasuredComesBack) {
    const auto read = region_from_description(region_description(unusual_region()), "region.oro");
    ASSERT_TRUE(read.ok()) << read.error().line();
    const SourceReport& s = read->sources[0];
    const SourceReport expected = unusual_source("");
    ASSERT_TRUE(s.stored && s.resampling && s.resampling->worst && s.resampling->lowest);
    EXPECT_EQ(s.stored->lowest_m, expected.stored->lowest_m);
    EXPECT_EQ(s.stored->highest_m, expected.stored->highest_m);
    EXPECT_EQ(s.stored->whole, expected.stored->whole);
    EXPECT_EQ(s.resampling->posts, expected.resampling->posts);
    EXPECT_EQ(s.resampling->compared, expected.resampling->compared);
    EXPECT_EQ(s.resampling->unshown, expected.resampling->unshown);
    EXPECT_EQ(s.resampling->hidden, expected.resampling->hidden);
    EXPECT_EQ(s.resampling->rms_m, expected.resampling->rms_m);
    EXPECT_EQ(s.resampling->worst->lon_deg, expected.resampling->worst->lon_deg);
    EXPECT_EQ(s.resampling->worst->shown_H_m, expected.resampling->worst->shown_H_m);
    EXPECT_EQ(s.resampling->lowest->shown_H_m, expected.resampling->lowest->shown_H_m);
}

TEST(RegionDescription, NamesThatAreNoUtf8AreStillText) {
    RegionGrid region = unusual_region();
    region.sources[0].path = "H\xf6hen.tif";
    const auto read = region_from_description(region_description(region), "region.oro");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->sources[0].path, "H\xef\xbf\xbdhen.tif");  // U+FFFD
}

// Each field taken away, and each put to a value of another kind, is named in the error.
TEST(RegionDescription, EveryFieldIsNeededAndOfItsKind) {
    const json whole = json::parse(region_description(unusual_region()));
    // Not all of a region is always known, nor all of a datum.
    const std::set<std::string> optional_fields{
        "outside",     "horizontal_datum", "accuracy_m", "accuracy_with_grids_m",
        "frame_epoch", "coordinate_epoch", "stored",     "resampling",
        "worst",       "highest",          "lowest",     "shown_H_m"};
    int fields = 0;
    const auto check_all = [&](const json::json_pointer& object) {
        for (const auto& [name, value] : whole.at(object).items()) {
            SCOPED_TRACE(name);
            ++fields;
            json without = whole;
            without.at(object).erase(name);
            if (optional_fields.contains(name))
                EXPECT_TRUE(region_from_description(without.dump(), "region.oro").ok());
            else
                EXPECT_NE(refusal(without.dump()).find(name + " is missing"), std::string::npos);
            json other = whole;
            other.at(object)[name] = value.is_string() ? json(1) : json("text");
            EXPECT_NE(refusal(other.dump()).find(name), std::string::npos);
            other.at(object)[name] = nullptr;
            EXPECT_NE(refusal(other.dump()).find(name), std::string::npos);
        }
    };
    for (const char* object : {"", "/seams", "/sources/1", "/sources/1/seams", "/sources/1/horizontal_datum",
                               "/sources/1/stored", "/sources/1/resampling", "/sources/1/resampling/highest"})
        check_all(json::json_pointer(object));
    EXPECT_EQ(fields, 12 + 3 + 22 + 3 + 10 + 3 + 8 + 4);
}

// Where posts lie in the CRS of their sources: of regions on a net alone.
TEST(RegionDescription, TheCrsOfPostsComesBackAndIsWhole) {
    RegionGrid region = unusual_region();
    EXPECT_EQ(region_description(region).find("posts_crs"), std::string::npos);
    region.posts_crs = PostsCrs{"PROJCRS[\"x\"]", {2600000.25, 25.0, 1e-17, 1200000.0, 0.5, -25.0}};
    const std::string text = region_description(region);
    const auto read = region_from_description(text, "region.oro");
    ASSERT_TRUE(read.ok()) << read.error().line();
    ASSERT_TRUE(read->posts_crs);
    EXPECT_EQ(read->posts_crs->wkt, region.posts_crs->wkt);
    EXPECT_EQ(read->posts_crs->crs_from_post, region.posts_crs->crs_from_post);
    const json whole = json::parse(text);
    for (const auto& [field, value, says] :
         {std::tuple{"/posts_crs", json(1), "posts_crs"},
          {"/posts_crs/wkt", json(1), "posts_crs.wkt must be text"},
          {"/posts_crs/crs_from_post", json::array({1, 2, 3}), "must have 6 numbers, and has 3"},
          {"/posts_crs/crs_from_post/4", json("x"), "crs_from_post[4] must be a number"}}) {
        json changed = whole;
        changed[json::json_pointer(field)] = value;
        EXPECT_NE(refusal(changed.dump()).find(says), std::string::npos) << refusal(changed.dump());
    }
}

TEST(RegionDescription, NumbersOutOfRangeAreRefused) {
    const json whole = json::parse(region_description(unusual_region()));
    const auto with = [&](const char* field, const json& value) {
        json changed = whole;
        changed[json::json_pointer(field)] = value;
        return changed.dump();
    };
    EXPECT_NE(refusal(with("/voids", -1)).find("voids must be a whole number"), std::string::npos);
    EXPECT_NE(refusal(with("/voids", 1.5)).find("voids must be a whole number"), std::string::npos);
    EXPECT_NE(refusal(with("/sources/0/rows", 2147483648U)).find("sources[0].rows must be at most"),
              std::string::npos);
    EXPECT_NE(refusal(with("/sources/0/box_deg", json::array({1, 2, 3}))).find("4 numbers"),
              std::string::npos);
    EXPECT_NE(refusal(with("/orograph_region", 2)).find("format is 2"), std::string::npos);
    EXPECT_NE(refusal(with("/geoid", std::string("a\0b", 3))).find("zero byte"), std::string::npos);
    std::string huge = whole.dump();
    const std::string spacing = "\"lat_spacing_deg\":";
    huge.insert(huge.find(spacing) + spacing.size(), "1e999,\"x\":");
    refusal(huge);
}

TEST(RegionDescription, WhatIsNoDescriptionIsRefused) {
    for (const char* text : {"", " ", "{}", "[]", "null", "7", "\"text\"", "{\"orograph_region\":1}",
                             "{\"a\":", "\xff\xfe", "{\"orograph_region\":1e0}"})
        refusal(text);
    const std::string text = region_description(unusual_region());
    for (std::size_t bytes = 0; bytes < text.size(); ++bytes) refusal(text.substr(0, bytes));
    refusal(text + "x");
}

// Texts that would take far more memory than they have bytes.
TEST(RegionDescription, TextsMadeToExhaustMemoryAreRefused) {
    constexpr std::size_t much = 20'000'000;
    EXPECT_NE(refusal(std::string(much, '[')).find("nested deeper"), std::string::npos);
    std::string wide = "{\"sources\":[1";
    for (int i = 0; i < 10'000'000; ++i) wide += ",1";
    EXPECT_NE(refusal(wide + "]}").find("more values"), std::string::npos);
}

// Bytes of a description changed at random: it is read, or refused in one line.
TEST(RegionDescription, RandomDamageIsReadOrRefused) {
    const auto seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const std::string whole = region_description(unusual_region());
    int refused = 0;
    for (int i = 0; i < 5000; ++i) {
        std::string text = whole;
        for (auto changes = 1 + random() % 3; changes > 0; --changes)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        const auto read = region_from_description(text, "region.oro");
        if (read.ok()) {
            EXPECT_EQ(read->sources.size(), 2U) << "seed " << seed;
            continue;
        }
        ++refused;
        EXPECT_EQ(read.error().line().find('\n'), std::string::npos) << "seed " << seed;
    }
    EXPECT_GT(refused, 500) << "seed " << seed;
}

}  // namespace
}  // namespace oro
