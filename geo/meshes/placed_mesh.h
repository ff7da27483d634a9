// Meshes of files, put on the Earth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/meshes/source_mesh.h"
#include "geo/sources/region_request.h"

namespace oro {

struct StoredMesh;
class StreamedMesh;

// As in Blender's "shade smooth by angle".
inline constexpr double default_crease_deg = 30.0;
inline constexpr double most_crease_deg = 180.0;

// A vertex on WGS84. H is above the geoid of the region that the mesh belongs to: that vertex is drawn at
// h = H times the exaggeration + N, as posts are.
struct PlacedVertex {
    double lat_deg{}, lon_deg{}, H_m{};
};
// Where it is drawn, before that is rounded to a lattice. undulation: N of the region; empty: 0.
Geodetic geodetic_of(const PlacedVertex& vertex, const UndulationField& undulation, double exaggeration);

// Upright ground along the rim of what a mesh cuts out of the terrain, by numbers of vertices: from one
// surface to the other; the terrain that is left lies on the right hand of the way from cut[0] to cut[1].
// Where both are the same, terrain that was cut meets what was not.
struct RimWall {
    std::array<std::uint32_t, 2> cut{};   // along the terrain
    std::array<std::uint32_t, 2> over{};  // above or below these
};

// What a baked file has of a mesh: one of both.
struct BakedMesh {
    std::shared_ptr<const StoredMesh> stored;  // its triangles as the file has them, with their graph
    // Reads them group by group: the mesh is here without vertices, triangles and colours.
    std::shared_ptr<const StreamedMesh> streamed;
    std::uint64_t undulation_fingerprint{};  // ... of N that it was opened with (fingerprint_of_undulation())
};

// A mesh as it is drawn and asked: its triangles' sides are straight in space, and no longer than
// longest_side_m. Vertices at one place of the file are one vertex.
struct PlacedMesh {
    std::string path;
    std::string format;  // for people
    MeshKind kind{MeshKind::unknown};
    std::string crs;      // "EPSG:2056 CH1903+ / LV95"
    std::string heights;  // what its heights are above: "sea level (EGM96)", "EPSG:5728 LN02 height"
    ScratchVector<PlacedVertex> vertices;
    ScratchVector<SourceTriangle> triangles;
    // Of the vertices, as the file states them; those beyond its end have none. Empty where the file states
    // none, or where another look was asked for.
    ScratchVector<VertexColour> colours;
    // Of the triangles, in the place of all other colours: what they are a part of (MeshParts). Empty: not
    // asked for.
    std::vector<VertexColour> part_colours;
    std::vector<MeshFeature> features;
    ScratchVector<std::uint32_t> feature_of;  // number of each triangle's feature; empty where there are none
    std::uint32_t look{};                     // gpu::mesh_look_..., but for features whose type says another
    bool has_look_by_type{};                  // ... as types of CityJSON do (look_of_type())
    std::vector<RimWall> rim_walls;           // of one that the terrain is cut out under
    std::size_t not_added{};                  // triangles that are the file's; those behind them were added
    std::size_t lengthened{};                 // features whose walls were led down to the terrain,
    double most_lengthened_m{};               // ... the longest by so much
    std::size_t in_file{};                    // triangles of the file
    std::size_t
        not_placed{};  // ... left out: the CRS has no place for a vertex, or none near where it is made for
    std::size_t not_finite{};     // ... left out: a vertex of the file is no finite number
    std::size_t degenerate{};     // ... left out: without an area on the lattice of 2^-11 m
    std::uint64_t fingerprint{};  // XXH64 of the vertices and triangles, before cutting, and of unit and CRS
    std::string note;             // what a user must know; "" for nothing
    // Where triangles meet at a smaller angle they share the light: the normal at their common vertex.
    double crease_deg{default_crease_deg};
    std::shared_ptr<const BakedMesh> baked;  // null: it was not
    // Before it has any of these: where its arrays will lie. Null: in ordinary memory.
    void lie_in(const std::shared_ptr<ScratchMemory>& scratch) {
        vertices = ScratchVector<PlacedVertex>(scratch), triangles = ScratchVector<SourceTriangle>(scratch);
        colours = ScratchVector<VertexColour>(scratch), feature_of = ScratchVector<std::uint32_t>(scratch);
    }
    // What `baked` has of them; null: nothing.
    [[nodiscard]] const StoredMesh* stored() const { return baked ? baked->stored.get() : nullptr; }
    [[nodiscard]] const StreamedMesh* streamed() const { return baked ? baked->streamed.get() : nullptr; }
};

// Tells one N from another. The same numbers give the same.
std::uint64_t fingerprint_of_undulation(const UndulationField& undulation);
// Whether a mesh that is read group by group is drawn where its file has it: at the N that it was opened
// with, and not exaggerated. Elsewhere all of it is read.
bool is_drawn_as_streamed(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration);

// Whether all corners of a triangle have a colour that the file states.
bool is_coloured(const PlacedMesh& mesh, std::size_t triangle);

// One line of what was placed: triangles, what was left out, what its heights are above, and its note.
std::string note_of_mesh(const PlacedMesh& mesh);

// Longer sides are cut, those of neighbours alike: a side that is straight in the CRS is then within 1 mm of
// one that is straight in space.
inline constexpr double longest_side_m = 200.0;
// Triangles of a mesh that is baked; others have MeshRequest::most_triangles.
inline constexpr std::size_t most_baked_triangles = 100'000'000;

// Reads and places the meshes that a request names. undulation: N of the region; empty: N is 0. A vertex's
// place is that of PROJ to within 1 um, its height to within 0.3 mm up to 4 km (heights of another datum are
// float32 on their way). Heights without a stated datum are above sea level. Errors: those of read_mesh(); a
// file that states no CRS where the request names none; a CRS or a unit that is unknown (usage); with
// strict_datum a vertical datum that there is no way from; no triangle that has a place; too many triangles.
// ground: of the region, the best first: footprints stand on it. scratch: where arrays of meshes of more than
// some 250,000 triangles lie while they are read, and stay; null: in memory. A further error: no room there.
Result<std::shared_ptr<const std::vector<PlacedMesh>>> open_meshes(
    const MeshRequest& request, bool strict_datum, const UndulationField& undulation,
    std::span<const HeightField* const> ground = {}, const std::shared_ptr<ScratchMemory>& scratch = nullptr);

}  // namespace oro
