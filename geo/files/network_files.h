// Whole files on a network (objects of a store), through GDAL's file systems: asked about, copied there and
// back, removed. Only where network_paths.h lets them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// What a server says of a file.
struct NetworkFile {
    std::uint64_t bytes{};
    std::string version;  // its ETag where it tells one, else the time at which it was written
};

// Asks the server anew. Nothing where there is no such file. Errors: usage where network paths are not
// allowed; a server that does not answer the question (403, 500).
Result<std::optional<NetworkFile>> network_file(const std::string& path);

// What must hold before anything is written there: the path names a file of a system that takes files, and
// nothing has the name unless `overwrite`. Errors: usage; failed for a file that is there, and as
// network_file() where it matters.
Result<void> check_network_target(const std::string& path, bool overwrite);

// Copies all of an open file of this machine to that path, in one request, or in several where it is larger
// than GDAL's VSIS3_CHUNK_SIZE and the like. The file is there whole afterwards, replacing what was there, or
// all is as before; what the server then says of its size has been held against what was sent. Errors:
// failed.
Result<void> upload_file(int descriptor, const std::string& path);
// Copies all of that file into an open file of this machine, from its beginning. Errors: failed.
Result<void> download_file(const std::string& path, int descriptor);
// Errors: failed.
Result<void> remove_network_file(const std::string& path);
// The files of the same folder whose names begin with that of `path` and a dot. Errors: failed.
Result<std::vector<std::string>> network_files_beside(const std::string& path);

}  // namespace oro
