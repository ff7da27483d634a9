// Views as files: what is written is what is read back, field by field.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/view/view.h"

namespace {

oro::View unusual_view() {
    oro::View view;
    view.region.paths = {"a.hgt", "b c.zip"};
    view.region.box = oro::BoundingBox{179.5, -17.25, -179.0, -16.0};
    view.region.height_unit = "us-ft";
    view.region.source_crs = "EPSG:2056";
    view.region.source_vertical = "EPSG:4979";
    view.region.fill_voids = true;
    view.region.strict_datum = true;
    view.camera.eye = {-16.123456789012345, 179.87654321098765, 1234.5678901234567};
    view.camera.attitude = {123.4567890123456, -12.3, 4.5};
    view.camera.vertical_fov_deg = 33.3;
    view.camera.width_px = 641;
    view.camera.height_px = 359;
    view.exaggeration = 1.7;
    view.samples = 5;
    view.sun = oro::SunDirection{270.0, -3.5};
    view.visibility_km = 12.5;
    view.style = "other";
    view.drape = {"a.tif"};
    view.drape_values = oro::ImageValues::codes;
    view.cover_choice = {{"cover.tif"}, "worldcover"};
    view.canopy_choice = {{"trees.tif", "more.tif"}, false, 0.25};
    view.detail = oro::DetailChoice{3, 2.5, oro::DetailMiddle{-16.125, 179.875}};
    view.sea = oro::Sea::low;
    view.rim = oro::Rim::none;
    view.labels = true;
    view.edges = oro::Edges::steps;
    view.show = oro::Show::levels;
    view.graticule = oro::Graticule::projected;
    view.mesh_level = 7;
    view.pipeline = "compute";
    view.model = {oro::Earth::sphere, {-0.25}, oro::Precision::naive};
    view.has_geoid = false;
    view.heights = oro::HeightStorage::i16;
    view.time_utc_s = 1234567890;
    return view;
}

TEST(ViewFile, EveryFieldComesBack) {
    const oro::View view = unusual_view();
    for (const bool pretty : {false, true}) {
        const std::string text = oro::view_to_json(view, pretty);
        const auto read = oro::view_from_json(text, "test");
        ASSERT_TRUE(read.ok()) << read.error().line();
        EXPECT_EQ(oro::view_to_json(*read, pretty), text);
        EXPECT_EQ(read->pipeline, "compute");
        EXPECT_EQ(read->region.source_crs, "EPSG:2056");
        EXPECT_EQ(read->region.source_vertical, "EPSG:4979");
        EXPECT_EQ(read->visibility_km, 12.5);
        EXPECT_EQ(read->drape_values, oro::ImageValues::codes);
        EXPECT_EQ(read->cover_choice, view.cover_choice);
        EXPECT_EQ(read->canopy_choice, view.canopy_choice);
        EXPECT_EQ(read->detail, view.detail);
        EXPECT_EQ(read->sea, oro::Sea::low);
        EXPECT_EQ(read->rim, oro::Rim::none);
        EXPECT_EQ(read->edges, oro::Edges::steps);
        EXPECT_EQ(read->show, oro::Show::levels);
        EXPECT_EQ(read->mesh_level, 7);
        EXPECT_EQ(read->graticule, oro::Graticule::projected);
        EXPECT_EQ(read->camera.eye.lat_deg, view.camera.eye.lat_deg);
        EXPECT_EQ(read->model.air, oro::Air{-0.25});
        EXPECT_FALSE(read->has_geoid);
    }
}

// Whatever the order of the table of options.
TEST(ViewFile, KeysStandAsTheyAlwaysDid) {
    oro::View view = unusual_view();
    view.shadows = view.sky_openness = true;
    view.mesh = "clusters";
    view.vectors.names = {"peaks.gpx"};
    view.vectors.overlay = {"track.gpx"};
    const auto json = nlohmann::ordered_json::parse(oro::view_to_json(view, false));
    std::string keys;
    for (const auto& [key, value] : json.items()) keys += key + " ";
    EXPECT_EQ(
        keys,
        "orograph_view sources bbox height_unit source_crs source_vertical fill_voids strict_datum eye "
        "heading_deg pitch_deg roll_deg fov_deg size_px samples exaggeration sun visibility_km style sea "
        "rim drape landcover canopy detail names overlay names_field shadows sky_openness labels show edges "
        "pipeline mesh "
        "mesh_level tau_px accuracy earth geoid refraction air precision heights graticule time_utc_s time ");
}

TEST(ViewFile, PanoramasComeBackAndHaveSomethingInThem) {
    oro::View view = unusual_view();
    EXPECT_FALSE(oro::view_from_json(oro::view_to_json(view, false), "test")->panorama);
    view.panorama = oro::PanoramaFrame{300.25, 123.5, -12.125, 4.5, false};
    const std::string text = oro::view_to_json(view, false);
    const auto read = oro::view_from_json(text, "test");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(oro::view_to_json(*read, false), text);
    EXPECT_EQ(read->panorama->sweep_deg, 123.5);
    EXPECT_FALSE(read->panorama->ridges);
    for (const oro::PanoramaFrame& bad : {oro::PanoramaFrame{0.0, 0.0, -5.0, 5.0},
                                          {0.0, 361.0, -5.0, 5.0},
                                          {0.0, 90.0, 5.0, 5.0},
                                          {0.0, 90.0, -80.0, 5.0},
                                          {400.0, 90.0, -5.0, 5.0}}) {
        view.panorama = bad;
        EXPECT_FALSE(oro::view_from_json(oro::view_to_json(view, false), "test").ok());
    }
}

// Found: none; --refraction meant another law before, and views of then draw what they drew.
TEST(ViewFile, ViewsThatDoNotNameTheirAirHaveThatOfBefore) {
    oro::View view = unusual_view();
    const auto air_of = [&](double k, bool named) {
        view.model.air = {k};
        std::string text = oro::view_to_json(view, false);
        const std::string field = R"("air":"constant",)";
        EXPECT_NE(text.find(field), std::string::npos) << text;
        if (!named) text.erase(text.find(field), field.size());
        const auto read = oro::view_from_json(text, "test");
        EXPECT_TRUE(read.ok());
        return read.ok() ? read->model.air : oro::Air{99.0};
    };
    EXPECT_EQ(air_of(0.13, true), oro::Air{0.13});
    EXPECT_EQ(air_of(0.13, false), oro::standard_air);
    EXPECT_EQ(air_of(0.2, false), (oro::Air{0.2, oro::AirLaw::standard}));
    EXPECT_EQ(air_of(0.0, false), oro::Air{});
    view.model.air = oro::standard_air;
    std::string text = oro::view_to_json(view, false);
    EXPECT_NE(text.find(R"("refraction":0.13,"air":"standard",)"), std::string::npos) << text;
    EXPECT_EQ(oro::view_from_json(text, "test")->model.air, oro::standard_air);
    text.replace(text.find("\"standard\""), 10, "\"thick\"");
    const auto read = oro::view_from_json(text, "test");
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().line().find("'air' is 'thick'"), std::string::npos) << read.error().line();
}

