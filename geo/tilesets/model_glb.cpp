#include <cstring>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "geo/tilesets/ground_model.h"

namespace oro {
namespace {

using ModelJson = nlohmann::ordered_json;

template <class Value>
void append_all(std::vector<std::uint8_t>& bytes, const std::vector<Value>& values) {
    const std::size_t before = bytes.size();
    bytes.resize(before + values.size() * sizeof(Value));
    std::memcpy(bytes.data() + before, values.data(), values.size() * sizeof(Value));
}

ModelJson parts_of(const glm::vec3& vector) {
    ModelJson list = ModelJson::array();
    for (const float part : {vector.x, vector.y, vector.z}) list.push_back(static_cast<double>(part));
    return list;
}

ModelJson add_accessor(ModelJson& json, std::size_t at, std::size_t bytes, int target, int component,
                       std::size_t count, const char* type) {
    ModelJson view = ModelJson::object();
    view["buffer"] = 0;
    view["byteOffset"] = at;
    view["byteLength"] = bytes;
    view["target"] = target;
    ModelJson accessor = ModelJson::object();
    accessor["bufferView"] = json["bufferViews"].size();
    accessor["componentType"] = component;
    accessor["count"] = count;
    accessor["type"] = type;
    json["bufferViews"].push_back(std::move(view));
    return accessor;
}

void add_asset(ModelJson& json, const GroundModel& model, const GlbLook& look) {
    json["asset"]["version"] = "2.0";
    json["asset"]["generator"] = look.generator;
    if (!look.attribution.empty()) json["asset"]["copyright"] = look.attribution;
    ModelJson& origin = json["asset"]["extras"]["origin"];
    origin["lat_deg"] = model.origin.lat_deg;
    origin["lon_deg"] = model.origin.lon_deg;
    origin["h_m"] = model.origin.h_m;
    json["asset"]["extras"]["error_m"] = model.error_m;
}

void add_scene(ModelJson& json, const GlbLook& look) {
    json["scene"] = 0;
    json["scenes"][0]["nodes"][0] = 0;
    json["nodes"][0]["mesh"] = 0;
    ModelJson& primitive = json["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = 0;
    primitive["attributes"]["NORMAL"] = 1;
    primitive["indices"] = 2;
    primitive["material"] = 0;
    ModelJson& pbr = json["materials"][0]["pbrMetallicRoughness"];
    for (const double part : look.colour) pbr["baseColorFactor"].push_back(part);
    pbr["baseColorFactor"].push_back(1.0);
    pbr["metallicFactor"] = 0.0;
    pbr["roughnessFactor"] = 1.0;
}

}  // namespace

std::vector<std::uint8_t> model_glb_bytes(const GroundModel& model, const GlbLook& look) {
    constexpr int is_float = 5126, is_unsigned_int = 5125, of_vertices = 34962, of_triangles = 34963;
    static_assert(sizeof(glm::vec3) == 12);
    std::vector<std::uint8_t> bytes;
    append_all(bytes, model.positions_m);
    append_all(bytes, model.normals);
    append_all(bytes, model.indices);
    ModelJson json = ModelJson::object();
    add_asset(json, model, look);
    add_scene(json, look);
    json["bufferViews"] = ModelJson::array();
    const std::size_t count = model.positions_m.size(), vectors = 12 * count;
    glm::vec3 low = model.positions_m.front(), high = low;
    for (const glm::vec3& position : model.positions_m)
        low = glm::min(low, position), high = glm::max(high, position);
    ModelJson positions = add_accessor(json, 0, vectors, of_vertices, is_float, count, "VEC3");
    positions["min"] = parts_of(low);
    positions["max"] = parts_of(high);
    ModelJson normals = add_accessor(json, vectors, vectors, of_vertices, is_float, count, "VEC3");
    ModelJson indices = add_accessor(json, 2 * vectors, 4 * model.indices.size(), of_triangles,
                                     is_unsigned_int, model.indices.size(), "SCALAR");
    json["accessors"] = ModelJson::array();
    for (ModelJson* const one : {&positions, &normals, &indices})
        json["accessors"].push_back(std::move(*one));
    json["buffers"][0]["byteLength"] = bytes.size();
    return glb_around(json.dump(-1, ' ', false, ModelJson::error_handler_t::replace), std::move(bytes));
}

}  // namespace oro
