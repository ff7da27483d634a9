// Pages in GPU memory: fixed slots in large buffers, reached by device address.
#pragma once

#include <functional>
#include <vector>

#include "core/page.h"
#include "render/resources.h"

namespace oro {

// The pages of one region on the GPU.
class PageStore {
  public:
    static Result<PageStore> create(const Gpu& gpu);

    // Adds a page. Errors: out of memory.
    Result<void> add_page(const gpu::PageBlock& block);
    // Sends what is not yet sent; to be called after the last page.
    Result<void> finish();

    [[nodiscard]] std::size_t size() const { return count_; }
    // Device address of a page's block, by the order in which pages were added.
    [[nodiscard]] VkDeviceAddress address(std::size_t page) const;
    [[nodiscard]] std::uint64_t bytes() const { return count_ * sizeof(gpu::PageBlock); }

  private:
    explicit PageStore(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> send();

    const Gpu* gpu_;
    Commands commands_;
    Buffer staging_;
    std::vector<Buffer> chunks_;
    std::size_t count_{};
    std::size_t sent_{};
};

}  // namespace oro
