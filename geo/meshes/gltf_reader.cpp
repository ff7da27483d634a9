// glTF 2.0 and GLB, in double: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/earth/ellipsoid.h"
#include "geo/meshes/gltf_json.h"
#include "geo/meshes/gltf_materials.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"
#include "geo/meshes/meshopt_view.h"
#include "geo/meshes/path_beside.h"
#include "geo/meshes/texture_colours.h"
#include "geo/pixels/picture_rows.h"
#include "geo/vectors/json_text.h"

namespace oro {
namespace {

constexpr std::size_t most_gltf_triangles = 50'000'000;

// The bytes of a text of base64 (RFC 4648); nothing of any other.
std::optional<std::string> base64_bytes(std::string_view text) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value_of{};
    value_of.fill(-1);
    for (std::size_t i = 0; i < digits.size(); ++i)
        value_of[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    unsigned held = 0, bits = 0;
    for (const char digit : text) {
        const int value = value_of[static_cast<unsigned char>(digit)];
        if (value < 0) return std::nullopt;
        held = held << 6U | static_cast<unsigned>(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<char>(held >> bits & 255U));
    }
    return bytes;
}

// The bytes that an accessor's elements stand in.
struct GltfElements {
    std::string_view bytes;  // from the first element on, to the end of the view
    std::size_t count{}, stride{}, component{};
    bool normalized{};
};

std::size_t component_bytes(std::size_t component) {
    switch (component) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

template <class T>
T gltf_value(std::string_view bytes, std::size_t at) {
    static_assert(std::endian::native == std::endian::little);
    T value{};
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

double gltf_number(const GltfElements& from, std::size_t element, std::size_t number) {
    const std::size_t at = element * from.stride + number * component_bytes(from.component);
    const auto part = [&](double value, double most) {
        return from.normalized ? std::max(value / most, -1.0) : value;
    };
    switch (from.component) {
        case 5120:
            return part(gltf_value<std::int8_t>(from.bytes, at), 127.0);
        case 5121:
            return part(gltf_value<std::uint8_t>(from.bytes, at), 255.0);
        case 5122:
            return part(gltf_value<std::int16_t>(from.bytes, at), 32767.0);
        case 5123:
            return part(gltf_value<std::uint16_t>(from.bytes, at), 65535.0);
        case 5125:
            return gltf_value<std::uint32_t>(from.bytes, at);
        default:
            return static_cast<double>(gltf_value<float>(from.bytes, at));
    }
}

constexpr std::string_view meshopt = "EXT_meshopt_compression";

// Those that are read, and those that change nothing of what is.
bool is_known_extension(const std::string& name) {
    constexpr std::array<std::string_view, 9> known{"KHR_mesh_quantization",
                                                    "KHR_materials_unlit",
                                                    meshopt,
                                                    "CESIUM_RTC",
                                                    "KHR_texture_transform",
                                                    "KHR_texture_basisu",
                                                    "EXT_texture_webp",
                                                    "EXT_mesh_features",
                                                    "EXT_structural_metadata"};
    return std::ranges::find(known, name) != known.end();
}

// An image of the file, as far as it is known.
struct GltfImage {
    bool is_asked{};       // for its bytes
    bool is_there{};       // a PNG or a JPEG
    std::size_t number{};  // among the textures that are read
};

class GltfReader {
  public:
    GltfReader(const JsonValue& root, std::optional<std::string_view> binary, const FileBeside& beside)
        : root_(root),
          binary_(binary),
          beside_(beside),
          nodes_(gltf_list(root, "nodes")),
          meshes_(gltf_list(root, "meshes")),
          accessors_(gltf_list(root, "accessors")),
          views_(gltf_list(root, "bufferViews")),
          images_(gltf_list(root, "images")),
          materials_(root),
          opened_(views_.size()),
          image_states_(images_.size()) {}

    Result<SourceMesh> all() {
        mesh_.format = "glTF";
        mesh_.unit = "meter";
        ORO_CHECK(check_asset());
        ORO_CHECK(read_buffers());
        ORO_CHECK(read_centre());
        on_way_.assign(nodes_.size(), false);
        ORO_TRY(const std::vector<std::size_t> roots, roots_of_scene());
        for (const std::size_t node : roots) ORO_CHECK(read_node(node, glm::dmat4(1.0)));
        if (!mesh_.colours.empty()) mesh_.colours.resize(mesh_.vertices.size());
        ORO_CHECK(colour_by_textures(textures_, textured_, mesh_));
        ORO_CHECK(move_to_origin());
        unread_.note_in(mesh_);
        if (without_triangles_ > 0)
            mesh_.notes.push_back(std::to_string(without_triangles_) +
                                  " primitives of points or lines, without triangles, left out");
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] Result<void> check_asset() const {
        const auto asset = gltf_member(root_, "asset");
        const auto version = asset ? gltf_member(*asset, "version") : std::nullopt;
        const std::string text = version ? version->words() : "";
        if (!text.starts_with("2."))
            return gltf_fault("is glTF " + (text.empty() ? "without a version" : shown_word(text)) +
                              ": 2.0 is read");
        for (const JsonValue& one : gltf_list(root_, "extensionsRequired"))
            if (!is_known_extension(one.words()))
                return gltf_fault("needs the extension " + shown_word(one.words()) + ", which is not read");
        return {};
    }

    Result<void> read_buffers() {
        const std::vector<JsonValue> buffers = gltf_list(root_, "buffers");
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            const std::string name = "buffer " + std::to_string(i);
            const auto length = gltf_count(buffers[i], "byteLength", std::nullopt);
            if (!length) return gltf_fault(name + " has no byteLength");
            const auto uri = gltf_member(buffers[i], "uri");
            const auto compressed = extension_of(buffers[i], meshopt);
            const auto fallback = compressed ? gltf_member(*compressed, "fallback") : std::nullopt;
            if (!uri && fallback && fallback->source() == "true") {
                buffers_.emplace_back();  // what is compressed stands in another
                continue;
            }
            if (!uri && (i > 0 || !binary_)) return gltf_fault(name + " has no uri");
            if (uri) {
                ORO_TRY(std::string bytes, bytes_of(uri->text(), name));
                own_bytes_.push_back(std::make_unique<std::string>(std::move(bytes)));
            }
            const std::string_view bytes = uri ? std::string_view(*own_bytes_.back()) : *binary_;
            if (bytes.size() < *length)
                return gltf_fault(name + " promises " + std::to_string(*length) + " bytes and has " +
                                  std::to_string(bytes.size()));
            buffers_.push_back(bytes.substr(0, *length));
        }
        return {};
    }

    [[nodiscard]] Result<std::string> bytes_of(const std::string& uri, const std::string& name) const {
        if (uri.starts_with("data:")) {
            const std::size_t comma = uri.find(',');
            if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64"))
                return gltf_fault(name + " has a data uri that is not base64");
            std::optional<std::string> bytes = base64_bytes(std::string_view(uri).substr(comma + 1));
            if (!bytes) return gltf_fault(name + " has a data uri whose base64 is damaged");
            return std::move(*bytes);
        }
        const std::optional<std::string> path = path_beside("", uri);
        if (!path) return gltf_fault(name + " is at " + shown_word(uri) + ": only files beside it are read");
        return beside_(*path);
    }

    // Of the scene that is shown; without scenes all nodes that are no child.
    [[nodiscard]] Result<std::vector<std::size_t>> roots_of_scene() const {
        std::vector<std::size_t> roots;
        const std::vector<JsonValue> scenes = gltf_list(root_, "scenes");
        if (scenes.empty()) {
            std::vector<bool> is_child(nodes_.size());
            for (const JsonValue& node : nodes_) {
                ORO_TRY(const std::vector<std::size_t> children,
                        numbers(node, "children", nodes_.size(), "node"));
                for (const std::size_t child : children) is_child[child] = true;
            }
            for (std::size_t i = 0; i < nodes_.size(); ++i)
                if (!is_child[i]) roots.push_back(i);
            return roots;
        }
        const auto scene = gltf_count(root_, "scene", 0);
        if (!scene || *scene >= scenes.size()) return gltf_fault("its scene is none of its scenes");
        return numbers(scenes[*scene], "nodes", nodes_.size(), "node");
    }

    [[nodiscard]] static Result<std::vector<std::size_t>> numbers(const JsonValue& object,
                                                                  std::string_view name, std::size_t count,
                                                                  const std::string& of) {
        std::vector<std::size_t> list;
        for (const JsonValue& one : gltf_list(object, name)) {
            long long number = -1;
            if (!whole_number_in(one.source(), number) || number < 0 ||
                static_cast<std::size_t>(number) >= count)
                return gltf_fault("there is no " + of + " " + shown_word(one.source()) + ": it has " +
                                  std::to_string(count));
            list.push_back(static_cast<std::size_t>(number));
        }
        return list;
    }

    [[nodiscard]] static Result<glm::dmat4> transform_of(const JsonValue& node) {
        if (gltf_member(node, "matrix")) {
            ORO_TRY(const std::vector<double> m, gltf_reals(node, "matrix", std::vector<double>(16)));
            glm::dmat4 matrix(1.0);
            for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
            return matrix;
        }
        ORO_TRY(const std::vector<double> t, gltf_reals(node, "translation", {0.0, 0.0, 0.0}));
        ORO_TRY(const std::vector<double> r, gltf_reals(node, "rotation", {0.0, 0.0, 0.0, 1.0}));
        ORO_TRY(const std::vector<double> s, gltf_reals(node, "scale", {1.0, 1.0, 1.0}));
        const glm::dmat3 turned = glm::mat3_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2])));
        glm::dmat4 matrix(1.0);
        for (int i = 0; i < 3; ++i) matrix[i] = glm::dvec4(turned[i] * s[static_cast<std::size_t>(i)], 0.0);
        matrix[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
        return matrix;
    }

