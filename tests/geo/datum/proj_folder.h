// PROJ's files, and a folder that stands for all of them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace oro::test {

// PROJ finds its files only in this folder while it lives.
class ProjFolder {
  public:
    explicit ProjFolder(const std::string& folder) { setenv("PROJ_DATA", folder.c_str(), 1); }
    ~ProjFolder() { unsetenv("PROJ_DATA"); }
    ProjFolder(const ProjFolder&) = delete;
    ProjFolder& operator=(const ProjFolder&) = delete;
};

inline std::optional<std::filesystem::path> proj_file(const std::string& name) {
    for (const char* folder : {"/usr/share/proj", "/usr/local/share/proj"}) {
        if (std::filesystem::exists(std::filesystem::path(folder) / name))
            return std::filesystem::path(folder) / name;
    }
    return std::nullopt;
}

}  // namespace oro::test
