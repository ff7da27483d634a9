// Materials of OBJ: files that `mtllib` names.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "geo/meshes/texture_colours.h"

namespace oro {

struct ObjMaterial {
    std::optional<glm::dvec3> colour;    // Kd, codes of sRGB from 0 to 1
    std::string texture;                 // map_Kd: from the folder of the file that names it; "" for none
    std::string folder;                  // of that file, from the mesh's folder
    glm::dvec2 offset{0.0}, scale{1.0};  // of texture coordinates: first scaled, then moved
    TextureWrap wrap{TextureWrap::repeat};
};

// The materials of a file by their names, added to those that are there; of two with one name the first
// stays. Other statements than newmtl, Kd and map_Kd (with -o, -s and -clamp) are passed over. Errors,
// without the file's name: the line, and what is wrong there.
Result<void> read_obj_materials(std::string_view text,
                                std::map<std::string, ObjMaterial, std::less<>>& materials);

}  // namespace oro
