#include "geo/meshes/footprints.h"

#include <gdal.h>
#include <ogr_api.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <type_traits>

#include "geo/meshes/ground_below.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_over_ground.h"
#include "geo/meshes/mesh_words.h"
#include "geo/meshes/polygon_cut.h"

namespace oro {
namespace {

using PlaceRings = std::vector<std::vector<VectorPlace>>;

// A height as files have it: a number of units, or of metres where "m" stands behind it. Nothing for any
// other text. Downwards where unit_m is negative.
std::optional<double> height_in_m(std::string_view text, double unit_m) {
    const std::string_view number = take_word(text), unit = take_word(text);
    double value = 0.0;
    std::string_view digits = number;
    const bool has_suffix = unit.empty() && digits.ends_with('m');
    if (has_suffix) digits.remove_suffix(1);
    const bool is_sound = (unit.empty() || unit == "m") && take_word(text).empty();
    if (!is_sound || digits.empty() || !mesh_number(digits, value) || !std::isfinite(value))
        return std::nullopt;
    return value * (has_suffix || unit == "m" ? std::copysign(1.0, unit_m) : unit_m);
}

// Whether a height is one that no building has, and stands for "not known".
bool stands_for_none(double height_m, double unit_m) {
    constexpr double shortest_foot_m = 0.3;
    const double most_m = least_height_of_none * (unit_m > shortest_foot_m ? std::min(unit_m, 1.0) : 1.0);
    return height_m <= 0.0 || height_m >= most_m;
}

struct FreeShape {
    void operator()(OGRGeometryH shape) const { OGR_G_DestroyGeometry(shape); }
};
using Shape = std::unique_ptr<std::remove_pointer_t<OGRGeometryH>, FreeShape>;

Shape shape_of(const PlaceRings& rings) {
    Shape polygon(OGR_G_CreateGeometry(wkbPolygon));
    for (const auto& ring : rings) {
        OGRGeometryH line = OGR_G_CreateGeometry(wkbLinearRing);
        for (const VectorPlace& place : ring) OGR_G_AddPoint_2D(line, place.lon_deg, place.lat_deg);
        OGR_G_AddPoint_2D(line, ring.front().lon_deg, ring.front().lat_deg);
        OGR_G_AddGeometryDirectly(polygon.get(), line);
    }
    return polygon;
}

PlaceRings rings_of(OGRGeometryH polygon) {
    PlaceRings rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
        OGRGeometryH line = OGR_G_GetGeometryRef(polygon, i);
        auto& ring = rings.emplace_back();
        for (int k = 0; k + 1 < OGR_G_GetPointCount(line); ++k)
            ring.push_back({OGR_G_GetY(line, k), OGR_G_GetX(line, k)});
        if (ring.size() < 3) rings.pop_back();
        if (rings.empty()) break;
    }
    return rings;
}

void add_polygons(OGRGeometryH shape, std::vector<PlaceRings>& polygons) {
    if (shape == nullptr) return;
    if (OGR_GT_Flatten(OGR_G_GetGeometryType(shape)) == wkbPolygon) {
        PlaceRings rings = rings_of(shape);
        if (!rings.empty()) polygons.push_back(std::move(rings));
        return;
    }
    for (int i = 0; i < OGR_G_GetGeometryCount(shape); ++i)
        add_polygons(OGR_G_GetGeometryRef(shape, i), polygons);
}

// The valid polygons of one, which is itself where it is valid.
std::vector<PlaceRings> valid_polygons(const PlaceRings& rings) {
    CPLPushErrorHandler(CPLQuietErrorHandler);  // why one is invalid: not a user's matter
    const Shape polygon = shape_of(rings);
    std::vector<PlaceRings> polygons;
    if (OGR_G_IsValid(polygon.get()) != 0) {
        polygons.push_back(rings);
    } else {
        const Shape valid(OGR_G_MakeValid(polygon.get()));
        add_polygons(valid.get(), polygons);
    }
    CPLPopErrorHandler();
    return polygons;
}

// A building before its ground is known.
struct Footprint {
    PlaceRings rings;
    double height_m{};
    double base_H_m{};
    MeshFeature feature;
};

struct Counts {
    std::size_t without_height{}, without_base{}, invalid{}, mended{}, without_ground{}, very_high{};
};

class FootprintReader {
  public:
    FootprintReader(const FootprintFields& fields, Counts& counts) : fields_(fields), counts_(counts) {}

