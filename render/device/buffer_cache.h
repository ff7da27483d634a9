// Items in GPU memory, in the buffers of a cache's bins, with the way into them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/cache/gpu_cache.h"
#include "render/device/resources.h"

namespace oro {

// An item whose rest the device writes: where it lies, and what that is made from.
struct ItemInPart {
    VkDeviceAddress item{}, source{};
};
// Records the writing of the rest of items, by compute shaders.
using WriteItems = std::function<void(VkCommandBuffer, std::span<const ItemInPart>)>;

// How the buffers of a cache are made.
struct CacheLayout {
    std::string name;          // of its buffers: "pages"
    std::size_t item_bytes{};  // what an item usually takes
    // Items of a buffer. There are as many in the next as in all before, from the first to the largest; where
    // the device has too little memory there are fewer, down to the smallest.
    std::size_t first_buffer{}, largest_buffer{}, smallest_buffer{};
    // What is on its way at a time: at least one item of any size.
    std::size_t staging_bytes{};
    WriteItems write_items{};  // empty: all bytes of items are sent
};

// A cache (core/cache/gpu_cache.h) that owns its buffers. They are made as items come, and so is what
// uploading takes: a cache without items takes nothing. It begins with frame 1.
template <class Key, class Value = NoValue>
class BufferCache {
  public:
    using Items = GpuCache<Key, Value>;
    using Handle = typename Items::Handle;

    // The budget may be shared. The GPU outlives the cache.
    BufferCache(const Gpu& gpu, CacheLayout layout, std::shared_ptr<MemoryBudget> budget)
        : gpu_(&gpu), layout_(std::move(layout)), budget_(std::move(budget)), items_(budget_) {
        capacity_ = std::max<std::size_t>(1, static_cast<std::size_t>(budget_->bytes() / layout_.item_bytes));
    }

    [[nodiscard]] Items& items() { return items_; }
    [[nodiscard]] const Items& items() const { return items_; }
    // The most items of the usual size that the budget and the device have memory for.
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    // Bytes of its buffers, and of all that was ever uploaded.
    [[nodiscard]] std::uint64_t bytes() const {
        std::uint64_t bytes = 0;
        for (const Buffer& buffer : buffers_) bytes += buffer.size;
        return bytes;
    }
    [[nodiscard]] std::uint64_t bytes_uploaded() const { return bytes_uploaded_; }
    [[nodiscard]] VkDeviceAddress address(const typename Items::Slot& slot) const {
        return buffers_[slot.bin].address + slot.offset;
    }
    [[nodiscard]] VkDeviceAddress address(Handle handle) const { return address(items_.at(handle)); }
    // Records the copying of an item's bytes to a buffer.
    void record_reading(VkCommandBuffer commands, const typename Items::Slot& slot, const Buffer& to,
                        VkDeviceSize at) const {
        const VkBufferCopy copy{slot.offset, at, slot.bytes};
        vkCmdCopyBuffer(commands, buffers_[slot.bin].handle.get(), to.handle.get(), 1, &copy);
    }

    // Whether an item of so many bytes finds memory without an eviction, and how many find some by evictions
    // of what no frame uses; 1 at least where there is none yet.
    [[nodiscard]] bool has_free(std::size_t bytes) const {
        return items_.has_free(bytes) || growth(bytes) > 0;
    }
    [[nodiscard]] std::size_t fitting(std::size_t bytes) const {
        return std::max<std::size_t>(items_.fitting(bytes) + growth(bytes), buffers_.empty() ? 1 : 0);
    }

    // As `spared`: nothing is evicted.
    static constexpr std::uint64_t evicts_nothing = ~std::uint64_t{0};
    // Of an item in part: bytes that are sent to its beginning, and bytes of what the rest is made from
    // (CacheLayout::write_items); these are staged at source_at().
    struct SentPart {
        std::size_t sent{}, source{};
        [[nodiscard]] std::size_t source_at() const { return multiple_of_16(sent); }
        [[nodiscard]] std::size_t staged() const {
            return source > 0 ? source_at() + multiple_of_16(source) : sent;
        }
        static std::size_t multiple_of_16(std::size_t bytes) { return (bytes + 15) / 16 * 16; }
    };
    // An item that is not in the cache, and where its bytes are to be written before anything else is added;
    // upload() sends them. Items::none: too few bytes may be evicted (GpuCache::evict). Waits for the upload
    // before the last one. Errors: the device; it has no memory for any item at all. What was added before is
    // uploaded then.
    struct Added {
        Handle handle{Items::none};
        std::byte* bytes{nullptr};
    };
    Result<Added> add(const Key& key, std::size_t bytes, std::uint64_t spared = 0) {
        return add(key, bytes, spared, {bytes, 0});
    }
    Result<Added> add(const Key& key, std::size_t bytes, std::uint64_t spared, const SentPart& part) {
        if (staged_bytes_ + part.staged() > layout_.staging_bytes) ORO_CHECK(upload());
        if (staged_.empty()) ORO_CHECK(begin_staging());
        Added added{items_.insert(key, bytes)};
        if (added.handle == Items::none) {
            const Result<bool> grown = add_buffer(bytes);
            if (!grown.ok()) ORO_CHECK(upload());
            ORO_TRY(const bool has_grown, grown);
            if (has_grown) added.handle = items_.insert(key, bytes);
        }
        if (added.handle == Items::none && spared != evicts_nothing)
            added.handle = items_.evict(key, bytes, spared);
        if (added.handle == Items::none) return added;
        added.bytes =
            staging_[turn_].buffer.mapped + std::exchange(staged_bytes_, staged_bytes_ + part.staged());
        staged_.push_back({added.handle, part});
        return added;
    }
    // Uploads what was added: it is there for all that is submitted afterwards. What lay there is overwritten
    // once all frames that were submitted before are done with it. Does not wait. Errors: the device; what
    // was not sent is not in the cache.
    Result<void> upload() {
        if (staged_.empty()) return {};
        const Result<void> copied = staging_[turn_].commands.submit(
            *gpu_, [&](VkCommandBuffer commands) { record_copies(commands); });
        for (std::size_t i = 0; !copied.ok() && i < staged_.size(); ++i)
            items_.erase(items_.at(staged_[i].item).key);
        if (copied.ok()) bytes_uploaded_ += staged_bytes_;
        staged_.clear();
        staged_bytes_ = 0;
        turn_ = 1 - turn_;
        return copied;
    }
    // Destroys buffers of which the frame uses nothing, for others that share the budget: true where there
    // were any. Waits for frames in flight.
    bool release_unused() {
        const std::vector<bool> stayed = items_.release_unused();
        if (std::ranges::find(stayed, false) != stayed.end()) gpu_->wait_idle();
        std::size_t buffer = 0;
        if (std::erase_if(buffers_, [&](const Buffer&) { return !stayed[buffer++]; }) == 0) return false;
        is_full_ = is_nearly_full_ = false;
        return true;
    }

