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
    const std::vector<FrameView> pictures = known_pictures(view, Style{}, two_cameras(), 2.0).views;
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_EQ(pictures[1].camera.eye.lat_deg, 46.5);
    EXPECT_EQ(pictures[0].tau_px, 1.5);
    EXPECT_EQ(pictures[0].tile.width_px, 300);
    EXPECT_EQ(pictures[0].tile.height_px, 200);
}

// Daylight of the usual sun, from above.
Style lit() {
    Style style{};
    style.frame.shadows = 1;
    style.frame.sun_enu = {0.0F, -0.6F, 0.8F};
    return style;
}

TEST(KnownPictures, HaveTheLightOfTheirStyle) {
    Style openness{};
    openness.frame.sky_openness = 1;
    const KnownPictures dark = known_pictures(View{}, Style{}, two_cameras());
    EXPECT_FALSE(dark.light.any());
    const KnownPictures open = known_pictures(View{}, openness, two_cameras());
    EXPECT_EQ(open.views.size(), 2U);
    EXPECT_TRUE(open.light.sky_openness);
    const KnownPictures one = known_pictures(View{}, lit(), std::vector<Camera>(1));
    ASSERT_EQ(one.views.size(), 1U);
    ASSERT_TRUE(one.light.sun_enu);
    EXPECT_NEAR(one.light.sun_enu->z, 0.8, 1e-6);
}

TEST(KnownPictures, AreNoneWhereSeveralHaveShadowsOrHeightsAreRounded) {
    View rounded;
    rounded.heights = HeightStorage::i16;
    EXPECT_TRUE(known_pictures(View{}, lit(), two_cameras()).views.empty());
    EXPECT_TRUE(known_pictures(rounded, Style{}, two_cameras()).views.empty());
    EXPECT_EQ(known_pictures(View{}, Style{}, two_cameras()).views.size(), 2U);
}

}  // namespace
}  // namespace oro
