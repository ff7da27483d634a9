#include "apps/bench/times/bench_region.h"

#include "apps/bench/times/bench_random.h"
#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/cluster_frame/region_clusters.h"
#include "core/lod/ground_means.h"

namespace oro {

Result<BenchRegion> open_bench_region(const BenchOptions& options) {
    BenchRegion region;
    if (options.region.empty()) {
        region.made = made_region(options.patches);
        region.pages = pages_in_memory(region.made, 1.0, thread_count());
        return region;
    }
    ORO_TRY(const std::vector<BakedGrid> grids, open_baked_file(options.region));
    if (grids.size() > 1)
        return Error{ErrorKind::usage, options.region, "has several grids of posts; one is needed"};
    region.file = grids.front();
    region.pages = pages_of_file(region.file.region);
    return region;
}

namespace {

Result<void> draw_clusters_of(const Gpu& gpu, std::uint64_t bytes, std::uint64_t main_bytes,
                              BenchRegion& region, Scene& scene) {
    ORO_TRY(const HeightField field, field_in_memory(*region.file.region));
    ORO_TRY(std::unique_ptr<RegionClusters> graph,
            clusters_of_file(region.file.clusters, region.file.region->fingerprint(), field,
                             scene.grids()[0].pages().facts().shape.occluder));
    ORO_TRY(ClusterScene made, ClusterScene::create(gpu, std::move(graph), bytes, main_bytes));
    scene.draw_clusters(std::move(made));
    return {};
}

}  // namespace

Result<Scene> scene_of(const Gpu& gpu, const BenchOptions& options, BenchRegion& region) {
    const bool clusters = options.mesh == "clusters";
    if (clusters && !region.file.clusters)
        return Error{ErrorKind::usage, "--mesh clusters",
                     "the region has none: orograph bake --mesh clusters makes them"};
    const std::uint64_t bytes =
        gpu_bytes(gpu, static_cast<std::uint64_t>(options.gpu_memory_mb) * 1000000U) / (clusters ? 2 : 1);
    SceneMemory memory;
    memory.gpu = bytes;
    memory.main = main_bytes(0) / (clusters ? 2 : 1);
    ORO_TRY(Scene scene, Scene::create(gpu, std::move(region.pages), memory, options.heights,
                                       asks_for_means(options.style)));
    if (clusters) ORO_CHECK(draw_clusters_of(gpu, bytes, memory.main, region, scene));
    // After the clusters: ground that is drawn by them has the processor's plan.
    if (options.plan_on_device) {
        ORO_TRY(const bool can,
                options.choose_on_device ? scene.choose_on_device(gpu) : scene.plan_on_device(gpu));
        if (!can) return Error{ErrorKind::failed, "--plan gpu", "the device has no doubles (shaderFloat64)"};
    }
    return scene;
}

Result<std::vector<BenchEye>> eyes_of(const BenchOptions& options, const BenchRegion& region) {
    if (!region.file.region)
        return std::vector<BenchEye>{{"above", eye_above(region.made, options.width_px, options.height_px)}};
    if (options.random_eyes > 0)
        return random_eyes(*region.pages, options.random_eyes, options.seed, options.width_px,
                           options.height_px);
    if (options.path.empty()) return Error{ErrorKind::usage, "--path", "is missing: name a file with eyes"};
    return read_bench_path(options.path, region.file.region->outline().undulation, options.width_px,
                           options.height_px);
}

}  // namespace oro
