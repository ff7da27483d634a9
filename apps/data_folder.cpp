#include "apps/data_folder.h"

#include <cstdlib>

namespace oro {

std::filesystem::path data_folder() {
    if (const char* named = std::getenv("OROGRAPH_DATA")) return named;
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path() / "share" / "orograph";
}

}  // namespace oro
