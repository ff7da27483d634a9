#include "render/page_store.h"

#include <cstring>

namespace oro {
namespace {
constexpr std::size_t pages_per_chunk = 512;   // 49 MB: far below every device's limit on one buffer
constexpr std::size_t pages_in_staging = 128;  // divides pages_per_chunk, so a batch never crosses chunks
}  // namespace

Result<PageStore> PageStore::create(const Gpu& gpu) {
    PageStore store(gpu);
    ORO_TRY(store.commands_, Commands::create(gpu, "page upload"));
    ORO_TRY(store.staging_,
            create_buffer(gpu, pages_in_staging * sizeof(gpu::PageBlock), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          BufferPlace::upload, "page staging"));
    return store;
}

Result<void> PageStore::add_page(const gpu::PageBlock& block) {
    if (count_ - sent_ == pages_in_staging) ORO_CHECK(send());
    std::memcpy(staging_.mapped + (count_ - sent_) * sizeof(gpu::PageBlock), &block, sizeof block);
    ++count_;
    return {};
}

Result<void> PageStore::finish() {
    return send();
}

Result<void> PageStore::send() {
    if (sent_ == count_) return {};
    if (sent_ / pages_per_chunk == chunks_.size()) {
        constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                             VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        ORO_TRY(Buffer chunk, create_buffer(*gpu_, pages_per_chunk * sizeof(gpu::PageBlock), usage,
                                            BufferPlace::device, "pages " + std::to_string(chunks_.size())));
        chunks_.push_back(std::move(chunk));
    }
    VkBufferCopy copy{};
    copy.dstOffset = sent_ % pages_per_chunk * sizeof(gpu::PageBlock);
    copy.size = (count_ - sent_) * sizeof(gpu::PageBlock);
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        vkCmdCopyBuffer(commands, staging_.handle.get(), chunks_.back().handle.get(), 1, &copy);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    }));
    sent_ = count_;
    return {};
}

VkDeviceAddress PageStore::address(std::size_t page) const {
    return chunks_[page / pages_per_chunk].address + page % pages_per_chunk * sizeof(gpu::PageBlock);
}

}  // namespace oro