    Result<void> read_node(std::size_t number, const glm::dmat4& above) {
        if (on_way_[number]) return gltf_fault("node " + std::to_string(number) + " is below itself");
        constexpr int deepest = 256;
        if (++depth_ > deepest) return gltf_fault("its nodes are more than 256 deep");
        constexpr std::size_t most_nodes = 1'000'000;
        if (++visited_ > most_nodes) return gltf_fault("has more than 1,000,000 nodes");
        const JsonValue& node = nodes_[number];
        ORO_TRY(const glm::dmat4 own, transform_of(node));
        const glm::dmat4 transform = above * own;
        if (gltf_member(node, "mesh")) {
            const auto mesh = gltf_count(node, "mesh", std::nullopt);
            if (!mesh || *mesh >= meshes_.size())
                return gltf_fault("node " + std::to_string(number) + " has a mesh that is not there");
            const auto name = gltf_member(node, "name");
            mesh_.parts.push_back({name ? name->words() : "", mesh_.triangles.size()});
            // Behind the ground of tiles that this program exports stand walls along their edges.
            const auto extras = gltf_member(meshes_[*mesh], "extras");
            const auto ground = extras ? gltf_count(*extras, "groundTriangles", std::nullopt) : std::nullopt;
            most_of_primitive_ = ground.value_or(most_gltf_triangles);
            for (const JsonValue& primitive : gltf_list(meshes_[*mesh], "primitives"))
                ORO_CHECK(read_primitive(primitive, transform));
        }
        on_way_[number] = true;
        ORO_TRY(const std::vector<std::size_t> children, numbers(node, "children", nodes_.size(), "node"));
        for (const std::size_t child : children) ORO_CHECK(read_node(child, transform));
        on_way_[number] = false;
        --depth_;
        return {};
    }

