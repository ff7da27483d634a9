// One frame: pages to ids and depth, ids to colours. The same path for pictures, the window and benchmarks.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/measure/drawn_point.h"
#include "render/device/pass_times.h"
#include "render/device/resources.h"
#include "render/frame/grid_frame.h"
#include "render/pipelines/choice_pass.h"
#include "render/pipelines/pipelines.h"
#include "render/pipelines/plan_pass.h"
#include "render/raster/compute_raster.h"
#include "render/raster/occlusion.h"
#include "render/shading/air_tables.h"
#include "render/shading/mesh_shadows.h"

namespace oro {

// What a frame did and how long the GPU took for it.
struct FrameReport {
    gpu::FrameCounts counts{};
    std::uint64_t pages{};         // of the frame, parents of drawn ones included
    double choose_s{};             // GPU timestamps: levels chosen
    double raster_s{};             // from pages to triangle ids, by either path
    double shade_s{};              // the shading pass
    std::vector<PassTime> passes;  // of shading, with time_passes
    bool images_settled{true};     // images over the ground are as fine as the frame asks for
    std::vector<FrameFeedback>
        feedback;  // of each grid, for Scene::apply_feedback(); none where it was drawn at once
    [[nodiscard]] double gpu_s() const { return choose_s + raster_s + shade_s; }
};

struct FrameRendererOptions {
    VkExtent2D extent{};           // largest tile, at most the device's limit
    bool several_samples{false};   // will be asked for sample_count > 1
    bool record_positions{false};  // mesh path only
    bool record_view{false};       // with record_positions: positions in view coordinates, as they are drawn
    bool smooth_edges{false};      // of pictures of one sample, see shaders/shade/edges.comp
    bool keep_depths{false};       // for read_depths(); without trees and grass,
    bool depths_of_growth{false};  // ... unless this, too: then their depths are below 0
    bool keep_triangles{false};    // for read_triangles()
    bool shades{true};             // false: there is nothing to be read but triangles; for times, too
    gpu::uint show{};              // gpu::show_...: what explains a frame of one sample, not its colours
    bool waits_for_images{true};   // false: a frame is drawn with what of them is there
    OcclusionUse occlusion{OcclusionUse::if_it_pays};  // without record_positions
    // Mesh path: triangles that cover no pixel's centre are not drawn; the ids are the same.
    bool leave_out_small{false};
    MeshletSplit split{MeshletSplit::by_device};  // mesh path; the ids are the same
    // Compute path: triangles are shared between invocations as on a GPU, also where a processor draws
    // (tests); the ids are the same.
    bool shares_triangles{false};
    // What a GPU shades and casts by several programs they do where a processor draws, too (tests); the
    // picture is the same.
    bool as_on_gpu{false};
    ListRoom list_room{};         // compute path: fewer than there are, for tests of full lists
    bool time_passes{false};      // for FrameReport::passes
    bool nearest_pyramid{false};  // wrong occlusion, for the test that notices it
    RasterPath path{RasterPath::mesh};
};

// Turns a plan into pixels, by either way of drawing, and reads them back.
//     FrameRendererOptions options;
//     options.extent = {320, 240};
//     ORO_TRY(FrameRenderer renderer, FrameRenderer::create(*gpu, options));
//     ORO_TRY(const FrameReport report, renderer.draw(std::move(plan), style));
//     ORO_TRY(const std::vector<std::uint8_t> rgba, renderer.read_picture(320, 240));
class FrameRenderer {
  public:
    static Result<FrameRenderer> create(const Gpu& gpu, const FrameRendererOptions& options);

    // Takes another size of picture. No frame is under way, and nobody on the device reads the picture.
    Result<void> resize(VkExtent2D extent);

