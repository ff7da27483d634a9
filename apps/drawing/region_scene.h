// From a region that was read to one that can be drawn.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/options/options.h"
#include "core/frame/known_pictures.h"
#include "geo/region/region.h"
#include "geo/together/cut_regions.h"
#include "render/scene/scene.h"

namespace oro {

// Pages of a grid, with levels for that exaggeration, of what those that are the ground leave of it. stop: as
// pages_in_memory(). Errors: damage in a baked region; nothing to draw in a grid that nothing is cut out of
// (no_data); stopped.
Result<std::unique_ptr<RegionPages>> grid_pages(const RegionGrid& grid, const GridClip& cut,
                                                double exaggeration, const RenderProgress& progress = {},
                                                const std::stop_token& stop = {});
// Pages of all grids of a region, in their order. progress: of the first. stop: as grid_pages(). pictures:
// all that they are for; none: any. They may then cost less
// (MadePostSource::pages()).
using GridPages = std::vector<std::unique_ptr<RegionPages>>;
Result<GridPages> make_grid_pages(const Region& region, const RegionCuts& cuts, double exaggeration,
                                  const RenderProgress& progress = {}, const std::stop_token& stop = {},
                                  const KnownPictures& pictures = {});
RegionPagesList pointers_to(const GridPages& pages);

// A region with all its grids, ready for a GPU, and the triangles that it has at full resolution.
struct RegionScene {
    Scene scene;
    std::uint64_t triangles{};
};
struct SceneRequest {
    double exaggeration{1.0};
    MemoryOptions memory{};
    HeightStorage heights{HeightStorage::f32};
    bool means{};
    bool clusters{};                  // drawn by the region's clusters (draws_clusters())
    std::optional<int> mesh_level{};  // those of one level of the graph (View)
    // What is drawn in the place of the region's meshes; null: themselves.
    std::shared_ptr<const std::vector<PlacedMesh>> meshes{};
};
// pages: of all grids (make_grid_pages()). cuts: of all of them (cut_regions()). Errors: out of device
// memory.
Result<RegionScene> scene_of_region(const Gpu& gpu, const Region& region, const RegionCuts& cuts,
                                    GridPages pages, const SceneRequest& request);

// What is drawn beside the grids of a region, as pages: what is between them, then its meshes; none where
// there is nothing. meshes: what is drawn in the place of the region's, as many; null: themselves. For any
// thread. Errors: as pages_beside().
Result<GridPages> pages_between(const Region& region, const RegionCuts& cuts, double exaggeration,
                                const std::vector<PlacedMesh>* meshes);
// These as a scene, for Scene::add() and Scene::replace_between(); nothing of none. Meshes count in
// `shared`, where it is not null. Errors: out of device memory.
Result<std::optional<Scene>> scene_between(const Gpu& gpu, GridPages pages,
                                           const std::shared_ptr<MemoryBudget>& shared);

// Draws other meshes in the place of a region's, in a scene of scene_of_region() of which no frame is under
// way. meshes: as many as the region has. Errors: out of device memory.
Result<void> redraw_meshes(const Gpu& gpu, const Region& region, const RegionCuts& cuts, double exaggeration,
                           const std::vector<PlacedMesh>& meshes, Scene& scene);

// What is said where a scene's GPU memory is too small for what a picture shows. what: "this view".
Error lacks_gpu_memory(const Scene& scene, const std::string& what);

// What to tell of a style that asks for means of the ground over grids of which one has none, being of too
// many posts: each of its pixels then has the colour of the ground in its middle. "" where all have them.
std::string note_of_missing_footprints(const gpu::FrameStyle& style, const RegionPagesList& grids);

}  // namespace oro
