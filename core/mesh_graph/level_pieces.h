// What the groups of a level of a mesh's graph answer for, between two of the builder's steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/base/scratch_memory.h"
#include "core/mesh_graph/original_pieces.h"

namespace oro {

// Pieces that went to users, in as many bytes as they need: 8, or for a part of a triangle 24 and 24 for each
// corner. They lie in `scratch`; null: in memory.
class StoredPieces final : public PieceTaker {
  public:
    struct Whole {
        std::uint32_t piece;
        int user;
    };
    struct Part {
        const glm::dvec3* corners{};
        std::uint32_t triangle{};
        int user{};
        std::uint8_t count{};
        bool has_marked{};
    };
    explicit StoredPieces(ScratchMemory* scratch)
        : scratch_(scratch),
          whole_(array_memory(scratch)),
          parts_(array_memory(scratch)),
          corners_(array_memory(scratch)) {}

    void take_whole(std::uint32_t piece, int user) override;
    void take_part(const OriginalPart& part, int user) override;
    // All of some, but for what lies on the ground. Nothing is taken after it: parts know where corners are.
    void join(std::span<const StoredPieces> some);
    void drop_whole() { whole_ = std::pmr::vector<Whole>(array_memory(scratch_)); }

    [[nodiscard]] std::span<const Whole> whole() const { return whole_; }
    // Of those that were taken, corners are none before join().
    [[nodiscard]] std::span<const Part> parts() const { return parts_; }

  private:
    void end_piece();
    ScratchMemory* scratch_;
    std::pmr::vector<Whole> whole_;
    std::pmr::vector<Part> parts_;
    std::pmr::vector<glm::dvec3> corners_;
};

// First take() what the groups of the level below hand on, then deal() it to users; then ask for that of
// each.
class LevelPieces {
  public:
    explicit LevelPieces(ScratchMemory* scratch)
        : scratch_(scratch), whole_(array_memory(scratch)), parts_(array_memory(scratch)) {}

    // After what was taken before.
    void take(std::span<const StoredPieces> handed);
    // users: groups that answer from here on. Pieces that are all that a block or a node has are joined.
    void deal(std::size_t users, const NearestTriangles& mesh, int threads);

    [[nodiscard]] std::span<const std::uint32_t> whole_of(std::size_t user) const {
        return std::span(whole_).subspan(first_whole_[user], whole_count_[user]);
    }
    [[nodiscard]] std::size_t parts_of(std::size_t user) const {
        return first_part_[user + 1] - first_part_[user];
    }
    [[nodiscard]] OriginalPart part(std::size_t user, std::size_t number) const;

  private:
    void deal_parts(std::size_t users);
    void deal_whole(std::size_t users);

    ScratchMemory* scratch_;
    std::vector<StoredPieces> handed_;
    // User after user; of whole ones there may be fewer than there is room for.
    std::pmr::vector<std::uint32_t> whole_;
    std::pmr::vector<const StoredPieces::Part*> parts_;
    std::vector<std::size_t> first_whole_, whole_count_, first_part_;  // by user; first: and the end
};

}  // namespace oro
