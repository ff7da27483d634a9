// What another Earth moves sideways: straight down nothing is lifted, and everything is displaced.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
using nlohmann::json;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::Words;

json effect_of_kind(const json& plan, const std::string& kind) {
    for (const json& effect : plan.at("effects"))
        if (effect.at("kind") == kind) return effect;
    ADD_FAILURE() << "no effect " << kind;
    return json::object();
}

// From 60 km at 36.6 N: the meridian's radius of curvature M is 6,358,122 m (a (1 - e^2) / (1 - e^2
// sin^2)^1.5, WGS84) against the sphere's 6,371,008.8, so a degree of latitude is drawn 0.20 % too long; N of
// the prime vertical is 6,385,740 m, and a degree of longitude is drawn 0.23 % too short. Ground that is x px
// from the nadir moves by that share of x: 0.20 % of 500 px is 1.0 px.
TEST(Sideways, ASphereStraightDownIsSeenByAllThatMeasure) {
    const std::string data = (oro::test::bundled_data() / "jacksboro.tif").string();
    const std::string picture = (oro::test::scratch_folder() / "p.png").string();
    // A field of view in which the region, 0.3 degrees or so, fills the picture's height of 1,000 px.
    const Words view{"--at", "36.6,-84.2", "--altitude", "60000",   "--pitch", "-90",   "--fov",
                     "20",   "--size",     "64x1000",    "--earth", "sphere",  "--tau", "0"};
    const json shot =
        object_said_by(joined({"shot", data, "--out", picture, "--verify", "--json", "-q"}, view));
    const json& error = shot.at("error");
    const double displacement_px = error.at("displacement_px").at("max").get<double>();
    std::printf("displacement %.3f px, %.1f m; surface %.3f px; seen %.3f px\n", displacement_px,
                error.at("displacement_m").at("max").get<double>(),
                error.at("surface_px").at("max").get<double>(), error.at("seen_px").at("max").get<double>());
    EXPECT_GT(displacement_px, 0.5);
    EXPECT_LT(displacement_px, 2.0);
    EXPECT_EQ(error.at("largest_px").get<double>(), displacement_px);
    const json plan = object_said_by(joined({"plan", data, "--json"}, view));
    const double bound_px = effect_of_kind(plan, "sphere").at("size").at("worst_px").get<double>();
    EXPECT_GE(bound_px, displacement_px);
    EXPECT_LE(bound_px, 3.0 * displacement_px) << "and says little";
    EXPECT_EQ(effect_of_kind(plan, "sphere").at("bound"), "estimated");
    EXPECT_GE(plan.at("total").at("worst_px").get<double>(), displacement_px);
    // A tolerance of half of that: no bundle holds it on a sphere, and all say so.
    const json chosen = object_said_by(joined({"shot", data, "--out", picture, "--overwrite", "--json", "-q",
                                               "--tolerance", std::to_string(0.5 * displacement_px) + "px"},
                                              Words(view.begin(), view.end() - 2)));
    EXPECT_EQ(chosen.at("accuracy").at("holds"), false) << chosen.at("accuracy").dump();
}

}  // namespace
