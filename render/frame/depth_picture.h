// A view drawn with the depth of each pixel beside its colour: what is held against the truth.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/earth/camera.h"
#include "core/measure/drawn_point.h"
#include "core/measure/skyline_error.h"
#include "core/truth/picture_error.h"
#include "render/frame/frame_renderer.h"
#include "render/frame/settled_frame.h"
#include "render/scene/scene.h"

namespace oro {

struct DepthPictureOptions {
    double tau_px{1.0};  // 0: full resolution
    WorldModel model{};
    bool skyline{true};      // draw the samples that skylines are found in, too
    int largest_tile_px{0};  // 0: chosen from the device; tests make it small
};

// A picture of one sample a pixel, its depths, and what it took. Counts and times are those of the centres'
// sample, sums over its tiles.
struct DepthPicture {
    int width_px{};
    int height_px{};
    std::vector<std::uint8_t> rgba;  // sRGB
    std::vector<float> depths;       // reversed, at the pixels' centres; 0 for the background
    std::vector<DrawnPoint> points;  // what each pixel's centre shows
    std::array<std::vector<float>, skyline_samples> skyline_depths;  // empty without `skyline`
    FrameReport report;
    std::uint64_t page_bytes{};  // on the GPU, of the pages that the frames read
    bool settled{true};          // all that tau asks for was there
    int tiles{};

    [[nodiscard]] DrawnDepths centres() const { return {depths, {0.5, 0.5}}; }
    [[nodiscard]] std::vector<DrawnDepths> skylines() const;
};

// What each pixel of a tile shows, row by row: of the frame that `renderer` drew last, made with
// keep_triangles. Errors: those of the device.
Result<std::vector<DrawnPoint>> read_points(FrameRenderer& renderer, const Camera& camera, const Tile& tile);

// Draws such pictures, one after another; those of one size share what a renderer needs.
class DepthPainter {
  public:
    // occlusion: if it may leave out what other ground hides; `if_it_pays` goes by times, and so may count
    // differently when the same is drawn again.
    DepthPainter(const Gpu& gpu, RasterPath path, OcclusionUse occlusion = OcclusionUse::if_it_pays)
        : gpu_(&gpu), path_(path), occlusion_(occlusion) {}

    // The next picture is drawn as by a painter that has drawn nothing: it uses neither what earlier frames
    // saw nor tables of light and shadow that they made. Programs stay. Scene::forget_frames() does the same
    // for what is drawn.
    void forget_frames() { renderer_.reset(); }

    // A picture of the camera's size, in tiles where the device cannot hold it. Errors: those of the device
    // and of the scene's pages.
    Result<DepthPicture> draw(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                              const DepthPictureOptions& options);

  private:
    Result<void> prepare(VkExtent2D extent);
    Result<void> draw_tile(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                           const DepthPictureOptions& options, const Tile& tile, DepthPicture& picture);
    Result<SettledFrame> draw_sample(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                                     const DepthPictureOptions& options, const Tile& tile,
                                     DepthPicture& picture, std::vector<float>& depths);

    const Gpu* gpu_;
    RasterPath path_;
    OcclusionUse occlusion_;
    std::optional<FrameRenderer> renderer_;
};

}  // namespace oro
