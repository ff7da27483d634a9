// Buffer views of glTF that are compressed by EXT_meshopt_compression.
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/EXT_meshopt_compression
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace oro {

// As the extension states it.
struct MeshoptView {
    std::string_view bytes;  // compressed
    std::size_t count{}, stride{};
    std::string mode;    // ATTRIBUTES, TRIANGLES, INDICES
    std::string filter;  // NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL
};

// The count times stride bytes that it holds, or a reason why there are none: a stride or a mode that the
// extension does not have, more than so few bytes can hold, or damaged ones.
Result<std::string> decompressed_view(const MeshoptView& view);

}  // namespace oro
