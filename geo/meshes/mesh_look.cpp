#include "geo/meshes/mesh_look.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "core/base/checksum.h"
#include "shaders/shared.h"

namespace oro {

std::uint32_t look_of_mesh(const SourceMesh& mesh, const std::string& asked) {
    if (asked == "ground" || mesh.format == "GeoPackage TIN" || mesh.format == "LandXML")
        return asked == "built" ? gpu::mesh_look_built : gpu::mesh_look_ground;
    constexpr std::array<std::string_view, 4> unknown{"OBJ", "PLY", "STL", "glTF"};
    if (asked.empty() && std::ranges::find(unknown, mesh.format) != unknown.end())
        return gpu::mesh_look_plain;
    return gpu::mesh_look_built;
}

std::uint32_t look_of_type(const std::string& type) {
    constexpr std::array<std::string_view, 3> paved{"Road", "Railway", "TransportSquare"};
    constexpr std::array<std::string_view, 4> ground{"PlantCover", "LandUse", "TINRelief",
                                                     "SolitaryVegetationObject"};
    if (type == "WaterBody") return gpu::mesh_look_water;
    if (std::ranges::find(ground, type) != ground.end()) return gpu::mesh_look_ground;
    return std::ranges::find(paved, type) != paved.end() ? gpu::mesh_look_paved : gpu::mesh_look_built;
}

float tone_of(const std::string& name) {
    const std::uint64_t hash = xxh64(std::as_bytes(std::span(name)));
    return static_cast<float>(hash >> 48U) / 65535.0F;
}

}  // namespace oro
