#include "geo/meshes/placed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/base/checksum.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/page_on_net.h"
#include "geo/coordinates/crs_places.h"
#include "geo/datum/vertical_datum.h"
#include "geo/meshes/crs_unit.h"
#include "geo/meshes/footprints.h"
#include "geo/meshes/lengthened_walls.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_look.h"
#include "geo/sources/length_unit.h"

namespace oro {

Geodetic geodetic_of(const PlacedVertex& vertex, const UndulationField& undulation, double exaggeration) {
    const double N_m = undulation.N_m.empty() ? 0.0 : undulation.at_m(vertex.lat_deg, vertex.lon_deg);
    return {vertex.lat_deg, vertex.lon_deg, vertex.H_m * exaggeration + N_m};
}

namespace {

// What turns a file's numbers into those of its CRS, and heights into metres.
struct MeshScale {
    double plane{1.0};
    double height_m{1.0};  // of heights that state no datum
    std::string note;
};

// Metres of the unit that is asked; nothing where none is.
Result<std::optional<double>> asked_unit_m(const std::string& asked_unit) {
    if (asked_unit.empty()) return std::optional<double>();
    const std::optional<double> unit_m = metres_in(asked_unit);
    if (unit_m) return unit_m;
    return Error{ErrorKind::usage, "--mesh-unit " + asked_unit, "is none of m, ft, us-ft, cm, dm, mm"};
}

Result<MeshScale> scale_of(const SourceMesh& mesh, const std::string& crs, const std::string& asked_unit) {
    MeshScale scale;
    ORO_TRY(std::optional<double> unit_m, asked_unit_m(asked_unit));
    if (!unit_m && !mesh.unit.empty()) unit_m = mesh.metres_per_unit;
    if (!unit_m) return scale;
    scale.height_m = *unit_m;
    const std::optional<double> axis_m = crs_unit_m(crs);
    if (!axis_m || std::abs(*unit_m / *axis_m - 1.0) < 1.0e-12) return scale;
    scale.plane = *unit_m / *axis_m;
    char text[120];
    std::snprintf(text, sizeof text, "its coordinates are taken times %.9g, from its unit to that of the CRS",
                  scale.plane);
    scale.note = text;
    return scale;
}

bool is_ecef(const std::string& crs) {
    return crs == ecef_crs;
}

// Places of a file's numbers.
class VertexPlaces {
  public:
    static Result<VertexPlaces> of(const std::string& crs, const MeshScale& scale,
                                   const UndulationField& undulation) {
        VertexPlaces places(scale, undulation);
        if (is_ecef(crs)) return places;
        ORO_TRY(CrsPlaces by_crs, CrsPlaces::of(crs));
        places.by_crs_ = std::move(by_crs);
        return places;
    }

    // "EPSG:2056 CH1903+ / LV95"
    [[nodiscard]] std::string name() const {
        return by_crs_ ? by_crs_->name() : std::string(ecef_crs) + " WGS 84 (geocentric)";
    }
    // at: finite. Nothing where it has no place, or is more than 100 km high or deep.
    [[nodiscard]] std::optional<PlacedVertex> vertex(const glm::dvec3& at) const {
        if (!by_crs_) return on_earth(at);
        const Result<Place> place = by_crs_->place(at.x * scale_.plane, at.y * scale_.plane);
        const double height_m = at.z * scale_.height_m;
        if (!place.ok() || std::abs(height_m) > most_height_m) return std::nullopt;
        return PlacedVertex{place->lat_deg, place->lon_deg, height_m};
    }
    // The first vertex of a triangle that is too high or too deep: "the height at 2683530, 1247000 is
    // 1e+09 m, beyond 100 km"; "" where none is.
    [[nodiscard]] std::string too_high_in(const SourceMesh& mesh) const {
        if (!by_crs_) return "";
        for (const SourceTriangle& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle) {
                const glm::dvec3& at = mesh.vertices[corner];
                const double height_m = at.z * scale_.height_m;
                if (!(std::abs(height_m) > most_height_m)) continue;
                char text[160];
                std::snprintf(text, sizeof text, "the height at %.10g, %.10g is %.10g m, beyond 100 km", at.x,
                              at.y, height_m);
                return text;
            }
        return "";
    }
    // Why the first vertex of a mesh has no place, and what would give it one.
    [[nodiscard]] std::string why_none(const glm::dvec3& first) const {
        if (!by_crs_)
            return "they lie farther than 100 km from the ellipsoid; is it in another CRS (--mesh-crs)?";
        const Result<Place> why = by_crs_->place(first.x * scale_.plane, first.y * scale_.plane);
        const bool is_swapped =
            !why.ok() && by_crs_->place(first.y * scale_.plane, first.x * scale_.plane).ok();
        const std::string reason = !why.ok() ? why.error().what : "its CRS has none for some part of each";
        return reason +
               (is_swapped ? "; with x and y swapped they have: x is the easting" : "; is --mesh-crs right?");
    }

