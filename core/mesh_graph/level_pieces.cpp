#include "core/mesh_graph/level_pieces.h"

#include <algorithm>
#include <numeric>

#include "core/base/parallel.h"
#include "core/mesh_graph/mesh_ground.h"

namespace oro {

void StoredPieces::take_part(const OriginalPart& part, int user) {
    corners_.insert(corners_.end(), part.corners.begin(), part.corners.begin() + part.count);
    parts_.push_back({nullptr, part.triangle, user, static_cast<std::uint8_t>(part.count), part.has_marked});
    end_piece();
}

void StoredPieces::take_whole(std::uint32_t piece, int user) {
    whole_.push_back({piece, user});
    end_piece();
}

// A group of a coarse level may answer for all of the mesh.
void StoredPieces::end_piece() {
    constexpr std::size_t many = 2048;
    if (scratch_ != nullptr && (whole_.size() + parts_.size()) % many == 0) scratch_->drop_pages();
}

void StoredPieces::join(std::span<const StoredPieces> some) {
    std::size_t whole = 0, parts = 0, corners = 0;
    for (const StoredPieces& one : some)
        whole += one.whole_.size(), parts += one.parts_.size(), corners += one.corners_.size();
    whole_.reserve(whole), parts_.reserve(parts), corners_.reserve(corners);
    for (const StoredPieces& one : some) {
        for (const Whole& piece : one.whole_)
            if (piece.user != on_ground) whole_.push_back(piece);
        auto from = one.corners_.begin();
        for (Part part : one.parts_) {
            const auto end = from + part.count;
            part.corners = corners_.data() + corners_.size();
            if (part.user != on_ground) corners_.insert(corners_.end(), from, end), parts_.push_back(part);
            from = end;
        }
    }
}

void LevelPieces::take(std::span<const StoredPieces> handed) {
    handed_.emplace_back(scratch_).join(handed);
}

void LevelPieces::deal_whole(std::size_t users) {
    first_whole_.assign(users + 1, 0);
    for (const StoredPieces& all : handed_)
        for (const StoredPieces::Whole& one : all.whole())
            ++first_whole_[static_cast<std::size_t>(one.user) + 1];
    std::partial_sum(first_whole_.begin(), first_whole_.end(), first_whole_.begin());
    whole_.resize(first_whole_.back());
    whole_count_.assign(users, 0);
    for (StoredPieces& all : handed_) {
        for (const StoredPieces::Whole& one : all.whole()) {
            const auto user = static_cast<std::size_t>(one.user);
            whole_[first_whole_[user] + whole_count_[user]++] = one.piece;
        }
        all.drop_whole();
    }
}

void LevelPieces::deal_parts(std::size_t users) {
    first_part_.assign(users + 1, 0);
    for (const StoredPieces& all : handed_)
        for (const StoredPieces::Part& one : all.parts())
            ++first_part_[static_cast<std::size_t>(one.user) + 1];
    std::partial_sum(first_part_.begin(), first_part_.end(), first_part_.begin());
    parts_.resize(first_part_.back());
    std::vector<std::size_t> next(first_part_.begin(), first_part_.end());
    for (const StoredPieces& all : handed_)
        for (const StoredPieces::Part& one : all.parts())
            parts_[next[static_cast<std::size_t>(one.user)]++] = &one;
}

void LevelPieces::deal(std::size_t users, const NearestTriangles& mesh, int threads) {
    deal_whole(users);
    deal_parts(users);
    in_parallel(static_cast<int>(users), threads, [&](int number) {
        const auto user = static_cast<std::size_t>(number);
        const std::span<const std::uint32_t> whole = whole_of(user);
        std::vector<std::uint32_t> joined(whole.begin(), whole.end());
        join_whole_pieces(mesh, joined);
        whole_count_[user] = joined.size();
        std::copy(joined.begin(), joined.end(),
                  whole_.begin() + static_cast<std::ptrdiff_t>(first_whole_[user]));
    });
}

OriginalPart LevelPieces::part(std::size_t user, std::size_t number) const {
    const StoredPieces::Part& stored = *parts_[first_part_[user] + number];
    OriginalPart part;
    std::copy(stored.corners, stored.corners + stored.count, part.corners.begin());
    part.count = stored.count, part.triangle = stored.triangle, part.has_marked = stored.has_marked;
    return part;
}

}  // namespace oro
