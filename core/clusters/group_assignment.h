// Which group each triangle of a level goes to, and which vertices have to stay for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/clusters/group_tiling.h"
#include "core/surface/original_surface.h"

namespace oro {

// What each vertex has been through, from level to level. 5 bytes a vertex of the original.
class VertexLocks {
  public:
    explicit VertexLocks(std::size_t vertex_count) : group_(vertex_count), levels_(vertex_count, 0) {}

    // A level: begun, then each corner of each triangle that goes to a group, then ended. What a group made
    // says the same as what it uses: vertices on its border have stayed.
    void begin_level();
    void see(VertexNumber vertex, std::uint32_t group) {
        std::uint32_t& known = group_[vertex];
        if (known == unseen)
            known = group;
        else if (known != group)
            known = shared;
    }
    void end_level();

    // Levels in a row, up to the last, that a vertex was on a border between groups at; at most 2.
    [[nodiscard]] int levels(VertexNumber vertex) const { return levels_[vertex]; }
    // On a border between groups of the last level.
    [[nodiscard]] bool is_locked(VertexNumber vertex) const { return levels_[vertex] != 0; }

    // Vertices that are locked, and those of them that were at the level before, too.
    [[nodiscard]] std::size_t locked() const { return locked_; }
    [[nodiscard]] std::size_t locked_twice() const { return locked_twice_; }

  private:
    static constexpr std::uint32_t unseen = ~std::uint32_t{0};
    static constexpr std::uint32_t shared = unseen - 1;
    std::vector<std::uint32_t> group_;
    std::vector<std::uint8_t> levels_;
    std::size_t locked_{};
    std::size_t locked_twice_{};
};

// The groups of all triangles of a level, part by part. A triangle goes to the tile that its middle lies in,
// but where it has a vertex that was on borders of both levels before: the triangles around such a vertex all
// go to one tile, so that it is on no border now. Vertices of that kind that share a triangle go together.
class GroupAssignment {
  public:
    using Parts = std::span<const std::vector<VertexTriangle>>;

    // in_one: all triangles go to one group. Afterwards `locks` tells of this level.
    GroupAssignment(const OriginalSurface& surface, Parts parts, const GroupTiling& tiling, bool in_one,
                    VertexLocks& locks);

    // Groups are numbered by tile, row by row.
    [[nodiscard]] std::size_t groups() const { return groups_; }
    [[nodiscard]] GroupTile tile(std::size_t group) const {
        return tiles_.empty() ? GroupTile{} : tiles_[group];
    }
    // That a group may make; of any length where all triangles go to one.
    [[nodiscard]] EdgeLimit longest_edges() const {
        return tiles_.empty() ? EdgeLimit{} : tiling_.longest_edges();
    }
    // A group's tile, widened.
    [[nodiscard]] PlaneBox around(std::size_t group) const { return tiling_.widened(tiles_[group]); }
    // Of the triangles of a part.
    [[nodiscard]] std::span<const std::uint32_t> groups_of(std::size_t part) const {
        return std::span(group_).subspan(first_[part], first_[part + 1] - first_[part]);
    }

  private:
    void join_kept(Parts parts, const VertexLocks& locks);
    VertexNumber first_of_kept(VertexNumber vertex);
    void choose_tiles(const OriginalSurface& surface, Parts parts, const VertexLocks& locks);
    void lock_borders(Parts parts, VertexLocks& locks) const;

    GroupTiling tiling_;
    std::size_t groups_{};
    std::vector<GroupTile> tiles_;      // by group; none where all is one
    std::vector<std::uint32_t> group_;  // by triangle, part after part
    std::vector<std::size_t> first_;    // triangle, by part
    // Vertices that must not stay for a third level: one of those that they go together with, of a lower
    // number or itself.
    std::map<VertexNumber, VertexNumber> kept_;
};

}  // namespace oro
