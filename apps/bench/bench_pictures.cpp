// orograph-bench-pictures: what another GPU draws of the same views, pixel by pixel. One device keeps what
// its pixels show in a file, another one is held against it. Links core and render alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "apps/bench/bench_path.h"
#include "apps/bench/bench_style.h"
#include "apps/report/option_words.h"
#include "core/baked/file_pages.h"
#include "render/device/raster_request.h"
#include "render/frame/depth_picture.h"

namespace oro {
namespace {

struct PicturesOptions {
    std::string region, path, keep, against;
    std::string pipeline{raster_requests.front().first};
    int width_px{640};
    int height_px{360};
    double tau_px{1.0};
};

// What one pixel shows: kept as it is in memory, for a comparison on machines of one kind.
struct KeptPixel {
    std::uint8_t rgba[4];
    float depth;        // reversed; 0: sky
    float row, column;  // of the region's posts
};

std::vector<KeptPixel> kept_of(const DepthPicture& picture) {
    std::vector<KeptPixel> pixels(picture.depths.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        std::memcpy(pixels[i].rgba, &picture.rgba[4 * i], 4);
        pixels[i].depth = picture.depths[i];
        pixels[i].row = static_cast<float>(picture.points[i].row);
        pixels[i].column = static_cast<float>(picture.points[i].column);
    }
    return pixels;
}

struct Differences {
    std::size_t pixels{}, colour{}, colour_beyond_3{}, sky{}, ground{};
    int largest_colour{};
    double largest_depth{};  // relative, where both show the same ground
};

Differences compare(const std::vector<KeptPixel>& here, const std::vector<KeptPixel>& there) {
    Differences found;
    found.pixels = here.size();
    for (std::size_t i = 0; i < here.size(); ++i) {
        const KeptPixel &a = here[i], &b = there[i];
        int off = 0;
        for (int channel = 0; channel < 3; ++channel)
            off = std::max(off, std::abs(a.rgba[channel] - b.rgba[channel]));
        found.largest_colour = std::max(found.largest_colour, off);
        found.colour += off > 0 ? 1 : 0;
        found.colour_beyond_3 += off > 3 ? 1 : 0;
        if ((a.depth == 0.0F) != (b.depth == 0.0F)) {
            ++found.sky;
            continue;
        }
        if (a.depth == 0.0F) continue;
        // Along a sight line that grazes the ground a rounding moves the row and column far, and the depth
        // as far: other ground is what lies at another distance by more than a hundredth.
        const double depth = std::abs(static_cast<double>(a.depth) / static_cast<double>(b.depth) - 1.0);
        if (depth > 0.01)
            ++found.ground;
        else
            found.largest_depth = std::max(found.largest_depth, depth);
    }
    return found;
}

Result<std::vector<KeptPixel>> read_kept(std::ifstream& file, const std::string& name, std::size_t pixels) {
    std::vector<KeptPixel> kept(pixels);
    file.read(reinterpret_cast<char*>(kept.data()),
              static_cast<std::streamsize>(kept.size() * sizeof(KeptPixel)));
    if (!file) return Error{ErrorKind::failed, name, "ends too early: kept of fewer eyes, or another size"};
    return kept;
}

Result<void> run(const PicturesOptions& options) {
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    ORO_TRY(const RasterPath path, raster_path_for(options.pipeline, gpu->report()));
    ORO_TRY(RegionFile opened, RegionFile::open(options.region));
    const auto file = std::make_shared<const RegionFile>(std::move(opened));
    auto pages = pages_of_file(file);
    ORO_TRY(const std::vector<BenchEye> eyes,
            read_bench_path(options.path, file->outline().undulation, options.width_px, options.height_px));
    ORO_TRY(Scene scene, Scene::create(*gpu, std::move(pages)));
    const gpu::FrameStyle style = bench_style();
    DepthPainter painter(*gpu, path);
    DepthPictureOptions picture_options;
    picture_options.tau_px = options.tau_px;
    picture_options.skyline = false;
    std::ofstream keeps;
    std::ifstream kept;
    if (!options.keep.empty()) keeps.open(options.keep, std::ios::binary);
    if (!options.against.empty()) kept.open(options.against, std::ios::binary);
    if (!options.keep.empty() && !keeps) return Error{ErrorKind::failed, options.keep, "cannot be written"};
    if (!options.against.empty() && !kept) return Error{ErrorKind::failed, options.against, "cannot be read"};
    std::printf("%s (%s), %s path, %d x %d px, tau %g px\n", gpu->report().name.c_str(),
                gpu->report().driver.c_str(), name_of(path).c_str(), options.width_px, options.height_px,
                options.tau_px);
    for (const BenchEye& eye : eyes) {
        ORO_TRY(const DepthPicture picture, painter.draw(scene, eye.camera, style, picture_options));
        const std::vector<KeptPixel> pixels = kept_of(picture);
        if (keeps.is_open())
            keeps.write(reinterpret_cast<const char*>(pixels.data()),
                        static_cast<std::streamsize>(pixels.size() * sizeof(KeptPixel)));
        if (!kept.is_open()) continue;
        ORO_TRY(const std::vector<KeptPixel> there, read_kept(kept, options.against, pixels.size()));
        const Differences found = compare(pixels, there);
        std::printf(
            "%-24s %zu pixels: another colour %zu (by more than 3 of 255: %zu, at most %d), sky or "
            "ground %zu, other ground %zu, distance within %.2g\n",
            eye.name.c_str(), found.pixels, found.colour, found.colour_beyond_3, found.largest_colour,
            found.sky, found.ground, found.largest_depth);
    }
    keeps.flush();
    if (keeps.is_open() && !keeps) return Error{ErrorKind::failed, options.keep, "cannot be written whole"};
    return {};
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{"Compares what two GPUs draw of the same views.", "orograph-bench-pictures"};
    oro::PicturesOptions options;
    app.add_option("REGION", options.region, "A region file (orograph bake makes one)")->required();
    app.add_option("--path", options.path, "Eyes to draw from: a .json file like those in data/paths")
        ->required();
    app.add_option("--keep", options.keep, "Write what each pixel shows into this file");
    app.add_option("--against", options.against, "Compare with such a file, of another device");
    app.add_option("--pipeline", options.pipeline, "mesh, compute or auto")
        ->check(CLI::IsMember(oro::words_of(oro::raster_requests)));
    app.add_option("--tau", options.tau_px, "Largest error, pixels; 0: full resolution")
        ->check(CLI::Range(0.0, 1000.0));
    app.add_option("--width", options.width_px, "Of the pictures, pixels")->check(CLI::Range(1, 8192));
    app.add_option("--height", options.height_px, "Of the pictures, pixels")->check(CLI::Range(1, 8192));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench-pictures: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    const oro::Result<void> done = oro::run(options);
    if (done.ok()) return 0;
    std::fprintf(stderr, "orograph-bench-pictures: %s\n", done.error().line().c_str());
    return static_cast<int>(done.error().kind);
}
