#include "geo/files/memory_files.h"

#include <cpl_vsi.h>

#include <atomic>
#include <utility>

namespace oro {

MemoryFiles::MemoryFiles() {
    static std::atomic<int> number{0};
    folder_ = "/vsimem/orograph-files-" + std::to_string(number++);
}

MemoryFiles::~MemoryFiles() {
    for (const File& file : files_) VSIUnlink(file.path.c_str());
    VSIRmdir(folder_.c_str());
}

std::string MemoryFiles::add(const std::string& name, std::string bytes) {
    const File& file =
        files_.emplace_back(File{folder_ + "/" + name, std::make_unique<std::string>(std::move(bytes))});
    VSIFCloseL(VSIFileFromMemBuffer(file.path.c_str(), reinterpret_cast<GByte*>(file.bytes->data()),
                                    file.bytes->size(), FALSE));
    return file.path;
}

}  // namespace oro
