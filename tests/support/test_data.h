// Where tests find their files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace oro::test {

// The repository's own data folder.
std::filesystem::path bundled_data();

// A file or folder of the real elevation data beside the repository (../shared/data, or OROGRAPH_TEST_DATA);
// nothing when it is not there. Tests that need it skip with a message: GTEST_SKIP() << "needs " << name.
std::optional<std::filesystem::path> real_data(const std::string& name);

// A new empty folder that is removed when the program ends.
std::filesystem::path scratch_folder();

}  // namespace oro::test
