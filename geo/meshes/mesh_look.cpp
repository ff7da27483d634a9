#include "geo/meshes/mesh_look.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "core/base/checksum.h"
#include "core/seam/cleared_map.h"  // gpu::mesh_look_...

namespace oro {

std::uint32_t look_of_mesh(const SourceMesh& mesh, const std::string& asked) {
    if (asked == "ground") return gpu::mesh_look_ground;
    if (asked == "built") return gpu::mesh_look_built;
    if (asked == "plain") return gpu::mesh_look_plain;
    if (mesh.kind == MeshKind::survey) return gpu::mesh_look_ground;
    return mesh.kind == MeshKind::unknown ? gpu::mesh_look_plain : gpu::mesh_look_built;
}

bool is_mesh_look(const std::string& asked) {
    return asked == "ground" || asked == "built" || asked == "plain";
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
