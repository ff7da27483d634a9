// The programs that a frame runs: rasterise meshlets into ids and depth, shade pixels.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include "render/device/gpu.h"
#include "shaders/shared.h"

namespace oro {

inline constexpr std::uint32_t depth_binding = 4;
inline constexpr VkFormat id_format = VK_FORMAT_R32_UINT;
inline constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat sum_format = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat picture_format_vk = VK_FORMAT_R8G8B8A8_UNORM;

// What a mesh workgroup draws at a time: as many whole meshlets as it has room for, or half of one. The
// triangle ids are the same.
enum class MeshletSplit { by_device, whole, halves };
// What a device draws where so much is asked: halves only where it has mesh_ballots, of itself where its
// subgroups have 32 besides. Never by_device.
MeshletSplit meshlet_split_for(MeshletSplit request, const DeviceReport& device);

// How many entries the compute path's lists take in a frame, of those that their buffers hold
// (shaders/shared.h: boxes_max and so on). Fewer in tests of full lists only.
struct ListRoom {
    std::uint32_t boxes{gpu::boxes_max};
    std::uint32_t large{gpu::large_max};
    std::uint32_t tasks{gpu::tasks_max};
    std::uint32_t clips{gpu::clips_max};
    auto operator<=>(const ListRoom&) const = default;
};

// What the shading pass has to do: each of these is code of its own, so that a picture pays for what it shows
// alone.
struct ShadingKind {
    bool as_map{};        // the style is more than tints by height in sunlight and haze
    bool in_air{};        // it has air that light goes through
    bool casts{};         // terrain casts shadows
    bool opens{};         // the sky's light is that of the part of the sky that is seen
    bool draped{};        // images lie over the ground
    bool by_means{};      // pixels are coloured by what FrameStyle.footprint says
    bool edges_follow{};  // the picture is left to `edges`
    bool parts_follow{};  // pixels whose footprint has several parts are left to a program of their own,
    bool parts_alone{};   // which this is
    bool on_net{};        // the region's posts lie on a net
    bool of_materials{};  // materials colour the ground (FrameStyle.materials)
    bool on_clusters{};   // clusters are drawn, not nodes of pages
    auto operator<=>(const ShadingKind&) const = default;
};

struct Pipelines {
    bool packed_heights{};  // as PipelineWants
    bool meshes{};          // likewise
    ListRoom list_room;
    // 0 ids, 1 sum, 2 picture: storage images of the shading pass; 3 FrameConstants; depth_binding: the mesh
    // path's depth, sampled
    OwnedSetLayout set;
    OwnedPipelineLayout layout;            // that set, and a FrameRound pushed
    VkShaderStageFlags round_stages{};     // ... to these
    OwnedPipeline lod_test, live_pages;    // levels chosen, in this order
    OwnedPipeline cull, cull_second_pass;  // of what is drawn: in the first round, in the others
    OwnedPipeline pyramid;                 // of the farthest depths, 64 x 64 pixels a workgroup
    OwnedPipeline terrain;                 // mesh path: task, mesh, fragment
    OwnedPipeline terrain_ties;            // ... and what is as near as what is there, with lower ids
    std::uint32_t meshlets_per_task{1};
    // Compute path, in this order.
    std::int32_t alone_max_px{};  // of the largest box of pixels that an invocation draws by itself
    OwnedPipeline raster_clear, raster, raster_clip, raster_boxes, raster_large;
    std::map<ShadingKind, OwnedPipeline> shades;  // compute, 8 x 8; see shading_for
    std::array<OwnedPipeline, 4> edges;  // without and with air, then both of clusters, 8 x 8; see edges_for
    std::array<OwnedPipeline, 2>
        texture_tile_feedback;               // what tiles of images are wanted (then of clusters), 8 x 8
    std::array<OwnedPipeline, 6> air;        // its tables, in this order, 64 entries a workgroup
    OwnedPipeline caster_heights, openness;  // of what casts shadows
    // Off and on a net, of clusters; of each by what it does (shares.comp), 16 x 16 pixels or 64 of a list.
    std::array<std::array<OwnedPipeline, 5>, 3> sun_shares;
    // Of frames of several grids, off and on a net: where pixels' ground is, 8 x 8; as sun_shares; 8 x 8.
    std::array<OwnedPipeline, 2> cast_places;
    std::array<std::array<OwnedPipeline, 5>, 2> joined_shares;
    OwnedPipeline join_shares;
    OwnedPipeline mesh_shares;  // past meshes, 8 x 8
    OwnedPipeline triangles;    // what each pixel shows, compute, 8 x 8
    OwnedPipeline show;         // colours by what draws a pixel, compute, 8 x 8
    // Of frames that draw clusters: see add_cluster_pipelines().
    OwnedPipeline choose_clusters, choose_clusters_second_pass;  // in the first round, in the others
    OwnedPipeline cluster_terrain, cluster_ties;                 // mesh path: mesh, fragment; as terrain_ties
    OwnedPipeline cluster_raster, cluster_clip;                  // compute path; then raster_large
    OwnedPipeline cluster_triangles;
    // Of frames with trees (render/growth): what stands on sites and what colours it, by what they ask for;
    // what draws them and softens their outlines; mesh path: copies of its images before that, and back.
    std::map<std::size_t, std::array<OwnedPipeline, 2>> growth;
    OwnedPipeline list_sites, draw_crowns, sort_pieces, draw_large_crowns, draw_shade_map, farthest_depths,
        smooth_crowns;
    OwnedPipeline seed_visibility, keep_ids;
    // Forests farther than their trees, and what water mirrors; by edges_follow. What tiles keep for others.
    std::array<OwnedPipeline, 2> raise_canopy, mirror_in_water;
    OwnedPipeline keep_for_tiles;
    // Of frames with grass, likewise; shade_meadow by edges_follow.
    std::map<std::size_t, OwnedPipeline> grow_meadow;
    OwnedPipeline draw_meadow, smooth_meadow;
    std::array<OwnedPipeline, 2> shade_meadow;
};

// What a renderer is asked for besides triangle ids.
struct PipelineWants {
    bool record_positions{false};  // the mesh shader writes each placed post to FrameConstants.recorded
    bool triangles{false};         // `triangles` is there
    bool show{false};              // `show` is there
    bool leave_out_small{false};   // mesh path: triangles that cover no pixel's centre are not drawn
    bool overdraw{false};          // triangles are counted into FrameConstants.overdraw
    // Compute path: invocations share triangles as on a GPU, also where a processor draws (tests only).
    bool shares_triangles{false};
    bool packed_heights{false};  // pages may have packed heights: their code would cost others registers
    bool meshes{false};          // likewise: pages may be those of meshes (core/seam/mesh_pages.h)
    ListRoom list_room{};        // compute path: fewer in tests only
    MeshletSplit split{MeshletSplit::by_device};  // mesh path: what a workgroup draws at a time
};

// Made once and kept until the device ends, with all that has been added since: drivers take longer to make
// them than to draw a small picture. Sizes of workgroups follow the device's preferred limits.
Result<std::shared_ptr<Pipelines>> shared_pipelines(const Gpu& gpu, RasterPath path,
                                                    const PipelineWants& wants);
// Those that draw clusters, as far as they are not there. triangles: as PipelineWants.
Result<void> add_cluster_pipelines(const Gpu& gpu, RasterPath path, bool triangles, Pipelines& pipelines);
// One that needs the set alone. `flags`: VK_PIPELINE_CREATE_...
Result<OwnedPipeline> create_compute_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                              std::span<const std::uint32_t> words, const char* name,
                                              const VkSpecializationInfo* constants = nullptr,
                                              VkPipelineCreateFlags flags = 0);

}  // namespace oro
