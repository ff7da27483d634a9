// CityJSON, read where it stands: https://www.cityjson.org/specs/2.0.1/ (and 1.0.3, 1.1.3).
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"
#include "geo/meshes/polygon_cut.h"
#include "geo/vectors/json_text.h"

namespace oro {
namespace {

constexpr std::size_t most_attributes = 64, longest_attribute = 200;

Error city_fault(const JsonValue& value, const std::string& why) {
    return mesh_fault("byte", value.at(), why);
}

std::optional<JsonValue> member(const JsonValue& object, std::string_view name) {
    for (const auto& [its_name, value] : object.members())
        if (its_name == name) return value;
    return std::nullopt;
}

std::string text_of_member(const JsonValue& object, std::string_view name) {
    const std::optional<JsonValue> value = member(object, name);
    return value ? value->words() : "";
}

// Numbers of an array; an Error where it has others than `count` of them.
Result<std::vector<double>> numbers_of(const JsonValue& array, std::size_t count) {
    std::vector<double> numbers;
    bool all = array.is(JsonValue::Kind::array);
    array.each([&](const JsonValue& one) {
        double number = 0.0;
        all = all && one.is(JsonValue::Kind::number) && mesh_number(one.source(), number);
        numbers.push_back(number);
        return all && numbers.size() <= count;
    });
    if (!all || numbers.size() != count)
        return city_fault(array, "is no list of " + std::to_string(count) + " numbers");
    return numbers;
}

Result<glm::dvec3> place_of(const JsonValue& array) {
    ORO_TRY(const std::vector<double> numbers, numbers_of(array, 3));
    return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

// "EPSG:7415" of an URN or a URL; "" where it is neither, or the code is no number above 0.
std::string epsg_of(const std::string& reference) {
    const std::size_t epsg = reference.find("EPSG");
    const std::size_t code = reference.find_last_of(":/");
    long long number = 0;
    if (epsg == std::string::npos || code == std::string::npos ||
        !whole_number_in(std::string_view(reference).substr(code + 1), number) || number <= 0)
        return "";
    return "EPSG:" + std::to_string(number);
}

// A geometry of an object, and its level of detail.
struct CityGeometry {
    JsonValue value;
    std::string kind;  // its member `type`
    std::string lod;
};

// Its level as a number: 2.2 is more than 2. Words that are none count as below 0.
double level_of(const std::string& lod) {
    double level = 0.0;
    return mesh_number(lod, level) && std::isfinite(level) ? level : -1.0;
}

// How many lists lie around the rings' numbers: surfaces of rings, shells of surfaces, solids of shells.
// Nothing for a type that has no surfaces.
std::optional<int> depth_of(const std::string& type) {
    if (type == "MultiSurface" || type == "CompositeSurface") return 2;
    if (type == "Solid") return 3;
    if (type == "MultiSolid" || type == "CompositeSolid") return 4;
    return std::nullopt;
}

struct CityObject {
    std::string type;
    std::vector<CityGeometry> geometries;
    std::vector<std::string> children, parents;
    std::vector<std::pair<std::string, std::string>> attributes;
    double highest_level{-1.0};  // of its geometries that have surfaces
};

class CityJsonReader {
  public:
    CityJsonReader(const JsonValue& root, std::string lod) : root_(root), lod_(std::move(lod)) {}

    Result<SourceMesh> all() {
        mesh_.format = "CityJSON";
        mesh_.kind = MeshKind::city_model;
        ORO_CHECK(check_version());
        if (const auto metadata = member(root_, "metadata"))
            mesh_.crs = epsg_of(text_of_member(*metadata, "referenceSystem"));
        ORO_CHECK(read_transform());
        const auto vertices = member(root_, "vertices");
        if (!vertices) return Error{ErrorKind::failed, "", "has no 'vertices'"};
        ORO_CHECK(read_vertices(*vertices));
        ORO_CHECK(read_templates());
        const auto objects = member(root_, "CityObjects");
        if (!objects || !objects->is(JsonValue::Kind::object))
            return Error{ErrorKind::failed, "", "has no 'CityObjects'"};
        for (const auto& [name, value] : objects->members()) {
            ORO_TRY(CityObject object, object_of(value));
            if (!objects_.emplace(name, std::move(object)).second)
                return city_fault(value, "the object " + shown_word(name) + " is there twice");
            order_.push_back(name);
        }
        for (const std::string& name : order_) ORO_CHECK(draw(name));
        if (mesh_.triangles.empty() && without_level_ > 0)
            return Error{ErrorKind::usage, "",
                         "has nothing in the level of detail " + shown_word(lod_) + " (--lod): it has " +
                             levels_in_words()};
        tell();
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] Result<void> check_version() const {
        const std::string version = text_of_member(root_, "version");
        if (version.starts_with("1.0") || version.starts_with("1.1") || version.starts_with("2.0")) return {};
        return Error{ErrorKind::failed, "",
                     "is CityJSON " + (version.empty() ? "without a version" : shown_word(version)) +
                         ": 1.0, 1.1 and 2.0 are read"};
    }

    Result<void> read_transform() {
        const auto transform = member(root_, "transform");
        if (!transform) {
            // Those from 1.1 on have one; some programs leave it out where vertices are metres.
            if (!text_of_member(root_, "version").starts_with("1.0"))
                mesh_.notes.emplace_back("it has no 'transform': its vertices are taken as they are");
            return {};
        }
        const auto scale = member(*transform, "scale"), translate = member(*transform, "translate");
        if (!scale || !translate) return city_fault(*transform, "'transform' has no scale and translate");
        ORO_TRY(scale_, place_of(*scale));
        ORO_TRY(translate_, place_of(*translate));
        return {};
    }

    Result<void> read_vertices(const JsonValue& list) {
        Result<void> read{};
        list.each([&](const JsonValue& value) {
            const Result<glm::dvec3> place = place_of(value);
            if (!place.ok())
                read = place.error();
            else
                mesh_.vertices.push_back(*place * scale_ + translate_);
            return read.ok();
        });
        own_vertices_ = mesh_.vertices.size();
        return read;
    }

    // Templates stay as they are: their instances are made of copies.
    Result<void> read_templates() {
        const auto list = member(root_, "geometry-templates");
        if (!list) return {};
        if (const auto vertices = member(*list, "vertices-templates")) {
            Result<void> read{};
            vertices->each([&](const JsonValue& value) {
                const Result<glm::dvec3> place = place_of(value);
                if (!place.ok())
                    read = place.error();
                else
                    template_vertices_.push_back(*place);
                return read.ok();
            });
            ORO_CHECK(std::move(read));
        }
        if (const auto templates = member(*list, "templates"))
            templates->each([&](const JsonValue& value) {
                templates_.push_back(geometry_of(value));
                return true;
            });
        return {};
    }

    [[nodiscard]] static CityGeometry geometry_of(const JsonValue& value) {
        return {value, text_of_member(value, "type"), text_of_member(value, "lod")};
    }

    // That of a template where it is an instance of one.
    [[nodiscard]] Result<CityGeometry> with_level(CityGeometry geometry) const {
        if (geometry.kind != "GeometryInstance") return geometry;
        ORO_TRY(const std::size_t number, template_of(geometry.value));
        geometry.lod = templates_[number].lod;
        return geometry;
    }

    [[nodiscard]] Result<std::size_t> template_of(const JsonValue& instance) const {
        const auto value = member(instance, "template");
        long long number = -1;
        if (!value || !whole_number_in(value->source(), number) || number < 0 ||
            static_cast<std::size_t>(number) >= templates_.size())
            return city_fault(instance, "there is no template " +
                                            (value ? shown_word(value->source()) : std::string("named")) +
                                            ": the file has " + std::to_string(templates_.size()));
        return static_cast<std::size_t>(number);
    }

    Result<CityObject> object_of(const JsonValue& value) {
        CityObject object;
        Result<void> read{};
        for (const auto& [name, what] : value.members()) {
            if (name == "type") object.type = what.words();
            if (name == "children" || name == "parents")
                what.each([&, list = name == "children" ? &object.children : &object.parents](
                              const JsonValue& one) { return list->push_back(one.text()), true; });
            if (name == "attributes") add_attributes(what, object);
            if (name != "geometry") continue;
            what.each([&](const JsonValue& one) {
                Result<CityGeometry> geometry = with_level(geometry_of(one));
                if (!geometry.ok()) {
                    read = geometry.error();
                    return false;
                }
                const bool has_surfaces =
                    depth_of(geometry->kind).has_value() || geometry->kind == "GeometryInstance";
                if (has_surfaces)
                    object.highest_level = std::max(object.highest_level, level_of(geometry->lod));
                else
                    ++without_surfaces_;
                if (has_surfaces) object.geometries.push_back(std::move(*geometry));
                return true;
            });
        }
        ORO_CHECK(std::move(read));
        return object;
    }

    // Texts, numbers and the like; lists and objects as they are written.
    static void add_attributes(const JsonValue& attributes, CityObject& object) {
        for (const auto& [name, value] : attributes.members()) {
            if (object.attributes.size() == most_attributes) break;
            object.attributes.emplace_back(name.substr(0, longest_attribute),
                                           value.words().substr(0, longest_attribute));
        }
    }

    // What an object is a part of in the end; a chain that comes back to itself ends.
    [[nodiscard]] std::vector<std::string> wholes_of(const std::string& name) const {
        std::vector<std::string> wholes;
        std::set<std::string> met{name};
        for (auto at = objects_.find(name); at != objects_.end() && !at->second.parents.empty();) {
            const std::string& parent = at->second.parents.front();
            if (!met.insert(parent).second) break;
            at = objects_.find(parent);
            if (at != objects_.end()) wholes.push_back(parent);
        }
        return wholes;
    }

    // Whether a part of it is there in more detail than it is itself.
    [[nodiscard]] bool is_in_parts(const CityObject& object) const {
        return std::ranges::any_of(object.children, [&](const std::string& child) {
            const auto found = objects_.find(child);
            return found != objects_.end() && found->second.highest_level > object.highest_level;
        });
    }

    Result<void> draw(const std::string& name) {
        const CityObject& object = objects_.at(name);
        if (object.geometries.empty()) return {};
        const double level = lod_.empty() ? object.highest_level : level_of(lod_);
        if (lod_.empty() && is_in_parts(object)) {
            ++in_parts_;
            return {};
        }
        MeshFeature feature{name, object.type, "", object.attributes, mesh_.triangles.size()};
        for (const std::string& whole : wholes_of(name)) {
            feature.part_of = whole;
            for (const auto& attribute : objects_.at(whole).attributes) {
                const bool is_known = std::ranges::any_of(
                    feature.attributes, [&](const auto& own) { return own.first == attribute.first; });
                if (!is_known && feature.attributes.size() < most_attributes)
                    feature.attributes.push_back(attribute);
            }
        }
        mesh_.features.push_back(std::move(feature));
        bool has_level = false;
        for (const CityGeometry& geometry : object.geometries) {
            levels_.insert(geometry.lod);
            if (level_of(geometry.lod) != level) continue;
            has_level = true;
            ORO_CHECK(geometry.kind == "GeometryInstance" ? instance(geometry) : own_surfaces(geometry));
        }
        if (!has_level) ++without_level_;
        if (mesh_.features.back().first_triangle == mesh_.triangles.size()) mesh_.features.pop_back();
        return {};
    }

    Result<void> own_surfaces(const CityGeometry& geometry) {
        const auto boundaries = member(geometry.value, "boundaries");
        if (!boundaries) return city_fault(geometry.value, "a geometry has no 'boundaries'");
        return surfaces(*boundaries, *depth_of(geometry.kind), 0, own_vertices_);
    }

    // A template, moved and turned, with its origin at one vertex.
    Result<void> instance(const CityGeometry& geometry) {
        ORO_TRY(const std::size_t number, template_of(geometry.value));
        const CityGeometry& made = templates_[number];
        const std::optional<int> depth = depth_of(made.kind);
        if (!depth) return {};
        const auto at = member(geometry.value, "boundaries");
        std::optional<std::size_t> vertex;
        if (at)
            at->each([&](const JsonValue& one) {
                long long index = -1;
                if (whole_number_in(one.source(), index) && index >= 0 &&
                    static_cast<std::size_t>(index) < own_vertices_)
                    vertex = static_cast<std::size_t>(index);
                return false;
            });
        if (!vertex) return city_fault(geometry.value, "an instance of a template has no vertex of the file");
        const auto matrix = member(geometry.value, "transformationMatrix");
        if (!matrix)
            return city_fault(geometry.value, "an instance of a template has no transformationMatrix");
        ORO_TRY(const std::vector<double> m, numbers_of(*matrix, 16));
        const std::size_t first = mesh_.vertices.size();
        if (first + template_vertices_.size() > most_vertices)
            return city_fault(geometry.value,
                              "its instances of templates have more than 100,000,000 vertices");
        for (const glm::dvec3& v : template_vertices_)
            mesh_.vertices.push_back(mesh_.vertices[*vertex] +
                                     glm::dvec3(m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3],
                                                m[4] * v.x + m[5] * v.y + m[6] * v.z + m[7],
                                                m[8] * v.x + m[9] * v.y + m[10] * v.z + m[11]));
        const auto boundaries = member(made.value, "boundaries");
        if (!boundaries) return city_fault(made.value, "a template has no 'boundaries'");
        return surfaces(*boundaries, *depth, first, template_vertices_.size());
    }

    // first: of the vertices that indices count from; count: how many there are.
    Result<void> surfaces(const JsonValue& list, int depth, std::size_t first, std::size_t count) {
        if (depth == 1) return {};
        if (!list.is(JsonValue::Kind::array)) return city_fault(list, "boundaries are no lists of lists");
        Result<void> read{};
        list.each([&](const JsonValue& one) {
            read = depth == 2 ? surface(one, first, count) : surfaces(one, depth - 1, first, count);
            return read.ok();
        });
        return read;
    }

    Result<void> surface(const JsonValue& list, std::size_t first, std::size_t count) {
        if (!list.is(JsonValue::Kind::array)) return city_fault(list, "a surface is no list of rings");
        PolygonRings rings;
        std::size_t corners = 0;
        bool is_outer = true, has_outer = true;
        Result<void> read{};
        list.each([&](const JsonValue& ring) {
            Result<std::vector<std::uint32_t>> made = ring_of(ring, first, count);
            if (!made.ok()) {
                read = made.error();
                return false;
            }
            corners += made->size();
            if (made->size() >= 3)
                rings.push_back(std::move(*made));
            else if (is_outer)
                has_outer = false;
            is_outer = false;
            return has_outer;
        });
        ORO_CHECK(std::move(read));
        if (!has_outer || rings.empty()) {
            ++short_rings_;
            return {};
        }
        if (corners > most_polygon_corners) return city_fault(list, "a surface has more than 10,000 corners");
        const bool is_sound = cut_polygon(mesh_.vertices, rings, mesh_.triangles);
        if (corners > 3) ++mesh_.polygons_cut;
        if (!is_sound) ++mesh_.polygons_crossing;
        return {};
    }

    [[nodiscard]] Result<std::vector<std::uint32_t>> ring_of(const JsonValue& list, std::size_t first,
                                                             std::size_t count) const {
        if (!list.is(JsonValue::Kind::array)) return city_fault(list, "a ring is no list of vertices");
        std::vector<std::uint32_t> ring;
        Result<void> read{};
        list.each([&](const JsonValue& one) {
            long long index = -1;
            if (!whole_number_in(one.source(), index) || index < 0 ||
                static_cast<std::size_t>(index) >= count) {
                read = city_fault(one, "there is no vertex " + shown_word(one.source()) + ": the file has " +
                                           std::to_string(count));
                return false;
            }
            const auto vertex = static_cast<std::uint32_t>(first + static_cast<std::size_t>(index));
            if (ring.empty() || ring.back() != vertex) ring.push_back(vertex);
            return true;
        });
        ORO_CHECK(std::move(read));
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        return ring;
    }

    // "1.2, 2.2": the levels of detail that its objects have.
    [[nodiscard]] std::string levels_in_words() const {
        std::string words;
        for (const std::string& level : levels_)
            words += (words.empty() ? "" : ", ") + (level.empty() ? "one without a name" : shown_word(level));
        return words;
    }

    void tell() {
        const auto note = [&](std::size_t many, const char* one, const char* several,
                              const std::string& what) {
            if (many > 0)
                mesh_.notes.push_back(std::to_string(many) + " " + (many == 1 ? one : several) + what);
        };
        note(without_surfaces_, "geometry", "geometries", " of points or lines, without surfaces, left out");
        note(short_rings_, "surface", "surfaces", " of fewer than three corners left out");
        note(in_parts_, "object drawn by its parts alone, which are",
             "objects drawn by their parts alone, which are", " there in more detail");
        note(without_level_, "object", "objects",
             " without the level of detail " + shown_word(lod_) + " left out (the file has " +
                 levels_in_words() + ")");
    }

    static constexpr std::size_t most_vertices = 100'000'000;
    const JsonValue root_;
    const std::string lod_;
    SourceMesh mesh_;
    glm::dvec3 scale_{1.0}, translate_{0.0};
    std::size_t own_vertices_{};
    std::vector<glm::dvec3> template_vertices_;
    std::vector<CityGeometry> templates_;
    std::map<std::string, CityObject> objects_;
    std::vector<std::string> order_;
    std::set<std::string> levels_;
    std::size_t without_surfaces_{}, short_rings_{}, in_parts_{}, without_level_{};
};

}  // namespace

Result<SourceMesh> read_cityjson(std::string_view bytes, const std::string& lod) {
    const std::size_t begin = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    ORO_TRY(const std::size_t end, check_json(bytes, begin));
    if (bytes.find_first_not_of(" \t\r\n", end) != std::string_view::npos)
        return mesh_fault("byte", end, "something stands behind the end of the object");
    const std::size_t at = bytes.find_first_not_of(" \t\r\n", begin);
    const JsonValue root(bytes, at == std::string_view::npos ? begin : at);
    if (!root.is(JsonValue::Kind::object) || text_of_member(root, "type") != "CityJSON")
        return Error{
            ErrorKind::failed, "",
            "is no CityJSON: its 'type' is " + (root.is(JsonValue::Kind::object)
                                                    ? "'" + shown_word(text_of_member(root, "type")) + "'"
                                                    : std::string("missing"))};
    return CityJsonReader(root, lod).all();
}

}  // namespace oro
