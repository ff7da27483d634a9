#include "apps/panorama/panorama_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/eye/standpoint.h"
#include "apps/fingerprints/fingerprints.h"
#include "apps/names/names_in_view.h"
#include "apps/output/picture_file.h"
#include "apps/overlay/overlay_in_view.h"
#include "apps/report/region_json.h"
#include "apps/view/trees_of_view.h"
#include "apps/view/view_paths.h"
#include "core/base/parallel.h"
#include "geo/canopy/raised_region.h"
#include "geo/files/letter_case.h"
#include "geo/pictures/picture.h"
#include "geo/pixels/picture_difference.h"
#include "geo/refined/refined_region.h"
#include "shaders/shared_growth.h"

namespace oro {
namespace {

constexpr double smallest_em_px = 11.0;
constexpr double lines_in_scene = 26.0, ems_in_width = 150.0;
constexpr SheetColour paper{251, 250, 246};

std::string angle_words(double deg, int decimals, char positive, char negative) {
    char text[60];
    std::snprintf(text, sizeof text, "%.*f° %c", decimals, std::abs(deg), deg < 0.0 ? negative : positive);
    return text;
}

// "; ground between posts invented within 3 km"; "" where none is.
std::string detail_words_of(const Region& region) {
    const RegionGrid* const refined = detail_of(region);
    if (refined == nullptr) return "";
    char text[80];
    std::snprintf(text, sizeof text, "; ground between posts invented within %.3g km",
                  refined->detail->radius_km);
    return text;
}

// "Finsteraarhorn, 46.53722° N, 8.12611° E, 4276 m above sea level"; a canopy, invented trees, and ground
// that is invented between posts, are told, too.
std::string eye_words(const View& view, const Region& region, const std::string& standpoint) {
    const Geodetic& eye = view.camera.eye;
    const double H_m = eye.h_m - region.grids.front().field.undulation.at_m(eye.lat_deg, eye.lon_deg);
    char height[80];
    std::snprintf(height, sizeof height, ", %ld m above sea level", std::lround(H_m));
    return standpoint + (standpoint.empty() ? "" : ", ") + angle_words(eye.lat_deg, 5, 'N', 'S') + ", " +
           angle_words(eye.lon_deg, 5, 'E', 'W') + height +
           (!view.canopy                 ? ""
            : view.canopy->is_invented() ? "; canopy invented by class"
                                         : "; with canopy") +
           (view.trees.value_or(false) ? "; trees invented" : "") + detail_words_of(region);
}

std::string source_words(const Region& region) {
    const std::string attribution = attribution_of(region);
    return attribution + (attribution.empty() ? "" : "; ") + "Orograph";
}

// Lets rows of a whole picture go through text that stands on it.
Result<void> hand_on(std::span<const std::uint8_t> rgb, int width_px, InkedRows& rows) {
    const std::size_t row_bytes = std::size_t{3} * static_cast<std::size_t>(width_px);
    for (std::size_t at = 0; at < rgb.size(); at += row_bytes)
        ORO_CHECK(rows.take(rgb.subspan(at, row_bytes)));
    return {};
}

// The lines of --overlay on a tile's picture.
Result<void> draw_overlay(const View& view, const TrueGround& ground, const CylinderTile& tile,
                          std::vector<std::uint8_t>& rgb) {
    View of_tile = view;
    of_tile.camera = tile.camera;
    OverlayInView overlay = overlay_in_view(of_tile, ground, PointsInView(ground, tile.camera, view.model),
                                            CylinderCut{}.oversampling);
    std::vector<std::uint8_t> written;
    written.reserve(rgb.size());
    InkedRows rows(tile.camera.width_px, tile.camera.height_px, std::move(overlay.inked),
                   [&](std::span<const std::uint8_t> row) {
                       written.insert(written.end(), row.begin(), row.end());
                       return Result<void>();
                   });
    ORO_CHECK(hand_on(rgb, tile.camera.width_px, rows));
    rgb = std::move(written);
    return {};
}

Geotags panorama_tags(const View& view, const Region& region, const PanoramaSheet& laid) {
    Geotags tags = geotags_of(view, region, std::nullopt);
    tags.panorama = PanoramaTag{laid.around.sweep_deg, laid.sheet.scene_top_px + laid.around.above_px,
                                laid.sheet.scene_top_px, laid.sheet.scene_rows_px};
    return tags;
}

Result<PanoramaFile> write_svg(const std::string& path, bool overwrite, const View& view,
                               const Region& region, const PanoramaSheet& laid,
                               const CylinderPicture& scene) {
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    ORO_TRY(const std::string svg,
            sheet_svg(laid.sheet, scene.rgb, "Panorama from " + eye_words(view, region, laid.standpoint),
                      source_words(region)));
    ORO_CHECK(file.write(svg.data(), svg.size()));
    return PanoramaFile{std::move(file), view.fingerprints};
}

}  // namespace

Result<void> give_rows(const Sheet& sheet, const CylinderPicture& scene, const RowSink& sink) {
    ORO_TRY(const TextFace face, TextFace::open());
    ORO_TRY(std::vector<InkedText> texts, inked_texts(sheet, face));
    InkedRows written(sheet.width_px, sheet.height_px, std::move(texts), sink);
    InkedRows lined(sheet.width_px, sheet.height_px, inked_lines(sheet),
                    [&](std::span<const std::uint8_t> row) { return written.take(row); });
    std::vector<std::uint8_t> blank;
    for (int x = 0; x < sheet.width_px; ++x)
        blank.insert(blank.end(), sheet.paper.begin(), sheet.paper.end());
    for (int y = 0; y < sheet.scene_top_px; ++y) ORO_CHECK(lined.take(blank));
    ORO_CHECK(hand_on(scene.rgb, sheet.width_px, lined));
    for (int y = sheet.scene_top_px + sheet.scene_rows_px; y < sheet.height_px; ++y)
        ORO_CHECK(lined.take(blank));
    return {};
}

bool is_svg(const std::string& path) {
    return lower_case(path).ends_with(".svg");
}

Cylinder cylinder_of(const View& view) {
    const PanoramaFrame& frame = *view.panorama;
    return cylinder_around(frame.from_deg, frame.sweep_deg, frame.low_deg, frame.high_deg,
                           view.camera.width_px);
}

CylinderCut cut_of(const Style& style) {
    CylinderCut cut;
    cut.with_forests = (style.frame.materials.on & gpu::materials_with_trees) != 0;
    return cut;
}

double panorama_em_px(const Cylinder& around) {
    return std::max(smallest_em_px,
                    std::min(around.height_px() / lines_in_scene, around.width_px / ems_in_width));
}

Result<PanoramaSheet> lay_out(const View& view, const Region& region, const TrueGround& ground) {
    PanoramaSheet laid;
    laid.around = cylinder_of(view);
    ORO_TRY(const TextFace face, TextFace::open());
    const double em_px = panorama_em_px(laid.around);
    laid.rulers = rulers_of(laid.around, em_px);
    laid.names.em_px = em_px;
    if (view.vectors_read) {
        PointsInView in_view(ground, view.camera, view.model, laid.around);
        if (view.canopy)
            in_view.count_from_below_canopy([&](const Geodetic& place) {
                const RegionGrid& grid = grid_at(region, place.lat_deg, place.lon_deg);
                return canopy_over_ground_m(grid, place.lat_deg, place.lon_deg).value_or(0.0);
            });
        const std::vector<NamedPoint> points = points_of(view);
        ORO_TRY(laid.names, panorama_names(points, in_view, laid.around, face, em_px));
        ORO_TRY(laid.standpoint, standpoint_name(points, view.camera.eye, face));
    }
    Sheet& sheet = laid.sheet;
    sheet.paper = paper;
    sheet.width_px = laid.around.width_px;
    sheet.scene_top_px = static_cast<int>(std::ceil(laid.names.row_px));
    sheet.scene_rows_px = laid.around.height_px();
    sheet.height_px = sheet.scene_top_px + sheet.scene_rows_px + laid.rulers.strip_px();
    ORO_CHECK(put_rulers(laid.rulers, laid.around, face, eye_words(view, region, laid.standpoint),
                         source_words(region), sheet));
    laid.names.put_on(sheet);
    // What could not be read counts as void: sight lines went through it.
    ORO_CHECK(region.health());
    return laid;
}

Result<CylinderPicture> draw_scene(const View& view, const Region& region, const TrueGround& ground,
                                   const Cylinder& around, const Gpu& gpu, Scene& scene, const Style& style,
                                   const RenderProgress& progress, const std::stop_token& stop) {
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, gpu));
    CylinderExtras extras;
    extras.ridges = view.panorama->ridges;
    const bool has_overlay = view.vectors_read && !view.vectors_read->overlay.empty();
    if (has_overlay || stop.stop_possible())
        extras.over = [&](const CylinderTile& tile, std::vector<std::uint8_t>& rgb) -> Result<void> {
            if (stop.stop_requested()) return Error{ErrorKind::failed, "", "stopped"};
            return has_overlay ? draw_overlay(view, ground, tile, rgb) : Result<void>();
        };
    PictureOptions options = picture_options(view, path);
    options.counts_near_trees = may_stand_among_trees(view, ground, style);
    ORO_TRY(CylinderPicture picture, render_cylinder(gpu, scene, view.camera.eye, around, cut_of(style),
                                                     style.frame, options, extras, progress));
    if (!gpu.validation_messages().empty())
        return Error{ErrorKind::failed, "Vulkan validation", gpu.validation_messages().front()};
    if (!picture.report.settled) return lacks_gpu_memory(scene, "this panorama");
    if (!picture.report.images_settled)
        return Error{ErrorKind::failed, "--gpu-memory",
                     "the GPU may hold " + std::to_string(scene.image_tiles_max()) +
                         " tiles of images; this panorama needs more (a smaller --width needs fewer)"};
    ORO_CHECK(region.health());
    return picture;
}

