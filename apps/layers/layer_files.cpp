#include <filesystem>
#include <set>

#include "apps/layers/picture_layers.h"
#include "apps/report/feature_words.h"
#include "apps/report/figures.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/rasters/layer_raster.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

using Tags = std::vector<std::pair<std::string, std::string>>;

Tags common_tags(const std::string& picture, const View& view, const Region& region) {
    const Geodetic& eye = view.camera.eye;
    const Attitude& attitude = view.camera.attitude;
    return {
        {"PICTURE", std::filesystem::path(picture).filename().string()},
        {"EYE_LATITUDE_LONGITUDE_h",
         all_digits(eye.lat_deg) + "," + all_digits(eye.lon_deg) + "," + all_digits(eye.h_m)},
        {"HEADING_PITCH_ROLL_DEG", all_digits(attitude.heading_deg) + "," + all_digits(attitude.pitch_deg) +
                                       "," + all_digits(attitude.roll_deg)},
        {"FOV_DEG", all_digits(view.camera.vertical_fov_deg)},
        {"TAU_PX", all_digits(view.tau_px)},
        {"GEOID", region.grids.front().geoid},
        {"VALUES_ARE", "of the middle of each pixel; NaN where it shows no ground"},
        {"SOFTWARE", "orograph " OROGRAPH_VERSION}};
}

// The numbers of sources are those of the list that --json prints.
Tags source_tags(const View& view, const Region& region) {
    Tags tags;
    if (!view.tells_paths) return tags;
    for (const RegionGrid& grid : region.grids) {
        for (const SourceReport& source : grid.sources)
            tags.emplace_back("SOURCE_" + std::to_string(tags.size()),
                              std::filesystem::path(source.path).filename().string());
    }
    return tags;
}

// What the codes of the layer cover are.
Tags cover_tags(const CoverMap& cover) {
    Tags tags{{"TABLE", cover.table().title}};
    for (const CoverClass& one : cover.table().classes)
        for (const int code : one.codes) tags.emplace_back("CLASS_" + std::to_string(code), one.name);
    return tags;
}

// Names of the features that show; none of more than a metadata block can hold.
Tags feature_tags(const Region& region, const PictureLayers& layers) {
    std::set<std::uint32_t> shown;
    for (const float number : layers.feature)
        if (number > 0.0F) shown.insert(static_cast<std::uint32_t>(number));
    constexpr std::size_t most_named = 20000;
    Tags tags;
    if (!region.meshes || shown.size() > most_named) return tags;
    std::uint32_t before = 0;
    for (const PlacedMesh& mesh : *region.meshes) {
        const auto count = static_cast<std::uint32_t>(mesh.features.size());
        for (const std::uint32_t number : shown)
            if (number > before && number <= before + count)
                tags.emplace_back("FEATURE_" + std::to_string(number),
                                  words_of(mesh.features[number - before - 1]));
        before += count;
    }
    return tags;
}

}  // namespace

bool has_meshes(const View& view, const Region& region) {
    return !view.region.meshes.files.empty() || (region.meshes && !region.meshes->empty());
}

std::vector<const char*> layers_of_view(bool covers, bool meshes) {
    std::vector<const char*> names(layer_names.begin(), layer_names.end());
    if (meshes) names.push_back("feature");
    if (covers) names.push_back("cover");
    return names;
}

std::string layer_path(const std::string& picture, const std::string& layer) {
    const std::filesystem::path path(picture);
    const bool is_png = path.extension() == ".png";
    return (is_png ? std::filesystem::path(path).replace_extension() : path).string() + "." + layer + ".tif";
}

Result<std::vector<WholeFile>> layer_files(const std::string& picture, bool overwrite, const View& view,
                                           const Region& region, const PictureLayers& layers) {
    using Doubles = std::span<const double>;
    using Floats = std::span<const float>;
    struct Layer {
        std::variant<Floats, Doubles> values;
        const char* what;
        const char* unit;
    };
    std::vector<Layer> all{
        {Doubles(layers.longitude_deg), "longitude, WGS84, east positive", "degree"},
        {Doubles(layers.latitude_deg), "latitude, WGS84, north positive", "degree"},
        {Floats(layers.H_m), "H: height of the ground above the geoid (sea level)", "metre"},
        {Floats(layers.h_m), "h: height of the ground above the WGS84 ellipsoid", "metre"},
        {Floats(layers.distance_m), "distance from the eye along the sight line", "metre"},
        {Floats(layers.slope_deg), "slope of the ground (Horn), 0 is level", "degree"},
        {Floats(layers.source), "number of the source in the list that --json prints, from 0", ""},
        {Floats(layers.shadow), "share of the sun's light past the terrain: 0 in shadow, 1 in the sun", ""},
    };
    if (has_meshes(view, region))
        all.push_back(
            {Floats(layers.feature),
             "number of the thing of a mesh (a building): the tags FEATURE_... have names of those that "
             "show",
             ""});
    if (view.cover)
        all.push_back(
            {Floats(layers.cover), "code of the land cover: the tags CLASS_... have its names", ""});
    const std::vector<const char*> names = layers_of_view(view.cover != nullptr, has_meshes(view, region));
    const Tags common = common_tags(picture, view, region);
    std::vector<WholeFile> files;
    for (std::size_t i = 0; i < all.size(); ++i) {
        LayerRaster raster{view.camera.width_px, view.camera.height_px, all[i].values,
                           all[i].what,          all[i].unit,           common};
        const std::string name = names[i];
        if (name == "source")
            for (auto& tag : source_tags(view, region)) raster.tags.push_back(std::move(tag));
        if (name == "feature")
            for (auto& tag : feature_tags(region, layers)) raster.tags.push_back(std::move(tag));
        if (name == "cover")
            for (auto& tag : cover_tags(*view.cover)) raster.tags.push_back(std::move(tag));
        ORO_TRY(WholeFile file, layer_raster(layer_path(picture, name), overwrite, raster));
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace oro
