#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"
#include "geo/meshes/obj_materials.h"
#include "geo/meshes/path_beside.h"
#include "geo/meshes/texture_colours.h"
#include "geo/pixels/picture_rows.h"

namespace oro {
namespace {

// The element that an index names: "7", or "-1" for the last one so far.
std::optional<std::uint32_t> obj_element(std::string_view word, std::size_t elements) {
    long long index = 0;
    if (!whole_number_in(word, index)) return std::nullopt;
    const auto count = static_cast<long long>(elements);
    if (index == 0 || index > count || index < -count) return std::nullopt;
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
}

// The rest of a line that is a name.
std::string obj_name(std::string_view words) {
    constexpr std::string_view blanks = " \t\v\f\r";
    const std::size_t begin = words.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return std::string(words.substr(begin, words.find_last_not_of(blanks) - begin + 1));
}

// Colours behind the places of vertices, as the file has them: from 0 to 1, or to 255 where one is larger.
class ObjColours {
  public:
    // words: behind a vertex's place. Three numbers are a colour; a fourth is its opacity, and one alone a
    // weight.
    Result<void> add(std::string_view words, std::size_t line, std::size_t vertex) {
        std::array<float, 3> parts{};
        for (float& part : parts) {
            const std::string_view word = take_word(words);
            if (word.empty()) return {};
            double value = 0.0;
            if (!mesh_number(word, value) || !std::isfinite(value))
                return mesh_fault("line", line, shown_word(word) + " is no number of a colour");
            part = static_cast<float>(value);
        }
        largest_ = std::max(largest_, std::ranges::max(parts));
        parts_.push_back(parts), of_.push_back(vertex);
        return {};
    }
    // Of so many vertices; none where no vertex has one.
    [[nodiscard]] std::vector<VertexColour> of_all(std::size_t vertices) const {
        if (parts_.empty()) return {};
        std::vector<VertexColour> colours(vertices);
        const float most = largest_ > 1.0F ? 255.0F : 1.0F;
        const auto code = [&](float part) {
            return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(part / most, 0.0F, 1.0F)));
        };
        for (std::size_t i = 0; i < parts_.size(); ++i)
            colours[of_[i]] = {code(parts_[i][0]), code(parts_[i][1]), code(parts_[i][2]), 1};
        return colours;
    }

  private:
    std::vector<std::array<float, 3>> parts_;
    std::vector<std::size_t> of_;
    float largest_{};
};

constexpr std::uint32_t no_coordinate = ~std::uint32_t{0};

// What a triangle shows, of a file with materials.
struct ObjTriangleLook {
    std::uint32_t material{};  // among the names that usemtl gave; 0: none
    std::array<std::uint32_t, 3> at{};
};

// Something that is wrong with a texture coordinate, and where.
struct ObjFault {
    std::size_t line{};
    std::string why;
};

class ObjReader {
  public:
    ObjReader(const FileBeside& beside, const std::shared_ptr<ScratchMemory>& scratch) : beside_(beside) {
        mesh_.format = "OBJ";
        mesh_.lie_in(scratch);
    }

    Result<SourceMesh> all(std::string_view bytes) {
        std::string joined;
        for (std::size_t number = 1; !bytes.empty(); ++number) {
            std::string_view line = take_line(bytes);
            if (line.ends_with('\\')) {  // goes on in the next line
                joined.append(line.substr(0, line.size() - 1)).push_back(' ');
                continue;
            }
            if (!joined.empty()) line = joined.append(line);
            ORO_CHECK(read_line(line.substr(0, line.find('#')), number));
            joined.clear();
        }
        if (!joined.empty()) return Error{ErrorKind::failed, "", "ends within a line that goes on"};
        const std::vector<VertexColour> colours = colours_.of_all(mesh_.vertices.size());
        mesh_.colours.assign(colours.begin(), colours.end());
        ORO_CHECK(read_libraries());
        ORO_CHECK(colour_by_materials());
        return std::move(mesh_);
    }

