#include "apps/commands/info_mesh.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>

#include "apps/command_line/refusals.h"
#include "apps/commands/mesh_levels.h"
#include "apps/options/region_option_table.h"
#include "apps/report/feature_words.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/view/mesh_request.h"
#include "core/base/one_line.h"
#include "core/base/parallel.h"
#include "geo/coordinates/crs_places.h"
#include "geo/files/letter_case.h"
#include "geo/meshes/mesh_census.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/meshes/source_mesh_graph.h"

namespace oro {
namespace {

std::size_t part_triangles(const SourceMesh& mesh, std::size_t part) {
    const std::size_t end =
        part + 1 < mesh.parts.size() ? mesh.parts[part + 1].first_triangle : mesh.triangles.size();
    return end - mesh.parts[part].first_triangle;
}

// What is wrong with the CRS that a file states; "" where nothing is.
std::string fault_of_crs(const std::string& crs) {
    return crs.empty() || crs == ecef_crs || CrsPlaces::of(crs).ok() ? "" : ", which PROJ does not know";
}

nlohmann::ordered_json mesh_json(const SourceMesh& mesh, const MeshCensus& census) {
    std::vector<std::string> notes = mesh.notes;
    if (const std::string fault = fault_of_crs(mesh.crs); !fault.empty())
        notes.push_back("its CRS is " + mesh.crs + fault);
    nlohmann::ordered_json parts = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < mesh.parts.size(); ++i)
        parts.push_back(json_object("name", mesh.parts[i].name, "triangles", part_triangles(mesh, i)));
    nlohmann::ordered_json textures = nlohmann::ordered_json::array();
    for (const MeshTexture& texture : mesh.textures)
        textures.push_back(
            json_object("name", texture.name, "width_px", texture.width_px, "height_px", texture.height_px));
    const nlohmann::ordered_json texels =
        mesh.textured_vertices == 0
            ? nlohmann::ordered_json()
            : nlohmann::ordered_json(mesh.texels / static_cast<double>(mesh.textured_vertices));
    const auto stated = [](const std::string& word) {
        return word.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(word);
    };
    return json_object("path", mesh.path, "format", mesh.format, "crs", stated(mesh.crs), "unit",
                       stated(mesh.unit), "triangles", census.triangles, "vertices", census.vertices, "parts",
                       std::move(parts), "least", json_list(census.least.x, census.least.y, census.least.z),
                       "most", json_list(census.most.x, census.most.y, census.most.z), "rims", census.rims,
                       "open_chains", census.open_chains, "rim_edges", census.rim_edges, "crowded_edges",
                       census.crowded_edges, "turned_edges", census.turned_edges, "degenerate",
                       census.degenerate, "duplicates", census.duplicates, "not_finite", mesh.not_finite,
                       "invisible", mesh.invisible, "polygons_cut", mesh.polygons_cut, "polygons_crossing",
                       mesh.polygons_crossing, "features", mesh.features.size(), "textures",
                       std::move(textures), "texels_per_vertex", texels, "notes", notes);
}

// Of a part: names of nothing but blanks are none.
std::string name_in_words(const std::string& name) {
    return name.find_first_not_of(" \t\r\n") == std::string::npos ? "without a name" : one_line(name);
}

void print_range(const char* what, double least, double most) {
    std::printf("  %-14s %.3f to %.3f\n", what, least, most);
}

void print_left_out(std::size_t count, const char* why) {
    if (count > 0)
        std::printf("  left out:      %s %s\n", counted(count, "triangle", "triangles").c_str(), why);
}

void print_textures(const SourceMesh& mesh) {
    constexpr std::size_t most_textures = 20;
    for (std::size_t i = 0; i < std::min(most_textures, mesh.textures.size()); ++i)
        std::printf("  texture:       %s, %d x %d pixels\n", one_line(mesh.textures[i].name).c_str(),
                    mesh.textures[i].width_px, mesh.textures[i].height_px);
    if (mesh.textures.size() > most_textures)
        std::printf("  and %zu more textures\n", mesh.textures.size() - most_textures);
}

void print_mesh(const SourceMesh& mesh, const MeshCensus& census) {
    std::printf("%s: %s, %s, %s\n", one_line(mesh.path).c_str(), mesh.format.c_str(),
                counted(census.triangles, "triangle", "triangles").c_str(),
                counted(census.vertices, "vertex", "vertices").c_str());
    constexpr std::size_t most_parts = 20;
    for (std::size_t i = 0; i < std::min(most_parts, mesh.parts.size()); ++i)
        std::printf("  part:          %s, %s\n", name_in_words(mesh.parts[i].name).c_str(),
                    counted(part_triangles(mesh, i), "triangle", "triangles").c_str());
    if (mesh.parts.size() > most_parts) std::printf("  and %zu more parts\n", mesh.parts.size() - most_parts);
    if (!mesh.features.empty())
        std::printf("  features:      %zu, the first %s\n", mesh.features.size(),
                    words_of(mesh.features.front()).c_str());
    std::printf("  CRS:           %s\n", mesh.crs.empty()
                                             ? "the file states none"
                                             : (one_line(mesh.crs) + fault_of_crs(mesh.crs)).c_str());
    std::printf("  unit:          %s\n",
                mesh.unit.empty() ? "the file states none" : one_line(mesh.unit).c_str());
    print_range("east:", census.least.x, census.most.x);
    print_range("north:", census.least.y, census.most.y);
    print_range("height:", census.least.z, census.most.z);
    std::printf("  rims:          %zu closed, of %s\n", census.rims,
                counted(census.rim_edges, "edge", "edges").c_str());
    if (census.open_chains > 0)
        std::printf("  open chains:   %zu of edges of one triangle\n", census.open_chains);
    std::printf("  crowded:       %s of three and more triangles\n",
                counted(census.crowded_edges, "edge", "edges").c_str());
    std::printf("  turned:        %s between triangles that face opposite ways\n",
                counted(census.turned_edges, "edge", "edges").c_str());
    std::printf("  degenerate:    %s without an area\n",
                counted(census.degenerate, "triangle", "triangles").c_str());
    std::printf("  duplicates:    %s\n", counted(census.duplicates, "triangle", "triangles").c_str());
    print_left_out(mesh.not_finite, "with a vertex that is no finite place");
    print_left_out(mesh.invisible, "that the file calls invisible");
    if (mesh.polygons_cut > 0)
        std::printf("  polygons:      %s of more than three corners, cut into triangles\n",
                    counted(mesh.polygons_cut, "polygon", "polygons").c_str());
    if (mesh.polygons_crossing > 0)
        std::printf("  not simple:    %s without an area, or crossing themselves\n",
                    counted(mesh.polygons_crossing, "polygon", "polygons").c_str());
    print_textures(mesh);
    for (const std::string& note : mesh.notes) std::printf("  note:          %s\n", one_line(note).c_str());
}

// Whether a GeoPackage holds surfaces: much else is in such files.
bool is_surfaces_file(const std::string& path) {
    return lower_case(path).ends_with(".gpkg") && read_mesh(path).ok();
}

// Refuses what says nothing of meshes that lie on no ground.
Result<void> check_of_meshes(const RegionOptions& region) {
    RegionOptions others = region;
    others.mesh_crs.clear(), others.mesh_unit.clear(), others.mesh_lod.clear(), others.strict_datum = false;
    if (const char* option = first_given_of_region(others); option != nullptr)
        return refused(option, "", "says nothing of a mesh alone: it is for elevation data");
    if (is_no_lod(region.mesh_lod))
        return refused("--lod", region.mesh_lod, "is no level of detail: 1, 2, 2.2, say");
    return {};
}

// Where a mesh lies on the Earth, as --mesh-crs and the options beside it say; nothing without them.
Result<std::optional<PlacedMesh>> placed_alone(const SourceMesh& mesh, const RegionOptions& region) {
    if (region.mesh_crs.empty() && region.mesh_unit.empty() && !region.strict_datum)
        return std::optional<PlacedMesh>();
    MeshRequest request;
    request.files = {mesh.path}, request.crs = region.mesh_crs, request.unit = region.mesh_unit;
    request.lod = region.mesh_lod;
    ORO_TRY(const auto meshes, open_meshes(request, region.strict_datum, {}));
    return std::optional(meshes->front());
}

// The least and the most of each: latitude, longitude, H.
struct PlacedExtent {
    PlacedVertex least{90.0, 360.0, std::numeric_limits<double>::infinity()};
    PlacedVertex most{-90.0, -360.0, -std::numeric_limits<double>::infinity()};
};
PlacedExtent extent_of(const PlacedMesh& mesh) {
    PlacedExtent extent;
    for (const SourceTriangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            const PlacedVertex& at = mesh.vertices[corner];
            extent.least = {std::min(extent.least.lat_deg, at.lat_deg),
                            std::min(extent.least.lon_deg, at.lon_deg), std::min(extent.least.H_m, at.H_m)};
            extent.most = {std::max(extent.most.lat_deg, at.lat_deg),
                           std::max(extent.most.lon_deg, at.lon_deg), std::max(extent.most.H_m, at.H_m)};
        }
    return extent;
}

nlohmann::ordered_json placed_json(const PlacedMesh& mesh) {
    const PlacedExtent extent = extent_of(mesh);
    return json_object("crs", mesh.crs, "heights", mesh.heights, "west_deg", extent.least.lon_deg,
                       "south_deg", extent.least.lat_deg, "east_deg", extent.most.lon_deg, "north_deg",
                       extent.most.lat_deg, "lowest_m", extent.least.H_m, "highest_m", extent.most.H_m,
                       "not_placed", mesh.not_placed, "note", mesh.note);
}

// What is known of a mesh on a region's ground: of footprints, which are made for that ground, less.
Result<nlohmann::ordered_json> mesh_on_ground_json(const PlacedMesh& mesh, const RegionOptions& options) {
    nlohmann::ordered_json json = json_object("path", mesh.path, "format", mesh.format, "crs", mesh.crs,
                                              "triangles", mesh.in_file, "features", mesh.features.size());
    if (options.building_height.empty() || is_mesh_file(mesh.path)) {
        ORO_TRY(const SourceMesh source, read_mesh(mesh.path, options.mesh_lod));
        json = mesh_json(source, census_of(source, options.mesh_crs));
    }
    json["placed"] = placed_json(mesh);
    return json;
}

// --lod is of one format.
Result<void> check_lod_of(const RegionOptions& region) {
    const auto may_have_levels = [&](const std::string& path) {
        const Result<SourceMesh> mesh = read_mesh(path);
        return !mesh.ok() || mesh->kind == MeshKind::city_model;
    };
    if (region.mesh_lod.empty() || std::ranges::any_of(region.paths, may_have_levels)) return {};
    return refused("--lod", region.mesh_lod, "is of CityJSON, and no mesh is in that format");
}

void print_placed(const PlacedMesh& mesh) {
    constexpr const char* sea_level = "sea level (EGM96)";
    const PlacedExtent extent = extent_of(mesh);
    // Of ECEF they are above the ellipsoid: without a region there is no geoid.
    const bool is_over_sea = mesh.heights != "the WGS84 ellipsoid";
    std::printf("  lies in:       %s\n", one_line(mesh.crs).c_str());
    std::printf("    latitude     %.6f to %.6f\n", extent.least.lat_deg, extent.most.lat_deg);
    std::printf("    longitude    %.6f to %.6f\n", extent.least.lon_deg, extent.most.lon_deg);
    std::printf("    %-12s %.3f to %.3f m above %s\n", is_over_sea ? "H" : "height", extent.least.H_m,
                extent.most.H_m, is_over_sea ? sea_level : one_line(mesh.heights).c_str());
    if (is_over_sea && mesh.heights != sea_level)
        std::printf("    from         heights above %s\n", one_line(mesh.heights).c_str());
    print_left_out(mesh.not_placed, "there, with a vertex that has no place in it");
}

}  // namespace

