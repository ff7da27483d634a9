// A GPU for render tests, with the validation layer and synchronization validation on: any message fails the
// test.
#pragma once

#include <gtest/gtest.h>

#include "render/device/gpu.h"

namespace oro::test {

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        GpuOptions options = gpu_options_from_environment();
        options.validation = true;
        auto made = Gpu::create(options);
        ASSERT_TRUE(made.ok()) << made.error().line();
        gpu_ = std::move(made).value();
    }
    void TearDown() override {
        if (!gpu_) return;
        for (const std::string& message : gpu_->validation_messages()) ADD_FAILURE() << message;
    }

    std::unique_ptr<Gpu> gpu_;
};

}  // namespace oro::test
