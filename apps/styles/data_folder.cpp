#include "apps/styles/data_folder.h"

#include <sys/auxv.h>

#include <cstdlib>
#include <utility>

namespace oro {
namespace fs = std::filesystem;

namespace {

// The running program's file. Where /proc is not mounted, the path by which it was started.
fs::path program_file() {
    std::error_code error;
    fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) return program;
    const char* const started_as = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
    if (started_as == nullptr) return {};
    program = fs::canonical(started_as, error);
    return error ? fs::path(started_as) : program;
}

// "": beside the program.
fs::path& folder_that_was_set() {
    static fs::path folder;
    return folder;
}

}  // namespace

void set_data_folder(fs::path folder) {
    folder_that_was_set() = std::move(folder);
}

fs::path data_folder() {
    if (const char* named = std::getenv("OROGRAPH_DATA")) return named;
    if (!folder_that_was_set().empty()) return folder_that_was_set();
    return program_file().parent_path().parent_path() / "share" / "orograph";
}

}  // namespace oro
