// KML 2.2 and 2.3, with Google's extensions.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "geo/files/guarded_files.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_file.h"
#include "geo/vectors/xml_text.h"

namespace oro {

// Appends a file's placemarks and overlays to `file`: a layer for each Document and Folder, `name` for those
// outside. Fields are the texts of the feature and its extended data. What cannot be drawn goes to
// `left_out`, with all its places. Errors (a reason, without the file's name): too many places; the watch's
// time is spent.
Result<void> read_kml(const XmlText& xml, const std::string& name, FileWatch& watch, VectorFile& file,
                      LeftOut& left_out);

}  // namespace oro
