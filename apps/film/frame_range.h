// Which frames of a film are drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace oro {

// Numbers of frames are written with six digits.
inline constexpr std::int64_t most_frames = 999'999;

// The number of frames of a film: one at its beginning, and one each 1 / fps seconds as long as it lasts.
// Errors: more than most_frames (usage).
Result<std::int64_t> frame_count(double duration_s, double fps);

// Frames first to last, counted from 1, and of these every `shards`th from number `shard` on.
struct FrameRange {
    std::int64_t first{1};
    std::int64_t last{};
    std::int64_t shard{1};
    std::int64_t shards{1};

    [[nodiscard]] bool holds(std::int64_t frame) const {
        return frame >= first && frame <= last && (frame - 1) % shards == shard - 1;
    }
};
// frames: "" or "120:240", either number may be left out; shard: "" or "2/4". Errors (usage): text that is
// none, numbers that there are not.
Result<FrameRange> frame_range(const std::string& frames, const std::string& shard, std::int64_t count);

// "frame-000012.png"
std::string frame_name(std::int64_t frame, const std::string& ending);

}  // namespace oro
