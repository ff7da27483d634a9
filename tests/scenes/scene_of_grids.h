// Grids that lie over or next to each other, as a scene that draws them as one surface.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/seam/mesh_pages.h"
#include "geo/together/cut_regions.h"
#include "render/scene/scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/height_storage.h"

namespace oro::test {

// What is left of a grid that others are cut out of.
inline HeightField rest_of(const HeightField& field, const GridClip& cut) {
    HeightField rest = field;
    for (std::size_t post = 0; post < cut.masked_posts.size(); ++post)
        if (cut.masked_posts[post] != 0) rest.H_m[post] = void_height_m;
    return rest;
}

inline Scene scene_of_pages(const Gpu& gpu, std::unique_ptr<RegionPages> pages) {
    auto scene = Scene::create(gpu, std::move(pages), {std::uint64_t{64} << 20U, 0}, asked_heights());
    EXPECT_TRUE(scene.ok()) << scene.error().line();
    return std::move(scene).value();
}

// The grids of a region, then the seam between them.
inline Scene scene_of_grids(const Gpu& gpu, const Region& region, const RegionCuts& cuts, const Seam& seam) {
    std::vector<Scene> scenes;
    for (std::size_t i = 0; i < region.grids.size(); ++i)
        scenes.push_back(
            scene_of_pages(gpu, pages_in_memory(rest_of(region.grids[i].field, cuts.grids[i]), 1.0, 2)));
    if (!seam.empty()) {
        auto pages = pages_beside(seam, {}, region_shape(region.grids[0].field, 1.0));
        EXPECT_TRUE(pages.ok()) << pages.error().line();
        for (auto& one : *pages) scenes.push_back(scene_of_pages(gpu, std::move(one)));
    }
    for (std::size_t i = 1; i < scenes.size(); ++i) scenes[0].add(std::move(scenes[i]));
    return std::move(scenes[0]);
}

}  // namespace oro::test
