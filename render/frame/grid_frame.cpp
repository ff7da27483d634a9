#include "render/frame/grid_frame.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "render/frame/frame_layout.h"

namespace oro {
namespace {

constexpr VkDeviceSize pages_offset = 8192;  // FrameConstants come first
static_assert(sizeof(gpu::FrameConstants) <= pages_offset);
constexpr VkDeviceSize cluster_groups_bytes = 16;
// Addresses that straddle 8 bytes cost 2 to 4 % of a frame.
static_assert((offsetof(gpu::FrameConstants, clusters) + offsetof(gpu::ClusterTable, drawn)) % 8 == 0);
static_assert(offsetof(gpu::FrameConstants, feedback) % 8 == 0);
static_assert(offsetof(gpu::FrameConstants, cut) % 8 == 0);

// Where the parts of a grid's data lie, in bytes.
struct DataLayout {
    VkDeviceSize rows;
    VkDeviceSize columns;
    VkDeviceSize before;
    VkDeviceSize clusters;  // workgroups of their draw, then they
    VkDeviceSize asked;     // ClusterCut::asked
    VkDeviceSize boxes;     // of clusters
    VkDeviceSize terms;     // of the plan,
    VkDeviceSize choice;    // ... of the choice of its pages, where the device makes it,
    VkDeviceSize changes;   // ... changes that it has to know,
    VkDeviceSize counts;    // ... how many it has chosen,
    VkDeviceSize sent;      // ... as far as is sent,
    VkDeviceSize numbers;   // of the plan's sources
    VkDeviceSize wanted;    // pages
    VkDeviceSize size;
};
constexpr VkDeviceSize aligned(VkDeviceSize size) {
    return (size + 15) / 16 * 16;
}
void add_choice(const DevicePlan& plan, DataLayout& layout) {
    layout.choice = aligned(layout.terms + sizeof(gpu::PlanTerms));
    layout.changes = aligned(layout.choice + sizeof(gpu::ChoiceTerms));
    layout.counts = aligned(layout.changes + plan.changes.size() * sizeof(gpu::BlockChange));
    layout.sent = layout.counts + sizeof(gpu::ChoiceCounts);
    layout.numbers = aligned(layout.sent);
    const VkDeviceSize numbers = plan.terms.row_count + plan.terms.column_count + plan.choice.capacity;
    layout.wanted = aligned(layout.numbers + numbers * sizeof(gpu::uint));
    layout.size = layout.wanted + plan.choice.capacity * sizeof(gpu::WantedPage);
}
DataLayout layout_of(const GridPlan& plan) {
    DataLayout layout{};
    layout.rows = aligned(pages_offset + plan.page_room() * sizeof(gpu::FramePage));
    layout.columns = aligned(layout.rows + plan.row_count() * sizeof(gpu::RowTerms));
    layout.before = aligned(layout.columns + plan.column_count() * sizeof(gpu::ColumnTerms));
    layout.clusters = aligned(layout.before + plan.page_room() * sizeof(gpu::uint));
    layout.asked = layout.boxes = layout.clusters;
    if (plan.clusters.on) {
        layout.asked = aligned(layout.clusters + cluster_groups_bytes +
                               plan.clusters.drawn.size() * sizeof(gpu::DrawnCluster));
        layout.boxes = aligned(layout.asked + plan.clusters.asked.size() * sizeof(gpu::AskedGroup));
    }
    layout.size = layout.boxes;
    if (plan.constants.occlusion != 0) layout.size += plan.clusters.boxes.size() * sizeof(gpu::ClusterBox);
    layout.terms = layout.size = aligned(layout.size);
    if (!plan.device.on) return layout;
    layout.numbers = layout.terms + sizeof(gpu::PlanTerms);
    layout.size = layout.numbers + plan.device.numbers.size() * sizeof(gpu::uint);
    if (plan.device.chooses) add_choice(plan.device, layout);
    return layout;
}

// Pages of a frame that the device has chosen; none where it tells of too few.
std::vector<PageIndex> chosen_of(const GridPlan& plan, const MadeChoice& made) {
    std::vector<PageIndex> pages;
    if (made.counts.wanted > made.wanted.size()) return pages;
    pages.resize(made.counts.open);
    for (const gpu::WantedPage& page : made.wanted)
        if (page.number < pages.size()) pages[page.number] = plan.device.page_numbers->page(page.page);
    return pages;
}

}  // namespace

Result<void> GridFrame::create_set(const Gpu& gpu, const Pipelines& pipelines,
                                   const std::array<VkImageView, 4>& images) {
    const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 3},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    VkDescriptorPool pool_handle{};
    ORO_VK(vkCreateDescriptorPool(gpu.device(), &pool, nullptr, &pool_handle));
    pool_ = OwnedDescriptorPool(gpu.device(), pool_handle);
    gpu.name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_handle, "frame");
    const VkDescriptorSetLayout layout = pipelines.set.get();
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = pool_handle;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &layout;
    ORO_VK(vkAllocateDescriptorSets(gpu.device(), &set, &set_));
    gpu.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set_, "frame");
    std::array<VkDescriptorImageInfo, 4> infos{};
    std::array<VkWriteDescriptorSet, 4> writes{};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const bool is_depth = i == 3;
        infos[i] = {VK_NULL_HANDLE, images[i], is_depth ? depth_read.layout : VK_IMAGE_LAYOUT_GENERAL};
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set_;
        writes[i].dstBinding = is_depth ? depth_binding : i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType =
            is_depth ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        writes[i].pImageInfo = &infos[i];
    }
    vkUpdateDescriptorSets(gpu.device(), 4, writes.data(), 0, nullptr);
    if (data_.handle) bind_constants(gpu);
    return {};
}

