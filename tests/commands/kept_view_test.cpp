// What a window's user has chosen, when another region is opened in it.
#include "apps/window/kept_view.h"

#include <gtest/gtest.h>

namespace {

oro::View shown_view() {
    oro::View view;
    view.region.paths = {"a.hgt"};
    view.camera.eye = {46.5, 8.0, 3000.0};
    view.camera.width_px = 641, view.camera.height_px = 359;
    view.camera.vertical_fov_deg = 33.5;
    view.exaggeration = 1.5;
    view.style = "contours";
    view.tau_px = 0.25;
    view.shadows = false;
    view.visibility_km = 40.0;
    view.drape = {"image.tif"};
    view.drape_opacity = 0.5;
    view.mesh = "clusters";
    view.mesh_level = 3;
    view.show = oro::Show::groups;
    view.model.air = {0.2, oro::AirLaw::constant};
    view.sun = oro::SunDirection{270.0, 12.0};
    view.vectors.overlay = {"track.gpx"};
    view.vectors_read = std::make_shared<oro::VectorsRead>();
    view.fingerprints.emplace();
    view.fingerprints->vectors.push_back({"track.gpx", 7});
    return view;
}

TEST(KeptView, OptionsOfTheWindowStayAndThoseOfDataAndEyeGo) {
    oro::WindowOptions options;
    options.view_file = "p.png";
    options.region.paths = {"a.hgt"};
    options.region.tile = "N46E008";
    options.region.fill_voids = true;
    options.view.at = "46.5,8.0";
    options.view.tau_px = 3.0;
    options.view.roll_deg = 5.0;
    options.gazetteers = {"names.txt"};
    options.memory.gpu_memory_mb = 512;
    const oro::WindowOptions other = oro::options_for_other_region(options, shown_view(), {"b", "c"});
    EXPECT_EQ(other.region.paths, (std::vector<std::string>{"b", "c"}));
    EXPECT_EQ(other.region.tile, "");
    EXPECT_TRUE(other.region.fill_voids);
    EXPECT_EQ(other.view_file, "");
    EXPECT_FALSE(other.view.at);
    EXPECT_EQ(other.view.size, "641x359");
    EXPECT_EQ(other.view.tau_px, 0.25) << "as it is now";
    EXPECT_EQ(other.view.exaggeration, 1.5);
    EXPECT_EQ(other.view.vertical_fov_deg, 33.5);
    EXPECT_EQ(other.view.roll_deg, 5.0);
    EXPECT_EQ(other.gazetteers, options.gazetteers);
    EXPECT_EQ(other.memory.gpu_memory_mb, 512);
}

// A canopy goes along, with the classes that it takes heights of.
TEST(KeptView, ACanopyGoesToOtherData) {
    oro::View shown = shown_view();
    shown.cover_choice = {{"cover.tif"}, "worldcover"};
    shown.canopy_choice.by_class = true;
    shown.canopy_choice.held = 0.25;
    const oro::WindowOptions of_classes = oro::options_for_other_region({}, shown, {"b"});
    EXPECT_EQ(of_classes.view.canopy, std::vector<std::string>{"class"});
    EXPECT_EQ(of_classes.view.canopy_held, 0.25);
    EXPECT_EQ(of_classes.view.landcover, std::vector<std::string>{"cover.tif,worldcover"});
    shown.canopy_choice = {{"trees.tif"}, false, {}};
    const oro::WindowOptions of_file = oro::options_for_other_region({}, shown, {"b"});
    EXPECT_EQ(of_file.view.canopy, std::vector<std::string>{"trees.tif"});
    EXPECT_FALSE(of_file.view.canopy_held);
    EXPECT_TRUE(of_file.view.landcover.empty());
}

TEST(KeptView, WhatWasChosenHoldsOn) {
    const oro::View shown = shown_view();
    oro::View view;
    view.region.paths = {"b"};
    view.camera.eye = {-3.0, 37.0, 9000.0};
    view.fingerprints.emplace();
    oro::keep_choices(shown, view);
    EXPECT_EQ(view.region.paths.front(), "b");
    EXPECT_EQ(view.camera.eye.lat_deg, -3.0);
    EXPECT_EQ(view.style, "contours");
    EXPECT_EQ(view.tau_px, 0.25);
    EXPECT_EQ(view.shadows, false);
    EXPECT_EQ(view.visibility_km, 40.0);
    EXPECT_EQ(view.drape_opacity, 0.5);
    EXPECT_EQ(view.model.air, shown.model.air);
    EXPECT_EQ(view.vectors.overlay.front(), "track.gpx");
    EXPECT_EQ(view.vectors_read, shown.vectors_read);
    EXPECT_EQ(view.fingerprints->vectors.size(), 1U);
    ASSERT_TRUE(view.sun);
    EXPECT_EQ(view.sun->azimuth_deg, 270.0);
    EXPECT_EQ(view.exaggeration, 1.0) << "what its levels were measured with";
    EXPECT_EQ(view.mesh, "auto") << "the other region may have no clusters";
    EXPECT_FALSE(view.mesh_level);
    EXPECT_FALSE(view.show);
}

}  // namespace
