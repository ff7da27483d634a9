// The ground and the meshes on it as one model, and how far it is from the ground.
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/export/exported_region.h"
#include "apps/commands/export/vertex_facts.h"
#include "apps/drawing/region_scene.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "geo/files/whole_file.h"
#include "geo/tilesets/ground_model.h"

namespace oro {
namespace {

// What is written.
struct WrittenModel {
    const GroundModel& ground;
    const std::vector<ModelMesh>& meshes;
    std::uint64_t bytes{};

    [[nodiscard]] std::uint64_t mesh_triangles() const {
        std::uint64_t sum = 0;
        for (const ModelMesh& mesh : meshes) sum += mesh.indices.size() / 3;
        return sum;
    }
    [[nodiscard]] std::uint64_t mesh_vertices() const {
        std::uint64_t sum = 0;
        for (const ModelMesh& mesh : meshes) sum += mesh.positions_m.size();
        return sum;
    }
};

void tell_model(const ExportOptions& options, const Region& region, const WrittenModel& written) {
    const GroundModel& model = written.ground;
    const std::uint64_t of_meshes = written.mesh_triangles(),
                        triangles = model.indices.size() / 3 + of_meshes;
    if (options.json) {
        auto json = json_object("file", options.out, "format", "gltf", "triangles", triangles, "vertices",
                                model.positions_m.size() + written.mesh_vertices(), "bytes", written.bytes,
                                "error_m", model.error_m, "origin",
                                json_object("lat_deg", model.origin.lat_deg, "lon_deg", model.origin.lon_deg,
                                            "h_m", model.origin.h_m),
                                "heights", heights_words(region), "attribution", attribution_of(region));
        if (!written.meshes.empty())
            json["meshes"] = json_object("triangles", of_meshes, "vertices", written.mesh_vertices());
        json["notes"] = all_notes(region);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Wrote %s: %s, %s bytes\n", options.out.c_str(),
                counted(triangles, "triangle", "triangles").c_str(), grouped(written.bytes).c_str());
    std::printf("Heights: h, above the ellipsoid WGS84; the data's are %s\n", heights_words(region).c_str());
    std::printf("From the ground: %s m at most (proven)\n", figure(model.error_m).c_str());
    if (!written.meshes.empty())
        std::printf("Meshes: %s of these triangles, at their full resolution\n", grouped(of_meshes).c_str());
}

// Of each vertex of the ground, by the levels of their patches. None where nothing colours the ground.
Result<std::vector<std::array<double, 3>>> colours_of(const ExportedFacts& facts, const PostGrid& grid,
                                                      const GroundModel& model) {
    std::vector<std::array<double, 3>> colours;
    if (!facts.has_colours()) return colours;
    std::map<int, std::vector<std::size_t>> vertices;  // by level
    for (std::size_t i = 0; i < model.posts.size(); ++i) vertices[model.posts[i].level].push_back(i);
    colours.resize(model.posts.size());
    for (const auto& [level, numbers] : vertices) {
        std::vector<VertexPlace> places;
        places.reserve(numbers.size());
        for (const std::size_t number : numbers) {
            const PageIndex& post = model.posts[number];
            const PostPlace at = grid.place_at(post.row, post.column);
            places.push_back({static_cast<double>(post.row), static_cast<double>(post.column), at.lat_deg,
                              normalised_lon_deg(at.lon_deg)});
        }
        ORO_TRY(const VertexFacts known, facts.at(level, places));
        for (std::size_t i = 0; i < numbers.size(); ++i) colours[numbers[i]] = known.colours[i];
    }
    return colours;
}

std::vector<ModelMesh> meshes_of(const Region& region, const GroundModel& model) {
    std::vector<ModelMesh> meshes;
    if (!region.meshes) return meshes;
    for (const PlacedMesh& mesh : *region.meshes)
        if (!mesh.triangles.empty())
            meshes.push_back(
                model_mesh(mesh, region.grids.front().field.undulation, model.origin, palette_of_meshes()));
    return meshes;
}

}  // namespace

Result<void> check_one_grid(const ExportOptions& options, const Region& region) {
    if (region.grids.size() > 1)
        return refused("--to", *options.to,
                       "these data are " + std::to_string(region.grids.size()) +
                           " grids of posts, and only one can be written: name files of one of them");
    return {};
}

Result<void> export_gltf(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    ORO_CHECK(check_one_grid(options, region));
    const GlbLook look = look_of(region);
    ORO_TRY(const std::unique_ptr<ExportedFacts> facts, ExportedFacts::of(options, region, 0, look.colour));
    ORO_TRY(const std::unique_ptr<RegionPages> pages,
            grid_pages(region.grids.front(), {}, 1.0,
                       [&](double share) { bar.show(share, "measuring levels"); }));
    bar.show(1.0, "choosing triangles");
    ORO_TRY(const GroundModel model, ground_model(*pages, options.max_error_m.value_or(0.0)));
    ORO_TRY(const auto colours, colours_of(*facts, region.grids.front().field.grid, model));
    ORO_CHECK(region.health());
    const std::vector<ModelMesh> meshes = meshes_of(region, model);
    const std::vector<std::uint8_t> bytes = model_glb_bytes(model, colours, meshes, look);
    ORO_TRY(WholeFile file, WholeFile::create(options.out, options.overwrite));
    ORO_CHECK(file.write(bytes.data(), bytes.size()));
    ORO_CHECK(file.commit());
    bar.clear();
    say_notes(region, options.quiet);
    for (const std::string& note : facts->notes()) say(options.quiet, "note: " + note);
    tell_model(options, region, {model, meshes, bytes.size()});
    return {};
}

}  // namespace oro
