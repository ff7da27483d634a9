#include "render/shading/caster_buffers.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "render/pipelines/shading_pipelines.h"
#include "shaders/shared_places.h"

namespace oro {
namespace {

constexpr VkBufferUsageFlags on_device =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
constexpr std::uint32_t groups_a_page = 4;  // of caster_heights.comp

VkDeviceSize aligned(VkDeviceSize size) {
    return (size + 15) / 16 * 16;
}

// Behind the shares of all pixels (shares.comp): a count, three numbers of workgroups; then pixels.
constexpr std::array<std::uint32_t, 4> empty_list{0, 0, 1, 1};
constexpr VkDeviceSize groups_at = sizeof(std::uint32_t);
VkDeviceSize list_at(VkExtent2D extent) {
    return aligned(VkDeviceSize{extent.width} * extent.height * sizeof(float));
}

VkDeviceSize bytes_of_shares(VkExtent2D extent) {
    return 2 * list_at(extent) + sizeof(empty_list);
}

// Towards the sun in ECEF, in steps of 0.0005: an eye that moves changes it little, and which nodes are
// gentle (caster_heights.comp) has room for 0.0028 radians.
glm::ivec3 sun_roughly(const gpu::FrameConstants& constants) {
    const gpu::vec2 latitude = constants.eye_post.latitude, meridian = constants.eye_meridian;
    const gpu::vec3 sun = constants.style.sun_enu;
    const float out = latitude.x * sun.z - latitude.y * sun.y, east = sun.x;
    const gpu::vec3 ecef(meridian.x * out - meridian.y * east, meridian.y * out + meridian.x * east,
                         latitude.y * sun.z + latitude.x * sun.y);
    return glm::ivec3(glm::round(2000.0F * ecef));
}

struct CasterLayout {
    VkDeviceSize pages, table, size;
};
CasterLayout layout_of(const CasterPlan& plan) {
    const VkDeviceSize pages = aligned(sizeof(gpu::FrameCasters));
    const VkDeviceSize table = aligned(pages + plan.pages.size() * sizeof(gpu::CasterPage));
    return {pages, table, aligned(table + plan.table.size() * sizeof(gpu::uint))};
}

void wait(VkCommandBuffer commands, VkPipelineStageFlags2 stage, VkAccessFlags2 access,
          VkPipelineStageFlags2 next = 0, VkAccessFlags2 use = 0) {
    memory_barrier(commands, stage, access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | next,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | use);
}
void wait_for_shaders(VkCommandBuffer commands) {
    wait(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

// Lines for every second pixel of every second row; then the others are looked at, and those that need lines
// have them, too.
void record_sun_shares(VkCommandBuffer commands, const std::array<OwnedPipeline, 5>& pipelines,
                       VkBuffer shares, VkExtent2D extent, const ShareOptions& how) {
    const std::array<std::size_t, 3> programs = share_programs(how);
    const auto bind = [&](std::size_t turn) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines[programs[turn]].get());
    };
    const auto dispatch = [&](std::size_t turn) {
        constexpr std::uint32_t side_px = 16;
        bind(turn);
        vkCmdDispatch(commands, (extent.width + side_px - 1) / side_px,
                      (extent.height + side_px - 1) / side_px, 1);
    };
    const VkDeviceSize list = list_at(extent);
    // A first turn that is a program of its own does this itself.
    if (how.both_turns_in_one) {
        vkCmdUpdateBuffer(commands, shares, list, sizeof(empty_list), empty_list.data());
        wait(commands, VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
             VK_ACCESS_2_TRANSFER_WRITE_BIT);
    }
    dispatch(0);
    wait_for_shaders(commands);
    dispatch(1);
    wait(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
         VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    bind(2);
    vkCmdDispatchIndirect(commands, shares, list + groups_at);
    wait_for_shaders(commands);
}

void dispatch_over_pixels(VkCommandBuffer commands, const OwnedPipeline& pipeline, std::uint32_t width_px,
                          std::uint32_t height_px) {
    constexpr std::uint32_t side_px = 8;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    vkCmdDispatch(commands, (width_px + side_px - 1) / side_px, (height_px + side_px - 1) / side_px, 1);
}

}  // namespace

Result<void> SharedShares::reserve(const Gpu& gpu, const FramePlan& plan, const gpu::FrameStyle& style) {
    is_on_ = style.shadows != 0 && plan.grids.size() > 1 &&
             std::ranges::any_of(plan.grids, [](const GridPlan& grid) { return grid.casters.for_shadows; });
    if (!is_on_) return {};
    const VkExtent2D extent{plan.view.width_px(), plan.view.height_px()};
    const VkDeviceSize pixels = VkDeviceSize{extent.width} * extent.height;
    if (shares_.size >= pixels * sizeof(float)) return {};
    ORO_CHECK(replace_buffer(gpu, places_, pixels * sizeof(gpu::CastPlace), on_device, MemoryKind::device,
                             "places in shadow"));
    ORO_CHECK(replace_buffer(gpu, of_one_grid_, bytes_of_shares(extent), on_device, MemoryKind::device,
                             "sun shares of one grid"));
    return replace_buffer(gpu, shares_, pixels * sizeof(float), on_device, MemoryKind::device,
                          "sun shares of all grids");
}

void SharedShares::record_clear(VkCommandBuffer commands) const {
    constexpr std::uint32_t one = 0x3f800000;  // as a float
    vkCmdFillBuffer(commands, shares_.handle.get(), 0, VK_WHOLE_SIZE, one);
    wait(commands, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

Result<void> CasterBuffers::reserve(const Gpu& gpu, const GridPlan& frame,
                                    const gpu::FrameConstants& constants) {
    const CasterPlan& plan = frame.casters;
    const auto grow = [&](Buffer& buffer, VkDeviceSize bytes, const char* name) -> Result<void> {
        if (buffer.size >= bytes) return {};
        made_.clear();
        return replace_buffer(gpu, buffer, std::max(bytes, 2 * buffer.size), on_device, MemoryKind::device,
                              name);
    };
    const VkDeviceSize bytes = layout_of(plan).size;
    ORO_CHECK(grow(data_, bytes, "casters"));
    if (staging_[slot_].size < bytes) {
        ORO_TRY(staging_[slot_], create_buffer(gpu, data_.size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                               MemoryKind::upload, "casters staging"));
    }
    ORO_CHECK(
        grow(nodes_, plan.pages.size() * gpu::meshlets_per_page * sizeof(gpu::CasterNode), "casters' nodes"));
    if (opens_)
        ORO_CHECK(grow(openness_, frame.pages.size() * gpu::open_corners * gpu::open_corners * sizeof(float),
                       "openness"));
    width_px_ = constants.width_px;
    height_px_ = constants.height_px;
    if (casts_ && !is_joined_)
        ORO_CHECK(grow(sun_shares_, bytes_of_shares({width_px_, height_px_}), "sun shares"));
    return {};
}

// What nodes and openness follow from: the casters as they are sent, then whose heights they are and of which
// pages, and where the sun is over them. Heights stay where they are, and the same place holds others only as
// another page.
void CasterBuffers::describe(const GridPlan& frame, const gpu::FrameCasters& casters,
                             const gpu::FrameConstants& constants) {
    const CasterPlan& plan = frame.casters;
    const CasterLayout layout = layout_of(plan);
    wanted_.assign(layout.size, std::byte{});
    const auto put = [&](VkDeviceSize at, const void* values, std::size_t bytes) {
        if (bytes > 0) std::memcpy(wanted_.data() + at, values, bytes);
    };
    put(0, &casters, sizeof(casters));
    put(layout.pages, plan.pages.data(), plan.pages.size() * sizeof(gpu::CasterPage));
    put(layout.table, plan.table.data(), plan.table.size() * sizeof(gpu::uint));
    const auto add = [&](const auto& value) {
        wanted_.resize(wanted_.size() + sizeof(value));
        std::memcpy(wanted_.data() + wanted_.size() - sizeof(value), &value, sizeof(value));
    };
    add(frame.heights);
    add(casts_);
    if (casts_) add(sun_roughly(constants));
    if (opens_)
        for (const gpu::FramePage& page : frame.pages) {
            add(page.block);
            add(page.level);
            add(page.first_row);
            add(page.first_column);
        }
    size_ = layout.size;
    is_new_ = frame.heights == 0 || wanted_ != made_;
}

Result<void> CasterBuffers::prepare(const Gpu& gpu, const ShareOptions& how, Pipelines& pipelines,
                                    const GridPlan& frame, const SharedShares& shared, std::size_t slot,
                                    gpu::FrameConstants& constants) {
    slot_ = slot;
    const CasterPlan& plan = frame.casters;
    const gpu::FrameStyle& style = constants.style;
    const bool there = !plan.pages.empty();
    casts_ = there && style.shadows != 0 && plan.for_shadows;
    opens_ = there && style.sky_openness != 0 && plan.for_openness;
    is_joined_ = shared.is_on() && (casts_ || !frame.pages.empty());
    on_net_ = constants.has_net != 0;
    on_clusters_ = constants.clusters.on != 0;
    how_ = how;
    constants.casters = {};
    if (!any()) return {};
    ORO_CHECK(add_cast_pipelines(gpu, pipelines));
    ORO_CHECK(is_joined_ ? add_joined_pipelines(gpu, how, on_net_, casts_, pipelines)
                         : add_share_pipelines(gpu, how, on_net_, on_clusters_, pipelines));
    ORO_CHECK(reserve(gpu, frame, constants));
    const CasterLayout layout = layout_of(plan);
    gpu::FrameCasters casters{};
    casters.own = plan.frame;
    casters.own.openness = address_words(openness_.address);
    const Buffer& shares = is_joined_ ? shared.of_one_grid() : sun_shares_;
    shares_ = shares.handle.get();
    casters.own.sun_shares = address_words(shares.address);
    casters.own.pages = address_words(data_.address + layout.pages);
    casters.own.table = address_words(data_.address + layout.table);
    casters.own.nodes = address_words(nodes_.address);
    casters.shown_shares = is_joined_ ? address_words(shared.shares()) : casters.own.sun_shares;
    casters.places = address_words(shared.places());
    describe(frame, casters, constants);
    if (is_new_) std::memcpy(staging_[slot_].mapped, wanted_.data(), size_);
    constants.casters = address_words(data_.address);
    pages_ = static_cast<std::uint32_t>(plan.pages.size());
    frame_pages_ = static_cast<std::uint32_t>(frame.pages.size());
    return {};
}

void CasterBuffers::record_casters(VkCommandBuffer commands, const Pipelines& pipelines) {
    if (!any() || !is_new_) return;
    const auto dispatch = [&](const OwnedPipeline& pipeline, std::uint32_t groups) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
        vkCmdDispatch(commands, std::min(groups, gpu::groups_per_row),
                      (groups + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
    };
    const VkBufferCopy copy{0, 0, size_};
    vkCmdCopyBuffer(commands, staging_[slot_].handle.get(), data_.handle.get(), 1, &copy);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    if (casts_) dispatch(pipelines.caster_heights, groups_a_page * pages_);
    if (opens_) dispatch(pipelines.openness, gpu::open_groups_a_page * frame_pages_);
    wait_for_shaders(commands);
    made_.swap(wanted_);
}

void CasterBuffers::record_places(VkCommandBuffer commands, const Pipelines& pipelines) const {
    if (!is_joined_ || frame_pages_ == 0) return;
    dispatch_over_pixels(commands, pipelines.cast_places[on_net_ ? 1 : 0], width_px_, height_px_);
    wait_for_shaders(commands);
}

void CasterBuffers::record_shares(VkCommandBuffer commands, const Pipelines& pipelines) const {
    if (!casts_) return;
    const auto& programs = is_joined_ ? pipelines.joined_shares[on_net_ ? 1 : 0]
                                      : pipelines.sun_shares[on_clusters_ ? 2
                                                             : on_net_    ? 1
                                                                          : 0];
    // What another grid's were for is done with.
    if (is_joined_)
        memory_barrier(commands,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT |
                           VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                           VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    record_sun_shares(commands, programs, shares_, {width_px_, height_px_}, how_);
    if (!is_joined_) return;
    dispatch_over_pixels(commands, pipelines.join_shares, width_px_, height_px_);
    wait_for_shaders(commands);
}

}  // namespace oro
