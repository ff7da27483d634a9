#include "apps/bench/times/bench_houses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/bench/times/bench_ground.h"
#include "apps/bench/times/bench_times.h"
#include "core/seam/mesh_pages.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double nearest_m = 100.0, farthest_m = 4000.0;
constexpr double part_of_width = 0.9;  // of the picture
constexpr int copies_behind = 9;

// Walls of metres' size and a flat roof.
struct House {
    Geodetic foot;
    double length_m, width_m, height_m, turned_rad;
};

void add_triangle(const std::array<Ecef, 3>& corners, float tone, Seam& seam) {
    SeamPiece piece;
    piece.two_sided = true;
    piece.tone = tone;
    const glm::dvec3 normal =
        glm::normalize(glm::cross(corners[1].m - corners[0].m, corners[2].m - corners[0].m));
    for (std::size_t i = 0; i < 3; ++i)
        piece.corners[i] = {corners[i], geodetic_from_ecef(corners[i]).h_m, normal};
    seam.pieces.push_back(piece);
}

void add_house(const House& house, float tone, Seam& seam) {
    const Ecef foot = ecef_from_geodetic(house.foot);
    const glm::dmat3 axes = ecef_from_enu(house.foot.lat_deg, house.foot.lon_deg);
    const double cosine = std::cos(house.turned_rad), sine = std::sin(house.turned_rad);
    const auto corner = [&](int number, double up_m) {
        const double x_m = (number == 1 || number == 2 ? 0.5 : -0.5) * house.length_m;
        const double y_m = (number >= 2 ? 0.5 : -0.5) * house.width_m;
        const glm::dvec3 enu{x_m * cosine - y_m * sine, x_m * sine + y_m * cosine, up_m};
        return Ecef{foot.m + axes * enu};
    };
    // Into the ground, which need not be level.
    const double bottom_m = -0.3 * house.length_m;
    for (int i = 0; i < 4; ++i) {
        const int next = (i + 1) % 4;
        add_triangle({corner(i, bottom_m), corner(next, bottom_m), corner(next, house.height_m)}, tone, seam);
        add_triangle({corner(i, bottom_m), corner(next, house.height_m), corner(i, house.height_m)}, tone,
                     seam);
    }
    const double top_m = house.height_m;
    add_triangle({corner(0, top_m), corner(1, top_m), corner(2, top_m)}, tone, seam);
    add_triangle({corner(0, top_m), corner(2, top_m), corner(3, top_m)}, tone, seam);
}

// In the place of those that the scene has.
Result<void> put_houses(const Gpu& gpu, const Seam& seam, Scene& scene) {
    if (seam.empty()) {
        scene.replace_between(std::nullopt);
        return {};
    }
    const RegionShape shape = scene.grids().front().pages().facts().shape;
    ORO_TRY(std::unique_ptr<RegionPages> pages, mesh_pages(seam, {}, shape));
    ORO_TRY(Scene between, Scene::create(gpu, std::move(pages)));
    scene.replace_between(std::move(between));
    return {};
}

// What the meshes of a scene take on the GPU, but for what casts their shadows: all of their pages are there.
ordered_json mesh_json(const Scene& scene) {
    std::uint64_t triangles = 0, clusters = 0, pages = 0, bytes = 0;
    for (const GridScene& grid : scene.grids()) {
        if (!grid.pages().has_meshes()) continue;
        for (int column = 0; column < grid.pages().layout(0).columns; ++column) {
            const auto record = grid.pages().record({0, column, 0});
            if (!record.ok()) continue;
            triangles += record->summary.triangles;
            clusters += record->summary.meshlets;
            bytes += grid.store().block_bytes({0, column, 0});
            pages += grid.store().has({0, column, 0}) ? 1 : 0;
        }
    }
    return {{"mesh_triangles", triangles},
            {"mesh_clusters", clusters},
            {"mesh_pages_here", pages},
            {"mesh_bytes_here", bytes},
            {"mesh_buffer_bytes", scene.grids().back().store().bytes()}};
}