    void layer(const VectorLayer& layer) {
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::polygon || shape.paths.empty()) continue;
            const std::optional<double> height_m =
                height_in_m(layer.text(shape, fields_.height), fields_.height_unit_m);
            if (!height_m || stands_for_none(*height_m, fields_.height_unit_m)) {
                ++counts_.without_height;
                continue;
            }
            std::optional<double> base_m = 0.0;
            if (!fields_.base.empty())
                base_m = height_in_m(layer.text(shape, fields_.base), fields_.base_unit_m);
            if (!base_m) {
                ++counts_.without_base;
                continue;
            }
            constexpr double very_high_m = 1000.0;
            counts_.very_high += *height_m > very_high_m ? 1U : 0U;
            std::vector<PlaceRings> polygons = valid_polygons(shape.paths);
            if (polygons.empty()) ++counts_.invalid;
            if (polygons.size() > 1 || (polygons.size() == 1 && polygons[0].size() != shape.paths.size()))
                ++counts_.mended;
            for (PlaceRings& rings : polygons)
                footprints.push_back({std::move(rings), *height_m, *base_m, feature_of(layer, shape)});
        }
    }

    std::vector<Footprint> footprints;

  private:
    static MeshFeature feature_of(const VectorLayer& layer, const VectorShape& shape) {
        MeshFeature feature;
        feature.type = layer.name;
        feature.name = layer.text(shape, "name");
        if (feature.name.empty()) feature.name = std::to_string(shape.record + 1);
        if (shape.record < layer.records.size())
            for (const VectorField& field : layer.records[shape.record])
                feature.attributes.emplace_back(layer.fields[field.name], field.text);
        return feature;
    }

    const FootprintFields& fields_;
    Counts& counts_;
};

// How bases lie to the lowest ground below each.
class BasesOverGround {
  public:
    void add(double above_m, const VectorPlace& place, std::span<const HeightField* const> ground) {
        if (above_m_.empty())
            for (const HeightField* const field : ground) {
                if (field->undulation.N_m.empty()) continue;
                over_.N_m = field->undulation.at_m(place.lat_deg, place.lon_deg);
                break;
            }
        above_m_.push_back(above_m);
    }
    [[nodiscard]] std::string in_words() {
        const auto middle = above_m_.begin() + static_cast<std::ptrdiff_t>(above_m_.size() / 2);
        std::nth_element(above_m_.begin(), middle, above_m_.end());
        over_.median_m = *middle, over_.vertices = above_m_.size();
        return words_of(over_, "the geoid", "its bases lie");
    }

  private:
    MeshOverGround over_;
    std::vector<double> above_m_;
};

// Roof and walls, outside to the right of where the outer ring goes.
void add_building(const Footprint& footprint, double bottom_H_m, double roof_H_m, SourceMesh& mesh) {
    PolygonRings rings;
    mesh.features.push_back(footprint.feature);
    mesh.features.back().first_triangle = mesh.triangles.size();
    for (const auto& ring : footprint.rings) {
        std::vector<std::uint32_t>& roof = rings.emplace_back();
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto count = static_cast<std::uint32_t>(ring.size());
        for (const VectorPlace& place : ring) {
            mesh.vertices.emplace_back(place.lon_deg, place.lat_deg, roof_H_m);
            mesh.vertices.emplace_back(place.lon_deg, place.lat_deg, bottom_H_m);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t here = first + 2 * i, next = first + 2 * ((i + 1) % count);
            roof.push_back(here);
            mesh.triangles.push_back({here, here + 1, next});
            mesh.triangles.push_back({next, here + 1, next + 1});
        }
    }
    if (!cut_polygon(mesh.vertices, rings, mesh.triangles)) ++mesh.polygons_crossing;
}

Result<void> check_field(const VectorFile& file, const char* option, const std::string& field) {
    std::string known;
    bool is_known = false;
    for (const VectorLayer& layer : file.layers) {
        if (layer.field_number(field) >= 0) {
            is_known = true;
            if (std::ranges::any_of(layer.shapes, [&](const VectorShape& shape) {
                    return shape.kind == VectorKind::polygon && !layer.text(shape, field).empty();
                }))
                return {};
        }
        for (const std::string& name : layer.fields) {
            constexpr std::size_t most_listed = 300;
            if (known.size() < most_listed) known += (known.empty() ? "" : ", ") + name;
        }
    }
    if (is_known)
        return Error{
            ErrorKind::usage, std::string(option) + " " + field,
            "has no value in any footprint of " + std::filesystem::path(file.file).filename().string()};
    return Error{ErrorKind::usage, std::string(option) + " " + field,
                 "is no field of " + std::filesystem::path(file.file).filename().string() +
                     (known.empty() ? ": it has none" : ": it has " + known)};
}

