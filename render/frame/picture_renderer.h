// Pictures of any size: drawn in tiles that the device can hold, handed on row by row.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/earth/camera.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"

namespace oro {

struct PictureOptions {
    int samples{1};          // per pixel, 1..64, each at a place of its own
    int largest_tile_px{0};  // 0: chosen from the device; tests make it small
    RasterPath path{RasterPath::mesh};
    double tau_px{1.0};  // 0: full resolution
    WorldModel model{};
    bool keep_depths{false};                           // for PictureRenderer::depths()
    bool depths_of_growth{false};                      // as FrameRendererOptions::depths_of_growth
    bool counts_near_trees{false};                     // for PictureReport::near_tree_px
    gpu::uint show{};                                  // gpu::show_..., of pictures of one sample
    OcclusionUse occlusion{OcclusionUse::if_it_pays};  // the picture is the same
};

// What it took to draw a picture: times are sums over its tiles and samples, counts those of the first sample
// of each tile.
struct PictureReport {
    std::uint64_t meshlets_drawn{};
    std::uint64_t meshlets_beyond_frustum{};
    std::uint64_t meshlets_beyond_horizon{};
    std::uint64_t mesh_groups{};
    std::uint64_t triangles_drawn{};
    std::uint64_t ground_px{};     // pixels that show ground, in any of their samples
    std::uint64_t pages_drawn{};   // with a meshlet of the right level
    bool settled{true};            // all that tau asks for was there
    bool images_settled{true};     // all of the images over the ground that the picture can show was there
    std::uint32_t near_tree_px{};  // that show a tree near the eye, in their last samples
    double choose_s{};             // GPU timestamps, all samples
    double raster_s{};
    double shade_s{};
    std::uint64_t pages_beyond_frustum{};
    std::uint64_t pages_beyond_horizon{};
    int tiles{};
    RasterPath path{RasterPath::mesh};

    // Adds what a part of the picture took; the path is the part's.
    void add(const PictureReport& part);
};

// Takes the next row of the picture, width * 3 bytes of sRGB.
using RowSink = std::function<Result<void>(std::span<const std::uint8_t> rgb)>;

// Draws pictures of one size, one after another: what the GPU needs for them is made once.
//     ORO_TRY(PictureRenderer renderer, PictureRenderer::create(*gpu, cameras.front(), style, {}));
//     for (const Camera& camera : cameras) ORO_CHECK(renderer.draw(scene, camera, style, sink));
class PictureRenderer {
  public:
    // `camera` and `style`: of the size and the kind of all pictures. Errors: those of the device.
    static Result<PictureRenderer> create(const Gpu& gpu, const Camera& camera, const gpu::FrameStyle& style,
                                          const PictureOptions& options);
    // Draws a picture as render_picture() does.
    Result<PictureReport> draw(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                               const RowSink& sink, const RenderProgress& progress = {});
    // Draws a part of a picture: its pixels are those that draw() gives, to the bit, and cost no more than
    // they do there. The sink gets the part's rows, and depths() has the whole picture's, 0 outside the part.
    // part: its place and size in the camera's picture, within it.
    Result<PictureReport> draw_part(Scene& scene, const Camera& camera, const Tile& part,
                                    const gpu::FrameStyle& style, const RowSink& sink,
                                    const RenderProgress& progress = {});
    // With keep_depths, of the last picture: reversed depths of its pixels (of their last samples), row by
    // row; 0 for the sky.
    [[nodiscard]] const std::vector<float>& depths() const { return depths_; }

  private:
    Result<void> keep_depths(const Tile& drawn, const Tile& own, int picture_width);
    Result<std::uint32_t> near_tree_pixels(const Tile& drawn, const Tile& own);
    Result<std::vector<std::uint8_t>> read_own(const Tile& drawn, const Tile& own, int picture_width,
                                               PictureReport& report);
    PictureRenderer(const PictureOptions& options, FrameRenderer renderer)
        : options_(options), renderer_(std::move(renderer)) {}
    PictureOptions options_;
    FrameRenderer renderer_;
    std::vector<float> depths_;
};

// Draws what the camera sees and hands it on from the top row down. Errors: those of the device and of the
// sink.
Result<PictureReport> render_picture(const Gpu& gpu, Scene& scene, const Camera& camera,
                                     const gpu::FrameStyle& style, const PictureOptions& options,
                                     const RowSink& sink, const RenderProgress& progress = {});

// Largest tile that a picture of the camera's size is drawn in. largest_tile_px: 0, or less than the device
// can hold.
VkExtent2D tile_extent(const Gpu& gpu, const Camera& camera, int largest_tile_px);

// Where sample i of n goes through its pixel: the centre for n = 1, else a low-discrepancy pattern.
// Source: M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018 (R2 sequence).
glm::dvec2 sample_place(int index, int count);

}  // namespace oro
