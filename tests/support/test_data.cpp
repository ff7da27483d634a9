#include "tests/support/test_data.h"

#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace oro::test {
namespace fs = std::filesystem;

fs::path bundled_data() { return fs::path(OROGRAPH_SOURCE_DIR) / "data"; }

std::optional<fs::path> real_data(const std::string& name) {
    const char* const named = std::getenv("OROGRAPH_TEST_DATA");
    const fs::path folder = named ? fs::path(named) : fs::path(OROGRAPH_SOURCE_DIR) / ".." / "shared" / "data";
    const fs::path file = folder / name;
    if (!fs::exists(file)) return std::nullopt;
    return fs::canonical(file);
}

fs::path scratch_folder() {
    struct Folders {
        std::mutex mutex;
        std::vector<fs::path> made;
        ~Folders() {
            std::error_code ignored;
            for (const fs::path& folder : made) fs::remove_all(folder, ignored);
        }
    };
    static Folders folders;
    std::string pattern = (fs::temp_directory_path() / "orograph-test-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no scratch folder at " + pattern);
    const std::lock_guard lock(folders.mutex);
    folders.made.emplace_back(pattern);
    return pattern;
}

}  // namespace oro::test
