#include "core/base/file_there.h"

#include <filesystem>

namespace oro {
namespace fs = std::filesystem;

bool is_no_answer(const std::error_code& failed) {
    if (!failed) return false;
    for (const std::errc of_the_name :
         {std::errc::no_such_file_or_directory, std::errc::not_a_directory, std::errc::filename_too_long,
          std::errc::permission_denied, std::errc::too_many_symbolic_link_levels})
        if (failed == of_the_name) return false;
    return true;
}

Error no_answer(const std::string& path, const std::error_code& failed) {
    return {ErrorKind::failed, path, "cannot be asked about: " + failed.message()};
}

Result<bool> is_there(const std::string& path) {
    std::error_code failed;
    const bool there = fs::exists(path, failed);
    if (is_no_answer(failed)) return no_answer(path, failed);
    return there;
}

Result<bool> is_same_file(const std::string& path, const std::string& other) {
    std::error_code failed;
    const bool same = fs::equivalent(path, other, failed);
    if (is_no_answer(failed)) return no_answer(path, failed);
    return same;
}

}  // namespace oro
