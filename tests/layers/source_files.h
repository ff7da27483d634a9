// The source files of the project, for tests that read them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/test_data.h"

namespace oro::test {

inline bool is_source(const std::filesystem::path& file) {
    static const std::regex ending("\\.(h|hpp|cpp|cc|c|glsl|comp|task|mesh|frag|vert)");
    return std::regex_match(file.extension().string(), ending);
}

inline std::filesystem::path project_folder() {
    return bundled_data().parent_path();
}

// All sources in these folders of the project, and in the folders in them.
inline std::vector<std::filesystem::path> sources_in(std::initializer_list<const char*> folders) {
    std::vector<std::filesystem::path> found;
    for (const char* folder : folders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(project_folder() / folder))
            if (entry.is_regular_file() && is_source(entry.path())) found.push_back(entry.path());
    }
    return found;
}

// What is in a file; one that cannot be read fails the test.
inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    EXPECT_TRUE(stream.good()) << file;
    return text.str();
}

}  // namespace oro::test
