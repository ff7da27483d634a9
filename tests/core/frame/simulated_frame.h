// What the GPU draws of a frame's plan, on the CPU: shaders/choose/lod_test.comp by hand, and
// shaders/choose/choose.glsl and cull_result.glsl themselves.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/earth/culling.h"
#include "core/frame/frame_plan.h"
#include "core/lod/levels.h"
#include "core/lod/levels_gpu.h"
#include "core/lod/pyramid.h"

namespace oro::gpu {

inline uvec2 device_address(const void* at) {
    const auto address = reinterpret_cast<std::uintptr_t>(at);
    return {static_cast<uint>(address), static_cast<uint>(std::uint64_t{address} >> 32U)};
}
template <class T>
T* at_address(uvec2 address) {
    return reinterpret_cast<T*>(static_cast<std::uintptr_t>(std::uint64_t{address.y} << 32U | address.x));
}

// The shaders' functions, with the buffers that they read by address. `block` of the frame's pages is the
// address of their nodes.
class SimulatedFrame {
  public:
    explicit SimulatedFrame(const GridPlan& plan);

    // A node that is drawn: its page's number in the frame, its own in the page, its edges.
    struct Node {
        uint page;
        uint meshlet;
        uint edges;
        bool is_seen;  // neither the frustum nor the horizon hides it
    };
    std::vector<Node> choose();
    [[nodiscard]] bool is_accepted(uint page, uint meshlet) const {
        return (accepted_[page * accepted_words + meshlet / 32U] >> (meshlet % 32U) & 1U) != 0;
    }

  private:
    [[nodiscard]] static bool acceptable(const FrameConstants& frame, const FramePage& page, uvec2 node);
    void lod_test(uint page_number);

    struct Words {
        explicit Words(uvec2 address) : at(at_address<const uint>(address)) {}
        const uint* at;
    };
    struct PageBlocks {
        explicit PageBlocks(uvec2 address) : at{{at_address<const MeshletBounds>(address)}} {}
        struct Block {
            const MeshletBounds* meshlets;
        };
        Block at[1];
    };
    struct FramePages {
        const FramePage* at;
    };
    struct Counts {
        explicit Counts(uvec2 address) : at(*at_address<FrameCounts>(address)) {}
        FrameCounts& at;
    };
    [[nodiscard]] FramePages frame_pages() const { return {at_address<const FramePage>(FRAME.pages)}; }
    static void atomicAdd(uint& to, uint what) { to += what; }
    static bool sphere_beyond_plane(const vec3& centre, float radius, const vec4& plane) {
        return sphere_beyond_plane_cpu(centre, radius, plane);
    }
    static bool beyond_horizon(const vec3& eye_offset, float eye_angle_rad, float horizon_angle_rad) {
        return beyond_horizon_cpu(eye_offset, eye_angle_rad, horizon_angle_rad);
    }
    FrameConstants FRAME;
// A struct is made by its name and parentheses in GLSL.
#define ChosenNode(cull_result, edges) \
    ChosenNode {                       \
        cull_result, edges             \
    }
#include "shaders/choose/cull_result.glsl"
// Needs what is above.
#include "shaders/choose/choose.glsl"
#undef ChosenNode

    const std::vector<FramePage>& pages_;
    std::vector<uint> accepted_;
    std::vector<bool> live_;
    FrameCounts counts_{};
};

inline SimulatedFrame::SimulatedFrame(const GridPlan& plan)
    : FRAME(plan.constants),
      pages_(plan.pages),
      accepted_(plan.pages.size() * accepted_words, 0U),
      live_(plan.pages.size(), false) {
    FRAME.pages = device_address(pages_.data());
    FRAME.accepted = device_address(accepted_.data());
    FRAME.counts = device_address(&counts_);
    for (uint page = 0; page < pages_.size(); ++page) lod_test(page);
}

inline bool SimulatedFrame::acceptable(const FrameConstants& frame, const FramePage& page, uvec2 node) {
    const MeshletBounds& bounds = PageBlocks(page.block).at[0].meshlets[node.x * meshlets_per_side + node.y];
    const uint quarter = node.x / (meshlets_per_side / 2U) * 2U + node.y / (meshlets_per_side / 2U);
    if ((page.fallback_quarters >> quarter & 1U) != 0U) return bounds.radius >= 0.0F;
    const vec3 centre_view = page.view_from_page * bounds.centre + page.origin_view;
    return node_acceptable(page.level, bounds, centre_view, frame.pixels_per_tangent, frame.corner_tangent,
                           frame.tau_px);
}

inline void SimulatedFrame::lod_test(uint page_number) {
    const FramePage& page = pages_[page_number];
    for (uint lane = 0; lane < meshlets_per_page; ++lane) {
        const uvec2 node(lane / meshlets_per_side, lane % meshlets_per_side);
        if (!acceptable(FRAME, page, node)) continue;
        accepted_[page_number * accepted_words + lane / 32U] |= 1U << (lane % 32U);
        const uvec2 above =
            node / 2U + uvec2(page.quarter / 2U, page.quarter % 2U) * (meshlets_per_side / 2U);
        if (page.parent == no_page || !acceptable(FRAME, pages_.at(page.parent), above))
            live_[page_number] = true;
    }
}

// As terrain.task and cull.comp: the live pages only.
inline std::vector<SimulatedFrame::Node> SimulatedFrame::choose() {
    std::vector<Node> nodes;
    for (uint page = 0; page < pages_.size(); ++page) {
        if (!live_[page]) continue;
        for (uint meshlet = 0; meshlet < meshlets_per_page; ++meshlet) {
            const ChosenNode chosen = choose_node(page, meshlet);
            count_cull_result(chosen.cull_result);
            if (chosen.cull_result != is_not_chosen)
                nodes.push_back({page, meshlet, chosen.edges, chosen.cull_result == is_kept});
        }
    }
    return nodes;
}

}  // namespace oro::gpu

namespace oro::test {

// The pages of a pyramid that is kept elsewhere.
class PyramidPages : public RegionPages {
  public:
    PyramidPages(const HeightField& field, const LevelPyramid& pyramid)
        : RegionPages({field.grid, field.undulation, pyramid.shape, 0}), pyramid_(pyramid) {}

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        return PageRecord(at(page));
    }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override {
        return Error{ErrorKind::failed, "test", "blocks are not kept"};
    }
    [[nodiscard]] const PyramidPage& at(const PageIndex& page) const {
        return pyramid_.levels[static_cast<std::size_t>(page.level)].page(page.row, page.column);
    }

    // Every page is there that `is_there` says so of; a SimulatedFrame finds its nodes.
    [[nodiscard]] Residency residency(const std::function<bool(const PageIndex&)>& is_there = {}) const {
        return [this, is_there](const PageIndex& page) -> std::uint64_t {
            if (is_there && !is_there(page)) return 0;
            return reinterpret_cast<std::uintptr_t>(at(page).nodes.data());
        };
    }

  private:
    const LevelPyramid& pyramid_;
};

// What the GPU draws, its nodes numbered over their levels.
inline std::vector<DrawnNode> drawn_nodes(const GridPlan& plan) {
    constexpr int side = static_cast<int>(gpu::meshlets_per_side);
    std::vector<DrawnNode> nodes;
    for (const gpu::SimulatedFrame::Node& node : gpu::SimulatedFrame(plan).choose()) {
        const PageIndex& page = plan.page_indices[node.page];
        const int meshlet = static_cast<int>(node.meshlet);
        nodes.push_back(
            {page.level, page.row * side + meshlet / side, page.column * side + meshlet % side, node.edges});
    }
    return nodes;
}

}  // namespace oro::test
