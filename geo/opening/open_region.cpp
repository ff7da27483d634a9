#include "geo/opening/open_region.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "core/base/files_of_job.h"
#include "core/base/files_read.h"
#include "core/base/scratch_memory.h"
#include "core/base/system_room.h"
#include "geo/files/library_faults.h"
#include "geo/files/raster_library.h"
#include "geo/meshes/footprints.h"
#include "geo/meshes/mesh_in_box.h"
#include "geo/meshes/mesh_over_ground.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/opening/grid_choice.h"
#include "geo/opening/grid_describing.h"
#include "geo/opening/grid_mosaic.h"
#include "geo/opening/made_world.h"
#include "geo/opening/region_files.h"
#include "geo/opening/region_sources.h"
#include "geo/region/region_grid.h"
#include "geo/sources/notes.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/feather.h"
#include "geo/together/mesh_cut.h"

namespace oro {
namespace {

// Under the meshes that are ground.
Result<void> cut_terrain_out(Region& region) {
    if (region.grids.size() > 1)
        return Error{ErrorKind::usage, "--cut-under", "is of a region of one grid, and this one has several"};
    auto meshes = std::make_shared<std::vector<PlacedMesh>>();
    if (region.meshes) *meshes = *region.meshes;
    bool is_any = false;
    for (PlacedMesh& mesh : *meshes) {
        if (mesh.look != gpu::mesh_look_ground) continue;
        is_any = true;
        ORO_CHECK(cut_under(region.grids.front().field, mesh));
    }
    if (!is_any)
        return Error{ErrorKind::usage, "--cut-under",
                     "needs a mesh that is ground: LandXML, a TIN, or --mesh-look ground"};
    region.meshes = std::move(meshes);
    return {};
}

// Leaves out the meshes that have nothing in the box that is asked for, with a note on each.
void leave_outside_out(const std::optional<BoundingBox>& box, std::vector<PlacedMesh>& meshes,
                       RegionGrid& noted) {
    if (!box) return;
    std::erase_if(meshes, [&](const PlacedMesh& mesh) {
        if (reaches_into(mesh, *box)) return false;
        add_note(noted.notes,
                 mesh.path + ": lies wholly outside the box " + bounding_box_text(*box) + " and is left out");
        return true;
    });
}

// The meshes in a baked file, before those that lie on it besides. Its description has the notes on them.
Result<void> take_baked_meshes(const std::string& path, const RegionRequest& request, MeshReading reading,
                               Region& region) {
    ORO_TRY(const std::shared_ptr<const Container> container, Container::open(path));
    const UndulationField& undulation = region.grids.front().field.undulation;
    // What lies in a box, and what cuts the terrain, is told by triangles.
    const bool streams = reading == MeshReading::streamed && !request.box && !request.meshes.cut_under;
    ORO_TRY(std::vector<PlacedMesh> meshes,
            streams ? open_baked_meshes(container, undulation) : read_baked_meshes(*container, undulation));
    leave_outside_out(request.box, meshes, region.grids.front());
    if (meshes.empty()) return {};
    region.meshes = std::make_shared<const std::vector<PlacedMesh>>(std::move(meshes));
    return {};
}

using Scratch = std::shared_ptr<ScratchMemory>;

// The meshes on a region, and what is to be told of them. scratch: where large ones lie; null: in memory.
Result<void> open_meshes_of(const RegionRequest& request, const Scratch& scratch, Region& region) {
    std::vector<const RegionGrid*> grids;
    for (const RegionGrid& grid : region.grids) grids.push_back(&grid);
    std::ranges::stable_sort(grids, {}, [](const RegionGrid* grid) { return grid->rank; });
    std::vector<const HeightField*> fields;
    for (const RegionGrid* const grid : grids) fields.push_back(&grid->field);
    ORO_TRY(const auto opened, open_meshes(request.meshes, request.strict_datum,
                                           region.grids.front().field.undulation, fields, scratch));
    RegionGrid& first = region.grids.front();
    std::vector<PlacedMesh> inside = *opened;
    leave_outside_out(request.box, inside, first);
    for (const PlacedMesh& mesh : inside) {
        // Made for the ground below: its own note says how bases lie.
        if (is_of_footprints(request.meshes, mesh.path)) {
            first.notes.push_back(note_of_mesh(mesh));
            continue;
        }
        const std::optional<MeshOverGround> over = mesh_over_ground(mesh, fields);
        const bool is_swapped = !over && is_over_ground_swapped(mesh, fields);
        first.notes.push_back(
            note_of_mesh(mesh) + "; " + words_of(over, first.geoid) +
            (is_swapped ? "; with latitude and longitude swapped it would: x is the longitude" : ""));
    }
    auto meshes = std::make_shared<std::vector<PlacedMesh>>();
    if (region.meshes) *meshes = *region.meshes;
    meshes->insert(meshes->end(), std::make_move_iterator(inside.begin()),
                   std::make_move_iterator(inside.end()));
    if (!meshes->empty()) region.meshes = std::move(meshes);
    if (request.meshes.cut_under) ORO_CHECK(cut_terrain_out(region));
    return region.health();
}

// A unit of heights that no source can have: of .hgt files the format says metres (SRTM's product
// specification), and not the user. Beside other files it is theirs, and a note says so.
Result<void> check_height_unit(const RegionRequest& request, std::span<const ChosenGrid> grids) {
    if (request.height_unit.empty() || request.height_unit == "m") return {};
    const bool are_hgt = std::ranges::all_of(grids, [](const ChosenGrid& grid) {
        return !grid.sources.empty() && std::ranges::all_of(grid.sources, [](const Source& source) {
            return source.kind == SourceKind::hgt;
        });
    });
    if (!are_hgt) return {};
    return Error{
        ErrorKind::usage, "--height-unit " + request.height_unit,
        "is not for .hgt files, whose format says metres: leave it out; if a file has other heights, "
        "gdal_translate -of GTiff makes one of it whose unit can be given"};
}

// The five steps. Of grids over each other one may lack all height: the others have ground.
Result<Region> read_region(const RegionRequest& request, const Progress& progress, MeshReading meshes,
                           const Scratch& scratch = nullptr) {
    ORO_TRY(const RegionFiles files, find_files(request));
    const bool is_baked = !files.baked.empty();
    if (!is_baked) start_gdal();
    ORO_TRY(RegionSources found, probe_files(files, request, progress));
    const std::vector<std::string> notes = found.notes;
    ORO_TRY(std::vector<ChosenGrid> chosen, choose_grids(std::move(found), request));
    ORO_CHECK(check_height_unit(request, chosen));
    const auto count = static_cast<double>(chosen.size());
    const bool may_lack = chosen.size() > 1 && (!is_baked || request.box);
    std::vector<RegionGrid> grids;
    std::vector<Error> empty;
    for (ChosenGrid& one : chosen) {
        const double before = static_cast<double>(grids.size()) / count;
        const Progress part = [&](double share, const std::string& what) {
            if (progress) progress(before + share / count, what);
        };
        const auto read = [&]() -> Result<RegionGrid> {
            if (is_made_world(one)) return made_world(one, request, notes);
            ORO_TRY(LaidGrid laid, lay_grid(std::move(one), request,
                                            grids.empty() ? notes : std::vector<std::string>(), part));
            return describe_grid(std::move(laid), request);
        };
        Result<RegionGrid> grid = read();
        if (grid)
            grids.push_back(std::move(*grid));
        else if (may_lack && grid.error().kind == ErrorKind::no_data)
            empty.push_back(grid.error());
        else
            return grid.error();
    }
    if (grids.empty()) return empty.front();
    if (progress) progress(1.0, "region read");
    Region region = describe_region(std::move(grids), empty, is_baked);
    if (request.feather_m > 0.0 && region.grids.size() > 1) ORO_CHECK(feather(region, request.feather_m));
    if (is_baked) ORO_CHECK(take_baked_meshes(files.baked, request, meshes, region));
    if (!request.meshes.files.empty()) ORO_CHECK(open_meshes_of(request, scratch, region));
    return region;
}

// Whether there are data in a request's box.
bool has_data(const RegionRequest& request) {
    const auto files = find_files(request);
    if (!files) return false;
    if (!files->baked.empty()) return read_region(request, {}, MeshReading::streamed).ok();
    auto found = probe_files(*files, request, {});
    return found.ok() && !found->sources.empty() && choose_extent(found->sources, request.box);
}

// Of a box without data: whether its numbers, taken as latitude first, are one with data. Then that is said.
Error with_order_of_box(Error fault, const RegionRequest& request) {
    if (fault.kind != ErrorKind::no_data || !request.box) return fault;
    RegionRequest other = request;
    other.box = with_latitude_first(*request.box);
    if (!other.box || !has_data(other)) return fault;
    fault.what +=
        ", but in " + bounding_box_text(*other.box) + ": longitude comes first (west,south,east,north)";
    return fault;
}

// That a box over the antimeridian which goes most of the way round the Earth is not one with west and east
// swapped: then the data lie in the swapped one, and not on both sides of the antimeridian.
Result<void> check_west_and_east(const RegionRequest& request) {
    if (!request.box) return {};
    const BoundingBox& box = *request.box;
    const bool crosses = box.west_deg > box.east_deg && box.west_deg < 180.0 && box.east_deg > -180.0;
    if (!crosses || box.west_deg - box.east_deg >= 180.0) return {};
    const auto has_data_between = [&](double west_deg, double east_deg) {
        RegionRequest other = request;
        other.box = BoundingBox{west_deg, box.south_deg, east_deg, box.north_deg};
        return has_data(other);
    };
    constexpr double near_deg = 90.0;  // so far from the antimeridian
    if (!has_data_between(box.east_deg, box.west_deg) ||
        (has_data_between(std::max(box.west_deg, 180.0 - near_deg), 180.0) &&
         has_data_between(-180.0, std::min(box.east_deg, near_deg - 180.0))))
        return {};
    return Error{ErrorKind::usage, "--bbox " + bounding_box_text(box),
                 "crosses the antimeridian, and goes most of the way round the Earth: did you mean " +
                     bounding_box_text({box.east_deg, box.south_deg, box.west_deg, box.north_deg}) + "?"};
}

// What keep_last_region() keeps.
struct KeptRegion {
    RegionRequest request;
    MeshReading meshes{};
    Region region;
    std::shared_ptr<const FilesReadSoFar> files;
};
struct RegionKeeping {
    bool keeps{};
    std::size_t read{};
    std::optional<KeptRegion> last;
};

RegionKeeping& keeping() {
    static RegionKeeping kept;
    return kept;
}

bool same_box(const std::optional<BoundingBox>& a, const std::optional<BoundingBox>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->west_deg == b->west_deg && a->south_deg == b->south_deg && a->east_deg == b->east_deg &&
           a->north_deg == b->north_deg;
}

bool asks_for_same(const RegionRequest& a, const RegionRequest& b) {
    const auto rest = [](const RegionRequest& one) {
        return std::tie(one.paths, one.strict_datum, one.fill_voids, one.resample, one.listed_first,
                        one.feather_m, one.height_unit, one.source_crs, one.source_vertical,
                        one.allow_multiple_grids, one.meshes);
    };
    return rest(a) == rest(b) && same_box(a.box, b.box);
}

// What a copy of a region takes in main memory, nearly all of it.
std::uint64_t bytes_of(const Region& region) {
    std::uint64_t floats = 0;
    for (const RegionGrid& grid : region.grids)
        floats += grid.field.H_m.size() + grid.field.N_of_posts_m.size() + grid.field.undulation.N_m.size();
    return floats * sizeof(float);
}

void keep(const RegionRequest& request, MeshReading meshes, const Region& region) {
    keeping().last.reset();
    const auto memory_bytes = machine_memory_bytes();
    if (memory_bytes && bytes_of(region) > *memory_bytes / 4) return;
    keeping().last = KeptRegion{request, meshes, region, files_read_so_far()};
}

Result<Region> read_or_kept(const RegionRequest& request, const Progress& progress, MeshReading meshes,
                            const Scratch& scratch) {
    RegionKeeping& kept = keeping();
    if (!kept.keeps) return read_region(request, progress, meshes, scratch);
    if (kept.last && kept.last->meshes == meshes && asks_for_same(kept.last->request, request) &&
        are_unchanged(*kept.last->files)) {
        remember_again(*kept.last->files);
        return kept.last->region;
    }
    kept.last.reset();
    ++kept.read;
    return read_region(request, progress, meshes, scratch);
}

Result<Region> opened_region(const RegionRequest& request, const Progress& progress, MeshReading meshes,
                             const Scratch& scratch) {
    try {
        ORO_CHECK(check_west_and_east(request));
        Result<Region> region = read_or_kept(request, progress, meshes, scratch);
        if (region.ok()) ORO_CHECK(libraries_are_sound());
        // Also where it could not be read: a file that is being rewritten is not damaged.
        ORO_CHECK(check_files_unchanged());
        if (!region.ok()) return with_order_of_box(region.error(), request);
        if (keeping().keeps && !keeping().last) keep(request, meshes, *region);
        return region;
    } catch (const std::bad_alloc&) {
        if (scratch != nullptr && scratch->error()) return *scratch->error();
        return Error{ErrorKind::failed, "region too large",
                     "not enough memory for its posts; narrow it with --bbox"};
    } catch (const std::exception& fault) {
        return Error{ErrorKind::failed, "reading a region", fault.what()};
    }
}

}  // namespace

void keep_last_region() {
    keeping() = {true, 0, std::nullopt};
}

void keep_no_region() {
    keeping() = {};
}

std::size_t regions_read() {
    return keeping().read;
}

Result<Region> open_region(const RegionRequest& request, const Progress& progress) {
    return open_region(request, progress, MeshReading::whole);
}

Result<Region> open_region(const RegionRequest& request, const Progress& progress, MeshReading meshes) {
    return opened_region(request, progress, meshes, nullptr);
}

Result<Region> open_region_in_scratch(const RegionRequest& request, const Progress& progress,
                                      const std::string& folder) {
    return opened_region(request, progress, MeshReading::whole, std::make_shared<ScratchMemory>(folder));
}

}  // namespace oro