    // Draws one sample of a plan (its tile is within the extent, its pages are on the GPU) and waits for it.
    // With sample_count > 1 the picture is complete after the last sample_index. Same plan, pages and style:
    // same bytes, on one driver. drapes: images over the ground of each grid, or null (Scene::drapes()).
    Result<FrameReport> draw(FramePlan plan, const gpu::FrameStyle& style, std::uint32_t sample_index = 0,
                             std::uint32_t sample_count = 1, std::vector<DrapeStore*> drapes = {});

    // From the next frame on only a part of a frame's picture is coloured: what it shows there is the same to
    // the bit, and the rest means nothing, nor do its depths. Places and sizes in pixels of the frame's own
    // picture; trees and shadows are still looked for everywhere. Nothing: all of it.
    void colour_only(const std::optional<VkRect2D>& part) { part_ = part; }

    // The next frames with trees are tiles of a picture of that size, until end_tiled_picture(): their water
    // mirrors what tiles show that were drawn before (core/frame/tile_order.h). Errors: out of device memory.
    Result<void> begin_tiled_picture(VkExtent2D size_px);
    // Which part of the next frames no other tile draws, in the frame: that is kept for the tiles after it.
    void keep_for_tiles(const VkRect2D& own);
    void end_tiled_picture() { tiled_ = {}; }

    // Several frames under way: submit() begins one of one sample as draw() does and does not wait for it;
    // finish() waits for the one that was begun first. At most frames_in_flight may be under way, and none
    // where draw() or what reads a picture is called. All that is submitted to the device afterwards sees the
    // picture. Images over the ground are drawn as they are there; finish() brings what of them the frame
    // lacked to the next one. The air may be that of an eye nearby (AirTables::prepare()). Errors of both:
    // those of draw().
    Result<void> submit(FramePlan plan, const gpu::FrameStyle& style, std::vector<DrapeStore*> drapes = {});
    Result<FrameReport> finish();
    [[nodiscard]] std::size_t under_way() const { return under_way_.size(); }
    // Makes the programs by which the device chooses pages (Scene::choose_on_device()): the first frame that
    // has them would wait for them. Errors: the device.
    Result<void> prepare_choice();

    // The picture's top left width x height pixels as RGBA rows, sRGB.
    Result<std::vector<std::uint8_t>> read_picture(std::uint32_t width, std::uint32_t height);
    // Puts rows as read_picture() gives them, four bytes a pixel, where the frame's own were. For what is
    // written over a picture before a window shows it.
    Result<void> replace_picture(std::span<const std::uint8_t> rgba, std::uint32_t width,
                                 std::uint32_t height);
    // Triangle ids of the last frame, which was that large (for tests and picking).
    Result<std::vector<std::uint32_t>> read_ids(std::uint32_t width, std::uint32_t height);
    // With keep_depths: reversed depth of each of its pixels at the centre, from the triangle seen there; 0
    // for the background.
    Result<std::vector<float>> read_depths(std::uint32_t width, std::uint32_t height);
    // Whether each pixel of the last frame, which was that large, shows a tree near its eye
    // (core/growth/near_trees.h): 1 or 0. Nothing is read where the frame had no trees.
    Result<std::vector<std::uint8_t>> read_near_trees(std::uint32_t width, std::uint32_t height);
    // With keep_triangles: what each pixel of some of its rows shows, row by row. first_row: a multiple of
    // triangle_rows(), which is the most that are read at a time.
    Result<std::vector<ShownTriangle>> read_triangles(std::uint32_t first_row, std::uint32_t rows);
    [[nodiscard]] std::uint32_t triangle_rows() const;
    // Gives 256 x 4 bits for each page of the last frame: the edges (shaders/choose/levels.glsl) of the nodes
    // that were drawn.
    Result<std::vector<std::uint32_t>> read_edges(std::size_t pages);
    // Gives 256 bits for each page: the nodes that may stand for what they cover.
    Result<std::vector<std::uint32_t>> read_accepted(std::size_t pages);
    // Gives cluster_... bits for each cluster that the last frame was offered (shaders/shared_clusters.h).
    Result<std::vector<std::uint32_t>> read_cluster_states(std::size_t clusters);
    // The tables of the air (shaders/shared.h, AirModel) of the last frame, as floats; its style had air.
    Result<std::vector<float>> read_air();
    // With record_positions: of every page of the last frame, 129 x 129 positions relative to the eye, in its
    // meridian frame (with record_view in view coordinates), as the mesh shader placed them (those of void
    // posts, and of posts that are not drawn, mean nothing). The first `most` of them.
    [[nodiscard]] std::vector<gpu::vec3> recorded(std::size_t most = SIZE_MAX) const;

