// Colours of buildings, as shaders/shade/built_colour.glsl has them.
#include "core/seam/mesh_colours.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

void expect_light(const gpu::vec3& light, const gpu::vec3& expected) {
    constexpr float rounding = 1.0e-4F;
    EXPECT_NEAR(light.x, expected.x, rounding);
    EXPECT_NEAR(light.y, expected.y, rounding);
    EXPECT_NEAR(light.z, expected.z, rounding);
}

// Of the tone 0.08 the wall is 0.156 of the way from white to cream, times 1.0917; the roof is slate, times
// 0.9530; and gravel is times 0.9336. By hand from the shader.
TEST(MeshColours, AreThoseOfPictures) {
    expect_light(colour_of_building(0.08F, 90.0F), {0.67346F, 0.64139F, 0.57145F});
    expect_light(colour_of_building(0.08F, 80.0F), {0.67346F, 0.64139F, 0.57145F});
    expect_light(colour_of_building(0.08F, 40.0F), {0.09530F, 0.08768F, 0.08386F});
    expect_light(colour_of_building(0.08F, 2.0F), {0.22406F, 0.21940F, 0.20539F});
    // In the middle of 74 to 80 degrees half of each.
    expect_light(colour_of_building(0.08F, 77.0F), {0.38438F, 0.36454F, 0.32766F});
    expect_light(colour_of_paving({0.5F, 0.25F, 0.1F}), {0.4F, 0.2F, 0.08F});
    EXPECT_GT(colour_of_plain_mesh().x, colour_of_plain_mesh().z);
}

// Tones are hues: names give houses of other colours.
TEST(MeshColours, DifferByTone) {
    const gpu::vec3 ochre = colour_of_building(0.4F, 90.0F), white = colour_of_building(0.0F, 90.0F);
    EXPECT_GT(white.z, 1.5F * ochre.z);
}

}  // namespace
}  // namespace oro
