// Facts of a source become words, and words become the same facts: what baked regions rely on.
#include "geo/sources/source_words.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

TEST(SourceWords, FormatsComeBack) {
    for (const SourceFormat format : {SourceFormat::srtm1_hgt, SourceFormat::srtm3_hgt}) {
        SourceReport source, again;
        source.format = format;
        again.driver = "left over";
        set_format(again, format_words(source));
        EXPECT_EQ(again.format, format);
        EXPECT_EQ(again.driver, "");
    }
    // A raster whose name only looks like one of them.
    for (const char* name : {"GTiff", "SRTM", "my SRTM3 .hgt", ""}) {
        SourceReport source;
        set_format(source, name);
        EXPECT_EQ(source.format, SourceFormat::raster) << name;
        EXPECT_EQ(format_words(source), name);
    }
}

TEST(SourceWords, DatumsComeBack) {
    for (const DatumFrom from : {DatumFrom::crs, DatumFrom::specified, DatumFrom::product,
                                 DatumFrom::dted_egm96, DatumFrom::dted_egm2008, DatumFrom::hgt_format,
                                 DatumFrom::assumed_unstated, DatumFrom::assumed_unreadable}) {
        for (const bool stands_in : {false, true}) {
            const bool is_named =
                from == DatumFrom::crs || from == DatumFrom::specified || from == DatumFrom::product;
            const HeightDatum datum{from, is_named ? "EPSG:5703 NAVD88 height" : "", stands_in};
            const std::string words = datum_words(datum);
            EXPECT_NE(words, "");
            const HeightDatum again = datum_of_words(words);
            EXPECT_EQ(again.from, datum.from) << words;
            EXPECT_EQ(again.name, datum.name) << words;
            EXPECT_EQ(again.egm96_stands_in, datum.egm96_stands_in) << words;
        }
    }
}

TEST(SourceWords, UnitsPostsAndVoidMethodsComeBack) {
    for (const UnitFrom from : {UnitFrom::file, UnitFrom::request, UnitFrom::assumed}) {
        const HeightUnit again = unit_of_words(unit_words({"us-ft", from}));
        EXPECT_EQ(again.name, "us-ft");
        EXPECT_EQ(again.from, from);
    }
    for (const PostsAre posts : {PostsAre::points, PostsAre::cell_centres})
        EXPECT_EQ(posts_of_words(posts_words(posts)), posts);
    for (const VoidMethod method : {VoidMethod::holes, VoidMethod::filled})
        EXPECT_EQ(void_method_of_words(void_method_words(method)), method);
    EXPECT_EQ(posts_of_words("corners"), std::nullopt);
    EXPECT_EQ(void_method_of_words(""), std::nullopt);
}

TEST(SourceWords, PlacementsComeBack) {
    for (const Placement& placement :
         {Placement{Fit::same_posts, 0.0, 1, 1}, Placement{Fit::same_posts, 0.0012, 1, 1},
          Placement{Fit::every_kth_post, 0.0, 3, 2}, Placement{Fit::every_kth_post, 0.0099, 12, 7},
          Placement{Fit::elsewhere, 0.0, 1, 1}}) {
        SourceReport source;
        source.crs = "EPSG:2056 CH1903+ / LV95";
        source.placement = placement;
        const std::string words = placement_words(source);
        const auto again = placement_of_words(words);
        ASSERT_TRUE(again) << words;
        EXPECT_EQ(again->fit, placement.fit) << words;
        EXPECT_EQ(again->moved_by_posts, placement.moved_by_posts) << words;
        EXPECT_EQ(again->lat_part, placement.lat_part) << words;
        EXPECT_EQ(again->lon_part, placement.lon_part) << words;
    }
    EXPECT_EQ(placement_words(SourceReport{}), "");
    EXPECT_FALSE(placement_of_words(""));
    EXPECT_FALSE(placement_of_words("thrown away"));
    SourceReport source;
    source.crs = "unnamed CRS";
    source.placement = Placement{};
    EXPECT_EQ(placement_words(source), "cubic resampling from unnamed CRS");
}

}  // namespace
}  // namespace oro
