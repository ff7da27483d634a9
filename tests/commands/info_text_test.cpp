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
    source.vertical_datum.from = DatumFrom::hgt_format;
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

RegionGrid region_of(std::vector<SourceReport> sources) {
    RegionGrid region;
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
    expect_words(text, {"region: 1 file\n", "void posts  none\n", "outside     none\n", "missing     none\n",
                        "overlaps    none\n", "\na/N46E008.hgt\n", "SRTM3 .hgt, posts are points", "in m\n",
                        "190 to 4142 m\n", "degrees (92.63 m north-south and 63.97 m east-west)\n",
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
    RegionGrid region = region_of({tile("a/N46E008.hgt"), other});
    region.seams = {1201, 12, 3.5};
    region.missing_cells = {"N46E009"};
    region.in_missing = 1;
    region.outside = 7;
    region.voids = 1500 + 8;
    const std::string text = info_text(region);
    expect_words(
        text,
        {"region: 2 files\n", "1,500, left as holes (--fill-voids",
         "outside     7 posts of the region's box, beyond the edges of the rasters\n",
         "missing     1 tile (cells of a degree without a file), 1 post: N46E009\n",
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
    // A quarter of a degree of the meridian at 46.5 N: M = 6,369.06 km.
    coarse.height_unit.name = "metre";
    coarse.lowest_m = -3.25;
    coarse.highest_m = 4142.0;
    expect_words(info_text(region_of({coarse})), {"degrees (27.79 km north-south and 19.19 km east-west)\n",
                                                  ", in m\n", "-3.2 to 4142.0 m\n"});
    // In a projection posts are as far apart both ways, and do not fill a box of degrees.
    coarse.lon_spacing_deg = 0.3625;
    expect_words(info_text(region_of({coarse})), {"degrees (27.67 km)\n"});
}

// Found: of a file in LV95 (EPSG:2056) the spacing was told in degrees.
TEST(InfoText, OfAProjectedFileTheSpacingIsTheCrssOwn) {
    SourceReport projected = tile("lv95.tif");
    // 30 m of the equator, 6,378,137 m from the Earth's middle; at 46.5 N of a meridian (6,369.06 km) and a
    // parallel.
    projected.nominal_spacing_deg = 0.000269494585;
    projected.lat_spacing_deg = 0.000269770;
    projected.lon_spacing_deg = 0.000390693;
    projected.spacing_m = 29.9876;
    expect_words(info_text(region_of({projected})),
                 {"posts       1201 x 1201, every 30 m of its CRS (29.99 m on the ground)\n"});
    expect_words(info_text(region_of({projected, projected})),
                 {"1201 x 1201 posts, every 30 m of its CRS (29.99 m on the ground); "});
    // Degrees of another datum stay degrees.
    SourceReport degrees = tile("nad27.tif");
    degrees.nominal_spacing_deg = 1.0 / 1200.0;
    expect_words(info_text(region_of({degrees})), {"every 0.000833333 x 0.000833333 degrees (92.63 m"});
}

TEST(InfoText, FilledPostsAndPlacementsAreTold) {
    SourceReport coarse = tile("c.tif");
    coarse.placement = Placement{Fit::every_kth_post, 0.0012, 3, 2};
    RegionGrid region = region_of({coarse});
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

// Found: the range of what was resampled was told as the file's.
TEST(InfoText, TheFilesOwnRangeAndTheRegionsAreToldApart) {
    SourceReport source = tile("a/swiss.tif");
    source.stored = StoredRange{190.0, 4142.0, true};
    expect_words(info_text(region_of({source})), {"  H           190 to 4142 m, as the file stores them\n"});
    source.lowest_m = 182.5;
    source.highest_m = 4101.25;
    expect_words(info_text(region_of({source})), {"  stored      190 to 4142 m: the file's own values\n",
                                                  "  H           182.5 to 4101.2 m at the region's posts\n"});
    expect_words(info_text(region_of({source, source})),
                 {"; stores 190 to 4142 m; H 182.5 to 4101.2 m at the region's posts"});
    source.stored->whole = false;
    expect_words(info_text(region_of({source})), {"190 to 4142 m in the part that was read"});
}

TEST(InfoText, ResamplingIsToldInMetresWithItsPlace) {
    SourceReport source = tile("a/swiss.tif");
    source.placement = Placement{};
    Resampling found;
    found.posts = 31000000;
    found.compared = 250000;
    found.rms_m = 1.8;
    found.worst = PostShown{46.5, 8.125, 1899.9, 2279.93};
    found.highest = PostShown{46.536527, 8.125552, 4107.896, 4087.12};
    found.lowest = PostShown{46.9, 8.6, 431.0, {}};
    source.resampling = found;
    expect_words(
        info_text(region_of({source})),
        {"  resampling  up to 380 m off at 46.500000 8.125000 (own 1899.9 m, shown 2279.9 m), 1.8 m RMS, of "
         "250,000 of 31,000,000 posts\n",
         "  highest     its post of 4107.9 m at 46.536527 8.125552, shown as 4087.1 m\n",
         "  lowest      its post of 431.0 m at 46.900000 8.600000, where the region has no ground\n"});
    // Of many, the worst one is named.
    SourceReport better = source;
    better.path = "b/better.tif";
    better.resampling->worst->shown_H_m = 1900.0;
    expect_words(info_text(region_of({better, source, tile("c.hgt")})),
                 {"heights of 2 files are resampled: its own posts are up to 380 m off",
                  "of swiss.tif; 1.8 m RMS of all 2 files", "; resampled: up to 0.1 m off"});
    expect_none(info_text(region_of({tile("c.hgt")})), {"resampl"});
}

// A part of a baked region does not tell; nothing is offered then.
TEST(InfoText, VoidsThatAreNotToldApartAreNotOfferedToBeFilled) {
    RegionGrid region = region_of({tile("a.hgt")});
    region.voids = 12;
    region.classifies_voids = false;
    const std::string text = info_text(region);
    expect_words(text, {"void posts  12 without a height, void in their file or outside the rasters",
                        "outside     not told apart from void posts in this baked region\n"});
    expect_none(text, {"--fill-voids"});
}

TEST(InfoText, FilesThatCannotBeOpenedAreListedWithTheReason) {
    FileListing listing;
    listing.files.push_back({"a.hgt", tile("a.hgt"), "", false, ""});
    listing.files.push_back({"b.tif", {}, "is no raster", true, ""});
    listing.files.push_back({"c.tif", {}, "has 3 bands", false, ""});
    listing.files.push_back({"d.tif", tile("d.tif"), "", false, "its posts are 1 m apart"});
    expect_words(listing_text(listing),
                 {"files: 2, all of them: ", "cannot be opened: 1 file\nb.tif  is no raster\n",
                  "passed over, without elevation: 1 file\nc.tif  has 3 bands\n",
                  "to be left out: 1 file\nd.tif  its posts are 1 m apart\n"});
    listing.files.clear();
    EXPECT_EQ(unread_files_text(listing), "");
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
