// From numbered frames to one file, by ffmpeg.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace oro {

// The ffmpeg of PATH. Errors (usage): there is none.
Result<std::string> ffmpeg_in_path(const std::string& out);

// What a movie is made of: frames 1 to `count` in a folder, by frame_name() with that ending.
struct MovieFrames {
    std::string folder;
    std::string ending;
    std::int64_t count{};
    double fps{};
};
// Writes an MP4 of the frames, with the video format that this ffmpeg takes for it by itself; the file is
// whole or not there. Sides of an odd number of pixels get one black row or column more, which the format
// asks for. Writes into the frames' folder on the way. Errors: what ffmpeg said last; a file that cannot get
// its name.
Result<void> write_movie(const std::string& ffmpeg, const MovieFrames& frames, const std::string& out,
                         bool overwrite);

}  // namespace oro