  private:
    static constexpr double most_height_m = 1.0e5;

    VertexPlaces(const MeshScale& scale, const UndulationField& undulation)
        : scale_(scale), undulation_(undulation) {}

    [[nodiscard]] std::optional<PlacedVertex> on_earth(const glm::dvec3& at) const {
        const glm::dvec3 at_m = at * scale_.height_m;
        constexpr double innermost_m = 6.0e6, outermost_m = 7.0e6;
        if (glm::length(at_m) < innermost_m || glm::length(at_m) > outermost_m) return std::nullopt;
        const Geodetic place = geodetic_from_ecef(Ecef{at_m});
        if (std::abs(place.h_m) > most_height_m) return std::nullopt;
        const double N_m = undulation_.N_m.empty() ? 0.0 : undulation_.at_m(place.lat_deg, place.lon_deg);
        return PlacedVertex{place.lat_deg, place.lon_deg, place.h_m - N_m};
    }

    MeshScale scale_;
    const UndulationField& undulation_;
    std::optional<CrsPlaces> by_crs_;  // nothing: the numbers are those of ECEF
};

// A mesh while it is placed: vertices of the file, and those in the middle of long sides.
class MeshPlacing {
  public:
    MeshPlacing(const SourceMesh& source, const VertexPlaces& places, bool with_colours,
                std::size_t most_triangles, const std::shared_ptr<ScratchMemory>& scratch)
        : source_(source),
          places_(places),
          most_triangles_(most_triangles),
          of_(scratch),
          at_(scratch),
          placed_(scratch),
          vertices_(scratch),
          colours_(scratch),
          ecef_(scratch) {
        for (auto* const array : {&at_, &ecef_}) array->reserve(source.vertices.size());
        placed_.reserve(source.vertices.size()), vertices_.reserve(source.vertices.size());
        for (const glm::dvec3& vertex : source.vertices) {
            add(vertex);
            drop_pages_after(scratch.get(), at_.size());
        }
        if (with_colours) colours_ = source.colours;
    }

    // Cuts what is longer, and leaves out what has no place.
    Result<void> cut(PlacedMesh& mesh) {
        if (fewest_pieces() > static_cast<double>(most_triangles_)) return too_many();
        of_.reserve(source_.triangles.size()), mesh.triangles.reserve(source_.triangles.size());
        std::uint32_t feature = 0;
        for (std::size_t number = 0; number < source_.triangles.size(); ++number) {
            const SourceTriangle& triangle = source_.triangles[number];
            drop_pages_after(of_.get_allocator().scratch().get(), number + 1);
            while (feature + 1 < source_.features.size() &&
                   source_.features[feature + 1].first_triangle <= number)
                ++feature;
            if (std::ranges::any_of(triangle, [&](std::uint32_t i) { return !placed_[i]; })) {
                ++mesh.not_placed;
                continue;
            }
            std::vector<SourceTriangle> open{triangle};
            while (!open.empty()) {
                const SourceTriangle one = open.back();
                open.pop_back();
                const std::optional<std::size_t> side = long_side(one);
                if (!side) {
                    mesh.triangles.push_back(one);
                    of_.push_back(static_cast<std::uint32_t>(number));
                    if (!source_.features.empty()) mesh.feature_of.push_back(feature);
                    if (mesh.triangles.size() + open.size() > most_triangles_) return too_many();
                    continue;
                }
                const std::uint32_t a = one[*side], b = one[(*side + 1) % 3], c = one[(*side + 2) % 3];
                const std::uint32_t middle = middle_of(a, b);
                if (!placed_[middle]) {
                    ++mesh.not_placed;
                    break;
                }
                open.push_back({a, middle, c});
                open.push_back({middle, b, c});
            }
        }
        mesh.vertices = std::move(vertices_);
        mesh.colours = std::move(colours_);
        return {};
    }
    // Of each triangle that cut() made, the one of the file that it is a piece of; rising.
    [[nodiscard]] std::span<const std::uint32_t> of() const { return of_; }

