// Notes on a region that every command says, on standard error and in --json.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/report/region_json.h"

namespace oro {
namespace {

Region region_from(std::initializer_list<std::pair<const char*, DatumFrom>> files) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field.grid.lat = {1.0, 0.0, 47, -1, 2};
    region.grids[0].field.grid.lon = {1.0, 0.0, 8, +1, 2};
    region.grids[0].field.H_m = {190.0F, 4142.0F, 200.0F, 300.0F};
    for (const auto& [path, from] : files) {
        SourceReport source;
        source.path = path;
        source.vertical_datum.from = from;
        region.grids[0].sources.push_back(source);
    }
    return region;
}

// Found: only `info` said that EGM96 is assumed.
TEST(RegionNotes, AssumedHeightsAreTold) {
    Region region = region_from({{"a.tif", DatumFrom::assumed_unstated}, {"b.tif", DatumFrom::crs}});
    region.grids[0].notes = {"something else"};
    const std::string words =
        "a.tif does not say what the heights refer to: EGM96 heights are assumed (--source-vertical tells "
        "what they are, when files are read)";
    EXPECT_EQ(all_notes(region), (std::vector<std::string>{"something else", words}));
    EXPECT_EQ(region_json(region.grids[0])["notes"], (std::vector<std::string>{"something else", words}));
    region.grids.push_back(region_from({{"c.tif", DatumFrom::assumed_unreadable}}).grids[0]);
    EXPECT_EQ(all_notes(region).size(), 3U) << "of all grids";
    const Region many = region_from({{"a.tif", DatumFrom::assumed_unstated},
                                     {"b.tif", DatumFrom::assumed_unstated},
                                     {"c.tif", DatumFrom::assumed_unstated}});
    EXPECT_EQ(note_of_assumed_heights(many.grids[0]).find("a.tif and 2 more files do not say"), 0U)
        << note_of_assumed_heights(many.grids[0]);
    for (const DatumFrom known : {DatumFrom::crs, DatumFrom::dted_egm96, DatumFrom::dted_egm2008,
                                  DatumFrom::hgt_format, DatumFrom::specified, DatumFrom::product})
        EXPECT_EQ(note_of_assumed_heights(region_from({{"a.tif", known}}).grids[0]), "");
}

// Found: a note on the geoid stood there once for each of several grids.
TEST(RegionNotes, WhatGridsShareIsToldOnce) {
    Region region = region_from({{"a.tif", DatumFrom::crs}});
    region.grids[0].notes = {"the geoid is coarse"};
    region.grids.push_back(region.grids[0]);
    region.grids[1].notes.emplace_back("of the second alone");
    EXPECT_EQ(all_notes(region), (std::vector<std::string>{"the geoid is coarse", "of the second alone"}));
}

}  // namespace
}  // namespace oro
