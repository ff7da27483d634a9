// Things of meshes, buildings say, in words and in JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "geo/meshes/source_mesh.h"

namespace oro {

// "BuildingPart UUID_64ef of UUID_2b58": its type, its name, and what it is part of. On one line.
std::string words_of(const MeshFeature& feature);
// Members: type, name, part_of (null where there is none) and attributes, an object of texts.
nlohmann::ordered_json feature_json(const MeshFeature& feature);

}  // namespace oro
