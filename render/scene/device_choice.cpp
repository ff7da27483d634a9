#include "render/scene/device_choice.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>
#include <utility>

namespace oro {

Result<DeviceChoice> DeviceChoice::create(const Gpu& gpu, const RegionPages& pages) {
    DeviceChoice choice(pages);
    const std::uint32_t count = choice.numbers_->page_count();
    choice.capacity_ = std::min(count, most_pages);
    choice.known_.resize(count);
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    ORO_TRY(choice.records_, create_buffer(gpu, count * sizeof(gpu::ChoicePage), usage,
                                           MemoryKind::mapped_device, "records of pages"));
    std::vector<gpu::ChoicePage> records(count);
    ORO_CHECK(fill_choice_records(pages, *choice.numbers_, records));
    std::memcpy(choice.records_.mapped, records.data(), records.size() * sizeof(gpu::ChoicePage));
    ORO_TRY(choice.tables_, create_buffer(gpu, count * (sizeof(gpu::uvec2) + 2 * sizeof(gpu::uint)), usage,
                                          MemoryKind::device, "choice of pages"));
    // No page is here.
    ORO_TRY(Commands commands, Commands::create(gpu, "choice of pages"));
    ORO_CHECK(commands.run(gpu, [&](VkCommandBuffer recorded) {
        vkCmdFillBuffer(recorded, choice.tables_.handle.get(), 0, VK_WHOLE_SIZE, 0);
        memory_barrier(recorded, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    }));
    return choice;
}

// Pages come, and others go for them, by what is sent; buffers are let go of with all their pages.
void DeviceChoice::note_pages(const PageStore& store) {
    if (store.bytes_sent() == bytes_sent_ && store.size() == size_) return;
    bytes_sent_ = store.bytes_sent();
    size_ = store.size();
    ++turn_;
    const auto change = [&](std::uint32_t number, std::uint64_t address) {
        known_[number].address = address;
        changes_.push_back({number, 0, address_words(address)});
        ++change_number_;
    };
    std::vector<std::uint32_t> here;
    here.reserve(here_.size() + 16);
    store.for_each([&](const PageIndex& page, std::uint64_t address) {
        const std::uint32_t number = numbers_->of(page);
        known_[number].found = turn_;
        here.push_back(number);
        if (known_[number].address != address) change(number, address);
    });
    for (const std::uint32_t number : here_)
        if (known_[number].found != turn_) change(number, 0);
    here_ = std::move(here);
}

void DeviceChoice::plan(const FrameView& view, const ModelView& model, double shading_spacing_px,
                        std::uint64_t means_before, GridPlan& plan) const {
    DevicePlan& device = plan.device;
    device.on = device.chooses = true;
    device.choice = choice_terms(*pages_, *numbers_, view, model, shading_spacing_px);
    device.choice.capacity = capacity_;
    device.choice.means_before = address_words(means_before);
    device.choice.records = address_words(records_.address);
    const std::uint64_t count = numbers_->page_count();
    device.choice.blocks = address_words(tables_.address);
    device.choice.ratings = address_words(tables_.address + count * sizeof(gpu::uvec2));
    device.choice.slots = address_words(tables_.address + count * (sizeof(gpu::uvec2) + sizeof(gpu::uint)));
    // The last change of each page.
    device.changes = changes_;
    const auto page_of = [](const gpu::BlockChange& change) { return change.page; };
    std::ranges::stable_sort(device.changes, {}, page_of);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < device.changes.size(); ++i)
        if (i + 1 == device.changes.size() || device.changes[i + 1].page != device.changes[i].page)
            device.changes[kept++] = device.changes[i];
    device.changes.resize(kept);
    device.choice.change_count = static_cast<gpu::uint>(kept);
    device.change_number = change_number_;
    device.pages_read = std::min<std::size_t>(capacity_, 2 * last_.pages_wanted + 256);
    device.page_numbers = numbers_;
    device.terms.row_count = numbers_->row_count();
    device.terms.column_count = numbers_->column_count();
    device.terms.page_count = capacity_;
    // Until the device knows it; 0 would say that nothing is drawn.
    plan.constants.page_count = std::max(1U, static_cast<gpu::uint>(last_.pages_wanted));
    Missing lacks = missing();
    plan.missing = std::move(lacks.pages);
    plan.missing_hidden = lacks.hidden;
    plan.hidden = last_.hidden;
    plan.pages_wanted = last_.pages_wanted;
    plan.pages_beyond_frustum = last_.pages_beyond_frustum;
    plan.pages_beyond_horizon = last_.pages_beyond_horizon;
}

DeviceChoice::Missing DeviceChoice::missing() const {
    Missing lacks{last_.missing, last_.missing_hidden};
    std::size_t at = 0;
    const std::size_t first_hidden = lacks.pages.size() - lacks.hidden;
    std::erase_if(lacks.pages, [&](const PageIndex& page) {
        const bool is_here = known_[numbers_->of(page)].address != 0;
        lacks.hidden -= at++ >= first_hidden && is_here ? 1 : 0;
        return is_here;
    });
    return lacks;
}

void DeviceChoice::note_plan(const GridPlan& plan) {
    last_ = {};
    last_.missing = plan.missing;
    last_.missing_hidden = plan.missing_hidden;
    last_.hidden = plan.hidden;
    last_.pages_wanted = plan.pages_wanted;
    whole_plans_ = plan.missing.empty() ? whole_plans_ + 1 : 0;
}

void DeviceChoice::for_each_here(const MadeChoice& made,
                                 const std::function<void(const PageIndex&)>& visit) const {
    for (const gpu::WantedPage& page : made.wanted)
        if (page.block != gpu::uvec2(0U)) visit(numbers_->page(page.page));
}

void DeviceChoice::apply_changes(const MadeChoice& made) {
    const std::uint64_t unknown = change_number_ - made.change_number;
    if (unknown < changes_.size())
        changes_.erase(changes_.begin(), changes_.end() - static_cast<std::ptrdiff_t>(unknown));
}

bool DeviceChoice::apply(const MadeChoice& made, const IsHidden& is_hidden) {
    apply_changes(made);
    ChosenPages chosen;
    if (made.counts.missing > 0) {
        chosen = chosen_pages(*numbers_, made.counts, made.wanted, is_hidden);
    } else {
        // Nobody asks for more where nothing is missing.
        chosen.pages_wanted = made.counts.wanted;
        chosen.pages_beyond_frustum = made.counts.beyond_frustum;
        chosen.pages_beyond_horizon = made.counts.beyond_horizon;
        chosen.is_whole = made.counts.wanted <= capacity_;
    }
    const bool is_news = chosen.missing != last_.missing;
    last_ = std::move(chosen);
    return is_news;
}

}  // namespace oro