  private:
    void add(const glm::dvec3& at) {
        at_.push_back(at);
        const bool finite = std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
        const std::optional<PlacedVertex> placed = finite ? places_.vertex(at) : std::nullopt;
        placed_.push_back(placed.has_value());
        vertices_.push_back(placed.value_or(PlacedVertex{}));
        ecef_.push_back(ecef_from_geodetic({vertices_.back().lat_deg, vertices_.back().lon_deg, 0.0}).m);
    }
    // By the sides' length over the ellipsoid, so that neighbours agree; of equal ones the first.
    [[nodiscard]] std::optional<std::size_t> long_side(const SourceTriangle& triangle) const {
        std::optional<std::size_t> longest;
        double most = longest_side_m;
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = glm::distance(ecef_[triangle[i]], ecef_[triangle[(i + 1) % 3]]);
            if (length > most) longest = i, most = length;
        }
        return longest;
    }
    // No fewer triangles than this are left of it: one with sides of longest_side_m has most area.
    [[nodiscard]] double fewest_pieces() const {
        const double most_m2 = 0.25 * std::sqrt(3.0) * longest_side_m * longest_side_m;
        double pieces = 0.0;
        for (const SourceTriangle& triangle : source_.triangles) {
            if (std::ranges::any_of(triangle, [&](std::uint32_t i) { return !placed_[i]; })) continue;
            const glm::dvec3& at = ecef_[triangle[0]];
            const double m2 = 0.5 * glm::length(glm::cross(ecef_[triangle[1]] - at, ecef_[triangle[2]] - at));
            pieces += std::max(m2 / most_m2, 1.0);
        }
        return pieces;
    }
    [[nodiscard]] Error too_many() const {
        double longest_m = 0.0;
        for (const SourceTriangle& triangle : source_.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                if (placed_[triangle[i]] && placed_[triangle[(i + 1) % 3]])
                    longest_m =
                        std::max(longest_m, glm::distance(ecef_[triangle[i]], ecef_[triangle[(i + 1) % 3]]));
        if (longest_m <= longest_side_m)
            return {
                ErrorKind::failed, source_.path,
                "has more than " + grouped(most_triangles_) + " triangles, which is the limit" + advice()};
        char text[400];
        std::snprintf(
            text, sizeof text,
            "has %zu triangle%s with sides of up to %.0f m. Sides are cut to 200 m, to be straight on the "
            "map and in space, and that makes more than %s triangles, which is the limit: give a "
            "part of the mesh, or is its unit wrong (--mesh-unit)?",
            source_.triangles.size(), source_.triangles.size() == 1 ? "" : "s", longest_m,
            grouped(most_triangles_).c_str());
        return {ErrorKind::failed, source_.path, text};
    }
    // "5,000,000".
    [[nodiscard]] static std::string grouped(std::size_t number) {
        std::string text = std::to_string(number);
        for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
        return text;
    }
    [[nodiscard]] std::string advice() const {
        if (most_triangles_ >= most_baked_triangles) return ": give a part of the mesh";
        return ": bake it (`orograph bake`), which takes " + grouped(most_baked_triangles);
    }
    std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] =
            middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(at_.size()));
        if (!is_new) return found->second;
        add(0.5 * (at_[std::min(a, b)] + at_[std::max(a, b)]));
        constexpr double half = 0.5;
        if (!colours_.empty()) colours_.push_back(colour_between(colours_[a], colours_[b], half));
        return found->second;
    }

    const SourceMesh& source_;
    const VertexPlaces& places_;
    std::size_t most_triangles_;
    ScratchVector<std::uint32_t> of_;
    ScratchVector<glm::dvec3> at_;  // in the file's numbers
    ScratchVector<char> placed_;
    ScratchVector<PlacedVertex> vertices_;
    ScratchVector<VertexColour> colours_;  // of these, or none
    ScratchVector<glm::dvec3> ecef_;       // on the ellipsoid
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

