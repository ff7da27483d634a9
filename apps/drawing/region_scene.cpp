#include "apps/drawing/region_scene.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "apps/drawing/clusters_of_region.h"
#include "apps/report/figures.h"
#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/cluster_frame/region_clusters.h"
#include "core/lod/data_means.h"
#include "core/lod/ground_means.h"
#include "core/made_pages/made_pages.h"
#include "core/seam/mesh_pages.h"
#include "core/terrain/drawn_heights.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/opening/made_world.h"
#include "geo/refined/refined_region.h"
#include "geo/together/baked_meshes.h"

namespace oro {
namespace {

// A baked grid's levels are those of its own heights; exaggerated ones, and those that its geoid was taken
// from, need levels of their own, and to measure these, all posts in memory.
Result<std::unique_ptr<RegionPages>> pages_of(const RegionGrid& grid, double exaggeration,
                                              const std::shared_ptr<const DataMeans>& means,
                                              const RenderProgress& progress, const std::stop_token& stop,
                                              const KnownPictures& pictures) {
    if (const MadePostSource* const made = made_posts_of(grid.field)) {
        if (exaggeration == 1.0) return made->pages(grid.field, pictures);
        return Error{
            ErrorKind::usage, "--exaggeration",
            "is not for made terrain whose posts are made where they are looked at; narrow the region "
            "with --bbox"};
    }
    if (!grid.file)
        return pages_beside_detail(grid.field, exaggeration, means, thread_count(), progress, stop);
    const bool own_geoid = grid.field.undulation.N_m.size() == grid.file->outline().undulation.N_m.size();
    if (own_geoid && exaggeration == 1.0) return pages_of_file(grid.file);
    ORO_TRY(HeightField field, field_in_memory(*grid.file));
    if (!own_geoid) {
        field.undulation = grid.field.undulation;
        field.N_of_posts_m = grid.field.N_of_posts_m;
    }
    return pages_in_memory(field, exaggeration, thread_count(), progress, stop);
}

// The field of a grid with its posts in memory.
Result<HeightField> posts_in_memory(const RegionGrid& grid) {
    HeightField field = grid.field;
    if (!grid.file) return field;
    ORO_TRY(const HeightField posts, field_in_memory(*grid.file));
    field.H_m = posts.H_m;
    field.posts = nullptr;
    field.range.reset();
    if (!field.undulation.N_m.empty()) field.N_of_posts_m = posts.N_of_posts_m;
    return field;
}

Result<std::unique_ptr<RegionPages>> pages_of_rest(const RegionGrid& grid, const GridClip& cut,
                                                   double exaggeration,
                                                   const std::shared_ptr<const DataMeans>& means,
                                                   const RenderProgress& progress,
                                                   const std::stop_token& stop) {
    ORO_TRY(HeightField rest, posts_in_memory(grid));
    for (std::size_t post = 0; post < cut.masked_posts.size(); ++post)
        if (cut.masked_posts[post] != 0) rest.H_m[post] = void_height_m;
    return pages_beside_detail(rest, exaggeration, means, thread_count(), progress, stop);
}

// Pages of a grid, as grid_pages() has them.
Result<std::unique_ptr<RegionPages>> pages_of_grid(const RegionGrid& grid, const GridClip& cut,
                                                   double exaggeration,
                                                   const std::shared_ptr<const DataMeans>& means,
                                                   const RenderProgress& progress,
                                                   const std::stop_token& stop,
                                                   const KnownPictures& pictures = {}) {
    const bool is_cut = std::ranges::find(cut.masked_posts, 1) != cut.masked_posts.end();
    ORO_TRY(std::unique_ptr<RegionPages> pages,
            is_cut ? pages_of_rest(grid, cut, exaggeration, means, progress, stop)
                   : pages_of(grid, exaggeration, means, progress, stop, pictures));
    if (!pages) return Error{ErrorKind::failed, "levels", "nobody waits for them any more"};
    if (!is_cut && pages->made_ground() == nullptr) pages->set_made_ground(made_ground_of(grid));
    if (!is_cut && pages->facts().triangles == 0)
        return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    return pages;
}

// Means of all posts of the data under invented ground; null where no ground is invented.
Result<std::shared_ptr<const DataMeans>> means_under_detail(const RegionGrid* data, double exaggeration) {
    if (data == nullptr) return std::shared_ptr<const DataMeans>();
    ORO_TRY(const HeightField field, posts_in_memory(*data));
    return std::make_shared<const DataMeans>(field.grid, drawn_heights(field, exaggeration, thread_count()),
                                             exaggeration);
}

std::uint64_t bytes_of(const std::optional<int>& mb) {
    return static_cast<std::uint64_t>(mb.value_or(0)) * 1000000U;
}

}  // namespace

Result<std::unique_ptr<RegionPages>> grid_pages(const RegionGrid& grid, const GridClip& cut,
                                                double exaggeration, const RenderProgress& progress,
                                                const std::stop_token& stop) {
    return pages_of_grid(grid, cut, exaggeration, {}, progress, stop);
}

Result<GridPages> make_grid_pages(const Region& region, const RegionCuts& cuts, double exaggeration,
                                  const RenderProgress& progress, const std::stop_token& stop,
                                  const KnownPictures& pictures) {
    const RegionGrid* const data = data_under_detail(region);
    ORO_TRY(const std::shared_ptr<const DataMeans> data_means, means_under_detail(data, exaggeration));
    GridPages pages;
    // Light on what stands on other ground is not known beforehand.
    const bool is_alone = region.grids.size() == 1 && !region.meshes;
    const KnownPictures known = is_alone || !pictures.light.any() ? pictures : KnownPictures{};
    for (const RegionGrid& grid : region.grids) {
        const std::size_t number = pages.size();
        ORO_TRY(std::unique_ptr<RegionPages> more,
                pages_of_grid(grid, cuts.grids[number], exaggeration, &grid == data ? data_means : nullptr,
                              number == 0 ? progress : RenderProgress{}, stop, known));
        pages.push_back(std::move(more));
    }
    return pages;
}

RegionPagesList pointers_to(const GridPages& pages) {
    std::vector<const RegionPages*> pointers;
    for (const std::unique_ptr<RegionPages>& one : pages) pointers.push_back(one.get());
    return RegionPagesList(std::move(pointers));
}

namespace {

// What takes the place of a scene's nodes. bytes: on the GPU.
Result<void> add_clusters(const Gpu& gpu, const RegionGrid& grid, std::uint64_t bytes,
                          std::uint64_t main_bytes, const std::optional<int>& level, Scene& scene) {
    ORO_TRY(std::unique_ptr<RegionClusters> clusters,
            clusters_of_region(grid, scene.grids().front().pages().facts().shape.occluder));
    ORO_TRY(ClusterScene made, ClusterScene::create(gpu, std::move(clusters), bytes, main_bytes));
    if (level) made.keep_to_level(static_cast<std::uint32_t>(*level));
    scene.draw_clusters(std::move(made));
    return {};
}

}  // namespace

Result<GridPages> pages_between(const Region& region, const RegionCuts& cuts, double exaggeration,
                                const std::vector<PlacedMesh>* meshes) {
    MeshesOfRegion whole;
    if (meshes == nullptr) {
        ORO_TRY(whole, whole_meshes(region));
        meshes = whole.get();
    }
    const Seam seam = seam_between(region, cuts, exaggeration, meshes);
    const HeightField& field = region.grids.front().field;
    return pages_beside(seam, field.undulation, region_shape(field, exaggeration));
}

Result<std::optional<Scene>> scene_between(const Gpu& gpu, GridPages pages,
                                           const std::shared_ptr<MemoryBudget>& shared) {
    std::optional<Scene> between;
    for (std::unique_ptr<RegionPages>& one : pages) {
        // What is between grids is small beside the rest, which it takes nothing from.
        SceneMemory memory;
        if (one->has_meshes()) memory.shared = shared;
        ORO_TRY(Scene made, Scene::create(gpu, std::move(one), memory));
        if (between)
            between->add(std::move(made));
        else
            between.emplace(std::move(made));
    }
    return between;
}

Result<RegionScene> scene_of_region(const Gpu& gpu, const Region& region, const RegionCuts& cuts,
                                    GridPages pages, const SceneRequest& request) {
    std::optional<Scene> scene;
    std::uint64_t triangles = 0;
    SceneMemory memory;
    // Clusters have half of either.
    const std::uint64_t parts = request.clusters ? 2 : 1;
    // ... and meshes that are read group by group half of main memory.
    const bool streams = region.meshes && std::ranges::any_of(*region.meshes, &PlacedMesh::streamed);
    memory.main = main_bytes(bytes_of(request.memory.memory_mb)) / parts / (streams ? 2 : 1);
    memory.shares = static_cast<unsigned>(pages.size());
    const std::uint64_t bytes = gpu_bytes(gpu, bytes_of(request.memory.gpu_memory_mb)) / parts;
    memory.shared = page_budget(gpu, bytes);
    for (std::unique_ptr<RegionPages>& one : pages) {
        triangles += one->facts().triangles;
        ORO_TRY(Scene made, Scene::create(gpu, std::move(one), memory, request.heights, request.means));
        if (scene)
            scene->add(std::move(made));
        else
            scene.emplace(std::move(made));
    }
    if (request.clusters)
        ORO_CHECK(add_clusters(gpu, region.grids.front(), bytes, memory.main, request.mesh_level, *scene));
    if (pages.size() > 1 || region.meshes) {
        ORO_TRY(GridPages beside, pages_between(region, cuts, request.exaggeration, request.meshes.get()));
        ORO_TRY(std::optional<Scene> between, scene_between(gpu, std::move(beside), memory.shared));
        if (between) {
            for (const GridScene& grid : between->grids()) triangles += grid.pages().facts().triangles;
            scene->add(std::move(*between));
        }
    }
    return RegionScene{std::move(*scene), triangles};
}

Result<void> redraw_meshes(const Gpu& gpu, const Region& region, const RegionCuts& cuts, double exaggeration,
                           const std::vector<PlacedMesh>& meshes, Scene& scene) {
    ORO_TRY(GridPages pages, pages_between(region, cuts, exaggeration, &meshes));
    ORO_TRY(std::optional<Scene> between,
            scene_between(gpu, std::move(pages), scene.grids().front().shared_memory()));
    scene.replace_between(std::move(between));
    return {};
}

Error lacks_gpu_memory(const Scene& scene, const std::string& what) {
    const GridScene& largest = *std::ranges::max_element(
        scene.grids(), {}, [](const GridScene& grid) { return grid.store().capacity(); });
    const auto& clusters = largest.clusters();
    const bool of_clusters = clusters && clusters->most_without_room() > 0;
    return {ErrorKind::failed, "--gpu-memory",
            "the GPU may hold " +
                (of_clusters ? std::to_string(clusters->store().capacity()) + " clusters"
                             : std::to_string(largest.store().capacity()) + " pages of terrain") +
                "; " + what + " needs more (a larger --tau needs fewer" +
                (clusters ? "; --mesh grid leaves all of the memory to blocks" : "") + ")"};
}

std::string note_of_missing_footprints(const gpu::FrameStyle& style, const RegionPagesList& grids) {
    if (!asks_for_means(style)) return "";
    for (std::size_t i = 0; i < grids.size(); ++i) {
        if (!grids[i].has_posts() || grids[i].knows_means()) continue;
        return std::string("note: ") + (grids.size() == 1 ? "the region" : "a grid of the region") + " has " +
               grouped(grids[i].facts().grid.post_count()) +
               " posts, too many to colour pixels by the mean of the ground that they cover: each has the "
               "colour of the ground in its middle";
    }
    return "";
}

}  // namespace oro
