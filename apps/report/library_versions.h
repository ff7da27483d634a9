// The versions of libraries that no file's meaning depends on; of those that read data
// geo/sources/library_report.h tells.
#pragma once

#include <string>
#include <vector>

namespace oro {

struct LibraryVersion {
    std::string key;   // in JSON: "zstd"
    std::string name;  // "zstd"
    std::string version;
};

// Of each library the version that runs, or that was compiled in; of Vulkan that of its headers.
std::vector<LibraryVersion> library_versions();
// Those of them whose version CMake has found (package_versions.cpp.in).
std::vector<LibraryVersion> package_versions();

}  // namespace oro
