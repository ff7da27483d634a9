#include "apps/maps/labelled_map.h"

#include <cstdint>
#include <deque>
#include <span>
#include <utility>

#include "apps/labels/labelled_picture.h"
#include "apps/text/inked_rows.h"
#include "apps/text/text_face.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

// The ground at nodes of a map. It goes on from each node to those beside it: nothing hides on a map.
Result<SeenHeights> heights_of_map(const View& view, const TrueGround& ground) {
    SeenHeights seen = no_heights(view.camera);
    ORO_TRY(MapPlaces places, MapPlaces::of(*view.map));
    const int step = seen.step_px;
    std::vector<std::optional<MapPlace>> row;
    for (int y = 0; y < seen.rows; ++y) {
        places.row(0.0, y * step, view.map->width_px, row);
        in_parallel(seen.columns, thread_count(), [&](int x) {
            const auto& place = row[static_cast<std::size_t>(x * step)];
            if (!place) return;
            const auto h_m = map_ground_h_m(ground, *place, view.sea == Sea::voids);
            if (!h_m) return;
            const double N_m = ground.N_m(place->lat_deg, place->lon_deg);
            seen.H_m[seen.at(x, y)] = static_cast<float>((*h_m - N_m) / ground.exaggeration());
            seen.far_m[seen.at(x, y)] = 1.0F;
        });
    }
    if (step == 1) smooth(seen);
    ORO_CHECK(ground.health());
    return seen;
}

// Takes a map's rows and hands them on with texts on them. What is transparent stays so, and is no colour
// that text could take from its surroundings.
class InkedMapRows {
  public:
    InkedMapRows(int width_px, int height_px, std::vector<InkedText> texts, const MapRowSink& sink)
        : sink_(sink),
          rows_(width_px, height_px, std::move(texts),
                [this](std::span<const std::uint8_t> rgb) { return hand_on(rgb); }) {}

    Result<void> take(std::span<const std::uint8_t> rgba) {
        std::vector<std::uint8_t> rgb, opacity;
        for (std::size_t at = 0; at < rgba.size(); at += 4) {
            const bool is_ground = rgba[at + 3] != 0;
            for (std::size_t c = 0; c < 3; ++c) rgb.push_back(is_ground ? rgba[at + c] : 255);
            opacity.push_back(rgba[at + 3]);
        }
        opacities_.push_back(std::move(opacity));
        return rows_.take(rgb);
    }

  private:
    Result<void> hand_on(std::span<const std::uint8_t> rgb) {
        const std::vector<std::uint8_t>& opacity = opacities_.front();
        std::vector<std::uint8_t> rgba;
        rgba.reserve(4 * opacity.size());
        for (std::size_t i = 0; i < opacity.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                rgba.push_back(opacity[i] != 0 ? rgb[3 * i + c] : std::uint8_t{0});
            rgba.push_back(opacity[i]);
        }
        opacities_.pop_front();
        return sink_(rgba);
    }

    const MapRowSink& sink_;
    InkedRows rows_;
    std::deque<std::vector<std::uint8_t>> opacities_;  // of rows that are not handed on yet
};

}  // namespace

Result<LabelledMap> draw_labelled_map(const Gpu& gpu, Scene& scene, const View& view,
                                      const TrueGround& ground, const Style& style, RasterPath path,
                                      const MapRowSink& sink, const RenderProgress& progress) {
    LabelledMap map;
    if (style.labels_px == 0.0) {
        ORO_TRY(map.report, draw_map(gpu, scene, view, ground, style, path, sink, progress));
        return map;
    }
    ORO_TRY(const SeenHeights seen, heights_of_map(view, ground));
    ORO_TRY(const TextFace face, TextFace::open());
    std::vector<InkedText> texts;
    ORO_TRY(map.labels, add_line_labels(face, seen, style, {}, texts));
    InkedMapRows rows(view.map->width_px, view.map->height_px, std::move(texts), sink);
    ORO_TRY(map.report, draw_map(
                            gpu, scene, view, ground, style, path,
                            [&](std::span<const std::uint8_t> rgba) { return rows.take(rgba); }, progress));
    return map;
}

}  // namespace oro
