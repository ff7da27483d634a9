// What the window measures is what the commands say, to the last digit.
#include "apps/options/realisation_options.h"
#include "apps/window/measure.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/commands/sight/profile_text.h"
#include "apps/commands/sight/sight_text.h"
#include "apps/options/realisation_options.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

std::string bundled() {
    return (test::bundled_data() / "jacksboro.tif").string();
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::unique_ptr<const SightGround> bundled_ground() {
    RegionOptions options;
    options.paths = {bundled()};
    auto ground = open_sight_ground(options, {});
    EXPECT_TRUE(ground.ok()) << ground.error().line();
    return std::move(*ground);
}

// The profile's files have the command's bytes, in each format, and its text is the same.
void expect_files_of_command(const Measurement& measurement, ProfileOptions options) {
    ASSERT_TRUE(measurement.profile);
    const fs::path folder = test::scratch_folder();
    options.region.paths = {bundled()};
    options.quiet = true;
    for (const char* const name : {"p.csv", "p.svg", "p.geojson"}) {
        options.out = (folder / name).string();
        testing::internal::CaptureStdout();
        const Result<void> ran = run_profile(options);
        const std::string printed = testing::internal::GetCapturedStdout();
        ASSERT_TRUE(ran.ok()) << ran.error().line();
        EXPECT_EQ(printed, profile_text(*measurement.profile));
        EXPECT_TRUE(bytes_of(folder / name) == profile_file_text(*measurement.profile, name)) << name;
    }
}

TEST(WindowMeasures, AProfileThatIsDrawn) {
    const auto ground = bundled_ground();
    const std::vector<LatLon> places{{36.5, -84.2}, {36.55, -84.35}, {36.600000001, -84.3}};
    const Measurement found = measured(places, standard_air, ground->ground()).value();
    ProfileOptions options;
    options.along = along_text(places);
    expect_files_of_command(found, options);
    ASSERT_TRUE(found.area);
    EXPECT_EQ(found.area->area_m2, geodesic_area(places).area_m2);
}

TEST(WindowMeasures, ALineOfAFile) {
    const auto ground = bundled_ground();
    const fs::path file = test::scratch_folder() / "ways.geojson";
    std::ofstream(file) << R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"name": "one"}, "geometry":
          {"type": "LineString", "coordinates": [[-84.2, 36.5], [-84.25, 36.55]]}},
        {"type": "Feature", "properties": {}, "geometry":
          {"type": "LineString", "coordinates": [[-84.35, 36.5], [-84.3, 36.55], [-84.32, 36.6]]}}]})";
    const Measurement found = measured_line(file.string(), 2, standard_air, ground->ground()).value();
    ProfileOptions options;
    options.along = file.string();
    options.line = 2;
    expect_files_of_command(found, options);
    EXPECT_FALSE(found.area);  // it does not end where it began
    EXPECT_EQ(names_of_lines(read_vectors(file.string()).value()),
              (std::vector<std::string>{"one", "line 2"}));
    EXPECT_FALSE(measured_line(file.string(), 3, standard_air, ground->ground()).ok());
}

TEST(WindowMeasures, TheLineOfSight) {
    const auto ground = bundled_ground();
    for (const auto& [from, to] : {std::pair{LatLon{36.5, -84.2}, LatLon{36.55, -84.35}},
                                   {LatLon{36.6, -84.3}, LatLon{36.601, -84.301}}}) {
        const Measurement found = measured({from, to}, standard_air, ground->ground()).value();
        ASSERT_TRUE(found.sight);
        const std::string ends = along_text({from, to});
        const std::size_t comma = ends.find(';');
        SightOptions options;
        options.region.paths = {bundled()};
        options.from = ends.substr(0, comma);
        options.to = ends.substr(comma + 2);
        options.json = options.quiet = true;
        testing::internal::CaptureStdout();
        const Result<void> ran = run_sight(options, {});
        auto printed = nlohmann::json::parse(testing::internal::GetCapturedStdout());
        ASSERT_TRUE(ran.ok()) << ran.error().line();
        printed.erase("notes");
        EXPECT_EQ(nlohmann::json::parse(sight_json(*found.sight, *ground).dump()), printed);
    }
}

}  // namespace
}  // namespace oro