// The constants are at the beginning of the grid's data.
void GridFrame::bind_constants(const Gpu& gpu) const {
    const VkDescriptorBufferInfo buffer{data_.handle.get(), 0, sizeof(gpu::FrameConstants)};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = 3;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    write.pBufferInfo = &buffer;
    vkUpdateDescriptorSets(gpu.device(), 1, &write, 0, nullptr);
}

Result<void> GridFrame::reserve(const Gpu& gpu, const GridPlan& plan, std::size_t slot) {
    slot_ = slot;
    const DataLayout layout = layout_of(plan);
    if (data_.size < layout.size) {
        constexpr VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
            VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        ORO_CHECK(replace_buffer(gpu, data_, std::max(layout.size, 2 * data_.size), usage, MemoryKind::device,
                                 "frame data"));
        bind_constants(gpu);
    }
    if (staging_[slot].size < layout.size) {
        ORO_TRY(staging_[slot], create_buffer(gpu, data_.size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                              MemoryKind::upload, "frame staging"));
    }
    const std::size_t count = std::max<std::size_t>(plan.page_room(), 64);
    if (count > page_capacity_) {
        // A multiple of 4, so that each part starts at a multiple of 16 bytes.
        const std::size_t capacity = (std::max(count, 2 * page_capacity_) + 3) / 4 * 4;
        constexpr VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        ORO_CHECK(replace_buffer(gpu, choice_, 4 * (live_pages_words + capacity * choice_words), usage,
                                 MemoryKind::device, "choice of levels"));
        page_capacity_ = capacity;
    }
    ORO_CHECK(reserve_feedback(gpu, plan));
    if (plan.clusters.on) return reserve_clusters(gpu, plan);
    if (plan.constants.occlusion != 0) ORO_CHECK(reserve_seen(gpu, plan.page_room()));
    return plan.device.chooses ? reserve_choice(gpu, plan) : Result<void>();
}

// After reserve_seen(): by its turns.
Result<void> GridFrame::reserve_choice(const Gpu& gpu, const GridPlan& plan) {
    const VkDeviceSize read = sizeof(gpu::ChoiceCounts) + plan.device.pages_read * sizeof(gpu::WantedPage);
    if (choice_read_[slot_].size < read) {
        ORO_TRY(choice_read_[slot_], create_buffer(gpu, 2 * read, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                   MemoryKind::readback, "choice read back"));
    }
    const VkDeviceSize bytes = VkDeviceSize{4} * plan.device.choice.page_count;
    if (plan.constants.occlusion == 0 || numbers_[turn_].size >= bytes) return {};
    return replace_buffer(gpu, numbers_[turn_], bytes,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "numbers of pages");
}

Result<void> GridFrame::reserve_clusters(const Gpu& gpu, const GridPlan& plan) {
    const VkDeviceSize bytes =
        sizeof(gpu::uint) * std::max<VkDeviceSize>(plan.clusters.drawn.size(), gpu::clusters_per_choice);
    if (cluster_states_.size >= bytes) return {};
    return replace_buffer(gpu, cluster_states_, std::max(bytes, 2 * cluster_states_.size),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                              VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "cluster states");
}

