#include "apps/film/frame_range.h"

#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"

namespace oro {
namespace {

bool read_number(std::string_view text, std::int64_t& value) {
    return text.empty() || (text.front() >= '0' && text.front() <= '9' && read_whole(text, value));
}

}  // namespace

Result<std::int64_t> frame_count(double duration_s, double fps) {
    // What lacks a millionth of a frame is one: 1 / 3 s at 30 frames a second has 11.
    const double frames = std::floor(duration_s * fps + 1e-6) + 1.0;
    if (frames > static_cast<double>(most_frames)) {
        char text[80];
        std::snprintf(text, sizeof text, "makes %.0f frames, more than %lld", frames,
                      static_cast<long long>(most_frames));
        return refused("--fps", "", text);
    }
    return static_cast<std::int64_t>(frames);
}

Result<FrameRange> frame_range(const std::string& frames, const std::string& shard, std::int64_t count) {
    FrameRange range;
    range.last = count;
    const std::string_view all(frames), part(shard);
    if (!frames.empty()) {
        const std::size_t colon = all.find(':');
        if (colon == std::string_view::npos || !read_number(all.substr(0, colon), range.first) ||
            !read_number(all.substr(colon + 1), range.last))
            return refused("--frames", frames, "must be FIRST:LAST, e.g. 121:240");
        if (range.first < 1 || range.last < range.first || range.last > count)
            return refused("--frames", frames,
                           "the film has frames 1 to " + std::to_string(count) +
                               ", and the first must not come after the last");
    }
    if (!shard.empty()) {
        const std::size_t slash = part.find('/');
        range.shard = range.shards = 0;
        if (slash == std::string_view::npos || !read_number(part.substr(0, slash), range.shard) ||
            !read_number(part.substr(slash + 1), range.shards) || range.shard < 1 ||
            range.shard > range.shards)
            return refused("--shard", shard, "must be NUMBER/COUNT, the number from 1 to the count: 2/4");
    }
    return range;
}

std::string frame_name(std::int64_t frame, const std::string& ending) {
    char text[40];
    std::snprintf(text, sizeof text, "frame-%06lld", static_cast<long long>(frame));
    return text + ending;
}

}  // namespace oro
