// Groups of a cluster graph that were read, and where their clusters are: as many as a budget of memory
// allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/cluster_file/group_code.h"
#include "core/earth/culling.h"
#include "core/earth/ellipsoid.h"

namespace oro {

// Where a cluster's triangles are, all of them: for culling, and to find what covers it.
struct ClusterReach {
    Ecef centre;
    double radius_m;
    HorizonCone horizon;
    // A box around `centre` that holds the same: its half axes along ECEF, east, north and up there.
    glm::mat3 half_axes_m;
    std::int32_t first_row, last_row, first_column, last_column;  // posts of the region
};

// The one owner of what was read. What the frame has used stays. Of the rest those least recently used give
// way as soon as all together take more than they may. So what is here takes no more than that, or than what
// one frame uses. Where no frame is ever begun, nothing gives way.
//
// For one thread, but for what says otherwise. What it points to is good until the next frame begins, if the
// frame has used it.
class GroupCache {
  public:
    static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

    // Once, before anything else. Numbers of the whole graph; leaves: of its clusters.
    void make_places(std::size_t groups, std::size_t clusters, std::uint32_t leaves);
    void hold_at_most(std::uint64_t bytes) { most_bytes_ = bytes; }
    // From here on groups count as used by another frame: those of earlier ones may give way.
    // What the last frame hid is the first of them.
    void begin_frame();
    // Groups that other ground hides, as far as is known, in the place of those told before. Any numbers: of
    // a cluster that nothing made or uses, no_group.
    void mark_occluded(std::vector<std::uint32_t> groups) { hidden_ = std::move(groups); }
    // Lets go of what the frame has not used, as far as there is too much of it.
    void end_frame() { evict_unused(0); }

    // Null where it is not here. The second is used by the frame.
    [[nodiscard]] const GroupPart* find(std::uint32_t group) const { return parts_[group].get(); }
    const GroupPart* use(std::uint32_t group);
    // The same for any thread, beside the one that uses the rest: whatever gives way, this stays.
    [[nodiscard]] std::shared_ptr<const GroupPart> share(std::uint32_t group) const;
    // A group that was read is used by the frame. One that is here already stays as it is.
    const GroupPart* put(std::uint32_t group, std::unique_ptr<GroupPart> part);

    // Null where nobody has found out, or it gave way with its group.
    [[nodiscard]] const ClusterReach* reach(std::uint32_t cluster) const { return reaches_[cluster].get(); }
    // The group that a cluster's reach is kept with: its maker, and of a leaf the group that uses it.
    // no_group: none that was read.
    [[nodiscard]] std::uint32_t keeper(std::uint32_t cluster, std::uint32_t maker) const {
        return maker == no_group ? users_[cluster] : maker;
    }
    // Where that group is here, it is used by the frame, and the reach is kept with it. (A graph without
    // groups keeps those of its leaves.)
    void put_reach(std::uint32_t cluster, std::uint32_t maker, const ClusterReach& reach);

    [[nodiscard]] std::size_t size() const { return size_; }
    // Of all that is here. (The graph's own tables are not counted: they are there whatever is read.)
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t most_bytes() const { return most_bytes_; }

  private:
    // A group that is here is one of a ring: those that give way first come first, after the ring's own
    // place, which is behind the last group's.
    struct Place {
        std::uint64_t used;  // frame
        std::uint32_t before, after;
    };
    [[nodiscard]] std::uint32_t ring() const { return static_cast<std::uint32_t>(parts_.size()); }
    void put_before(std::uint32_t next, std::uint32_t group);
    void take_out(std::uint32_t group);
    // Lets others give way until there is room for so much more, or no other can.
    void evict_unused(std::uint64_t more);
    void drop(std::uint32_t group);
    void drop_reach(std::uint32_t cluster);

    mutable std::mutex mutex_;                             // of parts_: other threads share them
    std::vector<std::shared_ptr<const GroupPart>> parts_;  // of each group; null: it is not here
    std::vector<Place> places_;                            // of each, and the ring's own
    std::vector<std::unique_ptr<ClusterReach>> reaches_;   // of each cluster, likewise
    std::vector<std::uint32_t> users_;  // of each leaf: the group that uses it, once that was read
    std::vector<std::uint32_t> hidden_;
    std::size_t size_{};
    std::uint64_t frame_{};
    std::uint64_t bytes_{};
    std::uint64_t most_bytes_{no_limit};
};

// What a group takes while it is held, without the reach of its clusters; and what one reach takes.
[[nodiscard]] std::uint64_t held_bytes(const GroupPart& part);
inline constexpr std::uint64_t held_reach_bytes = sizeof(ClusterReach) + 16;  // beside it: the allocator's

}  // namespace oro
