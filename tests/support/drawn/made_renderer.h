// A renderer that a test cannot do without.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "render/frame/frame_renderer.h"

namespace oro::test {

inline FrameRenderer made_renderer(const Gpu& gpu, const FrameRendererOptions& options) {
    auto made = FrameRenderer::create(gpu, options);
    EXPECT_TRUE(made.ok()) << made.error().line();
    return std::move(made).value();
}

}  // namespace oro::test
