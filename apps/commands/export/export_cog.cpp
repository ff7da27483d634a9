// H, slope or canopy on a region's own posts, as a Cloud Optimized GeoTIFF.
#include <algorithm>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/commands/export/exported_region.h"
#include "apps/commands/export/post_layer.h"
#include "apps/detail/detail_words.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "core/base/parallel.h"
#include "geo/rasters/cloud_raster.h"
#include "geo/refined/refined_region.h"

namespace oro {
namespace {

// Of a file: at some 12 bytes each they take 12 GB.
constexpr double most_posts_of_cog = 1.0e9;

Result<PostRaster> tagged_raster(const Region& region, const PostLayer& layer) {
    const RegionGrid& grid = region.grids.front();
    ORO_TRY(PostRaster raster, raster_of_layer(region, layer));
    raster.tags.emplace_back("VERTICAL_DATUM", heights_words(region));
    raster.tags.emplace_back("SOURCE_VERTICAL_DATUM", source_heights_words(region));
    raster.tags.emplace_back("SOFTWARE", "orograph " OROGRAPH_VERSION);
    if (grid.detail) raster.tags.emplace_back("INVENTED", detail_words(*grid.detail));
    if (const std::string attribution = attribution_of(region); !attribution.empty())
        raster.tags.emplace_back("ATTRIBUTION", attribution);
    return raster;
}

Result<void> check_grid(const Region& region) {
    if (region.grids.size() > 1)
        return refused("--to", "cog",
                       "a GeoTIFF holds one grid of posts, and these data are " +
                           std::to_string(region.grids.size()) + ": name files of one of them");
    const auto posts = static_cast<double>(region.grids.front().field.grid.post_count());
    if (posts > most_posts_of_cog)
        return refused("--to", "cog",
                       grouped(static_cast<std::uint64_t>(posts)) +
                           " posts are more than 1,000,000,000: give a part of them with --bbox");
    return {};
}

void tell_cog(const ExportOptions& options, const Region& region, const PostLayer& layer,
              const PostRaster& raster, const CloudRasterWritten& written) {
    const auto& values = raster.bands.front().values;
    const auto voids = static_cast<std::uint64_t>(std::ranges::count(values, raster.no_value));
    const char* const type = written.whole_numbers ? "int16" : "float32";
    if (!options.json) {
        std::printf("Wrote %s: %s x %s posts, %s, %s bytes\n", options.out.c_str(),
                    grouped(static_cast<std::uint64_t>(raster.part.columns)).c_str(),
                    grouped(static_cast<std::uint64_t>(raster.part.rows)).c_str(), type,
                    grouped(written.bytes).c_str());
        if (layer.name != "H") std::printf("Layer: %s\n", raster.bands.front().name.c_str());
        std::printf("Heights: %s\n", heights_words(region).c_str());
        if (const auto& detail = region.grids.front().detail)
            std::printf("%s\n", detail_words(*detail).c_str());
        if (voids > 0)
            std::printf("Without a %s: %s\n", layer.name == "H" ? "height" : "value",
                        counted(voids, "post", "posts").c_str());
        return;
    }
    nlohmann::ordered_json json =
        json_object("file", options.out, "format", "cog", "layer", layer.name, "columns", raster.part.columns,
                    "rows", raster.part.rows, "type", type, "no_value", raster.no_value, "voids", voids,
                    "bytes", written.bytes, "heights", heights_words(region));
    json["attribution"] = attribution_of(region);
    if (const auto& detail = region.grids.front().detail) json["detail"] = detail_json(*detail);
    json["notes"] = all_notes(region);
    if (layer.canopy)
        for (const std::string& note : layer.canopy->notes()) json["notes"].push_back(note);
    std::printf("%s\n", json_text(json, true).c_str());
}

Result<void> write_cog(const ExportOptions& options, const Region& region, const PostLayer& layer,
                       ProgressBar& bar) {
    bar.show(1.0, "writing");
    ORO_TRY(const PostRaster raster, tagged_raster(region, layer));
    ORO_TRY(const CloudRasterWritten written,
            write_cloud_raster(options.out, options.overwrite, raster, thread_count()));
    bar.clear();
    say_notes(region, options.quiet);
    if (layer.canopy)
        for (const std::string& note : layer.canopy->notes()) say(options.quiet, "note: " + note);
    tell_cog(options, region, layer, raster, written);
    return {};
}

}  // namespace

Result<void> export_cog(const ExportOptions& options, const Region& region, const PostLayer& layer,
                        ProgressBar& bar) {
    ORO_CHECK(check_grid(region));
    if (options.detail) {
        bar.show(0.5, "ground between posts");
        Region dense;
        ORO_TRY(RegionGrid grid, whole_with_detail(region.grids.front(), *options.detail));
        grid.notes = region.grids.front().notes;
        dense.grids.push_back(std::move(grid));
        ORO_CHECK(region.health());
        return write_cog(options, dense, layer, bar);
    }
    return write_cog(options, region, layer, bar);
}

}  // namespace oro