BoundingBox box_around(std::span<const PlacedVertex> vertices, std::span<const SourceTriangle> triangles) {
    BoundingBox box{180.0, 90.0, -180.0, -90.0};
    for (const SourceTriangle& triangle : triangles) {
        for (const std::uint32_t i : triangle) {
            box.west_deg = std::min(box.west_deg, vertices[i].lon_deg);
            box.east_deg = std::max(box.east_deg, vertices[i].lon_deg);
            box.south_deg = std::min(box.south_deg, vertices[i].lat_deg);
            box.north_deg = std::max(box.north_deg, vertices[i].lat_deg);
        }
    }
    return box;
}

void add_note(PlacedMesh& mesh, const std::string& note) {
    if (!note.empty()) mesh.note += (mesh.note.empty() ? "" : "; ") + note;
}

// Turns heights of the CRS's own vertical datum into H.
Result<void> lift_heights(const std::string& crs, const StatedDatum& datum, double height_m,
                          bool strict_datum, const UndulationField& undulation, PlacedMesh& mesh) {
    mesh.heights = datum.name;
    ORO_TRY(const GeoidOfRegion geoid, GeoidOfRegion::open(false));
    ORO_TRY(GeoidOfRegion::Shift shift,
            geoid.shift_from(crs, box_around(mesh.vertices, mesh.triangles), strict_datum));
    add_note(mesh, shift.note());
    for (PlacedVertex& vertex : mesh.vertices) {
        auto H_m = static_cast<float>(vertex.H_m / height_m * datum.metres_per_unit);
        vertex.H_m = vertex.H_m / height_m * datum.metres_per_unit;
        if (shift.does_nothing()) continue;
        ORO_CHECK(shift.apply(undulation, vertex.lat_deg, {&vertex.lon_deg, 1}, {&H_m, 1}));
        vertex.H_m = static_cast<double>(H_m);
    }
    if (shift.beyond_grid() > 0)
        add_note(mesh, "heights beyond the grid of " + datum.name + " count as above sea level");
    return {};
}

using LatticeKey = std::array<std::int64_t, 3>;

ScratchVector<LatticeKey> lattice_of(const UndulationField& undulation, const PlacedMesh& mesh) {
    ScratchVector<LatticeKey> lattice(mesh.vertices.get_allocator());
    lattice.reserve(mesh.vertices.size());
    for (const PlacedVertex& vertex : mesh.vertices)
        lattice.push_back(lattice_point(ecef_from_geodetic(geodetic_of(vertex, undulation, 1.0)).m).steps);
    return lattice;
}

// Whether each triangle has no corners on the lattice that an earlier one has, either way round.
ScratchVector<char> are_first(const PlacedMesh& mesh, std::span<const LatticeKey> lattice) {
    using Corners = std::array<LatticeKey, 3>;
    const auto corners = [&](std::uint32_t number) {
        Corners at{};
        for (std::size_t i = 0; i < 3; ++i) at[i] = lattice[mesh.triangles[number][i]];
        std::ranges::sort(at);
        return at;
    };
    // By a number that all orders of the same corners have.
    const auto memory = mesh.vertices.get_allocator();
    ScratchVector<std::pair<std::int64_t, std::uint32_t>> order(mesh.triangles.size(), memory);
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        order[i] = {0, i};
        for (const std::uint32_t corner : mesh.triangles[i]) {
            const LatticeKey& at = lattice[corner];
            order[i].first += (at[0] + 3 * at[1] + 7 * at[2]) * (1 + (at[1] & 1023));
        }
    }
    std::ranges::sort(order);
    ScratchVector<char> first(order.size(), 1, memory);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t k = i; k > 0 && order[k - 1].first == order[i].first; --k)
            if (corners(order[k - 1].second) == corners(order[i].second)) {
                first[order[i].second] = 0;
                break;
            }
    return first;
}

// Counts triangles of a file, not their pieces.
class OnceEach {
  public:
    void add(std::uint32_t number) {
        count += last_ != number ? 1U : 0U;
        last_ = number;
    }
    std::size_t count{};