  private:
    // Items of so many bytes for which the budget has memory left.
    [[nodiscard]] std::size_t growth(std::size_t bytes) const {
        return is_full_ ? 0 : static_cast<std::size_t>(budget_->left() / bytes);
    }
    // What is sent is written here, while what was sent before may still be on its way.
    Result<void> begin_staging() {
        Staging& staging = staging_[turn_];
        if (staging.buffer.handle) return staging.commands.wait();
        ORO_TRY(staging.commands, Commands::create(*gpu_, layout_.name + " upload"));
        const VkBufferUsageFlags read_by_shaders =
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        const VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | (layout_.write_items ? read_by_shaders : 0);
        ORO_TRY(staging.buffer, create_buffer(*gpu_, layout_.staging_bytes, usage, MemoryKind::upload,
                                              layout_.name + " staging"));
        return {};
    }
    // One more buffer, with room for `least_bytes` in one piece, where the budget and the device have memory.
    // The budget is what the device may be asked for; where it has less, fewer items are enough. The first
    // buffer is made whatever the budget says.
    Result<bool> add_buffer(std::size_t least_bytes) {
        constexpr VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        const bool is_first = buffers_.empty();
        if (!is_first && growth(least_bytes) == 0) return false;
        const auto left = static_cast<std::size_t>(budget_->left());
        const std::size_t held = static_cast<std::size_t>(bytes()) / layout_.item_bytes;
        const std::size_t wanted = is_nearly_full_
                                       ? layout_.smallest_buffer
                                       : std::clamp(held, layout_.first_buffer, layout_.largest_buffer);
        std::size_t count = std::min(wanted, std::max<std::size_t>(left / layout_.item_bytes, 1));
        for (;; count /= 2) {
            bool no_memory = false;
            std::size_t size = std::max(count * layout_.item_bytes, least_bytes);
            if (!is_first) size = std::min(size, left);
            auto buffer = create_buffer(*gpu_, size, usage, MemoryKind::device,
                                        layout_.name + " " + std::to_string(buffers_.size()), &no_memory);
            if (buffer.ok()) {
                buffers_.push_back(std::move(buffer).value());
                items_.add_bin(size);
                return true;
            }
            if (!no_memory) return buffer.error();
            is_nearly_full_ = true;
            if (count > layout_.smallest_buffer) continue;
            if (is_first) return buffer.error();
            is_full_ = true;
            capacity_ = held;
            return false;
        }
    }
    void record_copies(VkCommandBuffer commands) const {
        wait_for_earlier(commands);
        std::size_t staged = 0;
        std::vector<ItemInPart> in_part;
        const Buffer& staging = staging_[turn_].buffer;
        for (const auto& [handle, part] : staged_) {
            const auto& slot = items_.at(handle);
            const VkBufferCopy copy{staged, slot.offset, part.sent};
            vkCmdCopyBuffer(commands, staging.handle.get(), buffers_[slot.bin].handle.get(), 1, &copy);
            if (part.source > 0)
                in_part.push_back({address(slot), staging.address + staged + part.source_at()});
            staged += part.staged();
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
        if (in_part.empty()) return;
        layout_.write_items(commands, in_part);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    }

    const Gpu* gpu_;
    CacheLayout layout_;
    std::shared_ptr<MemoryBudget> budget_;
    std::vector<Buffer> buffers_;  // of the bins
    Items items_;
    struct Staging {
        Buffer buffer;
        Commands commands;
    };
    std::array<Staging, 2> staging_;  // by turns; after the buffers: its commands end before these
    std::size_t turn_{};
    struct StagedItem {
        Handle item{};
        SentPart part;
    };
    std::vector<StagedItem> staged_;  // that are not uploaded yet
    std::size_t staged_bytes_{};
    std::uint64_t bytes_uploaded_{};
    std::size_t capacity_{};
    bool is_nearly_full_{false};  // the device had no memory for a buffer of the usual size,
    bool is_full_{false};         // nor for a small one
};

}  // namespace oro