Result<PanoramaFile> write_panorama(const std::string& path, bool overwrite, const View& view,
                                    const Region& region, const Style& style, const PanoramaSheet& laid,
                                    const CylinderPicture& scene) {
    if (is_svg(path)) return write_svg(path, overwrite, view, region, laid, scene);
    ORO_TRY(View drawn, view_as_written_in(view, path));
    drawn.camera.height_px = laid.sheet.height_px;
    drawn.pipeline = name_of(scene.report.path);
    if (drawn.fingerprints) {
        drawn.fingerprints->style = style_fingerprint(style);
        drawn.fingerprints->pixels = 0;  // until they are drawn
    }
    ORO_CHECK(check_view_opens(drawn, path));
    ORO_TRY(const std::unique_ptr<PictureWriter> writer,
            create_picture(path, panorama_tags(drawn, region, laid), overwrite));
    PixelFingerprint pixels(laid.sheet.width_px, laid.sheet.height_px);
    ORO_CHECK(give_rows(laid.sheet, scene, [&](std::span<const std::uint8_t> rgb) {
        pixels.add(rgb);
        return writer->write_row(rgb);
    }));
    ORO_TRY(WholeFile file, writer->finished_file());
    if (drawn.fingerprints) {
        drawn.fingerprints->pixels = pixels.value();
        ORO_CHECK(replace_in_view(file, path, pixels_field(0), pixels_field(pixels.value())));
    }
    return PanoramaFile{std::move(file), drawn.fingerprints};
}

}  // namespace oro