// Pictures of before posts were kept where their files have them were drawn from resampled ones.
TEST(ViewFile, ViewsThatSayNothingOfOwnPostsAreDrawnResampled) {
    oro::View view = unusual_view();
    view.own_posts = true;
    const std::string text = oro::view_to_json(view, false);
    const auto own = oro::view_from_json(text, "test");
    ASSERT_TRUE(own.ok()) << own.error().line();
    EXPECT_TRUE(own->own_posts);
    EXPECT_FALSE(own->region.resample);
    EXPECT_EQ(oro::view_to_json(*own, false), text);
    std::string before = text;
    const std::string field = "\"own_posts\":true,";
    ASSERT_NE(before.find(field), std::string::npos) << text;
    before.erase(before.find(field), field.size());
    const auto old = oro::view_from_json(before, "test");
    ASSERT_TRUE(old.ok()) << old.error().line();
    EXPECT_FALSE(old->own_posts);
    EXPECT_TRUE(old->region.resample);
    EXPECT_EQ(oro::view_to_json(*old, false), before);
}

TEST(ViewFile, ViewsOfBeforeThereWereLabelsHaveNone) {
    oro::View view = unusual_view();
    const auto labels_of = [&](const std::string& field, const std::string& instead) {
        std::string text = oro::view_to_json(view, false);
        EXPECT_NE(text.find(field), std::string::npos) << text;
        text.replace(text.find(field), field.size(), instead);
        const auto read = oro::view_from_json(text, "test");
        EXPECT_TRUE(read.ok());
        return read.ok() ? read->labels : std::nullopt;
    };
    EXPECT_EQ(labels_of(R"("labels":"on",)", R"("labels":"on",)"), true);
    EXPECT_EQ(labels_of(R"("labels":"on",)", R"("labels":"off",)"), false);
    EXPECT_EQ(labels_of(R"("labels":"on",)", ""), false);
    view.labels.reset();
    EXPECT_EQ(labels_of(R"("labels":"style",)", R"("labels":"style",)"), std::nullopt);
    EXPECT_EQ(labels_of(R"("labels":"style",)", ""), false);
}

TEST(ViewFile, ViewsWithoutAPipelineAreAutomatic) {
    std::string text = oro::view_to_json(unusual_view(), false);
    const std::string field = R"("pipeline":"compute",)";
    ASSERT_NE(text.find(field), std::string::npos);
    text.erase(text.find(field), field.size());
    const auto read = oro::view_from_json(text, "test");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->pipeline, "auto");
}

TEST(ViewFile, UnknownPipelinesAreRefused) {
    oro::View view = unusual_view();
    view.pipeline = "vertex";
    const auto read = oro::view_from_json(oro::view_to_json(view, false), "test");
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().line().find("'pipeline' is 'vertex'"), std::string::npos) << read.error().line();
}

TEST(ViewFile, ARegionCannotBeChangedButItsPathsCan) {
    oro::View view = unusual_view();
    oro::RegionOptions options;
    options.paths = {"elsewhere.hgt"};
    EXPECT_TRUE(oro::change_region(view, options).ok());
    EXPECT_EQ(view.region.paths, options.paths);
    options.tile = "N46E008";
    const auto changed = oro::change_region(view, options);
    ASSERT_FALSE(changed.ok());
    EXPECT_EQ(changed.error().kind, oro::ErrorKind::usage);
}

}  // namespace