  private:
    std::uint32_t last_{~std::uint32_t{0}};
};

// Leaves out triangles without an area on the lattice, and those given again. of: which of the file's each is
// a piece of.
void drop_degenerate(const UndulationField& undulation, std::span<const std::uint32_t> of, PlacedMesh& mesh) {
    const ScratchVector<LatticeKey> lattice = lattice_of(undulation, mesh);
    const ScratchVector<char> first = are_first(mesh, lattice);
    const auto has_area = [&](const SourceTriangle& triangle) {
        std::array<glm::dvec3, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            const LatticeKey& steps = lattice[triangle[i]];
            at[i] = {steps[0], steps[1], steps[2]};
        }
        return glm::cross(at[1] - at[0], at[2] - at[0]) != glm::dvec3(0.0);
    };
    std::size_t kept = 0;
    OnceEach degenerate, again;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const SourceTriangle triangle = mesh.triangles[i];
        if (!has_area(triangle)) {
            degenerate.add(of[i]);
            continue;
        }
        if (first[i] == 0) {
            again.add(of[i]);
            continue;
        }
        if (!mesh.feature_of.empty()) mesh.feature_of[kept] = mesh.feature_of[i];
        mesh.triangles[kept++] = triangle;
    }
    mesh.triangles.resize(kept);
    if (!mesh.feature_of.empty()) mesh.feature_of.resize(kept);
    mesh.degenerate = degenerate.count;
    if (again.count > 0) add_note(mesh, std::to_string(again.count) + " left out, given twice");
}

// A mesh is drawn around one place, in steps of 2^-11 m that are 32 bits.
Result<void> check_reach(const PlacedMesh& mesh) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    glm::dvec3 least(infinite), most(-infinite);
    for (const SourceTriangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            const PlacedVertex& at = mesh.vertices[corner];
            const glm::dvec3 place = ecef_from_geodetic({at.lat_deg, at.lon_deg, at.H_m}).m;
            least = glm::min(least, place), most = glm::max(most, place);
        }
    constexpr double most_reach_m = 2.0e6;
    const double reach_m = glm::distance(least, most);
    if (reach_m <= most_reach_m) return {};
    return Error{ErrorKind::failed, mesh.path,
                 "reaches over " + std::to_string(std::llround(reach_m / 1000.0)) +
                     " km: one mesh may reach 2,000 km; is --mesh-crs right?"};
}

// Heights of bases in the vertical datum that --mesh-crs names: sea level where it names none.
struct Bases {
    const std::string& crs;
    const std::optional<StatedDatum>& datum;
    bool strict_datum;
    const UndulationField& undulation;

    // note: what was said of the way from the datum.
    [[nodiscard]] Result<void> lift(std::span<const VectorPlace> places, std::span<double> bases_H_m,
                                    std::string& note) const {
        if (!datum) return {};
        PlacedMesh each;  // lifted as meshes are: a triangle of one vertex a base
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            each.vertices.push_back({places[i].lat_deg, places[i].lon_deg, bases_H_m[i]});
            each.triangles.push_back({i, i, i});
        }
        ORO_CHECK(lift_heights(crs, *datum, datum->metres_per_unit, strict_datum, undulation, each));
        note = each.note;
        for (std::size_t i = 0; i < places.size(); ++i) bases_H_m[i] = each.vertices[i].H_m;
        return {};
    }
};

std::uint64_t fingerprint_of(const SourceMesh& source, const std::string& crs, const std::string& unit) {
    const std::string how = crs + "\n" + unit + "\n" + source.unit;
    const std::array parts{xxh64(std::as_bytes(std::span(source.vertices))),
                           xxh64(std::as_bytes(std::span(source.triangles))),
                           xxh64(std::as_bytes(std::span(how)))};
    const std::uint64_t all = xxh64(std::as_bytes(std::span(parts)));
    if (source.colours.empty()) return all;
    return xxh64(std::as_bytes(std::span(source.colours)), all);
}

