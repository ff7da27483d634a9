#include "apps/bench/times/bench_tables.h"

#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/times/bench_region.h"
#include "apps/bench/times/bench_times.h"
#include "render/device/raster_request.h"

namespace oro {
namespace {

constexpr std::array paths{std::pair{"compute", RasterPath::compute}, std::pair{"mesh", RasterPath::mesh}};

struct DrawnEye {
    BenchTimes times;
    double page_bytes{};
};

// One eye by one way of drawing, in a scene of its own settings.
Result<DrawnEye> time_eye(const Gpu& gpu, RasterPath path, Scene& scene, const BenchEye& eye,
                          const BenchOptions& options) {
    ORO_TRY(FrameRenderer renderer, renderer_for(gpu, path, options));
    ORO_TRY(BenchTimes times, time_frames(scene, renderer, eye.camera, options));
    return DrawnEye{std::move(times), scene.grids()[0].store().bytes_a_page()};
}

Result<Scene> scene_for(const Gpu& gpu, const BenchOptions& options) {
    ORO_TRY(BenchRegion region, open_bench_region(options));
    return scene_of(gpu, options, region);
}

// Triangles and times without level of detail, with it, and with occlusion, too.
Result<void> print_detail(const Gpu& gpu, BenchOptions options, const std::vector<BenchEye>& eyes) {
    std::printf(
        "\n| eye | path | no LOD: triangles | ms | LOD: triangles | ms | LOD and occlusion: triangles | ms "
        "|\n"
        "|---|---|---|---|---|---|---|---|\n");
    ORO_TRY(Scene scene, scene_for(gpu, options));
    const double tau_px = options.tau_px;
    for (const BenchEye& eye : eyes)
        for (const auto& [name, path] : paths) {
            std::printf("| %s | %s ", eye.name.c_str(), name);
            for (const auto& [tau, occlusion] : {std::pair{0.0, "off"}, {tau_px, "off"}, {tau_px, "on"}}) {
                options.tau_px = tau;
                options.occlusion = occlusion;
                ORO_TRY(const DrawnEye drawn, time_eye(gpu, path, scene, eye, options));
                std::printf("| %u | %.3f ", drawn.times.last.counts.triangles_drawn, 1e3 * drawn.times.gpu_s);
            }
            std::printf("|\n");
            std::fflush(stdout);
        }
    return {};
}

// Heights as they are kept on the GPU, without level of detail and with it.
Result<void> print_heights(const Gpu& gpu, BenchOptions options, const std::vector<BenchEye>& eyes) {
    constexpr std::array storages{std::pair{"32 bits", HeightStorage::f32},
                                  std::pair{"packed", HeightStorage::packed},
                                  std::pair{"16 bits", HeightStorage::i16}};
    std::printf(
        "\n| heights | bytes a page | a post, node bounds apart | eye | path | no LOD: ms | raster | LOD: ms "
        "| raster |\n|---|---|---|---|---|---|---|---|---|\n");
    const double tau_px = options.tau_px;
    for (const auto& [kept, storage] : storages) {
        options.heights = storage;
        ORO_TRY(Scene scene, scene_for(gpu, options));
        for (const BenchEye& eye : eyes)
            for (const auto& [name, path] : paths) {
                std::array<DrawnEye, 2> drawn;
                for (std::size_t i = 0; i < 2; ++i) {
                    options.tau_px = i == 0 ? 0.0 : tau_px;
                    ORO_TRY(drawn[i], time_eye(gpu, path, scene, eye, options));
                }
                std::printf("| %s | %.0f | %.2f | %s | %s | %.3f | %.3f | %.3f | %.3f |\n", kept,
                            drawn[0].page_bytes, scene.grids()[0].store().bytes_a_post(), eye.name.c_str(),
                            name, 1e3 * drawn[0].times.gpu_s, 1e3 * drawn[0].times.raster_s,
                            1e3 * drawn[1].times.gpu_s, 1e3 * drawn[1].times.raster_s);
                std::fflush(stdout);
            }
    }
    return {};
}

// Mesh shaders against compute, by tau: by how large triangles are on the picture.
Result<void> print_sizes(const Gpu& gpu, BenchOptions options, const std::vector<BenchEye>& eyes) {
    std::printf(
        "\n| eye | tau | triangles | pixels a triangle | compute: ms | raster | mesh: ms | raster | mesh / "
        "compute, raster |\n|---|---|---|---|---|---|---|---|---|\n");
    ORO_TRY(Scene scene, scene_for(gpu, options));
    for (const BenchEye& eye : eyes)
        for (const double tau_px : {0.25, 0.5, 1.0, 2.0, 4.0}) {
            options.tau_px = tau_px;
            ORO_TRY(const DrawnEye compute, time_eye(gpu, RasterPath::compute, scene, eye, options));
            ORO_TRY(const DrawnEye mesh, time_eye(gpu, RasterPath::mesh, scene, eye, options));
            const auto triangles = static_cast<double>(compute.times.last.counts.triangles_drawn);
            std::printf("| %s | %g | %.0f | %.1f | %.3f | %.3f | %.3f | %.3f | %.1f |\n", eye.name.c_str(),
                        tau_px, triangles,
                        triangles > 0.0 ? options.width_px * options.height_px / triangles : 0.0,
                        1e3 * compute.times.gpu_s, 1e3 * compute.times.raster_s, 1e3 * mesh.times.gpu_s,
                        1e3 * mesh.times.raster_s, mesh.times.raster_s / compute.times.raster_s);
            std::fflush(stdout);
        }
    return {};
}

}  // namespace

Result<void> print_tables(const Gpu& gpu, BenchOptions options) {
    for (const auto& [name, path] : paths) ORO_CHECK(raster_path_for(name, gpu.report()));
    std::vector<BenchEye> eyes;
    {
        ORO_TRY(const BenchRegion region, open_bench_region(options));
        ORO_TRY(eyes, eyes_of(options, region));
    }
    std::printf("%s (%s), %s, %d x %d px, tau %g px, medians of %d frames\n", gpu.report().name.c_str(),
                gpu.report().driver.c_str(), options.region.c_str(), options.width_px, options.height_px,
                options.tau_px, options.frames);
    const BenchOptions asked = options;
    ORO_CHECK(print_detail(gpu, options, eyes));
    ORO_CHECK(print_heights(gpu, asked, eyes));
    return print_sizes(gpu, asked, eyes);
}

}  // namespace oro