    // Those of a buffer that a view or an extension of it names; name: of what asks for them.
    [[nodiscard]] Result<std::string_view> stored_bytes(const JsonValue& at, const std::string& name) const {
        const auto buffer = gltf_count(at, "buffer", std::nullopt), begin = gltf_count(at, "byteOffset", 0),
                   length = gltf_count(at, "byteLength", std::nullopt);
        if (!buffer || *buffer >= buffers_.size() || !begin || !length || *begin > buffers_[*buffer].size() ||
            *length > buffers_[*buffer].size() - *begin)
            return gltf_fault(name + ": its buffer view lies beyond its buffer");
        return buffers_[*buffer].substr(*begin, *length);
    }

    Result<std::string_view> bytes_of_view(std::size_t number, const std::string& name) {
        if (opened_[number]) return std::string_view(*opened_[number]);
        const auto compressed = extension_of(views_[number], meshopt);
        if (!compressed) return stored_bytes(views_[number], name);
        MeshoptView view;
        ORO_TRY(view.bytes, stored_bytes(*compressed, name));
        const auto count = gltf_count(*compressed, "count", std::nullopt),
                   stride = gltf_count(*compressed, "byteStride", std::nullopt);
        const auto mode = gltf_member(*compressed, "mode"), filter = gltf_member(*compressed, "filter");
        if (!count || !stride || !mode)
            return gltf_fault("buffer view " + std::to_string(number) + " has no count, stride and mode");
        view.count = *count, view.stride = *stride;
        view.mode = shown_word(mode->words()), view.filter = filter ? shown_word(filter->words()) : "NONE";
        Result<std::string> bytes = decompressed_view(view);
        if (!bytes.ok())
            return gltf_fault("buffer view " + std::to_string(number) + " " + bytes.error().what);
        constexpr std::size_t most_bytes = std::size_t{1} << 31U;
        if ((opened_bytes_ += bytes->size()) > most_bytes)
            return gltf_fault("has more than 2 GiB when it is decompressed");
        opened_[number] = std::make_unique<std::string>(std::move(*bytes));
        return std::string_view(*opened_[number]);
    }