// Its arrays lie where those of the source do.
Result<PlacedMesh> placed(const SourceMesh& source, const MeshRequest& request, bool strict_datum,
                          const UndulationField& undulation) {
    const std::string crs = request.crs.empty() ? source.crs : request.crs;
    if (crs.empty())
        return Error{ErrorKind::failed, source.path,
                     "states no coordinate reference system: --mesh-crs EPSG:2056, say, tells where it lies"};
    ORO_TRY(const MeshScale scale, scale_of(source, crs, request.unit));
    const Result<VertexPlaces> places = VertexPlaces::of(crs, scale, undulation);
    if (!places.ok())
        return Error{request.crs.empty() ? ErrorKind::failed : places.error().kind,
                     request.crs.empty() ? source.path + ": " + crs : "--mesh-crs " + crs,
                     places.error().what};
    const std::shared_ptr<ScratchMemory> scratch = source.vertices.get_allocator().scratch();
    PlacedMesh mesh;
    mesh.lie_in(scratch);
    mesh.path = source.path, mesh.format = source.format, mesh.kind = source.kind;
    mesh.crs = places->name(), mesh.note = scale.note;
    mesh.heights = is_ecef(crs) ? "the WGS84 ellipsoid" : "sea level (EGM96)";
    for (const std::string& note : source.notes) add_note(mesh, note);
    mesh.features = source.features;
    mesh.look = look_of_mesh(source, request.look);
    mesh.crease_deg = request.crease_deg.value_or(default_crease_deg);
    mesh.has_look_by_type = request.look.empty() && source.kind == MeshKind::city_model;
    mesh.in_file = source.triangles.size() + source.not_finite;
    mesh.not_finite = source.not_finite;
    mesh.fingerprint = fingerprint_of(source, crs, request.unit);
    MeshPlacing placing(source, *places, request.look.empty() || request.look == "ground",
                        request.most_triangles, scratch);
    ORO_CHECK(placing.cut(mesh));
    const std::string too_high = mesh.not_placed > 0 ? places->too_high_in(source) : "";
    if (mesh.triangles.empty())
        return Error{ErrorKind::failed, source.path,
                     "none of its triangles has a place: " +
                         (too_high.empty() ? places->why_none(source.vertices[source.triangles.front()[0]])
                                           : too_high + "; is its unit right (--mesh-unit)?")};
    add_note(mesh, too_high);
    ORO_CHECK(check_reach(mesh));
    const std::optional<StatedDatum> datum = is_ecef(crs) ? std::nullopt : stated_datum(crs);
    if (datum) ORO_CHECK(lift_heights(crs, *datum, scale.height_m, strict_datum, undulation, mesh));
    drop_degenerate(undulation, placing.of(), mesh);
    if (mesh.triangles.empty())
        return Error{ErrorKind::failed, source.path, "no triangle has an area: is --mesh-unit right?"};
    return mesh;
}

// Buildings on the footprints of a vector file, placed.
Result<PlacedMesh> placed_footprints(const std::string& file, const MeshRequest& request, bool strict_datum,
                                     const UndulationField& undulation,
                                     std::span<const HeightField* const> ground) {
    ORO_TRY(const std::optional<double> unit_m, asked_unit_m(request.unit));
    std::optional<StatedDatum> datum;
    std::string crs_name;
    if (!request.crs.empty()) {
        const Result<CrsPlaces> by_crs = CrsPlaces::of(request.crs);
        if (!by_crs.ok()) return Error{by_crs.error().kind, "--mesh-crs " + request.crs, by_crs.error().what};
        crs_name = by_crs->name();
        if (!request.building_base.empty()) datum = stated_datum(request.crs);
    }
    FootprintFields fields{request.building_height, request.building_base, unit_m.value_or(1.0),
                           unit_m.value_or(1.0)};
    if (datum) fields.base_unit_m = datum->metres_per_unit;
    const Bases bases{request.crs, datum, strict_datum, undulation};
    std::string note;
    ORO_TRY(const SourceMesh source,
            buildings_on_footprints(file, fields, ground,
                                    [&](std::span<const VectorPlace> places, std::span<double> bases_H_m) {
                                        return bases.lift(places, bases_H_m, note);
                                    },
                                    {request.crs, unit_m}));
    MeshRequest as_placed = request;
    as_placed.crs.clear(), as_placed.unit.clear();
    ORO_TRY(PlacedMesh mesh, placed(source, as_placed, strict_datum, undulation));
    if (!crs_name.empty()) mesh.crs = crs_name;
    if (datum) mesh.heights = datum->name;
    add_note(mesh, note);
    return mesh;
}

