#include "apps/styles/data_folder.h"

#include <sys/auxv.h>

#include <cstdlib>

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

}  // namespace

fs::path data_folder() {
    if (const char* named = std::getenv("OROGRAPH_DATA")) return named;
    return program_file().parent_path().parent_path() / "share" / "orograph";
}

}  // namespace oro