bool names_meshes(const std::vector<std::string>& paths) {
    return !paths.empty() && std::ranges::all_of(paths, [](const std::string& path) {
        return is_mesh_file(path) || is_surfaces_file(path);
    });
}

Result<nlohmann::ordered_json> meshes_on_ground_json(const Region& region, const RegionOptions& options) {
    nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
    if (!region.meshes) return meshes;
    for (const PlacedMesh& mesh : *region.meshes) {
        if (mesh.stored() || mesh.streamed()) continue;
        ORO_TRY(nlohmann::ordered_json one, mesh_on_ground_json(mesh, options));
        meshes.push_back(std::move(one));
    }
    return meshes;
}

Result<void> run_mesh_info(const InfoOptions& options) {
    ORO_CHECK(check_of_meshes(options.region));
    ORO_CHECK(check_lod_of(options.region));
    nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
    for (const std::string& path : options.region.paths) {
        ORO_TRY(const SourceMesh mesh, read_mesh(path, options.region.mesh_lod));
        ORO_TRY(const std::optional<PlacedMesh> placed, placed_alone(mesh, options.region));
        const MeshCensus census = census_of(mesh, options.region.mesh_crs);
        std::optional<MeshGraph> graph;
        if (options.check) {
            ORO_TRY(graph, graph_of_source(mesh, thread_count()));
        }
        if (options.json) {
            meshes.push_back(mesh_json(mesh, census));
            if (placed) meshes.back()["placed"] = placed_json(*placed);
            if (graph) meshes.back()["levels"] = mesh_levels_json(*graph);
            continue;
        }
        print_mesh(mesh, census);
        if (placed) print_placed(*placed);
        if (graph) std::printf("  clusters:\n%s", mesh_levels_text(*graph, 15).c_str());
    }
    if (options.json) std::printf("%s\n", json_text(json_object("meshes", std::move(meshes)), true).c_str());
    return {};
}

}  // namespace oro