    // Of CESIUM_RTC, which adds it to all places.
    Result<void> read_centre() {
        const auto rtc = extension_of(root_, "CESIUM_RTC");
        if (!rtc) return {};
        ORO_TRY(const std::vector<double> centre, gltf_reals(*rtc, "center", std::vector<double>(3)));
        centre_ = {centre[0], centre[1], centre[2]};
        return {};
    }

    // What `export --to gltf` writes says where its middle is: its places are then those of ECEF.
    Result<void> move_to_origin() {
        const auto asset = gltf_member(root_, "asset");
        const auto extras = asset ? gltf_member(*asset, "extras") : std::nullopt;
        const auto origin = extras ? gltf_member(*extras, "origin") : std::nullopt;
        if (!origin) return {};
        std::array<double, 3> at{};
        const std::array<std::string_view, 3> names{"lat_deg", "lon_deg", "h_m"};
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto value = gltf_member(*origin, names[i]);
            if (!value || !mesh_number(value->source(), at[i]) || !std::isfinite(at[i])) return {};
        }
        const auto [lat_deg, lon_deg, h_m] = at;
        constexpr double most_h_m = 1.0e5;
        if (std::abs(lat_deg) > 90.0 || std::abs(lon_deg) > 360.0 || std::abs(h_m) > most_h_m)
            return gltf_fault("its asset.extras.origin is no place on the Earth");
        const glm::dvec3 middle = ecef_from_geodetic({lat_deg, lon_deg, h_m}).m;
        const glm::dmat3 axes = ecef_from_enu(lat_deg, lon_deg);
        for (glm::dvec3& vertex : mesh_.vertices) vertex = middle + axes * vertex;
        mesh_.crs = ecef_crs;
        return {};
    }

    // The bytes of an image; nothing, with a note, where it is not there, or neither PNG nor JPEG.
    Result<std::optional<std::string_view>> image_bytes(const JsonValue& image, const std::string& name) {
        const auto uri = gltf_member(image, "uri");
        if (!uri) {
            const auto view = gltf_count(image, "bufferView", std::nullopt);
            if (!view || *view >= views_.size())
                return gltf_fault(name + " has a buffer view that is not there");
            ORO_TRY(const std::string_view bytes, bytes_of_view(*view, name));
            return std::optional(bytes);
        }
        const std::string at = uri->text();
        const bool is_data = at.starts_with("data:");
        if (!is_data && !path_beside("", at)) {
            unread_.add(at, "is not read, as only files beside the mesh are");
            return std::optional<std::string_view>();
        }
        Result<std::string> bytes = bytes_of(at, name);
        if (!bytes.ok()) {
            if (is_data) return bytes.error();
            unread_.add(at, bytes.error().what);
            return std::optional<std::string_view>();
        }
        if ((image_bytes_ += bytes->size()) > most_mesh_bytes)
            return gltf_fault("has textures of more than 1 GiB");
        own_bytes_.push_back(std::make_unique<std::string>(std::move(*bytes)));
        return std::optional(std::string_view(*own_bytes_.back()));
    }

    // Whether a material's texture is read. Each is asked for once.
    Result<bool> find_image(const GltfTexture& texture) {
        if (!texture.image) {
            unread_.add("of an extension", "is neither PNG nor JPEG");
            return false;
        }
        GltfImage& state = image_states_[*texture.image];
        if (state.is_asked) return state.is_there;
        state.is_asked = true;
        const std::string name = "image " + std::to_string(*texture.image);
        const JsonValue& image = images_[*texture.image];
        ORO_TRY(const std::optional<std::string_view> bytes, image_bytes(image, name));
        if (!bytes) return false;
        const auto uri = gltf_member(image, "uri"), its_name = gltf_member(image, "name");
        std::string shown = uri && !uri->text().starts_with("data:") ? uri->text()
                            : its_name                               ? its_name->words()
                                                                     : "";
        if (shown.empty()) shown = name;
        if (!is_picture(*bytes)) {
            unread_.add(shown, "is neither PNG nor JPEG");
            return false;
        }
        state.is_there = true, state.number = textures_.size();
        textures_.push_back({shown, *bytes});
        return true;
    }

    // The colour of a primitive's material; its texture is one that is read.
    Result<GltfColour> colour_of(const JsonValue& primitive, const JsonValue& attributes) {
        if (!gltf_member(primitive, "material")) return GltfColour{};
        ORO_TRY(GltfColour colour, materials_.material(gltf_count(primitive, "material", std::nullopt)));
        if (!colour.texture) return colour;
        ORO_TRY(const bool is_there, find_image(*colour.texture));
        const std::string coordinates = "TEXCOORD_" + std::to_string(colour.texture->coordinates);
        const bool has_coordinates = gltf_member(attributes, coordinates).has_value();
        if (is_there && !has_coordinates)
            unread_.add(textures_[image_states_[*colour.texture->image].number].name,
                        "has no " + coordinates + " to lie by");
        if (!is_there || !has_coordinates) colour.texture.reset();
        return colour;
    }

    // Where the vertices of a primitive lie in its texture.
    Result<std::vector<glm::vec2>> texture_places(const GltfTexture& texture, const JsonValue& attributes,
                                                  std::size_t count) {
        const std::string name = "TEXCOORD_" + std::to_string(texture.coordinates);
        ORO_TRY(const GltfElements from, elements(gltf_count(attributes, name, std::nullopt), "VEC2", 2));
        if (from.count != count)
            return gltf_fault("a primitive has " + std::to_string(count) + " vertices and " +
                              std::to_string(from.count) + " of " + name);
        std::vector<glm::vec2> places;
        places.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec2 at(texture.place({gltf_number(from, i, 0), gltf_number(from, i, 1)}));
            if (!std::isfinite(at.x) || !std::isfinite(at.y))
                return gltf_fault("vertex " + std::to_string(i) + " of a primitive has a " + name +
                                  " that is no finite number");
            places.push_back(at);
        }
        return places;
    }

    // The triangles of a primitive from `begin` on, with their texture. Primitives of one material are one
    // part.
    Result<void> add_textured(const JsonValue& primitive, const JsonValue& attributes, std::size_t first,
                              std::size_t begin) {
        if (!colour_.texture) return {};
        const GltfTexture& texture = *colour_.texture;
        ORO_TRY(const std::vector<glm::vec2> places,
                texture_places(texture, attributes, mesh_.vertices.size() - first));
        const std::size_t material = gltf_count(primitive, "material", 0).value_or(0);
        const auto [found, is_new] = part_of_material_.try_emplace(material, textured_.size());
        if (is_new) textured_.push_back({image_states_[*texture.image].number, texture.wrap, {}});
        TexturedPart& part = textured_[found->second];
        for (std::size_t i = begin; i < mesh_.triangles.size(); ++i) {
            TexturedTriangle textured{static_cast<std::uint32_t>(i), {}};
            for (std::size_t k = 0; k < 3; ++k) textured.at[k] = places[mesh_.triangles[i][k] - first];
            part.triangles.push_back(textured);
        }
        return {};
    }

    // Of so many vertices, the last of the mesh.
    Result<void> read_colours(const JsonValue& primitive, const JsonValue& attributes, std::size_t count) {
        ORO_TRY(colour_, colour_of(primitive, attributes));
        const GltfColour& colour = colour_;
        const bool has_own = gltf_member(attributes, "COLOR_0").has_value();
        if (!has_own && !colour.is_stated && !colour.texture) return {};
        mesh_.colours.resize(mesh_.vertices.size());
        std::optional<GltfElements> own;
        if (has_own) {
            const auto number = gltf_count(attributes, "COLOR_0", std::nullopt);
            const auto type = number && *number < accessors_.size() ? gltf_member(accessors_[*number], "type")
                                                                    : std::nullopt;
            const bool has_opacity = type && type->words() == "VEC4";
            ORO_TRY(own, elements(number, has_opacity ? "VEC4" : "VEC3", has_opacity ? 4 : 3));
            if (own->count != count)
                return gltf_fault("a primitive has " + std::to_string(count) + " vertices and " +
                                  std::to_string(own->count) + " colours");
            const bool is_real = own->component == 5126,
                       is_code = own->component == 5121 || own->component == 5123;
            if (!is_real && !(is_code && own->normalized))
                return gltf_fault("a primitive has colours of a type that colours do not have");
        }
        const std::size_t first = mesh_.vertices.size() - count;
        for (std::size_t i = 0; i < count; ++i) {
            glm::dvec3 light = colour.factor;
            if (own)
                for (int part = 0; part < 3; ++part)
                    light[part] *= gltf_number(*own, i, static_cast<std::size_t>(part));
            mesh_.colours[first + i] = colour_of_light({light.x, light.y, light.z});
        }
        return {};
    }

    // numbers: of an element.
    [[nodiscard]] Result<GltfElements> elements(std::optional<std::size_t> number, const std::string& type,
                                                std::size_t parts) {
        if (!number || *number >= accessors_.size()) return gltf_fault("an accessor is not there");
        const JsonValue& accessor = accessors_[*number];
        const std::string name = "accessor " + std::to_string(*number);
        if (gltf_member(accessor, "sparse")) return gltf_fault(name + " is sparse, which is not read");
        const auto its_type = gltf_member(accessor, "type");
        const auto component = gltf_count(accessor, "componentType", std::nullopt),
                   count = gltf_count(accessor, "count", std::nullopt),
                   view = gltf_count(accessor, "bufferView", std::nullopt),
                   offset = gltf_count(accessor, "byteOffset", 0);
        if (!its_type || its_type->words() != type || !component || component_bytes(*component) == 0 ||
            !count || !view || !offset)
            return gltf_fault(name + " is no list of " + type + " in a buffer view");
        if (*view >= views_.size()) return gltf_fault(name + " has a buffer view that is not there");
        const std::size_t element = parts * component_bytes(*component);
        const auto stride = gltf_count(views_[*view], "byteStride", element);
        ORO_TRY(const std::string_view bytes, bytes_of_view(*view, name));
        if (!stride || *stride < element)
            return gltf_fault(name + ": its buffer view lies beyond its buffer");
        const bool fits = *count == 0 || (*offset <= bytes.size() && element <= bytes.size() - *offset &&
                                          *count - 1 <= (bytes.size() - *offset - element) / *stride);
        if (!fits) return gltf_fault(name + " lies beyond its buffer view");
        const auto normalized = gltf_member(accessor, "normalized");
        return GltfElements{bytes.substr(*count == 0 ? 0 : *offset), *count, *stride, *component,
                            normalized && normalized->source() == "true"};
    }

    Result<void> read_primitive(const JsonValue& primitive, const glm::dmat4& transform) {
        const auto mode = gltf_count(primitive, "mode", 4);
        const auto attributes = gltf_member(primitive, "attributes");
        if (!mode || *mode > 6) return gltf_fault("a primitive has a mode that is none");
        if (*mode < 4 || !attributes || !gltf_member(*attributes, "POSITION")) {
            ++without_triangles_;
            return {};
        }
        ORO_TRY(const GltfElements places,
                elements(gltf_count(*attributes, "POSITION", std::nullopt), "VEC3", 3));
        const std::size_t first = mesh_.vertices.size();
        if (places.count > most_gltf_triangles - std::min(first, most_gltf_triangles))
            return gltf_fault("has more than 50,000,000 vertices");
        for (std::size_t i = 0; i < places.count; ++i) {
            const glm::dvec3 at(transform * glm::dvec4(gltf_number(places, i, 0), gltf_number(places, i, 1),
                                                       gltf_number(places, i, 2), 1.0));
            // y is up, z comes towards one who looks north.
            mesh_.vertices.push_back(centre_ + glm::dvec3(at.x, -at.z, at.y));
        }
        ORO_CHECK(read_colours(primitive, *attributes, places.count));
        const std::size_t begin = mesh_.triangles.size();
        ORO_CHECK(read_indices(primitive, *mode, first, places.count));
        return add_textured(primitive, *attributes, first, begin);
    }

    Result<void> read_indices(const JsonValue& primitive, std::size_t mode, std::size_t first,
                              std::size_t vertices) {
        if (!gltf_member(primitive, "indices"))
            return triangles(
                mode, vertices, [&](std::size_t i) { return i; }, first, vertices);
        ORO_TRY(const GltfElements indices,
                elements(gltf_count(primitive, "indices", std::nullopt), "SCALAR", 1));
        return triangles(
            mode, indices.count,
            [&](std::size_t i) { return static_cast<std::size_t>(gltf_number(indices, i, 0)); }, first,
            vertices);
    }

    // mode: 4 triangles, 5 a strip, 6 a fan. Indices are those of whole numbers up to 2^32.
    template <class Index>
    Result<void> triangles(std::size_t mode, std::size_t count, const Index& index, std::size_t first,
                           std::size_t vertices) {
        const std::size_t step = mode == 4 ? 3 : 1;
        for (std::size_t i = 0; i + 2 < count && i / step < most_of_primitive_; i += step) {
            const std::size_t turned = mode == 5 ? i % 2 : 0;
            const std::array<std::size_t, 3> corners{mode == 6 ? index(0) : index(i), index(i + 1 + turned),
                                                     index(i + 2 - turned)};
            SourceTriangle triangle{};
            for (std::size_t k = 0; k < 3; ++k) {
                if (corners[k] >= vertices)
                    return gltf_fault("there is no vertex " + std::to_string(corners[k]) +
                                      ": its primitive has " + std::to_string(vertices));
                triangle[k] = static_cast<std::uint32_t>(first + corners[k]);
            }
            if (mesh_.triangles.size() >= most_gltf_triangles)
                return gltf_fault("has more than 50,000,000 triangles");
            mesh_.triangles.push_back(triangle);
        }
        return {};
    }

    const JsonValue root_;
    const std::optional<std::string_view> binary_;
    const FileBeside& beside_;
    const std::vector<JsonValue> nodes_, meshes_, accessors_, views_, images_;
    GltfMaterials materials_;
    std::vector<std::unique_ptr<std::string>> opened_;  // bytes of views that were compressed
    std::size_t opened_bytes_{};
    glm::dvec3 centre_{0.0};
    std::vector<GltfImage> image_states_;  // of each image
    std::size_t image_bytes_{};            // of other files
    std::vector<TextureBytes> textures_;
    std::vector<TexturedPart> textured_;
    std::map<std::size_t, std::size_t> part_of_material_;
    UnreadTextures unread_;
    GltfColour colour_;                                   // of the primitive that is read
    std::size_t most_of_primitive_{most_gltf_triangles};  // triangles that are read of it
    std::vector<std::unique_ptr<std::string>> own_bytes_;
    std::vector<std::string_view> buffers_;
    std::vector<bool> on_way_;
    int depth_{};
    std::size_t visited_{};
    std::size_t without_triangles_{};
    SourceMesh mesh_;
};