Result<void> lift_bases(const BaseLift& lift, std::vector<Footprint>& footprints) {
    std::vector<VectorPlace> places;
    std::vector<double> bases_H_m;
    for (const Footprint& footprint : footprints) {
        places.push_back(footprint.rings.front().front());
        bases_H_m.push_back(footprint.base_H_m);
    }
    ORO_CHECK(lift(places, bases_H_m));
    for (std::size_t i = 0; i < footprints.size(); ++i) footprints[i].base_H_m = bases_H_m[i];
    return {};
}

void tell(const Counts& counts, SourceMesh& mesh) {
    const auto note = [&](std::size_t count, const char* one, const char* several, const char* what) {
        if (count > 0)
            mesh.notes.push_back(std::to_string(count) + " " + (count == 1 ? one : several) + what);
    };
    const auto left_out = [&](std::size_t count, const char* why) {
        note(count, "footprint left out, ", "footprints left out, ", why);
    };
    left_out(counts.without_height, "without a height above 0 and below 9,999 m");
    left_out(counts.without_base, "whose base is no number");
    note(counts.invalid, "footprint left out, which crosses itself",
         "footprints left out, which cross themselves", " and cannot be made valid");
    left_out(counts.without_ground, "without ground below");
    note(counts.mended, "footprint that crossed itself", "footprints that crossed themselves", " made valid");
    note(counts.very_high, "building higher than 1,000 m: is its height",
         "buildings higher than 1,000 m: are their heights", " in metres?");
}

}  // namespace

bool is_of_footprints(const MeshRequest& request, const std::string& file) {
    return !request.building_height.empty() && !is_mesh_file(file);
}

Result<SourceMesh> buildings_on_footprints(const std::string& path, const FootprintFields& fields,
                                           std::span<const HeightField* const> ground, const BaseLift& lift,
                                           const VectorCrs& asked) {
    ORO_TRY(const VectorFile file, read_vectors_in(path, asked));
    if (file.count(VectorKind::polygon) == 0)
        return Error{ErrorKind::failed, path, "has no polygons, which footprints are"};
    ORO_CHECK(check_field(file, "--building-height", fields.height));
    if (!fields.base.empty()) ORO_CHECK(check_field(file, "--building-base", fields.base));
    Counts counts;
    FootprintReader reader(fields, counts);
    for (const VectorLayer& layer : file.layers) reader.layer(layer);
    if (!fields.base.empty()) ORO_CHECK(lift_bases(lift, reader.footprints));
    SourceMesh mesh;
    mesh.path = path, mesh.format = "footprints", mesh.kind = MeshKind::built, mesh.crs = "EPSG:4326";
    BasesOverGround bases;
    for (const Footprint& footprint : reader.footprints) {
        const std::optional<double> lowest_H_m = lowest_ground_H_m(footprint.rings, ground);
        if (!lowest_H_m) {
            ++counts.without_ground;
            continue;
        }
        const double base_H_m = fields.base.empty() ? *lowest_H_m : footprint.base_H_m;
        bases.add(base_H_m - *lowest_H_m, footprint.rings.front().front(), ground);
        add_building(footprint, std::min(base_H_m, *lowest_H_m - wall_below_ground_m),
                     base_H_m + footprint.height_m, mesh);
    }
    for (const std::string& note : file.notes)  // those of a mesh stand behind its file's name
        mesh.notes.push_back(note.starts_with(path + ": ") ? note.substr(path.size() + 2) : note);
    tell(counts, mesh);
    if (!fields.base.empty() && !mesh.triangles.empty()) mesh.notes.push_back(bases.in_words());
    if (!mesh.triangles.empty()) return mesh;
    std::string why;
    for (const std::string& note : mesh.notes) why += (why.empty() ? ": " : "; ") + note;
    if (counts.without_ground > 0 && !asked.crs.empty()) why += "; is --mesh-crs right?";
    return Error{ErrorKind::failed, path, "has no building" + why};
}

}  // namespace oro
