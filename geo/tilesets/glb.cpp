#include "geo/tilesets/glb.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "geo/tilesets/feature_table.h"
#include "geo/tilesets/source_table.h"

namespace oro {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little endian");
using Json = nlohmann::ordered_json;

// glTF's names for what buffers hold.
constexpr int component_byte = 5120, component_unsigned_byte = 5121, component_short = 5122,
              component_unsigned_short = 5123, component_unsigned_int = 5125, component_float = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr std::size_t float_bytes = 12, short_bytes = 8, normal_bytes = 4,
                      fact_bytes = 4;  // but for floats with padding
constexpr int normal_bits = 8;
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
    int component{};
    const char* attribute{};  // null: triangles
    const char* type{"VEC3"};
};
struct Views {
    std::vector<std::uint8_t> bytes;
    std::vector<View> views;  // positions first, triangles last
};

// The mesh's triangles as graphics cards like them, and its vertices in the order of their use.
struct OrderedMesh {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> numbers;  // of each vertex of the mesh: its new number
};

OrderedMesh ordered(const GroundMesh& mesh) {
    OrderedMesh order;
    const std::size_t vertices = mesh.positions.size(), ground = 3 * mesh.ground_triangles;
    order.indices.resize(mesh.indices.size());
    // In strips, which take fewer bytes.
    meshopt_optimizeVertexCacheStrip(order.indices.data(), mesh.indices.data(), ground, vertices);
    meshopt_optimizeVertexCacheStrip(order.indices.data() + ground, mesh.indices.data() + ground,
                                     mesh.indices.size() - ground, vertices);
    order.numbers.resize(vertices);
    meshopt_optimizeVertexFetchRemap(order.numbers.data(), order.indices.data(), order.indices.size(),
                                     vertices);
    for (std::uint32_t& index : order.indices) index = order.numbers[index];
    return order;
}

// A coordinate as the filter EXPONENTIAL has it: 2^0 times a whole number of 24 bits.
std::uint32_t exponential(std::int32_t steps) {
    return static_cast<std::uint32_t>(steps) & 0xFFFFFFU;
}

bool fits_shorts(const GroundMesh& mesh) {
    constexpr int most = 32767;
    return std::ranges::all_of(mesh.positions, [](const glm::ivec3& position) {
        return std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)}) <= most;
    });
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

// Vertices in their new order.
template <class Vertex>
void add_vertices(Views& views, const std::vector<Vertex>& vertices, const char* attribute,
                  const char* filter, int component, const char* type = "VEC3") {
    const std::size_t count = vertices.size(), stride = sizeof(Vertex);
    std::vector<std::uint8_t> bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(), count, stride));
    add_view(views, {0, 0, count, stride, "ATTRIBUTES", filter, array_buffer, component, attribute, type},
             std::move(bytes));
}

void add_positions(Views& views, const GroundMesh& mesh, const OrderedMesh& order) {
    const std::size_t count = mesh.positions.size();
    if (fits_shorts(mesh)) {
        std::vector<std::array<std::int16_t, short_bytes / 2>> shorts(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::ivec3& at = mesh.positions[i];
            shorts[order.numbers[i]] = {static_cast<std::int16_t>(at.x), static_cast<std::int16_t>(at.y),
                                        static_cast<std::int16_t>(at.z), 0};
        }
        add_vertices(views, shorts, "POSITION", nullptr, component_short);
        return;
    }
    std::vector<std::array<std::uint32_t, float_bytes / 4>> floats(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::ivec3& at = mesh.positions[i];
        floats[order.numbers[i]] = {exponential(at.x), exponential(at.y), exponential(at.z)};
    }
    add_vertices(views, floats, "POSITION", "EXPONENTIAL", component_float);
}

