// A GPU for render tests, with the validation layer and synchronization validation on: any message fails the
// test.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>

#include "render/device/gpu.h"

namespace oro::test {

// The device of this process, which its tests share: making one and its pipelines takes longer than most of
// them.
struct SharedGpu {
    std::unique_ptr<Gpu> gpu;
    std::size_t messages_reported{};

    // Fails the test that runs for each message that no test has failed for.
    void report_messages() {
        if (!gpu) return;
        const auto& messages = gpu->validation_messages();
        for (; messages_reported < messages.size(); ++messages_reported)
            ADD_FAILURE() << messages[messages_reported];
    }
    void destroy() {
        report_messages();
        gpu.reset();
        messages_reported = 0;
    }
};
inline SharedGpu& shared_gpu() {
    static SharedGpu shared;
    return shared;
}

// The device ends with the last test, before the libraries that it came from do.
class SharedGpuEnd : public ::testing::Environment {
  public:
    void TearDown() override { shared_gpu().destroy(); }
};
inline const ::testing::Environment* const shared_gpu_end =
    ::testing::AddGlobalTestEnvironment(new SharedGpuEnd);

class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        SharedGpu& shared = shared_gpu();
        if (!shared.gpu) {
            GpuOptions options = gpu_options_from_environment();
            options.validation = true;
            auto made = Gpu::create(options);
            ASSERT_TRUE(made.ok()) << made.error().line();
            shared.gpu = std::move(made).value();
        }
        gpu_ = shared.gpu.get();
    }
    void TearDown() override { shared_gpu().report_messages(); }
    // A device without pipelines, for tests that count what is made on it. The next tests share it.
    void renew_gpu() {
        shared_gpu().destroy();
        GpuTest::SetUp();
    }

    Gpu* gpu_{};  // of the process
};

}  // namespace oro::test
