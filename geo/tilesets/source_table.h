// The sources of the ground as metadata of glTF.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "geo/tilesets/glb.h"

namespace oro {

// The class "source" of 3D metadata, by itself.
nlohmann::ordered_json source_class_json();
// EXT_structural_metadata: a schema with that class, and a table with a row for each source. What the table
// holds is appended to `bytes`, the buffer with number 0, and the views of it to `views`. Source: Cesium,
// EXT_structural_metadata; OGC 22-025r4, 3D Metadata Specification.
nlohmann::ordered_json source_table_json(std::span<const GroundSource> sources,
                                         std::vector<std::uint8_t>& bytes, nlohmann::ordered_json& views);

}  // namespace oro