void add_normals(Views& views, const GroundMesh& mesh, const OrderedMesh& order) {
    const std::size_t count = mesh.normals.size();
    if (count == 0) return;
    std::vector<std::array<float, 4>> normals(count);
    for (std::size_t i = 0; i < count; ++i)
        normals[order.numbers[i]] = {mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z, 0.0F};
    std::vector<std::array<std::int8_t, normal_bytes>> octahedral(count);
    meshopt_encodeFilterOct(octahedral.data(), count, normal_bytes, normal_bits, normals.front().data());
    add_vertices(views, octahedral, "NORMAL", "OCTAHEDRAL", component_byte);
}

void add_facts(Views& views, const VertexFacts& facts, const OrderedMesh& order) {
    using Bytes = std::array<std::uint8_t, fact_bytes>;
    if (!facts.colours.empty()) {
        std::vector<Bytes> colours(facts.colours.size());
        for (std::size_t i = 0; i < colours.size(); ++i)
            colours[order.numbers[i]] = colour_bytes(facts.colours[i]);
        add_vertices(views, colours, "COLOR_0", nullptr, component_unsigned_byte);
    }
    if (!facts.sources.empty()) {
        std::vector<Bytes> sources(facts.sources.size());
        for (std::size_t i = 0; i < sources.size(); ++i) sources[order.numbers[i]][0] = facts.sources[i];
        add_vertices(views, sources, "_FEATURE_ID_0", nullptr, component_unsigned_byte, "SCALAR");
    }
    if (!facts.features.empty()) {
        std::vector<std::array<std::uint16_t, fact_bytes / 2>> features(facts.features.size());
        for (std::size_t i = 0; i < features.size(); ++i) features[order.numbers[i]][0] = facts.features[i];
        add_vertices(views, features, "_FEATURE_ID_0", nullptr, component_unsigned_short, "SCALAR");
    }
}

Views views_of(const GroundMesh& mesh, const VertexFacts& facts, const OrderedMesh& order) {
    [[maybe_unused]] static const bool chosen = (choose_codes(), true);
    assert(chosen);
    constexpr std::size_t most_of_short = 65535;  // 65535 itself is no vertex
    const std::size_t count = mesh.positions.size();
    Views views;
    add_positions(views, mesh, order);
    add_normals(views, mesh, order);
    add_facts(views, facts, order);
    std::vector<std::uint8_t> triangles(meshopt_encodeIndexBufferBound(order.indices.size(), count));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), order.indices.data(),
                                               order.indices.size()));
    const bool shorts = count <= most_of_short;
    add_view(
        views,
        {0, 0, order.indices.size(), shorts ? std::size_t{2} : std::size_t{4}, "TRIANGLES", nullptr,
         element_array_buffer, shorts ? component_unsigned_short : component_unsigned_int, nullptr, "SCALAR"},
        std::move(triangles));
    return views;
}

Json vector_json(const glm::dvec3& vector) {
    Json list = Json::array();
    for (const double part : {vector.x, vector.y, vector.z}) list.push_back(part == 0.0 ? 0.0 : part);
    return list;
}

// From whole steps along the mesh's axes to glTF's.
Json matrix_json(const GroundMesh& mesh) {
    Json list = Json::array();
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 axis = y_up(mesh.step_m * mesh.ecef_from_mesh[i]);
        for (const double part : {axis.x, axis.y, axis.z, 0.0}) list.push_back(part == 0.0 ? 0.0 : part);
    }
    const glm::dvec3 centre_m = y_up(mesh.centre_m);
    for (const double part : {centre_m.x, centre_m.y, centre_m.z, 1.0}) list.push_back(part);
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

