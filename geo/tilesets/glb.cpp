#include "geo/tilesets/glb.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

namespace oro {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little endian");
using Json = nlohmann::ordered_json;

// glTF's names for what buffers hold.
constexpr int component_short = 5122, component_unsigned_short = 5123, component_float = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr std::size_t position_bytes = 12, normal_bytes = 8;  // three shorts and two bytes that align them

template <class Vector>
Vector y_up(const Vector& ecef) {
    return {ecef.x, ecef.z, -ecef.y};
}

template <class Value>
void append(std::vector<std::uint8_t>& bytes, const Value& value) {
    std::array<std::uint8_t, sizeof(Value)> raw;
    std::memcpy(raw.data(), &value, sizeof(Value));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void pad(std::vector<std::uint8_t>& bytes, std::uint8_t with) {
    while (bytes.size() % 4 != 0) bytes.push_back(with);
}

struct Views {
    std::size_t normals_at{}, indices_at{};
    std::vector<std::uint8_t> bytes;
};

Views views_of(const GroundMesh& mesh) {
    assert(mesh.positions_m.size() < 0xFFFF);
    Views views;
    views.bytes.reserve(mesh.positions_m.size() * (position_bytes + normal_bytes) + 2 * mesh.indices.size());
    for (const glm::vec3& position : mesh.positions_m) append(views.bytes, y_up(position));
    views.normals_at = views.bytes.size();
    for (const glm::vec3& normal : mesh.normals) {
        const glm::vec3 turned = y_up(normal);
        for (const float part : {turned.x, turned.y, turned.z})
            append(views.bytes,
                   static_cast<std::int16_t>(std::lround(std::clamp(part, -1.0F, 1.0F) * 32767.0F)));
        append(views.bytes, std::int16_t{0});
    }
    views.indices_at = views.bytes.size();
    for (const std::uint32_t index : mesh.indices) append(views.bytes, static_cast<std::uint16_t>(index));
    return views;
}

Json vector_json(const glm::dvec3& vector) {
    Json list = Json::array();
    for (const double part : {vector.x, vector.y, vector.z}) list.push_back(part == 0.0 ? 0.0 : part);
    return list;
}

Json view_json(std::size_t at, std::size_t bytes, std::size_t stride, int target) {
    Json view = Json::object();
    view["buffer"] = 0;
    view["byteOffset"] = at;
    view["byteLength"] = bytes;
    if (stride > 0) view["byteStride"] = stride;
    view["target"] = target;
    return view;
}

Json accessor_json(int view, int component, std::size_t count, const char* type) {
    Json accessor = Json::object();
    accessor["bufferView"] = view;
    accessor["componentType"] = component;
    accessor["count"] = count;
    accessor["type"] = type;
    return accessor;
}

Json accessors_json(const GroundMesh& mesh) {
    glm::vec3 low = y_up(mesh.positions_m.front()), high = low;
    for (const glm::vec3& position : mesh.positions_m) {
        low = glm::min(low, y_up(position));
        high = glm::max(high, y_up(position));
    }
    Json list = Json::array();
    Json positions = accessor_json(0, component_float, mesh.positions_m.size(), "VEC3");
    positions["min"] = vector_json(low);
    positions["max"] = vector_json(high);
    list.push_back(std::move(positions));
    Json normals = accessor_json(1, component_short, mesh.normals.size(), "VEC3");
    normals["normalized"] = true;
    list.push_back(std::move(normals));
    list.push_back(accessor_json(2, component_unsigned_short, mesh.indices.size(), "SCALAR"));
    return list;
}

Json material_json(const GlbLook& look) {
    Json pbr = Json::object();
    Json colour = Json::array();
    for (const double part : look.colour) colour.push_back(part);
    colour.push_back(1.0);
    pbr["baseColorFactor"] = std::move(colour);
    pbr["metallicFactor"] = 0.0;
    pbr["roughnessFactor"] = 1.0;
    Json material = Json::object();
    material["pbrMetallicRoughness"] = std::move(pbr);
    return material;
}

Json list_of(Json one) {
    Json list = Json::array();
    list.push_back(std::move(one));
    return list;
}

Json mesh_json(const GroundMesh& mesh) {
    Json attributes = Json::object();
    attributes["POSITION"] = 0;
    attributes["NORMAL"] = 1;
    Json primitive = Json::object();
    primitive["attributes"] = std::move(attributes);
    primitive["indices"] = 2;
    primitive["material"] = 0;
    Json json = Json::object();
    json["primitives"] = list_of(std::move(primitive));
    json["extras"]["groundTriangles"] = mesh.ground_triangles;
    return json;
}

Json gltf_json(const GroundMesh& mesh, const GlbLook& look, const Views& views) {
    Json json = Json::object();
    json["asset"]["version"] = "2.0";
    json["asset"]["generator"] = look.generator;
    if (!look.attribution.empty()) json["asset"]["copyright"] = look.attribution;
    json["extensionsUsed"] = list_of("KHR_mesh_quantization");
    json["extensionsRequired"] = list_of("KHR_mesh_quantization");
    json["scene"] = 0;
    json["scenes"] = list_of(Json::object());
    json["scenes"][0]["nodes"] = list_of(0);
    Json node = Json::object();
    node["mesh"] = 0;
    node["translation"] = vector_json(y_up(mesh.centre_m));
    json["nodes"] = list_of(std::move(node));
    json["meshes"] = list_of(mesh_json(mesh));
    json["materials"] = list_of(material_json(look));
    json["accessors"] = accessors_json(mesh);
    json["bufferViews"] = list_of(view_json(0, views.normals_at, position_bytes, array_buffer));
    json["bufferViews"].push_back(
        view_json(views.normals_at, views.indices_at - views.normals_at, normal_bytes, array_buffer));
    json["bufferViews"].push_back(
        view_json(views.indices_at, 2 * mesh.indices.size(), 0, element_array_buffer));
    Json buffer = Json::object();
    buffer["byteLength"] = views.bytes.size();
    json["buffers"] = list_of(std::move(buffer));
    return json;
}

}  // namespace

std::vector<std::uint8_t> glb_bytes(const GroundMesh& mesh, const GlbLook& look) {
    constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A,
                            binary_chunk = 0x004E4942;
    Views views = views_of(mesh);
    pad(views.bytes, 0);
    const std::string text =
        gltf_json(mesh, look, views).dump(-1, ' ', false, Json::error_handler_t::replace);
    std::vector<std::uint8_t> json(text.begin(), text.end());
    pad(json, ' ');
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    const std::size_t all = header_bytes + 2 * chunk_header_bytes + json.size() + views.bytes.size();
    std::vector<std::uint8_t> bytes;
    bytes.reserve(all);
    for (const std::uint32_t word : {magic, version, static_cast<std::uint32_t>(all),
                                     static_cast<std::uint32_t>(json.size()), json_chunk})
        append(bytes, word);
    bytes.insert(bytes.end(), json.begin(), json.end());
    append(bytes, static_cast<std::uint32_t>(views.bytes.size()));
    append(bytes, binary_chunk);
    bytes.insert(bytes.end(), views.bytes.begin(), views.bytes.end());
    return bytes;
}

}  // namespace oro
