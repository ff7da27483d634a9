// What the colours of pictures that explain a frame are called, and how that is laid on paper.
#include "apps/legend/key_names.h"

#include <gtest/gtest.h>

#include "apps/legend/legend.h"
#include "apps/view/mesh_parts.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

Region flat_region(int rows, int columns) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field =
        test::made_field(47.0, 8.0, 20.0, rows, columns, [](double, double) { return 500.0F; });
    return region;
}
ColourKey key_of(Show show, const Region& region, int every = 1) {
    View view;
    view.show = show;
    return colour_key(view, region, Style{}, every);
}
std::vector<std::string> words_in(const ColourKey& key) {
    std::vector<std::string> words;
    for (const ColourKey::Named& named : key.names) words.push_back(named.name);
    return words;
}
TEST(KeyNames, SayWhatColoursOfAFrameStandFor) {
    const Region region = flat_region(3, 3);
    const ColourKey overdraw = key_of(Show::overdraw, region);
    EXPECT_EQ(words_in(overdraw), (std::vector<std::string>{"1", "2", "3-4", "5-8", "9-16", "more"}));
    EXPECT_EQ(overdraw.names[2].colour, (StripColour{115, 186, 107}));
    EXPECT_EQ(words_in(key_of(Show::visible, region)),
              (std::vector<std::string>{"a round before the last", "the last: what those left open"}));
    EXPECT_EQ(key_of(Show::meshlets, region).title, "Each meshlet in a colour of its own");
}

// 300 posts are 299 quads: three pages of 128, two of the next level, one of the third.
TEST(KeyNames, OfLevelsCountPostsOfTheRegion) {
    const Region region = flat_region(3, 300);
    EXPECT_EQ(words_in(key_of(Show::levels, region)), (std::vector<std::string>{"1", "2", "4"}));
    EXPECT_EQ(words_in(key_of(Show::levels, region, 4)), (std::vector<std::string>{"4", "8", "16"}))
        << "of every fourth post alone";
}

// 1,000 triangles, 667, 444, 296, 198, 132, 88: the last are one cluster.
TEST(KeyNames, OfMeshesSayWhatTheirClustersColoursStandFor) {
    Region region = flat_region(3, 3);
    PlacedMesh mesh;
    mesh.triangles.resize(1000);
    region.meshes = std::make_shared<const std::vector<PlacedMesh>>(1, mesh);
    View view;
    view.show = Show::levels;
    settle_mesh_parts(region, view);
    EXPECT_FALSE(view.shows_mesh_parts) << "all triangles of the mesh are drawn: levels are the ground's";
    view.mesh = "clusters";
    settle_mesh_parts(region, view);
    ASSERT_TRUE(view.shows_mesh_parts);
    const ColourKey levels = colour_key(view, region, Style{});
    EXPECT_EQ(levels.title, "Levels of the meshes' cluster graphs: 0 has every triangle");
    EXPECT_EQ(words_in(levels), (std::vector<std::string>{"0", "1", "2", "3", "4", "5", "6"}));
    EXPECT_EQ(levels.names[2].colour, (StripColour{120, 196, 66}));
    view.mesh = "auto", view.show = Show::groups;
    settle_mesh_parts(region, view);
    ASSERT_TRUE(view.shows_mesh_parts) << "groups are of clusters alone";
    EXPECT_EQ(colour_key(view, region, Style{}).title,
              "Each group of clusters of meshes in a colour of its own");
    view.mesh = "grid";
    settle_mesh_parts(region, view);
    EXPECT_FALSE(view.shows_mesh_parts);
    view.mesh = "clusters", view.show = Show::meshlets;
    settle_mesh_parts(region, view);
    EXPECT_FALSE(view.shows_mesh_parts);
}

// A strip has room for as many lines as names need.
TEST(KeyNames, GoOnOnMoreLines) {
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    ColourKey key;
    key.title = "Levels";
    for (int i = 0; i < 25; ++i) key.names.push_back({{0, 0, 0}, "10"});
    const auto one = place_names(*face, key, {10.0, 20.0}, 5000.0, 10.0);
    const auto many = place_names(*face, key, {10.0, 20.0}, 210.0, 10.0);
    ASSERT_TRUE(one.ok() && many.ok());
    EXPECT_DOUBLE_EQ(one->bottom_px, 20.0 + 15.5 + 11.0);
    EXPECT_LE(many->right_px, 210.0);
    // Each takes 22 px and its figures, 11 to 12 px: five on a line.
    EXPECT_DOUBLE_EQ(many->bottom_px, 20.0 + 15.5 + 4 * 16.0 + 11.0);
}

TEST(KeyNames, PicturesThatExplainAFrameHaveALegend) {
    View view;
    view.camera.width_px = 200;
    EXPECT_FALSE(has_own_legend(view));
    view.show = Show::levels;
    EXPECT_TRUE(has_own_legend(view));
    view.camera.width_px = 199;
    EXPECT_FALSE(has_own_legend(view));
}

}  // namespace
}  // namespace oro
