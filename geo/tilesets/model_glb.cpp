#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "geo/tilesets/ground_model.h"

namespace oro {
namespace {

using ModelJson = nlohmann::ordered_json;

ModelJson parts_of(const glm::vec3& vector) {
    ModelJson list = ModelJson::array();
    for (const float part : {vector.x, vector.y, vector.z}) list.push_back(static_cast<double>(part));
    return list;
}

// What is drawn by one node. A colour has three bytes and one that is unused: vertices begin at multiples of
// four.
struct ModelPart {
    std::string name;  // "": none
    std::span<const glm::vec3> positions_m, normals;
    std::span<const std::array<double, 3>> colours;  // or none
    std::span<const std::uint32_t> indices;
};

// Appends parts to one buffer, and what glTF says of them.
class ModelWriter {
  public:
    ModelWriter(const GroundModel& model, const GlbLook& look);
    // colour: of a part without colours.
    void add(const ModelPart& part, const std::array<double, 3>& colour, bool two_sided);
    std::vector<std::uint8_t> take();

  private:
    static constexpr int is_float = 5126, is_unsigned_int = 5125, is_unsigned_byte = 5121,
                         of_vertices = 34962, of_triangles = 34963;
    template <class Value>
    std::size_t add_view(std::span<const Value> values, int target);
    // Its number.
    std::size_t add_accessor(std::size_t view, int component, std::size_t count, const char* type);
    ModelJson attributes_of(const ModelPart& part);
    void add_material(bool has_colours, const std::array<double, 3>& colour, bool two_sided);

    ModelJson json_ = ModelJson::object();
    std::vector<std::uint8_t> bytes_;
};

ModelWriter::ModelWriter(const GroundModel& model, const GlbLook& look) {
    json_["asset"]["version"] = "2.0";
    json_["asset"]["generator"] = look.generator;
    if (!look.attribution.empty()) json_["asset"]["copyright"] = look.attribution;
    ModelJson& origin = json_["asset"]["extras"]["origin"];
    origin["lat_deg"] = model.origin.lat_deg;
    origin["lon_deg"] = model.origin.lon_deg;
    origin["h_m"] = model.origin.h_m;
    json_["asset"]["extras"]["error_m"] = model.error_m;
    json_["scene"] = 0;
    json_["scenes"][0]["nodes"] = ModelJson::array();
    for (const char* const list : {"nodes", "meshes", "materials", "bufferViews", "accessors"})
        json_[list] = ModelJson::array();
}

template <class Value>
std::size_t ModelWriter::add_view(std::span<const Value> values, int target) {
    ModelJson view = ModelJson::object();
    view["buffer"] = 0;
    view["byteOffset"] = bytes_.size();
    view["byteLength"] = values.size_bytes();
    view["target"] = target;
    const std::size_t before = bytes_.size();
    bytes_.resize(before + values.size_bytes());
    std::memcpy(bytes_.data() + before, values.data(), values.size_bytes());
    json_["bufferViews"].push_back(std::move(view));
    return json_["bufferViews"].size() - 1;
}

std::size_t ModelWriter::add_accessor(std::size_t view, int component, std::size_t count, const char* type) {
    ModelJson accessor = ModelJson::object();
    accessor["bufferView"] = view;
    accessor["componentType"] = component;
    accessor["count"] = count;
    accessor["type"] = type;
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].size() - 1;
}

ModelJson ModelWriter::attributes_of(const ModelPart& part) {
    static_assert(sizeof(glm::vec3) == 12);
    const std::size_t count = part.positions_m.size();
    glm::vec3 low = part.positions_m.front(), high = low;
    for (const glm::vec3& position : part.positions_m)
        low = glm::min(low, position), high = glm::max(high, position);
    ModelJson attributes = ModelJson::object();
    const std::size_t positions =
        add_accessor(add_view(part.positions_m, of_vertices), is_float, count, "VEC3");
    json_["accessors"][positions]["min"] = parts_of(low);
    json_["accessors"][positions]["max"] = parts_of(high);
    attributes["POSITION"] = positions;
    attributes["NORMAL"] = add_accessor(add_view(part.normals, of_vertices), is_float, count, "VEC3");
    if (part.colours.empty()) return attributes;
    std::vector<std::array<std::uint8_t, 4>> codes(count);
    std::ranges::transform(part.colours, codes.begin(), colour_bytes);
    const std::size_t view = add_view(std::span<const std::array<std::uint8_t, 4>>(codes), of_vertices);
    json_["bufferViews"][view]["byteStride"] = sizeof(codes.front());
    const std::size_t colours = add_accessor(view, is_unsigned_byte, count, "VEC3");
    json_["accessors"][colours]["normalized"] = true;
    attributes["COLOR_0"] = colours;
    return attributes;
}

void ModelWriter::add_material(bool has_colours, const std::array<double, 3>& colour, bool two_sided) {
    ModelJson material = ModelJson::object();
    ModelJson& pbr = material["pbrMetallicRoughness"];
    for (const double part : colour) pbr["baseColorFactor"].push_back(has_colours ? 1.0 : part);
    pbr["baseColorFactor"].push_back(1.0);
    pbr["metallicFactor"] = 0.0;
    pbr["roughnessFactor"] = 1.0;
    if (two_sided) material["doubleSided"] = true;
    json_["materials"].push_back(std::move(material));
}

void ModelWriter::add(const ModelPart& part, const std::array<double, 3>& colour, bool two_sided) {
    const std::size_t number = json_["nodes"].size();
    ModelJson mesh = ModelJson::object();
    ModelJson& primitive = mesh["primitives"][0];
    primitive["attributes"] = attributes_of(part);
    primitive["indices"] =
        add_accessor(add_view(part.indices, of_triangles), is_unsigned_int, part.indices.size(), "SCALAR");
    primitive["material"] = number;
    add_material(!part.colours.empty(), colour, two_sided);
    ModelJson node = ModelJson::object();
    if (!part.name.empty()) node["name"] = mesh["name"] = part.name;
    node["mesh"] = number;
    json_["meshes"].push_back(std::move(mesh));
    json_["nodes"].push_back(std::move(node));
    json_["scenes"][0]["nodes"].push_back(number);
}

std::vector<std::uint8_t> ModelWriter::take() {
    json_["buffers"][0]["byteLength"] = bytes_.size();
    return glb_around(json_.dump(-1, ' ', false, ModelJson::error_handler_t::replace), std::move(bytes_));
}

}  // namespace

std::vector<std::uint8_t> model_glb_bytes(const GroundModel& model,
                                          std::span<const std::array<double, 3>> colours,
                                          std::span<const ModelMesh> meshes, const GlbLook& look) {
    ModelWriter writer(model, look);
    // Without meshes the one node is the ground.
    writer.add({meshes.empty() ? "" : "ground", model.positions_m, model.normals, colours, model.indices},
               look.colour, false);
    for (const ModelMesh& mesh : meshes)
        writer.add({mesh.name, mesh.positions_m, mesh.normals, mesh.colours, mesh.indices}, look.colour,
                   true);
    return writer.take();
}

}  // namespace oro
