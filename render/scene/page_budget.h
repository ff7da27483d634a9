// Memory on the GPU that the pages of several scenes share.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "render/device/resources.h"

namespace oro {

// Counts bytes; who takes some says so, and says when they are free again.
class PageBudget {
  public:
    explicit PageBudget(std::uint64_t bytes) : bytes_(bytes) {}
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t left() const { return taken_ < bytes_ ? bytes_ - taken_ : 0; }
    void take(std::uint64_t bytes) { taken_ += bytes; }
    void give_back(std::uint64_t bytes) { taken_ -= bytes; }

  private:
    std::uint64_t bytes_;
    std::uint64_t taken_{};
};

// A buffer for some pages. It counts in a budget for as long as it is there.
class PageChunk {
  public:
    PageChunk(Buffer buffer, std::shared_ptr<PageBudget> budget)
        : buffer_(std::move(buffer)), budget_(std::move(budget)) {
        budget_->take(buffer_.size);
    }
    PageChunk(PageChunk&&) noexcept = default;
    PageChunk& operator=(PageChunk&& other) noexcept {
        let_go();
        buffer_ = std::move(other.buffer_);
        budget_ = std::move(other.budget_);
        return *this;
    }
    PageChunk(const PageChunk&) = delete;
    PageChunk& operator=(const PageChunk&) = delete;
    ~PageChunk() { let_go(); }
    void let_go() {
        if (budget_) budget_->give_back(buffer_.size);
        budget_ = nullptr;
        buffer_ = {};
    }
    [[nodiscard]] const Buffer& buffer() const { return buffer_; }

  private:
    Buffer buffer_;
    std::shared_ptr<PageBudget> budget_;  // null: nothing is held
};

}  // namespace oro