Result<SourceMesh> read_gltf_text(std::string_view text, std::optional<std::string_view> binary,
                                  const FileBeside& beside) {
    const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    ORO_CHECK(check_json(text, begin));
    const std::size_t at = text.find_first_not_of(" \t\r\n", begin);
    const JsonValue root(text, at == std::string_view::npos ? begin : at);
    if (!root.is(JsonValue::Kind::object)) return gltf_fault("is no glTF: it is no JSON object");
    return GltfReader(root, binary, beside).all();
}

}  // namespace

Result<SourceMesh> read_gltf(std::string_view bytes, const FileBeside& beside) {
    if (!bytes.starts_with("glTF")) return read_gltf_text(bytes, std::nullopt, beside);
    constexpr std::size_t head = 12, chunk_head = 8;
    if (bytes.size() < head + chunk_head) return gltf_fault("is cut off: a GLB has 20 bytes and more");
    if (gltf_value<std::uint32_t>(bytes, 4) != 2)
        return gltf_fault("is GLB of version " + std::to_string(gltf_value<std::uint32_t>(bytes, 4)) +
                          ": 2 is read");
    if (gltf_value<std::uint32_t>(bytes, 8) > bytes.size())
        return gltf_fault("is cut off: its header promises " +
                          std::to_string(gltf_value<std::uint32_t>(bytes, 8)) + " bytes; the file has " +
                          std::to_string(bytes.size()));
    std::optional<std::string_view> text, binary;
    for (std::size_t at = head; at + chunk_head <= bytes.size();) {
        const std::size_t length = gltf_value<std::uint32_t>(bytes, at);
        const std::string_view kind = bytes.substr(at + 4, 4);
        if (length > bytes.size() - at - chunk_head)
            return gltf_fault("byte " + std::to_string(at) + ": a chunk is longer than the file");
        const std::string_view chunk = bytes.substr(at + chunk_head, length);
        if (kind == "JSON" && !text) text = chunk;
        if (kind == std::string_view("BIN\0", 4) && !binary) binary = chunk;
        at += chunk_head + length;
    }
    if (!text) return gltf_fault("is a GLB without a chunk of JSON");
    return read_gltf_text(*text, binary, beside);
}

}  // namespace oro