// Options of kinds of files that no file is of.
Result<void> check_kinds(const MeshRequest& request, const std::vector<PlacedMesh>& meshes) {
    const bool has_footprints = std::ranges::any_of(
        request.files, [&](const std::string& file) { return is_of_footprints(request, file); });
    if (!request.building_height.empty() && !has_footprints)
        return Error{ErrorKind::usage, "--building-height " + request.building_height,
                     "is of footprints, and no --mesh-file holds any"};
    const bool has_city = std::ranges::find(meshes, MeshKind::city_model, &PlacedMesh::kind) != meshes.end();
    if (!request.lod.empty() && !has_city)
        return Error{ErrorKind::usage, "--lod " + request.lod,
                     "is of CityJSON, and no mesh is in that format"};
    return {};
}

}  // namespace

std::uint64_t fingerprint_of_undulation(const UndulationField& undulation) {
    const std::uint64_t axes = xxh64(std::as_bytes(std::span(&undulation.lat, 1))),
                        both = xxh64(std::as_bytes(std::span(&undulation.lon, 1)), axes);
    return xxh64(std::as_bytes(std::span(undulation.N_m)), both);
}

bool is_drawn_as_streamed(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration) {
    return mesh.streamed() && exaggeration == 1.0 &&
           mesh.baked->undulation_fingerprint == fingerprint_of_undulation(undulation);
}

bool is_coloured(const PlacedMesh& mesh, std::size_t triangle) {
    return !mesh.colours.empty() && std::ranges::all_of(mesh.triangles[triangle], [&](std::uint32_t corner) {
        return corner < mesh.colours.size() && mesh.colours[corner].is_stated != 0;
    });
}

std::string note_of_mesh(const PlacedMesh& mesh) {
    const auto several = [](std::size_t count, const char* what) {
        return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    };
    std::string note = mesh.path + ": a mesh of " + several(mesh.in_file, "triangle");
    if (!mesh.features.empty()) note += " in " + several(mesh.features.size(), "feature");
    note += ", heights above " + mesh.heights;
    const auto left_out = [&](std::size_t count, const char* why) {
        if (count > 0) note += "; " + std::to_string(count) + " left out, " + why;
    };
    left_out(mesh.not_finite, "with a vertex that is no finite place");
    left_out(mesh.not_placed, "with a vertex that has no place in its CRS");
    left_out(mesh.degenerate, "without an area");
    if (mesh.lengthened > 0) {
        char text[120];
        std::snprintf(text, sizeof text, "; walls of %zu %s led down to the ground, by up to %.1f m",
                      mesh.lengthened, mesh.lengthened == 1 ? "building" : "buildings",
                      mesh.most_lengthened_m);
        note += text;
    }
    if (!mesh.colours.empty()) note += "; its file states colours";
    return mesh.note.empty() ? note : note + "; " + mesh.note;
}

Result<std::shared_ptr<const std::vector<PlacedMesh>>> open_meshes(
    const MeshRequest& request, bool strict_datum, const UndulationField& undulation,
    std::span<const HeightField* const> ground, const std::shared_ptr<ScratchMemory>& scratch) {
    auto meshes = std::make_shared<std::vector<PlacedMesh>>();
    for (const std::string& file : request.files) {
        if (is_of_footprints(request, file)) {
            ORO_TRY(PlacedMesh mesh, placed_footprints(file, request, strict_datum, undulation, ground));
            mesh.not_added = mesh.triangles.size();
            meshes->push_back(std::move(mesh));
            continue;
        }
        ORO_TRY(const SourceMesh source, read_mesh(file, request.lod, scratch));
        ORO_TRY(PlacedMesh mesh, placed(source, request, strict_datum, undulation));
        mesh.not_added = mesh.triangles.size();
        lengthen_walls(ground, mesh);
        meshes->push_back(std::move(mesh));
        if (scratch != nullptr) scratch->drop_pages();
    }
    ORO_CHECK(check_kinds(request, *meshes));
    return std::shared_ptr<const std::vector<PlacedMesh>>(std::move(meshes));
}

}  // namespace oro
