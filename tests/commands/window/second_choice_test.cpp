// What a second view has otherwise than the first, where both stand, and what the pointer does there.
#include "apps/window/second_choice.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

View first_view() {
    View view;
    view.camera.eye = {46.5, 8.0, 3000.0};
    view.camera.attitude = {205.0, -4.0, 0.0};
    view.camera.width_px = 320, view.camera.height_px = 240;
    view.tau_px = 0.5;
    view.style = "default";
    view.mesh = "clusters";
    return view;
}

TEST(SecondChoices, NothingChosenIsTheFirstView) {
    const View first = first_view();
    const auto second = differing_view(first, {});
    ASSERT_TRUE(second.ok()) << second.error().line();
    EXPECT_EQ(second->tau_px, 0.5);
    EXPECT_EQ(second->exaggeration, 1.0);
    EXPECT_EQ(second->style, "default");
    EXPECT_TRUE(second->has_geoid);
    EXPECT_EQ(second->model.earth, Earth::ellipsoid);
    EXPECT_EQ(second->model.air, first.model.air);
    EXPECT_EQ(second->mesh, "auto") << "what draws it is chosen anew";
    const DifferenceWords words = difference_words(first, {}, {"a.tif", "b.tif"});
    EXPECT_EQ(words.first, "first view");
    EXPECT_EQ(words.second, "second view");
}

TEST(SecondChoices, WhatIsChosenIsInTheViewAndSaid) {
    SecondChoice choice;
    choice.tau_px = 4.0;
    choice.exaggeration = 2.0;
    choice.air = standard_air;
    choice.earth = Earth::sphere;
    choice.leaves_geoid_out = true;
    choice.sun_time = "2026-06-21T05:30+02:00";
    choice.paths = {"b.tif"};
    const View first = first_view();
    const auto second = differing_view(first, choice);
    ASSERT_TRUE(second.ok()) << second.error().line();
    EXPECT_EQ(second->tau_px, 4.0);
    EXPECT_EQ(second->exaggeration, 2.0);
    EXPECT_EQ(second->model.air, standard_air);
    EXPECT_EQ(second->model.earth, Earth::sphere);
    EXPECT_FALSE(second->has_geoid);
    ASSERT_TRUE(second->sun && second->sun->time);
    EXPECT_EQ(second->sun->time->utc_s, 1782012600);
    // Half past five in summer at 8 degrees east: the sun has just come up in the north-east.
    EXPECT_NEAR(second->sun->azimuth_deg, 54.0, 4.0);
    const DifferenceWords words = difference_words(first, choice, {"a.tif", "b.tif"});
    EXPECT_EQ(words.first,
              "a.tif, tau 0.50 px, heights x 1.00, ellipsoid, straight light, with geoid, usual light");
    EXPECT_EQ(words.second,
              "b.tif, tau 4.00 px, heights x 2.00, sphere, standard air, no geoid, sun "
              "2026-06-21T05:30+02:00");
}

TEST(SecondChoices, WhatIsTheSameIsNotSaid) {
    SecondChoice choice;
    choice.tau_px = 0.5;
    choice.earth = Earth::ellipsoid;
    choice.style = "default";
    choice.air = Air{};
    EXPECT_EQ(difference_words(first_view(), choice, {}).second, "second view");
}

TEST(SecondChoices, ATimeThatIsNoneIsRefused) {
    SecondChoice choice;
    choice.sun_time = "noon";
    const auto second = differing_view(first_view(), choice);
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().kind, ErrorKind::usage);
}

TEST(SecondChoices, TheEyeIsTheFirstOnesAsHighOverTheGround) {
    const Camera first = first_view().camera;
    const Camera second = second_camera(first, 161, 52.25);
    EXPECT_EQ(second.eye.lat_deg, first.eye.lat_deg);
    EXPECT_EQ(second.eye.lon_deg, first.eye.lon_deg);
    EXPECT_EQ(second.eye.h_m, 2947.75);
    EXPECT_EQ(second.attitude.heading_deg, 205.0);
    EXPECT_EQ(second.vertical_fov_deg, first.vertical_fov_deg);
    EXPECT_EQ(second.width_px, 161);
    EXPECT_EQ(second.height_px, 240);
}

// Every column is in one of them.
TEST(SecondChoices, HalvesFillTheWindow) {
    for (int width = 1; width < 700; ++width) {
        const TwoHalves sides = two_halves(TwoViewsLayout::side_by_side, 0.3, width);
        EXPECT_GE(sides.first_px, 1);
        EXPECT_GE(sides.second_px, 1);
        EXPECT_EQ(sides.begins_px, sides.first_px);
        if (width > 1) {
            ASSERT_EQ(sides.first_px + sides.second_px, width);
        }
        EXPECT_LE(sides.second_px - sides.first_px, 1);
        const TwoHalves swiped = two_halves(TwoViewsLayout::swipe, 0.3, width);
        EXPECT_EQ(swiped.first_px, width);
        EXPECT_EQ(swiped.second_px, width);
        EXPECT_NEAR(swiped.begins_px, 0.3 * width, 0.5);
    }
    EXPECT_EQ(two_halves(TwoViewsLayout::swipe, -1.0, 100).begins_px, 0);
    EXPECT_EQ(two_halves(TwoViewsLayout::swipe, 2.0, 100).begins_px, 100);
}

TEST(SecondChoices, WhatThePointerDoesInTheSecondHalfItDoesInTheFirst) {
    PointerOverHalves pointer;
    EXPECT_EQ(pointer.point_of_first({250.5, 10.5}, 0), glm::dvec2(250.5, 10.5)) << "there is one alone";
    EXPECT_EQ(pointer.point_of_first({50.5, 10.5}, 160), glm::dvec2(50.5, 10.5));
    EXPECT_EQ(pointer.point_of_first({250.5, 10.5}, 160), glm::dvec2(90.5, 10.5));
    // A drag goes on over the border, from either side.
    pointer.button(true, {250.5, 10.5}, 160);
    EXPECT_EQ(pointer.point_of_first({100.5, 20.5}, 160), glm::dvec2(-59.5, 20.5));
    pointer.button(false, {100.5, 20.5}, 160);
    EXPECT_EQ(pointer.point_of_first({100.5, 20.5}, 160), glm::dvec2(100.5, 20.5));
    pointer.button(true, {100.5, 10.5}, 160);
    EXPECT_EQ(pointer.point_of_first({200.5, 20.5}, 160), glm::dvec2(200.5, 20.5));
    // A button that went down on a panel comes up alone.
    pointer.button(false, {200.5, 20.5}, 160);
    pointer.button(false, {200.5, 20.5}, 160);
    EXPECT_EQ(pointer.point_of_first({200.5, 20.5}, 160), glm::dvec2(40.5, 20.5));
}

}  // namespace
}  // namespace oro
