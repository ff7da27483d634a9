#include "apps/commands/film/movie.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/output/child_process.h"
#include "core/base/file_target.h"
#include "core/base/open_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr const char* unnamed_movie = "film.mp4";

}  // namespace

Result<std::string> ffmpeg_in_path(const std::string& out) {
    const char* const path = std::getenv("PATH");
    const std::string_view all(path != nullptr ? path : "");
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find(':', begin), all.size());
        const fs::path program = fs::path(all.substr(begin, end - begin)) / "ffmpeg";
        std::error_code ignored;
        if (program.is_absolute() && fs::is_regular_file(program, ignored) &&
            access(program.c_str(), X_OK) == 0)
            return program.string();
        begin = end + 1;
    }
    return Error{
        ErrorKind::usage, "--out " + out,
        "needs ffmpeg, which is not in PATH: install it, or name a folder, into which the frames are "
        "drawn"};
}

Result<void> write_movie(const std::string& ffmpeg, const MovieFrames& frames, const std::string& out,
                         bool overwrite) {
    char rate[40];
    std::snprintf(rate, sizeof rate, "%.10g", frames.fps);
    ORO_CHECK(run_program(frames.folder, {ffmpeg,
                                          "-nostdin",
                                          "-y",
                                          "-loglevel",
                                          "error",
                                          "-framerate",
                                          rate,
                                          "-start_number",
                                          "1",
                                          "-i",
                                          "frame-%06d" + frames.ending,
                                          "-frames:v",
                                          std::to_string(frames.count),
                                          "-vf",
                                          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                          "-pix_fmt",
                                          "yuv420p",
                                          "-movflags",
                                          "+faststart",
                                          "-f",
                                          "mp4",
                                          unnamed_movie}));
    const std::string file = (fs::path(frames.folder) / unnamed_movie).string();
    ORO_TRY(OpenFile movie, OpenFile::open(file, OpenFile::Use::read_own));
    ORO_CHECK(movie.sync());
    return give_name(file, out, overwrite);
}

}  // namespace oro
