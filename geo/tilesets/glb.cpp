#include "geo/tilesets/glb.h"

#include <meshoptimizer.h>

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
constexpr std::size_t position_bytes = 12, normal_bytes = 8;  // three floats; three shorts and two bytes more
constexpr int normal_bits = 12;
constexpr const char* compression = "EXT_meshopt_compression";

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

// A compressed view, and what it is when it is not.
struct View {
    std::size_t at{}, bytes{};  // among the compressed ones
    std::size_t count{}, stride{};
    const char* mode{};
    const char* filter{};  // null for none
    int target{};
};
struct Views {
    std::vector<std::uint8_t> bytes;
    std::vector<View> views;  // positions, normals, triangles
};

// The mesh's triangles as graphics cards like them, and its vertices in the order of their use.
struct OrderedMesh {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> numbers;  // of each vertex of the mesh: its new number
};

OrderedMesh ordered(const GroundMesh& mesh) {
    OrderedMesh order;
    const std::size_t vertices = mesh.positions_m.size(), ground = 3 * mesh.ground_triangles;
    order.indices.resize(mesh.indices.size());
    meshopt_optimizeVertexCache(order.indices.data(), mesh.indices.data(), ground, vertices);
    meshopt_optimizeVertexCache(order.indices.data() + ground, mesh.indices.data() + ground,
                                mesh.indices.size() - ground, vertices);
    order.numbers.resize(vertices);
    meshopt_optimizeVertexFetchRemap(order.numbers.data(), order.indices.data(), order.indices.size(),
                                     vertices);
    for (std::uint32_t& index : order.indices) index = order.numbers[index];
    return order;
}

// A coordinate as the filter EXPONENTIAL has it: 2^exponent times a whole number of 24 bits.
std::uint32_t exponential(float value_m, int exponent) {
    constexpr double most = 0x7FFFFF;
    double steps = std::ldexp(static_cast<double>(value_m), -exponent);
    while (std::abs(steps) > most) steps = std::round(std::ldexp(steps, -1)), ++exponent;
    return static_cast<std::uint32_t>(exponent) << 24U |
           (static_cast<std::uint32_t>(static_cast<std::int32_t>(steps)) & 0xFFFFFFU);
}

// Codes that all decoders of the extension know.
void choose_codes() {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
}

void add_view(Views& views, View view, std::vector<std::uint8_t> bytes) {
    view.at = views.bytes.size();
    view.bytes = bytes.size();
    views.bytes.insert(views.bytes.end(), bytes.begin(), bytes.end());
    pad(views.bytes, 0);
    views.views.push_back(view);
}

void add_vertices(Views& views, const void* vertices, std::size_t count, std::size_t stride,
                  const char* filter) {
    std::vector<std::uint8_t> bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices, count, stride));
    add_view(views, {0, 0, count, stride, "ATTRIBUTES", filter, array_buffer}, std::move(bytes));
}

Views views_of(const GroundMesh& mesh, const OrderedMesh& order) {
    [[maybe_unused]] static const bool chosen = (choose_codes(), true);
    assert(chosen && mesh.positions_m.size() < 0xFFFF);
    const std::size_t count = mesh.positions_m.size();
    const int exponent = static_cast<int>(std::lround(std::log2(mesh.step_m)));
    std::vector<std::array<std::uint32_t, 3>> positions(count);
    std::vector<std::array<float, 4>> normals(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 position = y_up(mesh.positions_m[i]), normal = y_up(mesh.normals[i]);
        positions[order.numbers[i]] = {exponential(position.x, exponent), exponential(position.y, exponent),
                                       exponential(position.z, exponent)};
        normals[order.numbers[i]] = {normal.x, normal.y, normal.z, 0.0F};
    }
    Views views;
    add_vertices(views, positions.data(), count, position_bytes, "EXPONENTIAL");
    std::vector<std::array<std::int16_t, 4>> octahedral(count);
    meshopt_encodeFilterOct(octahedral.data(), count, normal_bytes, normal_bits, normals.front().data());
    add_vertices(views, octahedral.data(), count, normal_bytes, "OCTAHEDRAL");
    std::vector<std::uint8_t> triangles(meshopt_encodeIndexBufferBound(order.indices.size(), count));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), order.indices.data(),
                                               order.indices.size()));
    add_view(views, {0, 0, order.indices.size(), 2, "TRIANGLES", nullptr, element_array_buffer},
             std::move(triangles));
    return views;
}

Json vector_json(const glm::dvec3& vector) {
    Json list = Json::array();
    for (const double part : {vector.x, vector.y, vector.z}) list.push_back(part == 0.0 ? 0.0 : part);
    return list;
}

// fallback_at: where the view would lie in a buffer that is not compressed.
Json view_json(const View& view, std::size_t fallback_at) {
    Json compressed = Json::object();
    compressed["buffer"] = 0;
    compressed["byteOffset"] = view.at;
    compressed["byteLength"] = view.bytes;
    compressed["byteStride"] = view.stride;
    compressed["count"] = view.count;
    compressed["mode"] = view.mode;
    if (view.filter != nullptr) compressed["filter"] = view.filter;
    Json json = Json::object();
    json["buffer"] = 1;
    json["byteOffset"] = fallback_at;
    json["byteLength"] = view.count * view.stride;
    if (view.target == array_buffer) json["byteStride"] = view.stride;
    json["target"] = view.target;
    json["extensions"][compression] = std::move(compressed);
    return json;
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
    json["extensionsUsed"].push_back(compression);
    json["extensionsRequired"] = json["extensionsUsed"];
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
    json["bufferViews"] = Json::array();
    std::size_t fallback_bytes = 0;
    for (const View& view : views.views) {
        json["bufferViews"].push_back(view_json(view, fallback_bytes));
        fallback_bytes = (fallback_bytes + view.count * view.stride + 3) / 4 * 4;
    }
    Json buffer = Json::object();
    buffer["byteLength"] = views.bytes.size();
    json["buffers"] = list_of(std::move(buffer));
    Json fallback = Json::object();
    fallback["byteLength"] = fallback_bytes;
    fallback["extensions"][compression]["fallback"] = true;
    json["buffers"].push_back(std::move(fallback));
    return json;
}

}  // namespace

std::vector<std::uint8_t> glb_bytes(const GroundMesh& mesh, const GlbLook& look) {
    Views views = views_of(mesh, ordered(mesh));
    const std::string text =
        gltf_json(mesh, look, views).dump(-1, ' ', false, Json::error_handler_t::replace);
    return glb_around(text, std::move(views.bytes));
}

std::vector<std::uint8_t> glb_around(const std::string& json, std::vector<std::uint8_t> buffer) {
    constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A,
                            binary_chunk = 0x004E4942;
    std::vector<std::uint8_t> text(json.begin(), json.end());
    pad(text, ' ');
    pad(buffer, 0);
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    const std::size_t all = header_bytes + 2 * chunk_header_bytes + text.size() + buffer.size();
    std::vector<std::uint8_t> bytes;
    bytes.reserve(all);
    for (const std::uint32_t word : {magic, version, static_cast<std::uint32_t>(all),
                                     static_cast<std::uint32_t>(text.size()), json_chunk})
        append(bytes, word);
    bytes.insert(bytes.end(), text.begin(), text.end());
    append(bytes, static_cast<std::uint32_t>(buffer.size()));
    append(bytes, binary_chunk);
    bytes.insert(bytes.end(), buffer.begin(), buffer.end());
    return bytes;
}

}  // namespace oro