Result<void> GridFrame::reserve_feedback(const Gpu& gpu, const GridPlan& plan) {
    const bool wanted = plan.request_feedback && plan.constants.occlusion != 0;
    const std::size_t words =
        plan.clusters.on ? plan.clusters.drawn.size() : gpu::feedback_words * plan.page_room();
    const VkDeviceSize size = wanted ? sizeof(gpu::uint) * words : 0;
    feedback_size_[slot_] = size;
    if (feedback_.size < size)
        ORO_CHECK(replace_buffer(gpu, feedback_, std::max(size, 2 * feedback_.size),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                 MemoryKind::device, "feedback"));
    if (feedback_read_[slot_].size < size) {
        ORO_TRY(feedback_read_[slot_], create_buffer(gpu, feedback_.size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                     MemoryKind::readback, "feedback read back"));
    }
    return {};
}

// Bytes of what the frame tells of its nodes or clusters. Of pages that the device chooses those of whom it
// tells: there is room for many more.
VkDeviceSize GridFrame::requested_feedback() const {
    const VkDeviceSize size = feedback_size_[slot_];
    if (choice_terms_ == 0) return size;
    const VkDeviceSize pages = (choice_read_bytes_ - sizeof(gpu::ChoiceCounts)) / sizeof(gpu::WantedPage);
    return std::min(size, sizeof(gpu::uint) * gpu::feedback_words * pages);
}

void GridFrame::record_feedback(VkCommandBuffer commands) const {
    if (choice_terms_ != 0) {
        const VkDeviceSize read = choice_read_bytes_ - sizeof(gpu::ChoiceCounts);
        const std::array copies{VkBufferCopy{counts_at_, 0, sizeof(gpu::ChoiceCounts)},
                                VkBufferCopy{wanted_at_, sizeof(gpu::ChoiceCounts), read}};
        vkCmdCopyBuffer(commands, data_.handle.get(), choice_read_[slot_].handle.get(),
                        static_cast<std::uint32_t>(copies.size()), copies.data());
    }
    if (feedback_size_[slot_] == 0) return;
    const VkBufferCopy copy{0, 0, requested_feedback()};
    const Buffer& source_buffer = cluster_groups_ > 0 ? cluster_states_ : feedback_;
    vkCmdCopyBuffer(commands, source_buffer.handle.get(), feedback_read_[slot_].handle.get(), 1, &copy);
}

MadeChoice GridFrame::choice_of(const GridPlan& plan, std::size_t slot) const {
    MadeChoice made;
    const std::byte* const from = choice_read_[slot].mapped;
    std::memcpy(&made.counts, from, sizeof(made.counts));
    made.wanted.resize(std::min<std::size_t>(made.counts.wanted, plan.device.pages_read));
    if (!made.wanted.empty())
        std::memcpy(made.wanted.data(), from + sizeof(made.counts),
                    made.wanted.size() * sizeof(gpu::WantedPage));
    made.change_number = plan.device.change_number;
    return made;
}

FrameFeedback GridFrame::feedback_of(const GridPlan& plan, std::size_t slot) const {
    FrameFeedback feedback;
    const VkDeviceSize size = feedback_size_[slot];
    if (size == 0) return feedback;
    if (plan.clusters.on)
        feedback.clusters = plan.clusters.drawn;
    else
        feedback.pages = plan.device.chooses ? chosen_of(plan, choice_of(plan, slot)) : plan.page_indices;
    const std::size_t words =
        plan.device.chooses ? gpu::feedback_words * feedback.pages.size() : size / sizeof(gpu::uint);
    feedback.words.resize(words);
    if (words > 0) std::memcpy(feedback.words.data(), feedback_read_[slot].mapped, words * sizeof(gpu::uint));
    feedback.view = plan.constants;
    return feedback;
}

// Of this frame in rounds; those of the last one stay as they are.
Result<void> GridFrame::reserve_seen(const Gpu& gpu, std::size_t pages) {
    turn_ = 1 - turn_;
    const VkDeviceSize bytes = VkDeviceSize{4} * gpu::accepted_words * std::max<std::size_t>(pages, 64);
    if (seen_[turn_].size >= bytes) return {};
    return replace_buffer(gpu, seen_[turn_], std::max(bytes, 2 * seen_[turn_].size),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                              VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "nodes seen");
}

void GridFrame::remember(const GridPlan& plan) {
    forget();
    before_chosen_ = plan.device.chooses;
    if (plan.clusters.on)
        clusters_before_ = ++clusters_turn_;
    else if (plan.device.chooses)
        pages_before_ = plan.page_room();
    else
        remember_pages(plan.page_indices);
}

