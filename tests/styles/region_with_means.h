// Real data as most styles draw them: a scene with means of its ground.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "tests/support/drawn/region_scene.h"

namespace oro::test {

// For ASSERT_NO_FATAL_FAILURE.
inline void open_with_means(const Gpu& gpu, std::vector<std::string> paths, Region& region,
                            std::optional<Scene>& scene) {
    RegionRequest request;
    request.paths = std::move(paths);
    auto opened = open_region(request);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    region = std::move(*opened);
    auto made = create_scene(gpu, region, {.means = true});
    ASSERT_TRUE(made.ok()) << made.error().line();
    scene.emplace(std::move(*made));
}

}  // namespace oro::test
