#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"

namespace oro {
namespace {

// The vertex that a corner of a face names: "7", "7/2/1", or "-1" for the last one so far.
std::optional<std::uint32_t> obj_corner(std::string_view word, std::size_t vertices) {
    long long index = 0;
    if (!whole_number_in(word.substr(0, word.find('/')), index)) return std::nullopt;
    const auto count = static_cast<long long>(vertices);
    if (index == 0 || index > count || index < -count) return std::nullopt;
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
}

Result<void> obj_face(std::string_view words, std::size_t line, SourceMesh& mesh) {
    std::vector<std::uint32_t> corners;
    for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
        const auto corner = obj_corner(word, mesh.vertices.size());
        if (!corner)
            return mesh_fault("line", line,
                              "the corner " + shown_word(word) + " is none of the " +
                                  std::to_string(mesh.vertices.size()) + " vertices before it");
        corners.push_back(*corner);
    }
    if (const char* const fault = add_polygon(corners, mesh)) return mesh_fault("line", line, fault);
    return {};
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

Result<void> obj_line(std::string_view words, std::size_t line, SourceMesh& mesh, ObjColours& colours) {
    const std::string_view key = take_word(words);
    if (key == "v") {
        glm::dvec3 place{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(words);
            if (word.empty()) return mesh_fault("line", line, "a vertex has fewer than three numbers");
            if (!mesh_number(word, place[axis]))
                return mesh_fault("line", line, shown_word(word) + " is no number");
        }
        mesh.vertices.push_back(place);
        return colours.add(words, line, mesh.vertices.size() - 1);
    }
    if (key == "f") {
        return obj_face(words, line, mesh);
    }
    if (key == "o" || key == "g") {
        mesh.parts.push_back({std::string(take_word(words)), mesh.triangles.size()});
    }
    return {};
}

}  // namespace

Result<SourceMesh> read_obj(std::string_view bytes) {
    SourceMesh mesh;
    mesh.format = "OBJ";
    std::string joined;
    ObjColours colours;
    for (std::size_t number = 1; !bytes.empty(); ++number) {
        std::string_view line = take_line(bytes);
        if (line.ends_with('\\')) {  // goes on in the next line
            joined.append(line.substr(0, line.size() - 1)).push_back(' ');
            continue;
        }
        if (!joined.empty()) line = joined.append(line);
        ORO_CHECK(obj_line(line.substr(0, line.find('#')), number, mesh, colours));
        joined.clear();
    }
    if (!joined.empty()) return Error{ErrorKind::failed, "", "ends within a line that goes on"};
    mesh.colours = colours.of_all(mesh.vertices.size());
    return mesh;
}

}  // namespace oro