  private:
    Result<void> read_line(std::string_view words, std::size_t line) {
        const std::string_view key = take_word(words);
        if (key == "v") return read_vertex(words, line);
        if (key == "vt") read_coordinate(words, line);
        if (key == "f") return read_face(words, line);
        if (key == "o" || key == "g")
            mesh_.parts.push_back({std::string(take_word(words)), mesh_.triangles.size()});
        if (key == "mtllib") libraries_.push_back(obj_name(words));
        if (key == "usemtl") {
            const auto next = static_cast<std::uint32_t>(number_of_.size() + 1);
            material_ = number_of_.try_emplace(obj_name(words), next).first->second;
        }
        return {};
    }

    Result<void> read_vertex(std::string_view words, std::size_t line) {
        glm::dvec3 place{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(words);
            if (word.empty()) return mesh_fault("line", line, "a vertex has fewer than three numbers");
            if (!mesh_number(word, place[axis]))
                return mesh_fault("line", line, shown_word(word) + " is no number");
        }
        mesh_.vertices.push_back(place);
        return colours_.add(words, line, mesh_.vertices.size() - 1);
    }

    // One that is wrong is an error where a texture asks for it.
    void read_coordinate(std::string_view words, std::size_t line) {
        glm::dvec2 at(0.0);
        for (int part = 0; part < 2; ++part) {
            const std::string_view word = take_word(words);
            if (part > 0 && word.empty()) break;
            if (mesh_number(word, at[part]) && std::isfinite(static_cast<float>(at[part]))) continue;
            wrong_.try_emplace(static_cast<std::uint32_t>(coordinates_.size()),
                               ObjFault{line, shown_word(word) + " is no number of a texture"});
        }
        coordinates_.emplace_back(at);
    }

