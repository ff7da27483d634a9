#include "geo/meshes/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/base/open_file.h"
#include "geo/files/file_begin.h"
#include "geo/files/unread_formats.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/polygon_cut.h"

namespace oro {
namespace {

std::string mesh_ending(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    std::string ending = dot == std::string::npos ? "" : path.substr(dot + 1);
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

using MeshReader = Result<SourceMesh> (*)(std::string_view);
MeshReader mesh_reader_for(const std::string& path) {
    const std::string ending = mesh_ending(path);
    if (ending == "stl") return read_stl;
    return ending == "xml" || ending == "landxml" ? read_landxml : nullptr;
}

bool is_ply_name(const std::string& path) {
    return mesh_ending(path) == "ply";
}

bool is_city_name(const std::string& path) {
    if (mesh_ending(path) == "cityjson") return true;
    return mesh_ending(path) == "json" && mesh_ending(path.substr(0, path.size() - 5)) == "city";
}

// An std::string, or a ScratchVector of letters.
template <class Bytes>
Result<Bytes> mesh_bytes(const std::string& path, Bytes bytes, std::size_t most = most_mesh_bytes) {
    ORO_TRY(const OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    if (size > most)
        return Error{ErrorKind::failed, path,
                     "is larger than " + std::to_string(most >> 30U) + " GiB; a mesh may have so much"};
    bytes.resize(size);
    ORO_CHECK(file.read(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

// A copy of what was read in memory.
template <class T>
void put_into(const ScratchOfMesh& scratch, ScratchVector<T>& array) {
    if (array.get_allocator().scratch() == scratch) return;
    array = ScratchVector<T>(array.begin(), array.end(), scratch);
}

// With its slash; "" for where the program runs.
std::string folder_of(const std::string& path) {
    return path.substr(0, path.rfind('/') + 1);
}

bool is_obj_name(const std::string& path) {
    return mesh_ending(path) == "obj";
}

bool is_gltf_name(const std::string& path) {
    return mesh_ending(path) == "gltf" || mesh_ending(path) == "glb";
}

constexpr double geopackage_limit_s = 60.0;

// The local name of a text's first element: behind a byte order mark, declarations and comments.
std::string_view first_element(std::string_view text) {
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<')) {
        text.remove_prefix(at + 1);
        if (text.starts_with("!--")) {
            const std::size_t end = text.find("-->");
            if (end == std::string_view::npos) return "";
            text.remove_prefix(end);
        }
        if (text.starts_with('?') || text.starts_with('!') || text.starts_with("-->")) continue;
        const std::string_view name = text.substr(0, text.find_first_of(" \t\r\n/>"));
        return name.substr(name.find(':') == std::string_view::npos ? 0 : name.find(':') + 1);
    }
    return "";
}

// How finely colours of textures are kept.
void note_textures(SourceMesh& mesh) {
    if (mesh.textures.empty() || mesh.textured_vertices == 0) return;
    const double texels = mesh.texels / static_cast<double>(mesh.textured_vertices);
    char text[160];
    std::snprintf(text, sizeof text, "colours of its %s averaged at vertices, over %.*f texels each",
                  mesh.textures.size() == 1 ? "texture are" : "textures are", texels < 10.0 ? 1 : 0,
                  std::min(texels, 1.0e12));
    mesh.notes.emplace_back(text);
}

// Drops triangles with a vertex that is not finite, and keeps parts and features where they are.
void drop_not_finite(SourceMesh& mesh) {
    std::size_t kept = 0, part = 0, feature = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (; part < mesh.parts.size() && mesh.parts[part].first_triangle <= i; ++part)
            mesh.parts[part].first_triangle = kept;
        for (; feature < mesh.features.size() && mesh.features[feature].first_triangle <= i; ++feature)
            mesh.features[feature].first_triangle = kept;
        const SourceTriangle triangle = mesh.triangles[i];
        const bool finite = std::ranges::all_of(triangle, [&](std::uint32_t corner) {
            const glm::dvec3& at = mesh.vertices[corner];
            return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
        });
        if (finite) mesh.triangles[kept++] = triangle;
    }
    for (; part < mesh.parts.size(); ++part) mesh.parts[part].first_triangle = kept;
    for (; feature < mesh.features.size(); ++feature) mesh.features[feature].first_triangle = kept;
    mesh.not_finite = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
}

}  // namespace

const char* add_polygon(const std::vector<std::uint32_t>& corners, SourceMesh& mesh) {
    if (corners.size() < 3) return "a face has fewer than three corners";
    if (corners.size() > most_polygon_corners) return "a face has more than 10,000 corners";
    const bool is_sound = cut_polygon(mesh.vertices, {corners}, mesh.triangles);
    if (corners.size() > 3) ++mesh.polygons_cut;
    if (!is_sound) ++mesh.polygons_crossing;
    return nullptr;
}

bool is_mesh_file(const std::string& path) {
    const std::string ending = mesh_ending(path);
    if (is_city_name(path) || (ending != "xml" && ending != "json")) return is_mesh_name(path);
    const std::string bytes = begin_of_file(path, 65536);
    if (ending == "xml") return first_element(bytes) == "LandXML";
    return bytes.find("\"CityJSON\"") != std::string::npos ||
           bytes.find("\"CityObjects\"") != std::string::npos || is_tileset(bytes);
}

bool is_mesh_name(const std::string& path) {
    return mesh_reader_for(path) != nullptr || is_city_name(path) || is_gltf_name(path) ||
           is_ply_name(path) || is_obj_name(path);
}

Result<SourceMesh> read_mesh(const std::string& path, const std::string& lod, const ScratchOfMesh& scratch) {
    const MeshReader reader = mesh_reader_for(path);
    const bool is_ply = is_ply_name(path), is_obj = is_obj_name(path);
    const bool is_geopackage = mesh_ending(path) == "gpkg",
               is_city = is_city_name(path) || mesh_ending(path) == "json";
    if (const std::string why = why_unread(path, path); !why.empty())
        return Error{ErrorKind::failed, path, why};
    if (reader == nullptr && !is_geopackage && !is_city && !is_gltf_name(path) && !is_ply && !is_obj)
        return Error{
            ErrorKind::failed, path,
            "is no mesh by its name: .obj, .ply, .stl, .gltf, .glb, .xml, .landxml, .city.json, tileset.json "
            "and .gpkg are; of footprints --building-height FIELD tells how high buildings are"};
    const auto read_bytes = [&]() -> Result<SourceMesh> {
        const FileBeside beside = [&](const std::string& name) {
            return mesh_bytes(folder_of(path) + name, std::string());
        };
        const bool may_be_larger = is_ply && scratch != nullptr;
        ORO_TRY(const auto bytes, mesh_bytes(path, ScratchVector<char>(scratch),
                                             may_be_larger ? most_scratch_mesh_bytes : most_mesh_bytes));
        const std::string_view text(bytes.data(), bytes.size());
        if (is_ply) return read_ply(text, scratch);
        if (is_obj) return read_obj(text, beside, scratch);
        if (is_gltf_name(path)) return read_gltf(text, beside);
        if (!is_city_name(path) && is_city && is_tileset(text)) return read_tileset(text, beside);
        return is_city ? read_cityjson(text, lod) : reader(text);
    };
    Result<SourceMesh> read = is_geopackage ? read_geopackage_mesh(path, geopackage_limit_s) : read_bytes();
    if (!read.ok()) return Error{read.error().kind, path, read.error().what};
    SourceMesh mesh = std::move(*read);
    put_into(scratch, mesh.vertices), put_into(scratch, mesh.triangles), put_into(scratch, mesh.colours);
    mesh.path = path;
    if (mesh.triangles.empty())
        return Error{ErrorKind::failed, path,
                     mesh.invisible > 0 ? "no triangles: all are marked invisible" : "no triangles"};
    drop_not_finite(mesh);
    note_textures(mesh);
    if (mesh.triangles.empty())
        return Error{ErrorKind::failed, path, "no triangles: each has a vertex that is no finite place"};
    return mesh;
}

}  // namespace oro
