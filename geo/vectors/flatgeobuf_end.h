// Whether a FlatGeobuf ends with the features that its header counts.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// Walks over the features' lengths. A header that is damaged is no error here: GDAL tells it. Errors (a
// reason, without the file's name): bytes behind the last feature that the header counts, which GDAL would
// leave out without a word.
Result<void> check_flatgeobuf_end(const std::string& file);

}  // namespace oro
