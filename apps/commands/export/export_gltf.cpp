// The ground as one model, and how far it is from it.
#include <cstdio>
#include <string>

#include "apps/command_line/refusals.h"
#include "apps/commands/export/exported_region.h"
#include "apps/drawing/region_scene.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "core/base/srgb.h"
#include "geo/files/whole_file.h"
#include "geo/tilesets/ground_model.h"

namespace oro {
namespace {

// Of sRGB: what the style `natural` has for bare ground below the snow line.
constexpr std::array ground_colour{0x91 / 255.0, 0x8B / 255.0, 0x81 / 255.0};

void tell_model(const ExportOptions& options, const Region& region, const GroundModel& model,
                std::uint64_t bytes) {
    const std::uint64_t triangles = model.indices.size() / 3;
    if (options.json) {
        auto json = json_object("file", options.out, "format", "gltf", "triangles", triangles, "vertices",
                                model.positions_m.size(), "bytes", bytes, "error_m", model.error_m, "origin",
                                json_object("lat_deg", model.origin.lat_deg, "lon_deg", model.origin.lon_deg,
                                            "h_m", model.origin.h_m),
                                "heights", heights_words(region), "attribution", attribution_of(region),
                                "notes", all_notes(region));
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Wrote %s: %s, %s bytes\n", options.out.c_str(),
                counted(triangles, "triangle", "triangles").c_str(), grouped(bytes).c_str());
    std::printf("Heights: h, above the ellipsoid WGS84; the data's are %s\n", heights_words(region).c_str());
    std::printf("From the ground: %s m at most (proven)\n", figure(model.error_m).c_str());
}

}  // namespace

GlbLook look_of(const Region& region) {
    GlbLook look;
    for (std::size_t i = 0; i < ground_colour.size(); ++i) look.colour[i] = light_of_srgb(ground_colour[i]);
    look.attribution = attribution_of(region);
    look.generator = "orograph " OROGRAPH_VERSION;
    return look;
}

Result<void> check_one_grid(const ExportOptions& options, const Region& region) {
    if (region.grids.size() > 1)
        return refused("--to", *options.to,
                       "these data are " + std::to_string(region.grids.size()) +
                           " grids of posts, and only one can be written: name files of one of them");
    return {};
}

Result<void> export_gltf(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    ORO_CHECK(check_one_grid(options, region));
    ORO_TRY(const std::unique_ptr<RegionPages> pages,
            grid_pages(region.grids.front(), {}, 1.0,
                       [&](double share) { bar.show(share, "measuring levels"); }));
    bar.show(1.0, "choosing triangles");
    ORO_TRY(const GroundModel model, ground_model(*pages, options.max_error_m.value_or(0.0)));
    ORO_CHECK(region.health());
    const std::vector<std::uint8_t> bytes = model_glb_bytes(model, look_of(region));
    ORO_TRY(WholeFile file, WholeFile::create(options.out, options.overwrite));
    ORO_CHECK(file.write(bytes.data(), bytes.size()));
    ORO_CHECK(file.commit());
    bar.clear();
    say_notes(region, options.quiet);
    tell_model(options, region, model, bytes.size());
    return {};
}

}  // namespace oro
