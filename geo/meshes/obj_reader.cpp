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

Result<void> obj_line(std::string_view words, std::size_t line, SourceMesh& mesh) {
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
    } else if (key == "f") {
        return obj_face(words, line, mesh);
    } else if (key == "o" || key == "g") {
        mesh.parts.push_back({std::string(take_word(words)), mesh.triangles.size()});
    }
    return {};
}

}  // namespace

Result<SourceMesh> read_obj(std::string_view bytes) {
    SourceMesh mesh;
    mesh.format = "OBJ";
    std::string joined;
    for (std::size_t number = 1; !bytes.empty(); ++number) {
        std::string_view line = take_line(bytes);
        if (line.ends_with('\\')) {  // goes on in the next line
            joined.append(line.substr(0, line.size() - 1)).push_back(' ');
            continue;
        }
        if (!joined.empty()) line = joined.append(line);
        ORO_CHECK(obj_line(line.substr(0, line.find('#')), number, mesh));
        joined.clear();
    }
    if (!joined.empty()) return Error{ErrorKind::failed, "", "ends within a line that goes on"};
    return mesh;
}

}  // namespace oro
