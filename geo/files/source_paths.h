// From the paths a user names to the files that may hold elevation: folders and archives are searched.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

struct SourcePath {
    std::string file;     // as GDAL's virtual file system opens it; or all of a made: text
    std::string shown;    // as a person finds it, e.g. tiles.zip/N46E008.hgt
    std::string name;     // the innermost file's name without .gz, e.g. N46E008.hgt
    std::string archive;  // name of the archive that holds it, or ""
    bool named{};         // by the user, not found in a folder or archive
    bool hgt{};           // by its name's ending, any case
    std::size_t path{};   // number of the path that it was found by, the first of several
};

// Files under the paths, sorted by the byte order of their names, each once. In folders and archives only
// files whose ending says that they may hold elevation are taken; a file that is named itself is always
// taken. Errors: a path that is not there or cannot be read, a damaged archive, a path with nothing in it.
Result<std::vector<SourcePath>> find_sources(const std::vector<std::string>& paths);
// Finds sources as above; files in folders that cannot be read, and damaged archives there, go to
// `unreadable` instead.
Result<std::vector<SourcePath>> find_sources(const std::vector<std::string>& paths,
                                             std::vector<Error>& unreadable);

}  // namespace oro
