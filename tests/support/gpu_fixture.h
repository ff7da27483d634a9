// A GPU for render tests, with the validation layer and synchronization validation on: any message fails the
// test.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "render/device/gpu.h"

namespace oro::test {

// The device of this process, which its tests share: making one and its pipelines takes longer than most of them.
inline std::unique_ptr<Gpu>& shared_gpu() {
    static std::unique_ptr<Gpu> gpu;
    return gpu;
}

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!shared_gpu()) {
            GpuOptions options = gpu_options_from_environment();
            options.validation = true;
            auto made = Gpu::create(options);
            ASSERT_TRUE(made.ok()) << made.error().line();
            shared_gpu() = std::move(made).value();
        }
        gpu_ = shared_gpu().get();
        messages_before_ = gpu_->validation_messages().size();
    }
    void TearDown() override {
        if (!gpu_) return;
        const auto& messages = gpu_->validation_messages();
        for (std::size_t i = messages_before_; i < messages.size(); ++i) ADD_FAILURE() << messages[i];
    }
    // A device without pipelines, for tests that count what is made on it. The next tests share it.
    void renew_gpu() {
        shared_gpu().reset();
        GpuTest::SetUp();
    }

    Gpu* gpu_{};  // of the process

  private:
    std::size_t messages_before_{};
};

}  // namespace oro::test
