// Which sources are regions of their own.
#include "geo/region/disjoint_sources.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geo/opening/region_sources.h"
#include "geo/region/region_grid.h"

namespace oro {
namespace {

// A tile of 1,201 x 1,201 posts.
Source tile(int lat_deg, int lon_deg) {
    Source source = source_of_cell({lat_deg, lon_deg});
    source.report.path = std::to_string(lat_deg) + "," + std::to_string(lon_deg);
    source.on_degrees = true;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / 1200.0;
    source.lat_axis = {1200.0, lat_deg + 1.0, -1, 1201};
    source.lon_axis = {1200.0, static_cast<double>(lon_deg), 1, 1201};
    return source;
}

// Their paths, a group in brackets.
std::string groups(const std::vector<Source>& sources, const std::optional<BoundingBox>& box = {}) {
    std::string text;
    for (const std::vector<Source>& group : disjoint_sources(sources, box)) {
        text += "[";
        for (const Source& source : group) text += (text.back() == '[' ? "" : " ") + source.report.path;
        text += "]";
    }
    return text;
}

TEST(DisjointSources, FilesOnOppositeSidesOfTheEarthAreTwo) {
    EXPECT_EQ(groups({tile(46, 8), tile(-47, -172)}), "[46,8][-47,-172]");
}

TEST(DisjointSources, FilesThatTouchStayTogetherInTheOrderGiven) {
    EXPECT_EQ(groups({tile(46, 9), tile(-47, -172), tile(46, 8), tile(47, 10), tile(-47, -171)}),
              "[46,9 46,8 47,10][-47,-172 -47,-171]");
}

// A box of 3 cells holds 2; one of 9 cells holds 2, 4.5 times as many.
TEST(DisjointSources, AGapCountsByThePostsThatItWouldCost) {
    EXPECT_EQ(groups({tile(46, 8), tile(46, 10)}), "[46,8 46,10]");
    EXPECT_EQ(groups({tile(46, 8), tile(48, 10)}), "[46,8][48,10]");
}

TEST(DisjointSources, TheAntimeridianIsNoGap) {
    EXPECT_EQ(groups({tile(0, 179), tile(0, -180)}), "[0,179 0,-180]");
    EXPECT_EQ(groups({tile(0, 179), tile(0, -180), tile(0, -100)}), "[0,179 0,-180][0,-100]");
}

TEST(DisjointSources, SoManyGroupsAreOneRegion) {
    std::vector<Source> sources;
    for (int i = 0; i < static_cast<int>(groups_max); ++i)
        sources.push_back(tile(-60 + 3 * (i % 40), -180 + 3 * (i / 40)));
    EXPECT_EQ(disjoint_sources(sources, {}).size(), groups_max);
    sources.push_back(tile(0, 170));
    EXPECT_EQ(disjoint_sources(sources, {}).size(), 1U);
}

// Only what a box takes of them counts.
TEST(DisjointSources, ABoxAroundALittleOfEachMayBeOneGrid) {
    const BoundingBox corner{8.99, 46.99, 10.01, 48.01};
    std::vector<Source> sources{tile(46, 8), tile(48, 10)};
    EXPECT_EQ(groups(sources, corner), "[46,8][48,10]");
    const BoundingBox wide{8.2, 46.5, 10.8, 46.9};
    EXPECT_EQ(groups({tile(46, 8), tile(46, 10)}, wide), "[46,8 46,10]");
}

}  // namespace
}  // namespace oro
