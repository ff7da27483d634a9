#include "apps/library/library_data.h"

#include <dlfcn.h>

#include <filesystem>

#include "apps/styles/data_folder.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// "" for none.
fs::path folder_beside_library() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&find_library_data), &info) == 0 || info.dli_fname == nullptr)
        return {};
    std::error_code error;
    const fs::path library = fs::canonical(info.dli_fname, error);
    if (error) return {};
    constexpr int most_folders_up = 4;
    fs::path folder = library.parent_path();
    for (int up = 0; up < most_folders_up && folder.has_relative_path(); ++up) {
        folder = folder.parent_path();
        fs::path data = folder / "share" / "orograph";
        if (fs::is_directory(data, error)) return data;
    }
    return {};
}

}  // namespace

void find_library_data() {
    static const bool is_found = [] {
        if (fs::path folder = folder_beside_library(); !folder.empty()) set_data_folder(std::move(folder));
        return true;
    }();
    (void)is_found;
}

}  // namespace oro
