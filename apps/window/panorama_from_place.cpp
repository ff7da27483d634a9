#include "apps/window/panorama_from_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "apps/drawing/mesh_cut.h"
#include "apps/eye/standpoint.h"
#include "apps/report/json_text.h"
#include "apps/window/seen_around.h"

namespace oro {

Result<View> panorama_view(const View& shown, const PanoramaChoice& choice, const Region& region) {
    View view = shown;
    const Standing standing{"--at", at_text(choice.place), "--above", choice.above_m, 2.0, std::nullopt};
    ORO_TRY(const Standpoint stood, stand(standing, region, view.exaggeration));
    view.camera.eye = stood.eye;
    // A bundle of accuracy has its own air.
    if (choice.bends && view.model.air.k == 0.0 && view.accuracy.empty()) view.model.air = standard_air;
    view.panorama.reset();
    view.labels.reset();
    view.legend = false;
    view.recorded.reset();
    view.time_utc_s = time_now_s();
    aim_sun(view.sun, view.camera.eye);
    return view;
}

Result<DrawnPanorama> drawn_panorama(View view, const AskedFrame& asked, const Region& region,
                                     const RegionCuts& cuts, const PanoramaDrawing& drawing,
                                     const Progress& progress) {
    DrawnPanorama drawn;
    // view.mesh tells what is drawn from then on.
    if (const auto clusters = draws_terrain_clusters(region, view); !clusters.ok()) return clusters.error();
    progress(0.0, "looking around");
    ORO_TRY(const auto ground, RegionGround::of(region, cuts, view.exaggeration));
    ORO_TRY(drawn.leaves_out_near, set_frame(asked, ground->ground(), view));
    ORO_TRY(drawn.style, style_of_panorama(view, region));
    ORO_TRY(drawn.laid, lay_out(view, region, ground->ground()));
    if (drawing.stop.stop_requested()) return Error{ErrorKind::failed, "", "stopped"};
    ORO_TRY(drawn.scene, draw_panorama(view, region, cuts, ground->ground(), drawn.style, drawn.laid.around,
                                       drawing, progress));
    ORO_CHECK(
        give_rows(drawn.laid.sheet, drawn.scene, [&](std::span<const std::uint8_t> row) -> Result<void> {
            drawn.rgb.insert(drawn.rgb.end(), row.begin(), row.end());
            return {};
        }));
    drawn.view = std::move(view);
    return drawn;
}

Result<void> write_drawn_panorama(const std::string& path, const DrawnPanorama& drawn, const Region& region) {
    ORO_TRY(PanoramaFile written,
            write_panorama(path, false, drawn.view, region, drawn.style, drawn.laid, drawn.scene));
    return commit_together({&written.file});
}

namespace {

// From which pixel of a sheet to which one (left out) a window's pixel lies.
struct PixelRange {
    int from, to;
};
std::vector<PixelRange> ranges(double first_px, double scale, int count, int of_sheet) {
    std::vector<PixelRange> all;
    for (int i = 0; i < count; ++i) {
        const double from = first_px + i / scale, to = first_px + (i + 1) / scale;
        // Of a window's pixel within one of the sheet's: that one.
        const int low = static_cast<int>(std::floor(from + 1e-9));
        const int high = std::max(low + 1, static_cast<int>(std::floor(to + 1e-9)));
        all.push_back({std::clamp(low, 0, of_sheet), std::clamp(high, 0, of_sheet)});
    }
    return all;
}

}  // namespace

std::vector<std::uint8_t> pixels_of(const SheetPart& part, const std::vector<std::uint8_t>& rgb,
                                    int sheet_width_px, int sheet_height_px) {
    constexpr std::array<unsigned, 3> beside{24, 28, 32};
    const auto columns = ranges(part.left_px, part.scale, part.width_px, sheet_width_px);
    const auto rows = ranges(part.top_px, part.scale, part.height_px, sheet_height_px);
    std::vector<std::uint8_t> pixels;
    pixels.reserve(std::size_t{4} * columns.size() * rows.size());
    for (const PixelRange& down : rows) {
        for (const PixelRange& right : columns) {
            const auto count = static_cast<unsigned>((down.to - down.from) * (right.to - right.from));
            std::array<unsigned, 3> sum{};
            for (int y = down.from; y < down.to; ++y) {
                for (int x = right.from; x < right.to; ++x) {
                    const std::size_t at =
                        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sheet_width_px) +
                             static_cast<std::size_t>(x));
                    for (std::size_t k = 0; k < 3; ++k) sum[k] += rgb[at + k];
                }
            }
            for (std::size_t k = 0; k < 3; ++k)
                pixels.push_back(
                    static_cast<std::uint8_t>(count > 0 ? (sum[k] + count / 2) / count : beside[k]));
            pixels.push_back(255);
        }
    }
    return pixels;
}

}  // namespace oro
