#include "geo/meshes/mesh_facts.h"

#include <cmath>
#include <filesystem>
#include <string>

#include "core/base/little_endian.h"
#include "core/seam/cleared_map.h"  // gpu::mesh_look_...

namespace oro {
namespace {

constexpr std::size_t most_feature_attributes = 64;

void visit_text(NumberWriter& writer, const std::string& text) {
    writer(static_cast<std::uint32_t>(text.size()));
    for (const char letter : text) writer(letter);
}
void visit_text(NumberReader& reader, std::string& text) {
    std::uint32_t size = 0;
    reader(size);
    if (!reader.has(size, 1)) {
        reader.fail();
        return;
    }
    text.resize(size);
    for (char& letter : text) reader(letter);
}

// A count that a reader may resize to: of things of so many bytes at least.
void visit_count(NumberWriter& writer, std::uint64_t& count, std::size_t) {
    writer(count);
}
void visit_count(NumberReader& reader, std::uint64_t& count, std::size_t least_bytes) {
    reader(count);
    if (reader.has(count, least_bytes)) return;
    reader.fail();
    count = 0;
}

template <class Visit>
void visit_feature(Visit& visit, auto& feature) {
    visit_text(visit, feature.name), visit_text(visit, feature.type), visit_text(visit, feature.part_of);
    std::uint64_t attributes = feature.attributes.size();
    visit_count(visit, attributes, 8);
    if constexpr (!Visit::writes) feature.attributes.resize(attributes);
    for (auto& [key, value] : feature.attributes) visit_text(visit, key), visit_text(visit, value);
}

template <class Visit>
void visit_facts(Visit& visit, auto& mesh) {
    visit_text(visit, mesh.path), visit_text(visit, mesh.format), visit_text(visit, mesh.crs);
    visit_text(visit, mesh.heights), visit_text(visit, mesh.note);
    auto kind = static_cast<std::uint8_t>(mesh.kind),
         has_look = static_cast<std::uint8_t>(mesh.has_look_by_type);
    visit(kind), visit(has_look), visit(mesh.look);
    std::array<std::uint64_t, 5> counts{mesh.lengthened, mesh.in_file, mesh.not_placed, mesh.not_finite,
                                        mesh.degenerate};
    for (std::uint64_t& count : counts) visit(count);
    visit(mesh.most_lengthened_m), visit(mesh.fingerprint);
    std::uint64_t features = mesh.features.size();
    visit_count(visit, features, 20);
    if constexpr (!Visit::writes) {
        if (kind > static_cast<std::uint8_t>(MeshKind::city_model) || has_look > 1) visit.fail();
        mesh.kind = static_cast<MeshKind>(kind), mesh.has_look_by_type = has_look != 0;
        mesh.lengthened = counts[0], mesh.in_file = counts[1], mesh.not_placed = counts[2];
        mesh.not_finite = counts[3], mesh.degenerate = counts[4];
        mesh.features.resize(features);
    }
    for (auto& feature : mesh.features) visit_feature(visit, feature);
}

// What few meshes have stands behind the rest, and is not there where they have none of it.
template <class Visit>
void visit_rare_facts(Visit& visit, auto& mesh) {
    visit(mesh.crease_deg);
    std::uint64_t colours = mesh.colours.size();
    visit_count(visit, colours, 4);
    if constexpr (!Visit::writes) mesh.colours.resize(colours);
    for (auto& colour : mesh.colours) {
        visit(colour.red), visit(colour.green), visit(colour.blue), visit(colour.is_stated);
        if constexpr (!Visit::writes)
            if (colour.is_stated > 1) visit.fail();
    }
    if constexpr (!Visit::writes)
        if (!(mesh.crease_deg >= 0.0 && mesh.crease_deg <= most_crease_deg)) visit.fail();
}

}  // namespace

std::vector<std::byte> facts_to_bytes(const PlacedMesh& mesh, ScratchVector<VertexColour> colours) {
    PlacedMesh facts;
    facts.path = std::filesystem::path(mesh.path).filename().string();
    facts.format = mesh.format, facts.crs = mesh.crs, facts.heights = mesh.heights, facts.note = mesh.note;
    facts.kind = mesh.kind, facts.has_look_by_type = mesh.has_look_by_type, facts.look = mesh.look;
    facts.lengthened = mesh.lengthened, facts.in_file = mesh.in_file, facts.not_placed = mesh.not_placed;
    facts.not_finite = mesh.not_finite, facts.degenerate = mesh.degenerate;
    facts.most_lengthened_m = mesh.most_lengthened_m, facts.fingerprint = mesh.fingerprint;
    facts.features = mesh.features;
    facts.crease_deg = mesh.crease_deg, facts.colours = std::move(colours);
    NumberWriter writer;
    visit_facts(writer, facts);
    if (!facts.colours.empty() || facts.crease_deg != default_crease_deg) visit_rare_facts(writer, facts);
    return std::move(writer.bytes);
}

std::optional<PlacedMesh> facts_from_bytes(std::span<const std::byte> bytes) {
    NumberReader reader(bytes);
    PlacedMesh mesh;
    visit_facts(reader, mesh);
    if (!reader.rest().empty()) visit_rare_facts(reader, mesh);
    if (reader.is_wrong() || !std::isfinite(mesh.most_lengthened_m) || mesh.look > gpu::mesh_look_plain)
        return std::nullopt;
    for (const MeshFeature& feature : mesh.features)
        if (feature.attributes.size() > most_feature_attributes) return std::nullopt;
    return mesh;
}

}  // namespace oro
