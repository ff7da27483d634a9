#include "apps/output/picture_file.h"

#include <filesystem>

#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/fingerprints/fingerprints.h"
#include "apps/maps/labelled_map.h"
#include "apps/report/region_json.h"
#include "apps/view/view_paths.h"
#include "geo/pixels/picture_difference.h"

namespace oro {

PictureFiles picture_files(const std::string& picture) {
    const std::filesystem::path path(picture);
    const bool is_png = path.extension() == ".png";
    return {picture,
            (is_png ? std::filesystem::path(path).replace_extension() : path).string() + ".error.png",
            picture};
}

Geotags geotags_of(const View& view, const Region& region, const std::optional<SeenPlace>& middle) {
    const Camera& camera = view.camera;
    Geotags tags;
    tags.lat_deg = camera.eye.lat_deg;
    tags.lon_deg = camera.eye.lon_deg;
    tags.h_m = camera.eye.h_m;
    tags.N_m = region.grids.front().field.undulation.at_m(tags.lat_deg, tags.lon_deg);
    tags.H_m = tags.h_m - tags.N_m;
    tags.geoid = region.grids.front().geoid;
    tags.heading_deg = camera.attitude.heading_deg;
    tags.pitch_deg = camera.attitude.pitch_deg;
    tags.roll_deg = camera.attitude.roll_deg;
    tags.vertical_fov_deg = camera.vertical_fov_deg;
    tags.width_px = camera.width_px;
    tags.height_px = camera.height_px;
    tags.strip_px = view.legend_px;
    tags.time_utc_s = view.time_utc_s;
    if (middle)
        tags.destination =
            DestinationTag{middle->lat_deg, middle->lon_deg, middle->bearing_deg, middle->distance_m};
    tags.attribution = attribution_of(region);
    tags.software = "Orograph " OROGRAPH_VERSION;
    tags.view_json = view_to_json(view, false);
    return tags;
}

namespace {

// A map's rows, on their way to its file: what is transparent is white in a format without opacity, and black
// for fingerprints and comparisons, as it is when it is read again.
class MapRows {
  public:
    MapRows(const std::string& picture, PictureWriter& writer, PixelFingerprint& pixels, const RowSink& also)
        : channels_(static_cast<std::size_t>(map_channels(picture))),
          writer_(writer),
          pixels_(pixels),
          also_(also) {}

    Result<void> take(std::span<const std::uint8_t> rgba) {
        rgb_.clear();
        on_white_.clear();
        for (std::size_t at = 0; at < rgba.size(); at += 4) {
            for (std::size_t c = 0; c < 3; ++c) {
                rgb_.push_back(rgba[at + c]);
                on_white_.push_back(rgba[at + 3] == 0 ? 255 : rgba[at + c]);
            }
        }
        pixels_.add(rgb_);
        if (also_) ORO_CHECK(also_(rgb_));
        return writer_.write_row(channels_ == 4 ? rgba : std::span<const std::uint8_t>(on_white_));
    }

    // What stands below it, opaque.
    Result<void> take_strip(std::span<const std::uint8_t> rgb, int width_px) {
        std::vector<std::uint8_t> rgba;
        for (std::size_t at = 0; at < rgb.size(); at += 3) {
            rgba.insert(rgba.end(), {rgb[at], rgb[at + 1], rgb[at + 2], 255});
            if (rgba.size() < static_cast<std::size_t>(width_px) * 4) continue;
            ORO_CHECK(take(rgba));
            rgba.clear();
        }
        return {};
    }

  private:
    std::size_t channels_;
    PictureWriter& writer_;
    PixelFingerprint& pixels_;
    const RowSink& also_;
    std::vector<std::uint8_t> rgb_, on_white_;
};

}  // namespace

Result<void> check_drawn(const Gpu& gpu, Scene& scene, const PictureReport& report) {
    if (!gpu.validation_messages().empty())
        return Error{ErrorKind::failed, "Vulkan validation", gpu.validation_messages().front()};
    if (!report.settled) return lacks_gpu_memory(scene, "this view");
    if (!report.images_settled)
        return Error{ErrorKind::failed, "--gpu-memory",
                     "the GPU may hold " + std::to_string(scene.image_tiles_max()) +
                         " tiles of images; this view needs more (a smaller --size needs fewer)"};
    return {};
}

Result<DrawnPicture> draw_picture(const PictureFiles& files, bool overwrite, const View& view,
                                  const Region& region, const RegionGround& ground,
                                  const std::optional<SeenPlace>& middle, const Gpu& gpu, Scene& scene,
                                  const Style& style, std::span<const std::uint8_t> strip,
                                  const RenderProgress& progress, const RowSink& also) {
    // The eye and the tags come from heights that were asked for by now.
    ORO_CHECK(region.health());
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, gpu));
    // Drawn again another day, when auto may come to another answer, the view gives the same bytes.
    ORO_TRY(View drawn, view_as_written_in(view, files.paths_start_at));
    drawn.pipeline = name_of(path);
    if (drawn.fingerprints) {
        drawn.fingerprints->style = style_fingerprint(style);
        drawn.fingerprints->pixels = 0;  // until they are drawn
    }
    ORO_CHECK(check_view_opens(drawn, files.picture));
    const Geotags tags = geotags_of(drawn, region, middle);
    ORO_TRY(const std::unique_ptr<PictureWriter> writer,
            view.map ? create_map(files.picture, tags, *view.map, overwrite)
                     : create_picture(files.picture, tags, overwrite));
    PixelFingerprint pixels(view.camera.width_px, view.camera.height_px + view.legend_px);
    const auto take = [&](std::span<const std::uint8_t> rgb) -> Result<void> {
        pixels.add(rgb);
        if (also) ORO_CHECK(also(rgb));
        return writer->write_row(rgb);
    };
    LabelledPicture labelled;
    if (view.map) {
        MapRows rows(files.picture, *writer, pixels, also);
        ORO_TRY(LabelledMap map,
                draw_labelled_map(
                    gpu, scene, view, ground.ground(), style, path,
                    [&](std::span<const std::uint8_t> rgba) { return rows.take(rgba); }, progress));
        labelled.report = map.report;
        labelled.labels = std::move(map.labels);
        ORO_CHECK(rows.take_strip(strip, view.camera.width_px));
    } else {
        ORO_TRY(labelled, render_labelled(gpu, scene, view, ground.ground(), style, path, take, progress));
    }
    const PictureReport& report = labelled.report;
    const auto row_bytes = static_cast<std::size_t>(view.camera.width_px) * 3;
    for (std::size_t at = 0; !view.map && at < strip.size(); at += row_bytes)
        ORO_CHECK(take(strip.subspan(at, row_bytes)));
    ORO_CHECK(check_drawn(gpu, scene, report));
    ORO_TRY(WholeFile file, writer->finished_file());
    if (drawn.fingerprints) {
        drawn.fingerprints->pixels = pixels.value();
        ORO_CHECK(replace_in_view(file, files.picture, pixels_field(0), pixels_field(pixels.value())));
    }
    return DrawnPicture{
        report,          std::move(labelled.labels), std::move(labelled.names), std::move(labelled.overlay),
        std::move(file), drawn.fingerprints};
}

}  // namespace oro
