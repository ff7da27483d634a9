#include <array>
#include <cstring>
#include <string>
#include <string_view>

#include "geo/meshes/equal_corners.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"

namespace oro {
namespace {

constexpr std::size_t stl_header_bytes = 80, stl_triangle_bytes = 50;

std::uint64_t stl_count(std::string_view bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + stl_header_bytes, sizeof count);
    return count;
}

SourceMesh stl_binary(std::string_view bytes) {
    SourceMesh mesh;
    EqualCorners corners(mesh);
    const std::uint64_t count = stl_count(bytes);
    const char* from = bytes.data() + stl_header_bytes + sizeof(std::uint32_t);
    for (std::uint64_t i = 0; i < count; ++i, from += stl_triangle_bytes) {
        std::array<float, 12> numbers{};  // the normal, then three corners
        std::memcpy(numbers.data(), from, sizeof numbers);
        SourceTriangle triangle{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::size_t first = 3 + 3 * corner;
            triangle[corner] = corners.vertex({numbers[first], numbers[first + 1], numbers[first + 2]});
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

Result<SourceMesh> stl_text(std::string_view rest) {
    SourceMesh mesh;
    EqualCorners corners(mesh);
    SourceTriangle triangle{};
    std::size_t corner = 0;
    bool is_open = false;
    for (std::size_t line = 1; !rest.empty(); ++line) {
        std::string_view words = take_line(rest);
        const std::string_view key = take_word(words);
        if (key == "solid") {
            mesh.parts.push_back({std::string(take_word(words)), mesh.triangles.size()});
            is_open = true;
        } else if (key == "endsolid") {
            is_open = false;
        } else if (key == "vertex") {
            if (corner == 3) return mesh_fault("line", line, "a facet has more than three corners");
            glm::dvec3 place{};
            for (int axis = 0; axis < 3; ++axis) {
                const std::string_view word = take_word(words);
                if (!mesh_number(word, place[axis]))
                    return mesh_fault("line", line,
                                      word.empty() ? "a vertex has fewer than three numbers"
                                                   : shown_word(word) + " is no number");
            }
            triangle[corner++] = corners.vertex(place);
        } else if (key == "endfacet") {
            if (corner != 3) return mesh_fault("line", line, "a facet has fewer than three corners");
            mesh.triangles.push_back(triangle);
            corner = 0;
        }
    }
    if (is_open || corner != 0) return Error{ErrorKind::failed, "", "is cut off: it has no endsolid"};
    return mesh;
}

}  // namespace

Result<SourceMesh> read_stl(std::string_view bytes) {
    constexpr std::size_t begin = stl_header_bytes + sizeof(std::uint32_t);
    // Binary files, too, may begin with "solid": their length decides.
    const bool has_count = bytes.size() >= begin;
    if (has_count && begin + stl_count(bytes) * stl_triangle_bytes == bytes.size()) {
        SourceMesh mesh = stl_binary(bytes);
        mesh.format = "STL";
        return mesh;
    }
    if (bytes.starts_with("solid") && bytes.find('\0') == std::string_view::npos) {
        ORO_TRY(SourceMesh mesh, stl_text(bytes));
        mesh.format = "STL";
        return mesh;
    }
    if (!has_count) return Error{ErrorKind::failed, "", "is no STL: it has fewer than 84 bytes"};
    return Error{ErrorKind::failed, "",
                 "is no whole STL: its header promises " + std::to_string(stl_count(bytes)) +
                     " triangles, which take " +
                     std::to_string(begin + stl_count(bytes) * stl_triangle_bytes) + " bytes; the file has " +
                     std::to_string(bytes.size())};
}

}  // namespace oro
