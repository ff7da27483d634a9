// The features of meshes (buildings) as metadata of glTF.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "geo/tilesets/glb.h"

namespace oro {

// EXT_structural_metadata: a schema with the class "feature", and a table with a row for each feature: its
// name, type, what it is part of and its file, and a column of texts for each attribute that any of them has,
// 100 at most, "" where a feature has it not. What the table holds is appended to `bytes`, the buffer with
// number 0, and the views of it to `views`. Source: Cesium, EXT_structural_metadata; OGC 22-025r4, 3D
// Metadata Specification.
nlohmann::ordered_json feature_table_json(std::span<const GlbFeature> features,
                                          std::vector<std::uint8_t>& bytes, nlohmann::ordered_json& views);

}  // namespace oro
