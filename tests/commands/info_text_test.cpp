// What `info` prints: the region first, one line for each of many files, and the right number of everything.
#include "apps/commands/info_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oro {
namespace {

SourceReport tile(const std::string& path) {
    SourceReport source;
    source.path = path;
    source.format = SourceFormat::srtm3_hgt;
    source.crs = "EPSG:4326 WGS 84";
    source.vertical_datum.from = DatumFrom::assumed_for_hgt;
    source.attribution = "somebody";
    source.rows = source.columns = 1201;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / 1200.0;
    source.spacing_m = 92.63;
    source.box = {8.0, 46.0, 9.0, 47.0};
    source.lowest_m = 190.0;
    source.highest_m = 4142.0;
    source.placement = Placement{Fit::same_posts, 0.0, 1, 1};
    return source;
}

Region region_of(std::vector<SourceReport> sources) {
    Region region;
    region.field.grid.lat = {1.0, 0.0, 47, -1, 2};
    region.field.grid.lon = {1.0, 0.0, 8, +1, 2};
    region.field.H_m = {190.0F, 4142.0F, 200.0F, 300.0F};
    region.geoid = "EGM96 (egm96_15.gtx)";
    region.sources = std::move(sources);
    return region;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        EXPECT_NE(text.find(word), std::string::npos) << text << "\nlacks: " << word;
}

void expect_none(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        EXPECT_EQ(text.find(word), std::string::npos) << text << "\nhas: " << word;
}

TEST(InfoText, OneFileTellsAllOfItself) {
    const std::string text = info_text(region_of({tile("a/N46E008.hgt")}));
    expect_words(text, {"region: 1 file\n", "void posts  none\n", "no data     none\n", "overlaps    none\n",
                        "\na/N46E008.hgt\n", "SRTM3 .hgt, posts are points", "in m\n", "190 to 4142 m\n",
                        "degrees (92.63 m north-south and 63.97 m east-west)\n",
                        "its posts are the region's posts\n", "attribution somebody\n"});
    expect_none(text, {"1 files", "sources", " 0 of", "no cell", "note"});
    EXPECT_LT(text.find("region: "), text.find("N46E008.hgt"));
}

// Found: how far a datum's own degrees may be off was said nowhere.
TEST(InfoText, AnotherDatumSaysHowNearItIsToWgs84) {
    SourceReport source = tile("a/old.tif");
    expect_none(info_text(region_of({source})), {"\n  datum"});
    HorizontalDatum& datum = source.horizontal_datum;
    datum.is_wgs84 = false;
    datum.operation = "NAD27 to WGS 84 (6)";
    datum.accuracy_m = 7.0;
    datum.missing_grids = {"us_noaa_conus.tif", "us_noaa_kshpgn.tif"};
    datum.accuracy_with_grids_m = 1.5;
    const std::string words =
        "within 7 m of WGS84, by NAD27 to WGS 84 (6); within 1.5 m with us_noaa_conus.tif and "
        "us_noaa_kshpgn.tif, which PROJ lacks";
    expect_words(info_text(region_of({source})), {"\n  datum       " + words + "\n"});
    expect_words(info_text(region_of({source, source})), {"EPSG:4326 WGS 84; " + words + "; "});
    datum = {};
    datum.is_wgs84 = false;
    expect_words(info_text(region_of({source})), {"how near to WGS84 is not known"});
    datum.operation = "made up";
    datum.ballpark = true;
    expect_words(info_text(region_of({source})), {"(ballpark): off by an unknown amount"});
    datum.ballpark = false;
    datum.unchanged = true;
    datum.accuracy_m = 0.5;
    expect_words(info_text(region_of({source})), {"taken as WGS84, within 0.5 m\n"});
    datum.one_to_two_metres = true;
    datum.frame_epoch = 2010.0;
    expect_words(info_text(region_of({source})),
                 {"taken as WGS84, within 1 to 2 m; dynamic, reference epoch 2010, the coordinates' epoch is "
                  "not stated"});
    datum.coordinate_epoch = 2020.5;
    expect_words(info_text(region_of({source})), {"epoch 2010; coordinates of epoch 2020.5\n"});
}

TEST(InfoText, ManyFilesAreALineEachAfterWhatTheyShare) {
    SourceReport other = tile("b/fine.tif");
    other.format = SourceFormat::raster;
    other.driver = "GTiff";
    other.attribution = "";
    other.voids = 1500;
    other.implausible = 2;
    other.seams = {40, 1, 2.5};
    Region region = region_of({tile("a/N46E008.hgt"), other});
    region.seams = {1201, 12, 3.5};
    region.missing_cells = {"N46E009"};
    region.in_missing = 1;
    region.outside = 7;
    region.voids = 1500 + 8;
    const std::string text = info_text(region);
    expect_words(
        text,
        {"region: 2 files\n", "1,500, left as holes (--fill-voids",
         "1 post in 1 cell of a degree that no file covers: N46E009; 7 posts beyond the edges of the files\n",
         "1,201 posts are in more than one file, 12 of them with other heights, by up to 3.5 m",
         "files: 2, all of them: posts are points; EPSG:4326 WGS 84;",
         "a/N46E008.hgt  box 8,46,9,47; 1201 x 1201 posts, every 92.63 m north-south and 63.97 m east-west; "
         "H 190 to 4142 m; SRTM3 .hgt; "
         "somebody\n",
         "void posts: 1,500, 2 of them heights that no terrain has",
         "1 post differs from another file's, by up to 2.5 m; GTiff; attribution not stated\n"});
    const auto of_files =
        std::count(text.begin() + static_cast<std::ptrdiff_t>(text.find("files: 2")), text.end(), '\n');
    EXPECT_EQ(of_files, 3);
}

TEST(InfoText, LengthsAreInWordsAndUnitsShort) {
    SourceReport coarse = tile("world.tif");
    coarse.rows = coarse.columns = 5;
    coarse.lat_spacing_deg = coarse.lon_spacing_deg = 0.25;
    coarse.spacing_m = 27670.0;
    coarse.height_unit.name = "metre";
    coarse.lowest_m = -3.25;
    coarse.highest_m = 4142.0;
    expect_words(info_text(region_of({coarse})), {"degrees (27.67 km north-south and 19.19 km east-west)\n",
                                                  ", in m\n", "-3.2 to 4142.0 m\n"});
    // In a projection posts are as far apart both ways, and do not fill a box of degrees.
    coarse.lon_spacing_deg = 0.3625;
    expect_words(info_text(region_of({coarse})), {"degrees (27.67 km)\n"});
}

TEST(InfoText, FilledPostsAndPlacementsAreTold) {
    SourceReport coarse = tile("c.tif");
    coarse.placement = Placement{Fit::every_kth_post, 0.0012, 3, 2};
    Region region = region_of({coarse});
    region.void_method = VoidMethod::filled;
    region.filled = 12;
    expect_words(
        info_text(region),
        {"void posts  none left, 12 filled from their neighbours\n",
         "each of its posts stands for 3 x 2 of the region's; those between are interpolated, moved by "
         "up to 0.0012 of their spacing\n"});
    region.sources[0].placement = Placement{};
    expect_words(info_text(region), {"its posts lie elsewhere than the region's: heights are resampled"});
}

TEST(InfoText, FilesThatWereNotReadHaveNoHeights) {
    SourceReport unread = tile("a.hgt");
    unread.placement.reset();
    expect_words(unread_text({unread}), {"H           not read\n"});
    expect_none(unread_text({unread}), {"void posts", "placement", "190"});
    const std::string two = unread_text({unread, unread});
    expect_words(two, {"files: 2, all of them: SRTM3 .hgt", "a.hgt  box 8,46,9,47;", "; H not read\n"});
}

}  // namespace
}  // namespace oro
