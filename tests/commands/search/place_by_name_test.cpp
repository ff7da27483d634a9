// Places by their names: which one a text means, and what is said where none or several are.
#include "apps/search/place_by_name.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/test_data.h"

namespace oro {
namespace {

SearchPlace peak(const char* name, double lat_deg, double lon_deg, double H_m) {
    return {name, lat_deg, lon_deg, H_m, PlaceClass::summit, 0.0};
}

// Heights and places of OpenStreetMap, of which the digits that count here are made up.
const std::vector<SearchPlace>& peaks() {
    static const std::vector<SearchPlace> all{peak("Eiger", 46.5776, 8.0053, 3967.0),
                                              peak("Mönch", 46.5585, 7.9973, 4110.0),
                                              peak("Jungfrau", 46.5367, 7.9626, 4158.0),
                                              peak("Jungfraujoch", 46.5475, 7.9804, 3466.0),
                                              peak("Großes Wiesbachhorn", 47.1567, 12.7553, 3564.0),
                                              peak("Rothorn", 46.0, 7.8, 3103.0),
                                              peak("Rothorn", 46.8, 8.1, 2350.0),
                                              peak("Rothorn", 46.1, 7.1, 2998.0),
                                              peak("Rothorn", 46.2, 7.2, 1000.0),
                                              peak("Rothorn", 46.3, 7.3, 1100.0),
                                              peak("Rothorn", 46.4, 7.4, 1200.0),
                                              peak("Eiger", 46.5776, 8.0053, 3967.0)};
    return all;
}

std::string fault(const std::string& text) {
    const auto found = place_by_name(text, peaks(), "peaks.geojson");
    return found.ok() ? "found " + found->place.name : found.error().what;
}

TEST(PlaceByName, IsTheWholeNameWhateverItsLetters) {
    for (const char* const text : {"Mönch", "monch", " MÖNCH ", "Mo\u0308nch"}) {
        const auto found = place_by_name(text, peaks(), "f");
        ASSERT_TRUE(found.ok()) << text << ": " << found.error().what;
        EXPECT_EQ(found->place.name, "Mönch");
        EXPECT_EQ(found->place.lat_deg, 46.5585);
        EXPECT_TRUE(found->is_whole);
    }
    // The whole name counts, though another name begins so; and one that two files hold is one.
    EXPECT_EQ(place_by_name("jungfrau", peaks(), "f")->place.lon_deg, 7.9626);
    EXPECT_EQ(place_by_name("Eiger", peaks(), "f")->place.H_m, 3967.0);
}

TEST(PlaceByName, IsTheOnlyNameThatBeginsSo) {
    const auto found = place_by_name("grosses wies", peaks(), "f");
    ASSERT_TRUE(found.ok()) << found.error().what;
    EXPECT_EQ(found->place.name, "Großes Wiesbachhorn");
    EXPECT_FALSE(found->is_whole);
    EXPECT_EQ(fault("Jungf"),
              "begins the names of 2 places: Jungfrau, 4158 m, at 46.53670,7.96260; Jungfraujoch, 3466 "
              "m, at 46.54750,7.98040; give more of the name, or the coordinates of one");
}

TEST(PlaceByName, SeveralAreListedAndNoneIsChosen) {
    EXPECT_EQ(fault("Rothorn"),
              "is the name of 6 places: Rothorn, 3103 m, at 46.00000,7.80000; Rothorn, 2998 m, at "
              "46.10000,7.10000; Rothorn, 2350 m, at 46.80000,8.10000; Rothorn, 1200 m, at 46.40000,7.40000; "
              "Rothorn, 1100 m, at 46.30000,7.30000; and 1 more; give the coordinates of one");
}

TEST(PlaceByName, NearSpellingsAreSuggested) {
    EXPECT_EQ(fault("Aiger"), "is no name of peaks.geojson: did you mean Eiger?");
    EXPECT_EQ(fault("Eigre"), "is no name of peaks.geojson: did you mean Eiger?");
    EXPECT_EQ(fault("wiesbachhorn"), "is no name of peaks.geojson: did you mean Großes Wiesbachhorn?");
    EXPECT_EQ(fault("Matterhorn"), "is no name of peaks.geojson");
    EXPECT_EQ(fault("..."), "is no name of peaks.geojson");
}

TEST(PlaceByName, ATextWithoutALetterIsNone) {
    EXPECT_FALSE(may_be_name("46.57, 7.99"));
    EXPECT_FALSE(may_be_name(""));
    EXPECT_TRUE(may_be_name("K2"));
    EXPECT_TRUE(may_be_name("富士山"));
}

TEST(PlaceByName, FilesOfPointsAndDumpsAreRead) {
    const std::filesystem::path folder = test::scratch_folder();
    std::ofstream(folder / "p.geojson")
        << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"A","wo":"B"},)"
           R"("geometry":{"type":"Point","coordinates":[8.5,46.5]}}]})";
    const auto points = read_named_places((folder / "p.geojson").string(), "wo");
    ASSERT_TRUE(points.ok()) << points.error().line();
    ASSERT_EQ(points->size(), 1U);
    EXPECT_EQ(points->front().name, "B");
    EXPECT_EQ(points->front().lat_deg, 46.5);
    std::ofstream(folder / "dump.txt")
        << "2661169\tBern\tBern\t\t46.94809\t7.44744\tP\tPPLC\tCH\t\tBE\t\t\t\t121631\t\t549\t"
           "Europe/Zurich\t2019-01-01\n";
    const auto dump = read_named_places((folder / "dump.txt").string(), "name");
    ASSERT_TRUE(dump.ok()) << dump.error().line();
    EXPECT_EQ(dump->front().name, "Bern");
    EXPECT_FALSE(read_named_places((folder / "none.gpx").string(), "name").ok());
}

}  // namespace
}  // namespace oro
