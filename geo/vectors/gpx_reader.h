// GPX 1.0 and 1.1.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "geo/files/guarded_files.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_file.h"
#include "geo/vectors/xml_text.h"

namespace oro {

// Appends the layers waypoints, routes and tracks of a file to `file`, each with what its elements say of
// themselves as fields. What cannot be drawn goes to `left_out`, with all its places. Errors (a reason,
// without the file's name): too many places; the watch's time is spent.
Result<void> read_gpx(const XmlText& xml, std::string_view text, FileWatch& watch, VectorFile& file,
                      LeftOut& left_out);

}  // namespace oro
