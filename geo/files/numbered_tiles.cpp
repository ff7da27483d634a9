#include "geo/files/numbered_tiles.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace oro {
namespace fs = std::filesystem;

namespace {

bool is_number(const std::string& name) {
    return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

Result<void> check_holds_tiles_alone(const std::string& folder, const std::string& extension,
                                     const std::string& index, const std::vector<std::string>& also) {
    const int least = also.empty() ? 2 : 1, deepest = also.empty() ? 2 : 3;
    std::error_code failed;
    for (fs::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const fs::path name = entry->path().filename();
        std::error_code unknown;
        const bool is_folder = entry->symlink_status(unknown).type() == fs::file_type::directory;
        const int depth = entry.depth();
        const bool is_ours =
            is_folder
                ? depth < deepest && (is_number(name.string()) ||
                                      (depth == 0 && std::ranges::find(also, name.string()) != also.end()))
                : (depth == 0 && name == index) ||
                      (depth >= least && depth <= deepest && name.extension() == extension &&
                       is_number(name.stem().string()));
        if (!is_ours)
            return Error{ErrorKind::failed, folder,
                         "holds " + fs::relative(entry->path(), folder, unknown).string() +
                             ", which is no tile: it is not replaced"};
    }
    if (failed) return Error{ErrorKind::failed, folder, "cannot be read: " + failed.message()};
    return {};
}

}  // namespace oro
