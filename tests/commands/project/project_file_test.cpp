// Projects: what is written is read again, from wherever its folder has gone.
#include "apps/project/project_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

void touch(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "x";
}

// In a folder with a track, an image and names; the elevation lies beside it.
Project made_project(const fs::path& folder) {
    for (const char* const name :
         {"work/track.gpx", "work/places.geojson", "work/far.geojson", "work/old.tif", "work/image.tif",
          "work/cover.tif", "data/N46E008.hgt", "work/names.txt"})
        touch(folder / name);
    Project project;
    View& view = project.view;
    view.region.paths = {(folder / "data/N46E008.hgt").string()};
    view.camera.eye = {46.58123456789, 8.01, 2345.678901};
    view.camera.attitude = {123.456, -7.5, 0.25};
    view.camera.vertical_fov_deg = 37.0;
    view.camera.width_px = 960;
    view.camera.height_px = 540;
    view.style = "contours";
    view.exaggeration = 1.25;
    view.tau_px = 0.5;
    view.drape = {(folder / "work/image.tif").string()};
    view.vectors.overlay = {(folder / "work/track.gpx").string()};
    view.sun = SunDirection{120.0, 30.0, SunTime{"2026-06-21T08:00+02:00", 1'782'021'600}};
    view.time_utc_s = 1'782'021'600;
    project.overlay = view.vectors.overlay;
    project.names = {(folder / "work/places.geojson").string(), (folder / "work/far.geojson").string()};
    project.images = {(folder / "work/old.tif").string(), (folder / "work/image.tif").string()};
    project.cover = {(folder / "work/cover.tif").string()};
    project.gazetteers = {(folder / "work/names.txt").string()};
    project.tells_paths = false;
    project.bookmarks = {{"Hut", 46.6, 8.02, std::nullopt},
                         {"Col", 46.61, 8.03, BookmarkedEye{2500.0, 10.0, -5.0, 0.0, 45.0}}};
    CameraKey key;
    key.eye = {46.5, 8.1, 3000.5};
    key.attitude = {10.0, -20.0, 0.0};
    project.film.push_back({key, HeightAbove::ellipsoid});
    key.time_s = 5.5;
    key.time_utc_s = 1'782'021'700;
    project.film.push_back({key, HeightAbove::ellipsoid});
    project.measured = {{46.5, 8.0}, {46.55, 8.05}};
    project.viewshed = ProjectViewshed{{46.57, 8.01}, 12.5, 1.75, 15.0, false};
    return project;
}

std::string fault_of(const std::string& text) {
    const auto read = project_from_json(text, "p.json");
    EXPECT_FALSE(read.ok()) << text;
    return read.ok() ? "" : read.error().line();
}

TEST(Projects, AreReadAsTheyWereWritten) {
    const fs::path folder = test::scratch_folder();
    const Project project = made_project(folder);
    const std::string file = (folder / "work/project.json").string();
    const auto text = project_to_json(project, file);
    ASSERT_TRUE(text.ok()) << text.error().line();
    EXPECT_EQ(text->find(folder.string()), std::string::npos) << "no path of this machine is in it\n"
                                                              << *text;
    // Where the folder that holds both has gone, the paths lead there.
    const fs::path moved = test::scratch_folder() / "moved";
    fs::rename(folder, moved);
    const std::string there = (moved / "work/project.json").string();
    std::ofstream(there) << *text;
    EXPECT_TRUE(is_project(there));
    const auto read = read_project(there);
    ASSERT_TRUE(read.ok()) << read.error().line();
    const auto leads = [&](const std::string& path, const char* to) {
        EXPECT_TRUE(fs::equivalent(path, moved / to)) << path;
    };
    ASSERT_EQ(read->view.region.paths.size(), 1U);
    leads(read->view.region.paths[0], "data/N46E008.hgt");
    ASSERT_EQ(read->names.size(), 2U);
    leads(read->names[1], "work/far.geojson");
    ASSERT_EQ(read->images.size(), 2U);
    leads(read->images[0], "work/old.tif");
    leads(read->cover.at(0), "work/cover.tif");
    leads(read->overlay.at(0), "work/track.gpx");
    leads(read->gazetteers.at(0), "work/names.txt");
    leads(read->view.drape.at(0), "work/image.tif");
    EXPECT_EQ(read->view.read_from, there);
    // All else to the last digit: the same paths given back, the same text.
    Project again = *read;
    View& view = again.view;
    EXPECT_EQ(view.camera.eye.lat_deg, project.view.camera.eye.lat_deg);
    EXPECT_EQ(view.camera.attitude.heading_deg, 123.456);
    EXPECT_FALSE(again.tells_paths);
    ASSERT_EQ(again.film.size(), 2U);
    EXPECT_EQ(again.film[1].heights, HeightAbove::ellipsoid);
    EXPECT_EQ(again.film[1].key.time_s, 5.5);
    EXPECT_EQ(again.film[1].key.eye.h_m, 3000.5);
    ASSERT_TRUE(again.bookmarks.at(1).eye);
    EXPECT_EQ(again.bookmarks[1].eye->h_m, 2500.0);
    EXPECT_EQ(again.measured.at(1).lon_deg, 8.05);
    ASSERT_TRUE(again.viewshed);
    EXPECT_EQ(again.viewshed->target_m, 1.75);
    EXPECT_FALSE(again.viewshed->bends);
    const auto text_again = project_to_json(again, there);
    ASSERT_TRUE(text_again.ok()) << text_again.error().line();
    EXPECT_EQ(*text_again, *text);
}

TEST(Projects, HaveNoMoreThanThereIs) {
    const fs::path folder = test::scratch_folder();
    Project project;
    project.view.region.paths = {"a.tif"};
    const auto text = project_to_json(project, (folder / "p.json").string());
    ASSERT_TRUE(text.ok()) << text.error().line();
    for (const char* const field : {"film", "measured", "viewshed"})
        EXPECT_EQ(text->find('"' + std::string(field) + '"'), std::string::npos) << field;
    const auto read = project_from_json(*text, (folder / "p.json").string());
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_TRUE(read->film.empty() && read->bookmarks.empty() && read->measured.empty());
    EXPECT_FALSE(read->viewshed);
    EXPECT_TRUE(read->tells_paths);
}

TEST(Projects, WhatIsDamagedIsToldInOneLine) {
    EXPECT_EQ(fault_of("{}"), "p.json: holds no project that can be read: no orograph_project in it");
    EXPECT_EQ(fault_of(R"({"orograph_project": 2})"),
              "p.json: holds no project that can be read: its format is 2, this program reads 1");
    EXPECT_NE(fault_of(R"({"orograph_project": 1)").find("holds no project that can be read"),
              std::string::npos);
    EXPECT_NE(fault_of(R"({"orograph_project": 1})").find("'view'"), std::string::npos);
    EXPECT_NE(fault_of(R"({"orograph_project": 1, "view": {"orograph_view": 1}})").find("p.json"),
              std::string::npos);
    // Every cut of a whole one.
    const fs::path folder = test::scratch_folder();
    const auto text = project_to_json(made_project(folder), (folder / "work/project.json").string());
    ASSERT_TRUE(text.ok());
    for (std::size_t length = 0; length + 2 < text->size(); length += 97)
        EXPECT_EQ(fault_of(text->substr(0, length)).find('\n'), std::string::npos);
    // A field of another type.
    const auto with = [&](const std::string& what, const std::string& other) {
        std::string changed = *text;
        const std::size_t at = changed.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        return at == std::string::npos ? changed : changed.replace(at, what.size(), other);
    };
    const std::vector<std::pair<std::string, std::string>> changes{
        {"\"tells_paths\": false", "\"tells_paths\": 1"},
        {"\"radius_km\": 15.0", "\"radius_km\": -1"},
        {"\"layers\": {", "\"layers\": 3, \"was\": {"},
        {"\"bookmarks\": [", "\"bookmarks\": [7, "}};
    for (const auto& [what, other] : changes)
        EXPECT_FALSE(project_from_json(with(what, other), "p.json").ok()) << other;
    EXPECT_FALSE(is_project((folder / "no.json").string()));
    std::ofstream(folder / "path.json") << R"({"orograph_path": 1})";
    EXPECT_FALSE(is_project((folder / "path.json").string()));
    EXPECT_TRUE(is_camera_path((folder / "path.json").string()));
    std::ofstream(folder / "whole.json") << *text;
    EXPECT_TRUE(is_project((folder / "whole.json").string()));
    EXPECT_FALSE(is_camera_path((folder / "whole.json").string())) << "it has one, and is more";
    EXPECT_FALSE(is_project((folder / "work/track.gpx").string()));
}

}  // namespace
}  // namespace oro
