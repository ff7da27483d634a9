#include "apps/commands/export/post_layer.h"

#include <cmath>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/sight/sight_ground.h"
#include "core/base/parallel.h"
#include "core/terrain/horn_slope.h"
#include "geo/canopy/canopy_of_posts.h"

namespace oro {
namespace {

PostRaster::Band heights_band(const HeightField& field) {
    PostRaster::Band band{"H, metres above the geoid", {}, "metre"};
    band.values.reserve(field.grid.post_count());
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column) {
            const float H_m = field.H_at_post_m(row, column);
            band.values.push_back(is_void(H_m) ? no_post_value : H_m);
        }
    }
    return band;
}

PostRaster::Band slope_band(const HeightField& field) {
    PostRaster::Band band{"slope of the ground (Horn), degrees, 0 is level", {}, "degree"};
    const auto columns = static_cast<std::size_t>(field.grid.columns());
    band.values.resize(field.grid.post_count());
    in_parallel(field.grid.rows(), thread_count(), [&](int row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const auto slope_deg = horn_slope_deg(field, row, static_cast<double>(column));
            band.values[static_cast<std::size_t>(row) * columns + column] =
                slope_deg ? static_cast<float>(*slope_deg) : no_post_value;
        }
    });
    return band;
}

Result<PostRaster::Band> canopy_band(const HeightField& field, const CanopyMap& canopy) {
    PostRaster::Band band{"canopy: metres from the ground to the top of what grows on it", {}, "metre"};
    ORO_TRY(band.values, canopy_of_posts(field.grid, canopy));
    std::size_t post = 0;
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column, ++post)
            if (std::isnan(band.values[post]) || is_void(field.H_at_post_m(row, column)))
                band.values[post] = no_post_value;
    }
    return band;
}

}  // namespace

std::vector<std::string> PostLayer::files() const {
    return canopy ? files_of_cover({nullptr, canopy, std::nullopt}) : std::vector<std::string>{};
}

Result<void> check_layer_words(const ExportOptions& options) {
    const bool is_cog = options.to == "cog", is_canopy = options.layer == "canopy";
    if (options.layer && !is_cog) return refused("--layer", *options.layer, "needs --to cog");
    if (is_canopy && options.canopy.empty())
        return refused("--layer", "canopy", "needs --canopy, a raster of canopy heights");
    if (!options.canopy.empty() && !is_canopy)
        return refused("--canopy", options.canopy.front(), "needs --layer canopy");
    if (options.layer.value_or("H") != "H" && options.detail)
        return refused("--detail", std::to_string(*options.detail), "needs --layer H");
    if (is_canopy && !options.landcover.empty() && options.canopy.front() != "class")
        return refused("--landcover", options.landcover.front(), "needs --canopy class");
    return {};
}

Result<PostLayer> open_post_layer(const ExportOptions& options) {
    PostLayer layer;
    if (options.layer) layer.name = *options.layer;
    if (layer.name != "canopy") return layer;
    ViewOptions words;
    words.canopy = options.canopy;
    words.landcover = options.landcover;
    ORO_TRY(const SightCover cover, open_sight_cover(words));
    layer.canopy = cover.canopy;
    return layer;
}

Result<PostRaster> raster_of_layer(const Region& region, const PostLayer& layer) {
    const RegionGrid& grid = region.grids.front();
    PostRaster raster;
    raster.grid = grid.field.grid;
    raster.crs = grid.posts_crs;
    raster.part = {0, raster.grid.rows(), 0, raster.grid.columns()};
    raster.no_value = no_post_value;
    raster.fractions = layer.name != "H";
    if (layer.canopy) {
        ORO_TRY(PostRaster::Band band, canopy_band(grid.field, *layer.canopy));
        raster.bands.push_back(std::move(band));
        if (layer.canopy->is_invented())
            raster.tags.emplace_back("INVENTED",
                                     "heights of classes of " + layer.canopy->cover()->table().title);
    } else {
        raster.bands.push_back(layer.name == "slope" ? slope_band(grid.field) : heights_band(grid.field));
    }
    ORO_CHECK(region.health());
    return raster;
}

}  // namespace oro
