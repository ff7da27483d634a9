// Places of vertices beside those that are known, for a range coder either way: where walls stand upright,
// floors and eaves are level, and sides come again.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/cluster_file/number_code.h"
#include "core/mesh_file/stored_mesh.h"

namespace oro {

// The sides of triangles that were met last, the last first, whichever way they go.
class RecentSides {
  public:
    static constexpr std::size_t most = 16;
    static constexpr std::int64_t rounded = 3;  // steps that one may be off and be the same

    void add(const LatticeSteps& side) {
        const auto same = std::ranges::find_if(
            sides_, [&](const LatticeSteps& one) { return is_like(one, side, 1) || is_like(one, side, -1); });
        if (same != sides_.end())
            sides_.erase(same);
        else if (sides_.size() == most)
            sides_.pop_back();
        sides_.insert(sides_.begin(), side);
    }
    [[nodiscard]] std::span<const LatticeSteps> all() const { return sides_; }

  private:
    static bool is_like(const LatticeSteps& one, const LatticeSteps& other, std::int64_t way) {
        for (std::size_t i = 0; i < 3; ++i)
            if (std::abs(one[i] - way * other[i]) > rounded) return false;
        return true;
    }
    std::vector<LatticeSteps> sides_;
};

// Which way is up at a place, in whole numbers: the same on every machine. Of WGS84's normal it is off by
// less than 10 um in 10 m.
struct UprightAxes {
    LatticeSteps up;
    std::size_t most{};  // the axis that is the most upright, and the others
    std::size_t one, other;

    explicit UprightAxes(const LatticeSteps& at) {
        // 7067 / 2^20 is a^2 / b^2 - 1.
        constexpr unsigned kept = 10;
        up = {at[0] >> kept, at[1] >> kept, (at[2] + (at[2] * 7067 >> 20U)) >> kept};
        for (std::size_t i = 1; i < 3; ++i)
            if (std::abs(up[i]) > std::abs(up[most])) most = i;
        if (up[most] == 0) up[most] = 1;
        one = (most + 1) % 3, other = (most + 2) % 3;
    }
    // sum / up[most] in whole numbers.
    [[nodiscard]] std::int64_t share(std::int64_t sum) const {
        const std::int64_t of = std::abs(up[most]), half = of / 2, signed_sum = up[most] < 0 ? -sum : sum;
        return signed_sum < 0 ? -((half - signed_sum) / of) : (signed_sum + half) / of;
    }
};

// Differences are coded modulo 2^32 steps; so are places, above the least one.
template <class Coder>
class PlaceCode {
  public:
    PlaceCode(Coder& coder, const LatticeSteps& least) : coder_(coder), least_(least) {}

    // What the vertices of a triangle are met beside: those of it that are known; of one that hangs at a side
    // that side's two ends, and the other triangle's third vertex.
    struct Known {
        std::array<LatticeSteps, 2> corners{};
        std::size_t count{};
        LatticeSteps last{};  // the vertex that was met last; the least place where there is none
        bool hangs{};
        LatticeSteps third{};
    };
    // The place of a new vertex into `at`; `there` is an encoder's. False where a decoder's bytes tell none.
    bool code(const Known& known, const LatticeSteps& there, LatticeSteps& at);
    void add_triangle(const std::array<LatticeSteps, 3>& corners) {
        for (std::size_t i = 0; i < 3; ++i) sides_.add(less(corners[(i + 1) % 3], corners[i]));
    }

  private:
    // The parallelogram's fourth corner; above or below the first or the second corner; a side that is known
    // from one of them on, all but rounding, or nearly; level with the vertex that was met last.
    enum Kind : std::uint32_t { fourth, above_first, above_second, same_side, like_side, level, kinds };
    struct Guess {
        std::uint32_t kind{level};
        LatticeSteps from{};
        std::uint32_t side{};  // of sides_, which way it goes, and from which corner
        bool is_back{};
        std::uint32_t corner{};
    };

    static LatticeSteps less(const LatticeSteps& a, const LatticeSteps& b) {
        return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }
    static std::int64_t wrapped(std::int64_t steps) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(steps)));
    }
    static unsigned width(const LatticeSteps& away) {
        unsigned bits = 0;
        for (const std::int64_t one : away)
            bits += 2U * static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(std::abs(one))));
        return bits;
    }
    [[nodiscard]] bool set_place(const Known& known, Guess& guess) const;
    [[nodiscard]] LatticeSteps away(const Guess& guess, const LatticeSteps& there) const;
    [[nodiscard]] LatticeSteps place(const Guess& guess, const LatticeSteps& away) const;
    [[nodiscard]] Guess best(const Known& known, const LatticeSteps& there) const;
    bool code_guess(const Known& known, Guess& guess);

    Coder& coder_;
    LatticeSteps least_;
    RecentSides sides_;
    std::int64_t height_{};  // of the vertex that was above or below another last, along the upright axis
    std::array<FewNumbers, 3> kind_;
    SmallNumber side_;
    std::array<AdaptiveBit, 2> is_back_, corner_;
    std::array<std::array<NearZero, 3>, kinds + 3> away_;
};

