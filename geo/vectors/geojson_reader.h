// GeoJSON (RFC 7946, and as it was before).
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "geo/files/guarded_files.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Appends the layer of a file's text (UTF-8) to `file`; `name` is the layer's where the text has none. What
// cannot be drawn goes to `left_out`, with all its places. Errors (a reason, without the file's name): text
// that is no JSON, with the line; a CRS that is not known; too many places; the watch's time is spent.
Result<void> read_geojson(std::string_view text, const std::string& name, FileWatch& watch, VectorFile& file,
                          LeftOut& left_out);

}  // namespace oro