void GridFrame::remember_pages(std::span<const PageIndex> pages) {
    for (PageTable& level : before_) level.clear();
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const auto level = static_cast<std::size_t>(pages[i].level);
        if (before_.size() <= level) before_.resize(level + 1);
        before_[level].insert(pages[i].row, pages[i].column, static_cast<gpu::uint>(i));
    }
    pages_before_ = pages.size();
}

// FrameConstants::page_before.
std::vector<gpu::uint> GridFrame::numbers_before(const GridPlan& plan) const {
    std::vector<gpu::uint> numbers(plan.pages.size(), gpu::no_page);
    if (!remembers(plan)) return numbers;
    for (std::size_t i = 0; i < std::min(numbers.size(), plan.page_indices.size()); ++i) {
        const PageIndex& page = plan.page_indices[i];
        if (before_.size() <= static_cast<std::size_t>(page.level)) continue;
        const std::uint32_t found = before_[static_cast<std::size_t>(page.level)].find(page.row, page.column);
        if (found != PageTable::none) numbers[i] = found;
    }
    return numbers;
}

void GridFrame::address(GridPlan& plan) const {
    const DataLayout layout = layout_of(plan);
    gpu::FrameConstants& constants = plan.constants;
    constants.pages = address_words(data_.address + pages_offset);
    constants.row_terms = address_words(data_.address + layout.rows);
    constants.column_terms = address_words(data_.address + layout.columns);
    if (plan.device.on) {
        gpu::PlanTerms& terms = plan.device.terms;
        terms.pages = constants.pages;
        terms.rows = constants.row_terms;
        terms.columns = constants.column_terms;
        terms.numbers = address_words(data_.address + layout.numbers);
    }
    if (plan.device.chooses) address_choice(plan);
    if (plan.clusters.on) {
        constants.clusters.drawn = address_words(data_.address + layout.clusters + cluster_groups_bytes);
        constants.cut.asked = address_words(data_.address + layout.asked);
        constants.cut.groups = address_words(data_.address + layout.clusters);
        constants.cluster_boxes = address_words(data_.address + layout.boxes);
        constants.cluster_states = address_words(cluster_states_.address);
        constants.clusters_turn = clusters_turn_ + 1;
        constants.clusters_before = clusters_before_;
    }
    VkDeviceAddress at = choice_.address;
    constants.live_pages = address_words(at);
    at += 4 * live_pages_words;
    constants.live = address_words(at);
    at += 4 * live_words * page_capacity_;
    constants.accepted = address_words(at);
    at += VkDeviceSize{4} * gpu::accepted_words * page_capacity_;
    constants.edges = address_words(at);
    at += VkDeviceSize{4} * gpu::edges_words * page_capacity_;
    constants.round_pages = address_words(choice_.address + 4 * round_pages_at);
    constants.round_live = address_words(at);
    at += 4 * live_words * page_capacity_;
    for (gpu::uvec2* bits : {&constants.kept, &constants.drawn, &constants.drawn_now}) {
        *bits = address_words(at);
        at += VkDeviceSize{4} * gpu::accepted_words * page_capacity_;
    }
    constants.seen = address_words(seen_[turn_].address);
    if (constants.occlusion != 0 && !plan.clusters.on && remembers(plan))
        constants.seen_before = address_words(seen_[1 - turn_].address);
    constants.page_before = address_words(data_.address + layout.before);
    constants.feedback =
        feedback_size_[slot_] > 0 && !plan.clusters.on ? address_words(feedback_.address) : gpu::uvec2(0U);
}

VkDeviceAddress GridFrame::frame_counts() const {
    static_assert(offsetof(gpu::FrameConstants, first_page) ==
                  offsetof(gpu::FrameConstants, page_count) + sizeof(gpu::uint));
    return data_.address + offsetof(gpu::FrameConstants, page_count);
}

void GridFrame::address_choice(GridPlan& plan) const {
    const DataLayout layout = layout_of(plan);
    gpu::ChoiceTerms& choice = plan.device.choice;
    choice.changes = address_words(data_.address + layout.changes);
    choice.counts = address_words(data_.address + layout.counts);
    choice.wanted = address_words(data_.address + layout.wanted);
    choice.pages = address_words(data_.address + pages_offset);
    choice.numbers = address_words(data_.address + layout.numbers);
    choice.frame_counts = address_words(frame_counts());
    choice.plan_count = address_words(data_.address + layout.terms + offsetof(gpu::PlanTerms, page_count));
    if (plan.constants.occlusion == 0) return;
    choice.page_before = address_words(data_.address + layout.before);
    choice.numbers_now = address_words(numbers_[turn_].address);
    if (remembers(plan)) choice.numbers_before = address_words(numbers_[1 - turn_].address);
}

