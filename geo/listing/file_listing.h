// Every file that paths name or hold, whether it can be opened or not, by its name and header alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source_report.h"

namespace oro {

struct ListedFile {
    std::string path;                    // as found
    std::optional<SourceReport> report;  // nothing where it holds no elevation or cannot be opened
    std::string reason;                  // then: why
    bool damaged{};         // a region that holds it cannot be opened; false: it is passed over, or is well
    std::string leave_out;  // why the others would make a region without it; "" where it need not go
};

struct FileListing {
    std::vector<ListedFile> files;  // by the byte order of their names; unreadable ones last
    std::optional<Error> error;     // why they make no region together; nothing where headers see no reason
    std::uint64_t looked_at{};      // headers that were read now, and not known from an earlier call
};

// Where headers are kept between calls; a path of "" keeps nothing. `stamp`: the program's version.
struct ListingCache {
    std::string folder;
    std::string stamp;
};

// Reads no post, but a few rows of files that share a grid (geo/opening/companions.h). Files that by their
// names lie outside a box are not listed. Errors: a path that is not there, or has nothing in it; what was
// told of files and PROJ does not know.
Result<FileListing> list_files(const RegionRequest& request, const ListingCache& cache,
                               const Progress& progress);

}  // namespace oro