// False where there is no such vertex or side.
template <class Coder>
bool PlaceCode<Coder>::set_place(const Known& known, Guess& guess) const {
    const auto& [first, second] = known.corners;
    switch (guess.kind) {
        case fourth:
            for (std::size_t i = 0; i < 3; ++i) guess.from[i] = first[i] + second[i] - known.third[i];
            return known.hangs;
        case above_first:
            guess.from = first;
            return known.count > 0;
        case above_second:
            guess.from = second;
            return known.count > 1;
        case same_side:
        case like_side:
            if (guess.side >= sides_.all().size() || guess.corner >= known.count) return false;
            for (std::size_t i = 0; i < 3; ++i)
                guess.from[i] = known.corners[guess.corner][i] +
                                (guess.is_back ? -sides_.all()[guess.side][i] : sides_.all()[guess.side][i]);
            return true;
        case level:
            guess.from = known.last;
            return true;
        default:
            return false;
    }
}

template <class Coder>
LatticeSteps PlaceCode<Coder>::away(const Guess& guess, const LatticeSteps& there) const {
    LatticeSteps way = less(there, guess.from);
    for (std::int64_t& one : way) one = wrapped(one);
    if (guess.kind == fourth || guess.kind == same_side || guess.kind == like_side) return way;
    const UprightAxes axes(guess.from);
    const auto& [up, most, one, other] = axes;
    if (guess.kind == level)
        return {way[one], way[other],
                wrapped(way[most] + axes.share(up[one] * way[one] + up[other] * way[other]))};
    return {wrapped(way[most] - height_), wrapped(way[one] - axes.share(way[most] * up[one])),
            wrapped(way[other] - axes.share(way[most] * up[other]))};
}

// The inverse.
template <class Coder>
LatticeSteps PlaceCode<Coder>::place(const Guess& guess, const LatticeSteps& away) const {
    LatticeSteps way = away;
    if (guess.kind == level || guess.kind == above_first || guess.kind == above_second) {
        const UprightAxes axes(guess.from);
        const auto& [up, most, one, other] = axes;
        if (guess.kind == level) {
            way[one] = away[0], way[other] = away[1];
            way[most] = away[2] - axes.share(up[one] * way[one] + up[other] * way[other]);
        } else {
            way[most] = wrapped(away[0] + height_);
            way[one] = away[1] + axes.share(way[most] * up[one]);
            way[other] = away[2] + axes.share(way[most] * up[other]);
        }
    }
    LatticeSteps at;
    for (std::size_t i = 0; i < 3; ++i)
        at[i] = least_[i] + static_cast<std::uint32_t>(guess.from[i] + way[i] - least_[i]);
    return at;
}

// An encoder's: the one whose differences take the fewest bits.
template <class Coder>
typename PlaceCode<Coder>::Guess PlaceCode<Coder>::best(const Known& known, const LatticeSteps& there) const {
    Guess found;
    unsigned least_bits = ~0U;
    const auto try_one = [&](Guess guess, unsigned bits) {
        if (bits < least_bits) least_bits = bits, found = guess;
    };
    // What each kind takes besides.
    constexpr unsigned of_level = 4, of_side = 2;
    for (const Kind kind : {level, fourth, above_first, above_second})
        if (Guess guess{kind}; set_place(known, guess))
            try_one(guess, (kind == level ? of_level : 0) + width(away(guess, there)));
    for (std::uint32_t side = 0; side < sides_.all().size(); ++side)
        for (std::uint32_t corner = 0; corner < known.count; ++corner)
            for (const bool is_back : {false, true}) {
                LatticeSteps off = less(there, known.corners[corner]);
                bool is_same = true;
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::int64_t step = sides_.all()[side][i];
                    off[i] = wrapped(is_back ? off[i] + step : off[i] - step);
                    is_same = is_same && std::abs(off[i]) <= RecentSides::rounded;
                }
                try_one({is_same ? same_side : like_side, {}, side, is_back, corner},
                        of_side + static_cast<unsigned>(std::bit_width(side)) + width(off));
            }
    return found;
}

template <class Coder>
bool PlaceCode<Coder>::code_guess(const Known& known, Guess& guess) {
    constexpr std::uint32_t bits = 3;
    if (known.count > 0) guess.kind = kind_[known.hangs ? 2 : known.count - 1].code(coder_, bits, guess.kind);
    if (guess.kind == same_side || guess.kind == like_side) {
        const std::size_t how = known.hangs ? 1 : 0;
        guess.side = side_.code(coder_, guess.side);
        guess.is_back = coder_.bit(is_back_[how], guess.is_back);
        if (known.count > 1) guess.corner = coder_.bit(corner_[how], guess.corner == 1) ? 1 : 0;
    }
    return set_place(known, guess);
}

template <class Coder>
bool PlaceCode<Coder>::code(const Known& known, const LatticeSteps& there, LatticeSteps& at) {
    Guess guess;
    if constexpr (Coder::writes) guess = best(known, there);
    if (!code_guess(known, guess)) return false;
    LatticeSteps off{};
    if constexpr (Coder::writes) off = away(guess, there);
    const std::size_t how = guess.kind != level ? guess.kind : level + (known.hangs ? 3 : known.count);
    for (std::size_t i = 0; i < 3; ++i)
        off[i] = away_[how][i].code(coder_, static_cast<std::int32_t>(off[i]));
    at = place(guess, off);
    if (guess.kind == above_first || guess.kind == above_second) height_ = wrapped(off[0] + height_);
    return true;
}

}  // namespace oro