    Result<void> read_face(std::string_view words, std::size_t line) {
        std::vector<std::uint32_t> corners, at;
        for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
            const std::size_t slash = word.find('/');
            const auto corner = obj_element(word.substr(0, slash), mesh_.vertices.size());
            if (!corner)
                return mesh_fault("line", line,
                                  "the corner " + shown_word(word) + " is none of the " +
                                      std::to_string(mesh_.vertices.size()) + " vertices before it");
            corners.push_back(*corner);
            at.push_back(coordinate_of(slash == std::string_view::npos ? "" : word.substr(slash + 1), line));
        }
        const std::size_t before = mesh_.triangles.size();
        if (const char* const fault = add_polygon(corners, mesh_)) return mesh_fault("line", line, fault);
        if (material_ != 0 || !looks_.empty()) add_looks(before, corners, at);
        return {};
    }
    // words: what stands behind a corner's first slash.
    std::uint32_t coordinate_of(std::string_view words, std::size_t line) {
        const std::string_view word = words.substr(0, words.find('/'));
        if (word.empty()) return no_coordinate;
        const auto found = obj_element(word, coordinates_.size());
        if (found) return *found;
        // Numbers that no coordinate has stand for what is wrong.
        constexpr std::uint32_t most_faults = 1000;
        const std::uint32_t number = no_coordinate - 1 - std::min(missing_, most_faults);
        ++missing_;
        wrong_.try_emplace(number,
                           ObjFault{line, "the texture coordinate " + shown_word(word) + " is none of the " +
                                              std::to_string(coordinates_.size()) + " before it"});
        return number;
    }
    void add_looks(std::size_t before, const std::vector<std::uint32_t>& corners,
                   const std::vector<std::uint32_t>& at) {
        looks_.resize(before);
        std::map<std::uint32_t, std::uint32_t> of_many;
        constexpr std::size_t few = 8;
        if (corners.size() > few)
            for (std::size_t i = 0; i < corners.size(); ++i) of_many.try_emplace(corners[i], at[i]);
        for (std::size_t i = before; i < mesh_.triangles.size(); ++i) {
            ObjTriangleLook look{material_, {}};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = mesh_.triangles[i][k];
                look.at[k] =
                    of_many.empty()
                        ? at[static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin())]
                        : of_many.at(vertex);
            }
            looks_.push_back(look);
        }
    }

    // One line may name several; a name may hold blanks.
    Result<void> read_libraries() {
        if (number_of_.empty()) return {};
        for (const std::string& line : libraries_) {
            ORO_TRY(const std::string why, read_library(line));
            if (why.empty()) continue;
            std::string_view words = line;
            const std::string_view first = take_word(words);
            if (first.size() == line.size()) {
                mesh_.notes.push_back("its materials in " + shown_word(line) + " are not read, which " + why);
                continue;
            }
            words = line;
            for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
                ORO_TRY(const std::string its_why, read_library(std::string(word)));
                if (its_why.empty()) continue;
                mesh_.notes.push_back("its materials in " + shown_word(line) + " are not read, which " + why);
                break;
            }
        }
        return {};
    }
    // Why a file cannot be read, or "". Errors: what is wrong in it.
    Result<std::string> read_library(std::string name) {
        std::ranges::replace(name, '\\', '/');
        const std::optional<std::string> path = path_beside("", name);
        if (!path) return std::string("is not beside the mesh");
        const Result<std::string> bytes = beside_(*path);
        if (!bytes.ok()) return bytes.error().what;
        std::map<std::string, ObjMaterial, std::less<>> read;
        const Result<void> is_read = read_obj_materials(*bytes, read);
        if (!is_read.ok())
            return Error{ErrorKind::failed, "",
                         "its materials in " + shown_word(name) + ": " + is_read.error().what};
        for (auto& [its_name, material] : read) {
            material.folder = std::string(folder_of_path(*path));
            materials_.try_emplace(its_name, std::move(material));
        }
        return std::string();
    }

    // The number of a material's texture among those that are read; nothing where it has none.
    std::optional<std::size_t> texture_of(const ObjMaterial& material) {
        if (material.texture.empty()) return std::nullopt;
        const std::optional<std::string> path = path_beside(material.folder, material.texture);
        if (!path) {
            unread_.add(material.texture, "is not read, as only files beside the mesh are");
            return std::nullopt;
        }
        const auto [found, is_new] = number_of_texture_.try_emplace(*path);
        if (!is_new) return found->second;
        Result<std::string> bytes = beside_(*path);
        if (!bytes.ok()) {
            unread_.add(*path, bytes.error().what);
        } else if (!is_picture(*bytes)) {
            unread_.add(*path, "is neither PNG nor JPEG");
        } else {
            found->second = textures_.size();
            texture_bytes_.push_back(std::make_unique<std::string>(std::move(*bytes)));
            textures_.push_back({*path, *texture_bytes_.back()});
        }
        return found->second;
    }

    // What the materials of a file do to its vertices. A vertex that triangles of several share is one for
    // each of them; kind 0: no material colours it.
    struct Kind {
        std::optional<glm::dvec3> colour;
        std::optional<std::size_t> part;  // of textured_
        glm::dvec2 offset{0.0}, scale{1.0};
    };

    // Two of each material: with its texture, and without for triangles that have no coordinates.
    std::vector<Kind> kinds_of_materials() {
        std::vector<Kind> kinds(2 * number_of_.size() + 1);
        for (const auto& [name, number] : number_of_) {
            const auto found = materials_.find(name);
            if (found == materials_.end()) continue;
            const ObjMaterial& material = found->second;
            Kind &with = kinds[2 * number - 1], &without = kinds[2 * number];
            with.colour = without.colour = material.colour;
            const std::optional<std::size_t> texture = texture_of(material);
            if (!texture) continue;
            with.part = textured_.size(), with.offset = material.offset, with.scale = material.scale;
            textured_.push_back({*texture, {material.wrap, material.wrap}, {}});
        }
        return kinds;
    }

    Result<void> colour_by_materials() {
        if (looks_.empty() || materials_.empty()) return {};
        const std::vector<Kind> kinds = kinds_of_materials();
        std::vector<std::size_t> owner(mesh_.vertices.size(), no_owner);
        for (std::size_t i = 0; i < looks_.size(); ++i) {
            ORO_TRY(const std::size_t kind, kind_of(i, kinds));
            for (std::uint32_t& corner : mesh_.triangles[i]) corner = own_vertex(corner, kind, owner);
        }
        if (std::ranges::all_of(owner, [](std::size_t one) { return one == no_owner || one == 0; }))
            return unread_.note_in(mesh_), Result<void>{};
        mesh_.colours.resize(mesh_.vertices.size());
        for (std::size_t i = 0; i < owner.size(); ++i) {
            VertexColour& colour = mesh_.colours[i];
            if (owner[i] == no_owner || owner[i] == 0) continue;
            const Kind& kind = kinds[owner[i]];
            if (!kind.part && colour.is_stated != 0) continue;
            const glm::dvec3 codes = glm::round(255.0 * kind.colour.value_or(glm::dvec3(1.0)));
            colour = {static_cast<std::uint8_t>(codes.x), static_cast<std::uint8_t>(codes.y),
                      static_cast<std::uint8_t>(codes.z), 1};
        }
        ORO_CHECK(colour_by_textures(textures_, textured_, mesh_));
        unread_.note_in(mesh_);
        return {};
    }

    // Of a triangle, which its part gets if it is textured. Errors: a coordinate that is wrong.
    Result<std::size_t> kind_of(std::size_t triangle, const std::vector<Kind>& kinds) {
        const ObjTriangleLook& look = looks_[triangle];
        if (look.material == 0) return std::size_t{0};
        const std::size_t without = 2 * std::size_t{look.material}, with = without - 1;
        const std::size_t otherwise = kinds[without].colour ? without : 0;
        if (!kinds[with].part) return otherwise;
        TexturedTriangle textured{static_cast<std::uint32_t>(triangle), {}};
        for (std::size_t k = 0; k < 3; ++k) {
            if (look.at[k] == no_coordinate) {
                unread_.add(textures_[textured_[*kinds[with].part].texture].name,
                            "has triangles without texture coordinates");
                return otherwise;
            }
            if (const auto wrong = wrong_.find(look.at[k]); wrong != wrong_.end())
                return mesh_fault("line", wrong->second.line, wrong->second.why);
            glm::dvec2 at = glm::dvec2(coordinates_[look.at[k]]) * kinds[with].scale + kinds[with].offset;
            at.y = 1.0 - at.y;  // v of OBJ goes up
            textured.at[k] = glm::vec2(at);
            if (!std::isfinite(textured.at[k].x) || !std::isfinite(textured.at[k].y))
                return Error{ErrorKind::failed, "", "map_Kd scales a texture coordinate beyond all bounds"};
        }
        textured_[*kinds[with].part].triangles.push_back(textured);
        return with;
    }

    // The vertex of a kind that lies where another does: itself, or a copy.
    std::uint32_t own_vertex(std::uint32_t vertex, std::size_t kind, std::vector<std::size_t>& owner) {
        if (owner[vertex] == no_owner) owner[vertex] = kind;
        if (owner[vertex] == kind) return vertex;
        const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto [found, is_new] = copies_.try_emplace({vertex, kind}, next);
        if (!is_new) return found->second;
        const glm::dvec3 at = mesh_.vertices[vertex];
        mesh_.vertices.push_back(at);
        if (!mesh_.colours.empty()) {
            const VertexColour colour = mesh_.colours[vertex];
            mesh_.colours.push_back(colour);
        }
        owner.push_back(kind);
        return next;
    }

    static constexpr std::size_t no_owner = ~std::size_t{0};

    const FileBeside& beside_;
    SourceMesh mesh_;
    ObjColours colours_;
    std::vector<glm::vec2> coordinates_;
    std::map<std::uint32_t, ObjFault> wrong_;         // by the number of the coordinate
    std::uint32_t missing_{};                         // coordinates that are not there
    std::vector<std::string> libraries_;              // lines of mtllib
    std::map<std::string, std::uint32_t> number_of_;  // of what usemtl names, from 1 on
    std::uint32_t material_{};                        // of the faces that are read
    std::vector<ObjTriangleLook> looks_;  // of triangles, where a material is named; those behind have none
    std::map<std::string, ObjMaterial, std::less<>> materials_;
    std::map<std::string, std::optional<std::size_t>> number_of_texture_;  // by its path
    std::vector<std::unique_ptr<std::string>> texture_bytes_;
    std::vector<TextureBytes> textures_;
    std::vector<TexturedPart> textured_;
    std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> copies_;
    UnreadTextures unread_;
};

}  // namespace

Result<SourceMesh> read_obj(std::string_view bytes, const FileBeside& beside,
                            const std::shared_ptr<ScratchMemory>& scratch) {
    return ObjReader(beside, scratch).all(bytes);
}

}  // namespace oro