void print_eye(const std::string& name, const ordered_json& json) {
    std::printf("  %-24s", name.c_str());
    for (const auto& [what, times] : json.items())
        std::printf("  %s %.3f ms (raster %.3f, %u triangles)", what.c_str(), times["gpu_ms"].get<double>(),
                    times["raster_ms"].get<double>(), times["triangles"].get<unsigned>());
    std::printf("\n");
}

}  // namespace

Result<Seam> houses_around(const RegionPages& pages, const Camera& camera, HousesLie lie, int count,
                           std::uint64_t seed) {
    EvenNumbers random(seed);
    GroundBelow ground(pages);
    Seam seam;
    const double half_deg = part_of_width * std::atan(camera.half_fov_tangent().x) * degrees;
    const double middle_deg = camera.attitude.heading_deg + (lie == HousesLie::behind ? 180.0 : 0.0);
    const Geodetic& eye = camera.eye;
    std::vector<House> houses;
    for (int i = 0; i < count; ++i) {
        const double way_m = std::exp(random.between(std::log(nearest_m), std::log(farthest_m)));
        const double azimuth_rad = (middle_deg + random.between(-half_deg, half_deg)) / degrees;
        House& house =
            houses.emplace_back(House{eye, random.between(8.0, 20.0), random.between(6.0, 12.0),
                                      random.between(4.0, 12.0), random.between(0.0, std::numbers::pi)});
        house.foot.lat_deg += way_m * std::cos(azimuth_rad) * degrees / meridian_radius_m(eye.lat_deg);
        house.foot.lon_deg += way_m * std::sin(azimuth_rad) * degrees /
                              (prime_vertical_radius_m(eye.lat_deg) * std::cos(eye.lat_deg / degrees));
    }
    // Those on one page one after the other, for only one is kept.
    const PostGrid& grid = pages.facts().grid;
    const auto page_of = [&](const House& house) {
        return std::pair(std::floor(grid.lat.index_at(house.foot.lat_deg) / gpu::page_quads),
                         std::floor(grid.lon.index_at(house.foot.lon_deg) / gpu::page_quads));
    };
    std::ranges::stable_sort(houses, {}, page_of);
    for (House& house : houses) {
        ORO_TRY(house.foot.h_m, ground.h_m(house.foot.lat_deg, house.foot.lon_deg));
        add_house(house, static_cast<float>(random.between(0.0, 1.0)), seam);
    }
    return seam;
}

Result<ordered_json> time_houses(const Gpu& gpu, Scene& scene, FrameRenderer& renderer,
                                 const std::vector<BenchEye>& eyes, const BenchOptions& options) {
    ordered_json json = ordered_json::object();
    const RegionPages& pages = scene.grids().front().pages();
    for (const BenchEye& eye : eyes) {
        ORO_TRY(const Seam ahead,
                houses_around(pages, eye.camera, HousesLie::ahead, options.houses, options.seed));
        ORO_TRY(const Seam behind, houses_around(pages, eye.camera, HousesLie::behind,
                                                 copies_behind * options.houses, options.seed + 1));
        Seam both = ahead;
        std::ranges::copy(behind.pieces, std::back_inserter(both.pieces));
        ordered_json& one = json[eye.name];
        const std::array<std::pair<const char*, Seam>, 3> arms{
            {{"without", {}}, {"houses", ahead}, {"more_behind", std::move(both)}}};
        for (const auto& [name, seam] : arms) {
            ORO_CHECK(put_houses(gpu, seam, scene));
            ORO_TRY(const BenchTimes times, time_frames(scene, renderer, eye.camera, options));
            one[name] = times_json(times);
            if (!seam.empty()) one[name].update(mesh_json(scene));
        }
        ORO_CHECK(put_houses(gpu, {}, scene));
        if (!options.json) print_eye(eye.name, one);
    }
    return json;
}

}  // namespace oro