    // What the device had of the plan of a grid of the last frame: its pages, its rows and its columns of
    // posts as words, addresses apart (for tests of what a plan leaves to it).
    struct PlannedWords {
        std::vector<std::uint32_t> pages, rows, columns;
    };
    Result<PlannedWords> read_plan(std::size_t grid);

    [[nodiscard]] bool needs_depths() const { return options_.keep_depths || options_.smooth_edges; }
    [[nodiscard]] const Image& picture() const { return picture_; }
    // Gives the picture away; resize() makes another, and nothing may be drawn before.
    [[nodiscard]] Image release_picture() { return std::exchange(picture_, Image{}); }
    [[nodiscard]] VkExtent2D extent() const { return options_.extent; }

  private:
    explicit FrameRenderer(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> create_images();
    Result<void> create_sets();
    Result<void> choose_pipelines(const FramePlan& plan);
    Result<void> reserve(const FramePlan& plan);
    // What a frame is asked for besides its plan.
    struct FrameAsked {
        const gpu::FrameStyle& style;
        std::uint32_t sample_index, sample_count;
        std::span<DrapeStore* const> drapes;
        bool in_parts;   // images over the ground are waited for before it is shaded
        bool exact_air;  // AirTables::prepare()
    };
    // What a frame has for itself while others are under way.
    struct Slot {
        Buffer counts_read;  // for the host
        OwnedQueryPool timestamps;
        std::unique_ptr<PassTimes> passes;  // with time_passes
        std::optional<FramePlan> plan;
        Occlusion::Trial trial;
        bool has_images{}, in_parts{};
        Commands commands;  // last: what is under way ends before the rest goes
    };
    Result<void> create_slot(Slot& slot) const;
    Result<void> begin(FramePlan plan, const FrameAsked& asked);
    Result<FrameReport> report_of(Slot& slot);
    Result<void> add_times(const Slot& slot, FrameReport& report);
    // Of the frame that is being recorded.
    void end_pass(VkCommandBuffer commands, const char* name) const;
    // For what is recorded while no frame is under way.
    [[nodiscard]] Commands& commands() { return slots_.front().commands; }
    Result<void> upload(std::size_t number, GridPlan& plan, const FrameAsked& asked);
    Result<void> add_triangles(std::uint32_t grid, std::uint32_t first_row, std::uint32_t rows,
                               std::vector<ShownTriangle>& shown);
    Result<std::vector<std::uint32_t>> read_words(const Buffer& buffer, VkDeviceSize first,
                                                  std::size_t count);
    void record(VkCommandBuffer commands, const Slot& slot);
    void record_upload(VkCommandBuffer commands, std::size_t grids) const;
    Result<void> prepare_device_plans(const FramePlan& plan);
    void record_device_plans(VkCommandBuffer commands, const FramePlan& plan) const;
    void record_clear(VkCommandBuffer commands, const FramePlan& plan) const;
    void record_choice(VkCommandBuffer commands, const GridFrame& grid, const GridPlan& plan) const;
    void record_rounds(VkCommandBuffer commands, const FramePlan& plan) const;
    void record_round(VkCommandBuffer commands, const FramePlan& plan, std::size_t number) const;
    void record_pyramid(VkCommandBuffer commands, const FramePlan& plan) const;
    void push(VkCommandBuffer commands, const gpu::FrameRound& round) const;
    void record_raster(VkCommandBuffer commands, const FramePlan& plan, std::size_t number) const;
    void record_round_choice(VkCommandBuffer commands, const GridFrame& grid, const ClusterPlan& clusters,
                             bool first) const;
    void record_meshes(VkCommandBuffer commands, std::size_t grid, bool ties) const;
    [[nodiscard]] bool remembers(const FramePlan& plan) const;
    void remember(const FramePlan& plan);
    Result<void> choose_shading(GridFrame& grid, gpu::FrameConstants& constants);
    [[nodiscard]] bool has_images(const FramePlan& plan) const;
    void record_casters(VkCommandBuffer commands, const FramePlan& plan);
    void record_shade(VkCommandBuffer commands, const FramePlan& plan);
    [[nodiscard]] bool draws_growth() const;
    [[nodiscard]] bool has_growth(const FramePlan& plan) const;
    Result<void> reserve_growth(const FramePlan& plan);
    Result<void> choose_growth(GridFrame& grid, const GridPlan& plan);
    void record_growth(VkCommandBuffer commands, const FramePlan& plan) const;
    enum class GrowthPass { raise, shade, mirror, keep, smooth };
    void record_growth_pixels(VkCommandBuffer commands, const FramePlan& plan, GrowthPass pass) const;
    void record_show(VkCommandBuffer commands, const FramePlan& plan) const;
    void dispatch_pixels(VkCommandBuffer commands, const FramePlan& plan) const;
    void record_ids_alone(VkCommandBuffer commands) const;
    void record_tile_feedback(VkCommandBuffer commands, const FramePlan& plan) const;
    Result<void> ask_again(const GridFrame& grid, const GridPlan& plan, std::uint32_t seed);
    Result<bool> load_requested_tiles(const GridFrame& grid, const GridPlan& plan, const Slot& slot);
    Result<bool> load_images(const Slot& slot);
    Result<void> shade_with_images(Slot& slot);
    Result<std::vector<std::byte>> read_image(const Image& image, VkImageAspectFlags aspect,
                                              ImageUse last_use, std::uint32_t width, std::uint32_t height);

    const Gpu* gpu_;
    FrameRendererOptions options_;
    std::shared_ptr<Pipelines> pipelines_;
    VkPipeline edges_{VK_NULL_HANDLE};  // of the frame
    std::vector<GridFrame> grids_;      // those of the plan, and as many more as earlier ones had
    std::optional<ComputeRaster> compute_;
    std::optional<Occlusion> occlusion_;
    std::optional<ChoicePass> choice_pass_;  // likewise
    std::optional<PlanPass> plan_pass_;      // once a plan leaves anything to it
    AirTables air_;
    SharedShares shared_shares_;
    MeshShadowFrame mesh_shadows_;
    Image ids_, depth_, sum_, picture_;
    Buffer depths_;
    Buffer tiles_in_parts_;
    Buffer visibility_;          // mesh path: FrameConstants::visibility of frames with trees
    Buffer canopy_;              // GrowthTable::canopy
    Buffer kept_picture_;        // TiledPicture::pixels
    gpu::TiledPicture tiled_{};  // all zero: frames are pictures of their own
    Buffer overdraw_;            // FrameConstants::overdraw, where it is shown
    Buffer triangles_;
    Buffer counts_;  // on the device
    Buffer recorded_;
    std::uint32_t last_width_px_{};
    std::optional<VkRect2D> part_;              // colour_only()
    std::vector<char> last_grids_;              // of the last frame: 1 where a grid had pages in it
    std::size_t slot_{};                        // of the frame that is being begun
    std::vector<std::size_t> under_way_;        // slots of frames, in their order
    std::array<Slot, frames_in_flight> slots_;  // last: frames end before what they use
};

}  // namespace oro
