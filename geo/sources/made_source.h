// Made terrain as a source: it stands where a file would, and its posts are reckoned instead of read.
#pragma once

#include "core/base/result.h"
#include "geo/files/source_paths.h"
#include "geo/sources/source.h"

namespace oro {

// The source that a made: text describes. Errors: those of made_terrain_of.
Result<Source> inspect_made(const SourcePath& path);
// Makes a window of its posts, on as many threads as the machine has.
Result<PostBlock> read_made(const Source& source, const PostWindow& window);

}  // namespace oro
