#include "geo/files/file_begin.h"

#include <algorithm>
#include <span>

#include "core/base/open_file.h"

namespace oro {

std::string begin_of_file(const std::string& path, std::uint64_t most_bytes) {
    const Result<OpenFile> file = OpenFile::open(path, OpenFile::Use::read);
    if (!file.ok()) return "";
    const Result<std::uint64_t> size = file->size();
    if (!size.ok()) return "";
    std::string bytes(std::min(*size, most_bytes), '\0');
    return file->read(0, std::as_writable_bytes(std::span(bytes))).ok() ? bytes : "";
}

}  // namespace oro
