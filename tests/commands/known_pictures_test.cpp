// Must hold: pages are made for pictures that are known only where nothing beyond these gives them light, and
// heights are those of the pages.
#include "apps/drawing/known_pictures.h"

#include <gtest/gtest.h>

#include <vector>

namespace oro {
namespace {

std::vector<Camera> two_cameras() {
    std::vector<Camera> cameras(2);
    cameras[0].width_px = cameras[1].width_px = 300;
    cameras[0].height_px = cameras[1].height_px = 200;
    cameras[1].eye.lat_deg = 46.5;
    return cameras;
}

TEST(KnownPictures, AreThoseOfTheCameras) {
    View view;
    view.tau_px = 0.75;
    const std::vector<FrameView> pictures = known_pictures(view, Style{}, two_cameras(), 2.0);
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_EQ(pictures[1].camera.eye.lat_deg, 46.5);
    EXPECT_EQ(pictures[0].tau_px, 1.5);
    EXPECT_EQ(pictures[0].tile.width_px, 300);
    EXPECT_EQ(pictures[0].tile.height_px, 200);
}

TEST(KnownPictures, AreNoneWhereLightComesFromBeyondOrHeightsAreRounded) {
    Style shadows{}, openness{};
    shadows.frame.shadows = 1;
    openness.frame.sky_openness = 1;
    View rounded;
    rounded.heights = HeightStorage::i16;
    EXPECT_TRUE(known_pictures(View{}, shadows, two_cameras()).empty());
    EXPECT_TRUE(known_pictures(View{}, openness, two_cameras()).empty());
    EXPECT_TRUE(known_pictures(rounded, Style{}, two_cameras()).empty());
    EXPECT_EQ(known_pictures(View{}, Style{}, two_cameras()).size(), 2U);
}

}  // namespace
}  // namespace oro