// What the device makes by itself is not sent.
void GridFrame::fill_choice(const GridPlan& plan) {
    const DataLayout layout = layout_of(plan);
    std::byte* const to = staging_[slot_].mapped;
    choice_terms_ = data_.address + layout.choice;
    counts_at_ = layout.counts;
    wanted_at_ = layout.wanted;
    page_groups_ = layout.counts + offsetof(gpu::ChoiceCounts, groups);
    choice_read_bytes_ = sizeof(gpu::ChoiceCounts) + plan.device.pages_read * sizeof(gpu::WantedPage);
    sent_from_ = layout.terms;
    sent_to_ = layout.sent;
    std::memcpy(to + layout.choice, &plan.device.choice, sizeof(plan.device.choice));
    if (!plan.device.changes.empty())
        std::memcpy(to + layout.changes, plan.device.changes.data(),
                    plan.device.changes.size() * sizeof(gpu::BlockChange));
    std::memset(to + layout.counts, 0, sizeof(gpu::ChoiceCounts));
}

void GridFrame::fill(const GridPlan& plan) {
    const DataLayout layout = layout_of(plan);
    size_ = layout.size;
    const auto copy = [&](VkDeviceSize at, const auto& values) {
        if (!values.empty())
            std::memcpy(staging_[slot_].mapped + at, values.data(), values.size() * sizeof(values[0]));
    };
    clears_seen_ = plan.constants.occlusion != 0 && !plan.clusters.on;
    std::memcpy(staging_[slot_].mapped, &plan.constants, sizeof(plan.constants));
    copy(pages_offset, plan.pages);
    plan_terms_ = plan.device.on ? data_.address + layout.terms : 0;
    planned_parts_ = {{{pages_offset, plan.page_room() * sizeof(gpu::FramePage)},
                       {layout.rows, plan.row_count() * sizeof(gpu::RowTerms)},
                       {layout.columns, plan.column_count() * sizeof(gpu::ColumnTerms)}}};
    if (plan.device.on) {
        std::memcpy(staging_[slot_].mapped + layout.terms, &plan.device.terms, sizeof(plan.device.terms));
        copy(layout.numbers, plan.device.numbers);
    }
    choice_terms_ = 0;
    if (plan.device.chooses) {
        fill_choice(plan);
        cluster_groups_ = 0;
        return;
    }
    copy(layout.rows, plan.row_terms);
    copy(layout.columns, plan.column_terms);
    if (plan.constants.occlusion != 0) copy(layout.before, numbers_before(plan));
    cluster_groups_ = plan.clusters.on ? layout.clusters : 0;
    if (!plan.clusters.on) return;
    constexpr std::array<std::uint32_t, 3> groups{0, 0, 1};  // until the cut is made
    std::memcpy(staging_[slot_].mapped + layout.clusters, groups.data(), sizeof(groups));
    copy(layout.clusters + cluster_groups_bytes, plan.clusters.drawn);
    copy(layout.asked, plan.clusters.asked);
    if (plan.constants.occlusion != 0) copy(layout.boxes, plan.clusters.boxes);
}

void GridFrame::record_upload(VkCommandBuffer commands) const {
    const std::array copies{VkBufferCopy{0, 0, choice_terms_ != 0 ? sizeof(gpu::FrameConstants) : size_},
                            VkBufferCopy{sent_from_, sent_from_, sent_to_ - sent_from_}};
    vkCmdCopyBuffer(commands, staging_[slot_].handle.get(), data_.handle.get(), choice_terms_ != 0 ? 2 : 1,
                    copies.data());
    if (clears_seen_) vkCmdFillBuffer(commands, seen_[turn_].handle.get(), 0, VK_WHOLE_SIZE, 0);
    const VkDeviceSize feedback_size = requested_feedback();
    if (feedback_size > 0) vkCmdFillBuffer(commands, feedback_.handle.get(), 0, feedback_size, 0);
}

void GridFrame::bind(VkCommandBuffer commands, const Pipelines& pipelines, VkPipelineBindPoint point) const {
    vkCmdBindDescriptorSets(commands, point, pipelines.layout.get(), 0, 1, &set_, 0, nullptr);
}

}  // namespace oro
