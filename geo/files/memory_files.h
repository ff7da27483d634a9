// Files in memory that GDAL opens by their names.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace oro {

// A folder of GDAL's file system in memory, which no other one's files are in. It goes with what it holds.
class MemoryFiles {
  public:
    MemoryFiles();
    ~MemoryFiles();
    MemoryFiles(const MemoryFiles&) = delete;
    MemoryFiles& operator=(const MemoryFiles&) = delete;

    // Puts a file there (`name` has no folder), and gives the name by which GDAL opens it.
    std::string add(const std::string& name, std::string bytes);

  private:
    struct File {
        std::string path;
        std::unique_ptr<std::string> bytes;  // GDAL reads them where they are
    };
    std::string folder_;
    std::vector<File> files_;
};

}  // namespace oro