Json accessors_json(const GroundMesh& mesh, const Views& views) {
    glm::ivec3 low = mesh.positions.front(), high = low;
    for (const glm::ivec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    Json list = Json::array();
    for (const View& view : views.views) {
        const int number = static_cast<int>(list.size());
        Json accessor = accessor_json(number, view.component, view.count, view.type);
        const std::string attribute = view.attribute == nullptr ? "" : view.attribute;
        if (number == 0) {
            accessor["min"] = vector_json(low);
            accessor["max"] = vector_json(high);
        } else if (attribute == "NORMAL" || attribute == "COLOR_0") {
            accessor["normalized"] = true;
        }
        list.push_back(std::move(accessor));
    }
    return list;
}

Json material_json(const GlbLook& look, bool has_colours) {
    Json pbr = Json::object();
    Json colour = Json::array();
    for (const double part : look.colour) colour.push_back(has_colours ? 1.0 : part);
    colour.push_back(1.0);
    pbr["baseColorFactor"] = std::move(colour);
    pbr["metallicFactor"] = 0.0;
    pbr["roughnessFactor"] = 1.0;
    Json material = Json::object();
    material["pbrMetallicRoughness"] = std::move(pbr);
    if (look.two_sided) material["doubleSided"] = true;
    return material;
}

Json list_of(Json one) {
    Json list = Json::array();
    list.push_back(std::move(one));
    return list;
}

Json mesh_json(const GroundMesh& mesh, const GlbLook& look, const Views& views) {
    Json attributes = Json::object();
    Json primitive = Json::object();
    for (std::size_t i = 0; i + 1 < views.views.size(); ++i) {
        attributes[views.views[i].attribute] = i;
        if (std::string(views.views[i].attribute) != "_FEATURE_ID_0") continue;
        Json features = Json::object();
        features["featureCount"] = look.features.empty() ? look.sources.size() : look.features.size();
        features["attribute"] = 0;
        features["propertyTable"] = 0;
        primitive["extensions"]["EXT_mesh_features"]["featureIds"] = list_of(std::move(features));
    }
    primitive["attributes"] = std::move(attributes);
    primitive["indices"] = views.views.size() - 1;
    primitive["material"] = 0;
    Json json = Json::object();
    json["primitives"] = list_of(std::move(primitive));
    if (look.features.empty()) json["extras"]["groundTriangles"] = mesh.ground_triangles;
    return json;
}

Json gltf_json(const GroundMesh& mesh, const VertexFacts& facts, const GlbLook& look, Views& views) {
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
    node["matrix"] = matrix_json(mesh);
    json["nodes"] = list_of(std::move(node));
    json["meshes"] = list_of(mesh_json(mesh, look, views));
    json["materials"] = list_of(material_json(look, !facts.colours.empty()));
    json["accessors"] = accessors_json(mesh, views);
    json["bufferViews"] = Json::array();
    std::size_t fallback_bytes = 0;
    for (const View& view : views.views) {
        json["bufferViews"].push_back(view_json(view, fallback_bytes));
        fallback_bytes = (fallback_bytes + view.count * view.stride + 3) / 4 * 4;
    }
    if (!facts.sources.empty() || !facts.features.empty()) {
        json["extensionsUsed"].push_back("EXT_mesh_features");
        json["extensionsUsed"].push_back("EXT_structural_metadata");
        json["extensions"]["EXT_structural_metadata"] =
            facts.features.empty() ? source_table_json(look.sources, views.bytes, json["bufferViews"])
                                   : feature_table_json(look.features, views.bytes, json["bufferViews"]);
        pad(views.bytes, 0);
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

std::array<std::uint8_t, 4> colour_bytes(const std::array<double, 3>& light) {
    std::array<std::uint8_t, 4> bytes{};
    for (std::size_t part = 0; part < light.size(); ++part)
        bytes[part] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(light[part], 0.0, 1.0)));
    return bytes;
}

std::vector<std::uint8_t> glb_bytes(const GroundMesh& mesh, const VertexFacts& facts, const GlbLook& look) {
    Views views = views_of(mesh, facts, ordered(mesh));
    const std::string text =
        gltf_json(mesh, facts, look, views).dump(-1, ' ', false, Json::error_handler_t::replace);
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
