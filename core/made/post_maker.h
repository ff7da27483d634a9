// Who makes posts of made terrain in the place of the threads that ask for them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/made/made_rule.h"

namespace oro {

// Heights of posts row by row, as made_row_coarse_heights() has them: of the terrain, and of its coarse
// octaves where these are asked for.
struct MadeSteps {
    std::span<const std::int32_t> all, coarse;
};

// As coarse octaves: they are not asked for.
inline constexpr std::uint32_t no_coarse_octaves = 0xffffffffU;

// Makes posts of fbm elsewhere, with the same bits: by a GPU (render/made/gpu_post_maker.h).
class MadePostMaker {
  public:
    virtual ~MadePostMaker() = default;
    // Of all rows and columns at such places, 1 of each at least. coarse_octaves: 0 to the rule's. What it
    // gives is there until it is asked again. Nothing: not on this thread, not so many, not this kind of
    // terrain, or the device failed; who asks makes them then.
    virtual std::optional<MadeSteps> make(const gpu::MadeRule& rule, std::span<const MadeRow> rows,
                                          std::span<const MadeColumn> columns,
                                          std::uint32_t coarse_octaves) = 0;
};

}  // namespace oro
