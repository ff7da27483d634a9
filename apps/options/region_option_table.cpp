#include "apps/options/region_option_table.h"

#include <algorithm>
#include <utility>

#include "apps/command_line/refusals.h"
#include "geo/meshes/mesh_file.h"

namespace oro {
namespace {

constexpr Limits memory_mb{16, 1000000};

using RegionRows = std::vector<OptionRow<RegionOptions>>;

template <class Value>
void add(RegionRows& rows, const OptionText& text, Value RegionOptions::*field, const char* help,
         std::vector<std::string> words = {}) {
    rows.push_back(option_row<RegionOptions>(option_headings::data, text, field, help, std::move(words)));
}

// Which files, and which part of them.
void add_sources(RegionRows& rows) {
    add(rows, {"PATH ...", shown_first}, &RegionOptions::paths,
        "Files or folders: SRTM tiles (.hgt), GeoTIFF and other rasters, also in .zip, .tar.gz or .gz; or "
        "one file that orograph bake wrote (.oro). Or terrain that is made by a rule, as in "
        "made:fbm?seed=7.");
    add(rows, {"--bbox WEST,SOUTH,EAST,NORTH", shown_first, "all the data"}, &RegionOptions::bbox,
        "Take only the part between these edges, in degrees. West may be more than east: the part then "
        "crosses the 180th meridian. Not with --tile.");
    add(rows, {"--tile CELL", no_trait, "all the data", "", {}, "--bbox"}, &RegionOptions::tile,
        "Take only a cell of one degree, e.g. N46E008, or a range of them, N46E006:N47E010. Not with "
        "--bbox.");
    add(rows, {"--coordinates CRS", no_trait, "degrees of WGS84"}, &RegionOptions::coordinates,
        "Two plain numbers that stand for a place are coordinates of this CRS, easting (or longitude) first: "
        "--coordinates EPSG:2056 --at 2642950,1166825. --bbox is XMIN,YMIN,XMAX,YMAX in it, and the box of "
        "latitudes and longitudes around that is taken. EPSG:2056, or another that PROJ knows; or source: "
        "the CRS of the data. Places in other forms stay what they are.");
    add(rows, {"--order", no_trait, "finest"}, &RegionOptions::order,
        "Which file is the ground where several have some: the one with the closest points (finest), or the "
        "one named first (listed; of a folder by the order of names).",
        {"finest", "listed"});
    add(rows, {"--feather METRES", no_trait, "", "", view_limits::feather_m}, &RegionOptions::feather_m,
        "Let heights go over smoothly to those of a coarser file below, within so many metres inside the rim "
        "of a finer one; what that changed is told. Without this they meet in a step as high as they "
        "differ.");
}

// How files are read.
void add_reading(RegionRows& rows) {
    add(rows, {"--height-unit UNIT", no_trait, "the file's, or metres where it says nothing"},
        &RegionOptions::height_unit,
        "Take heights in this unit, whatever a file says: m, ft, us-ft, cm, dm or mm. ft is the "
        "international foot, us-ft the US survey foot.",
        {"m", "ft", "us-ft", "cm", "dm", "mm"});
    add(rows, {"--source-crs CRS", no_trait}, &RegionOptions::source_crs,
        "Where files lie that state no coordinate reference system: EPSG:2056, or another that PROJ knows. "
        "Files that state one keep it.");
    add(rows,
        {"--source-vertical CRS", no_trait, "what the product is known to have, else sea level (EGM96)"},
        &RegionOptions::source_vertical,
        "What heights refer to, of files that do not say it: EPSG:5728 (Switzerland, LN02), EPSG:5703 "
        "(NAVD88), EPSG:4979 (above the ellipsoid), or another.");
    add(rows, {"--strict-datum", no_trait}, &RegionOptions::strict_datum,
        "Stop where heights cannot be converted from a file's vertical datum (what they are heights above), "
        "or where PROJ lacks a grid or a way for its horizontal datum. Without this they count as heights "
        "above sea level (EGM96), places are as good as they can be, and a note says so.");
    add(rows, {"--resample", no_trait}, &RegionOptions::resample,
        "Bring the points of files in a CRS of their own (a projected one, say) onto latitudes and "
        "longitudes. Without this they stay where that CRS has them, with the heights of their file; "
        "resampled, summits lose some metres. For --earth, --precision, and to compare.");
    add(rows, {"--fill-voids", no_trait}, &RegionOptions::fill_voids,
        "Give void posts (points that a file leaves empty) a height from their neighbours. Without this they "
        "are holes. Not for what lies outside a raster, nor for missing tiles.");
}

// Meshes on the ground.
void add_meshes(RegionRows& rows) {
    add(rows, {"--mesh-file FILE", no_trait}, &RegionOptions::mesh_files,
        "Draw a triangle mesh on the ground, and let it hide what is behind it: a surveyor's LandXML (.xml), "
        "a town's CityJSON, OBJ, PLY, STL, glTF, the finest tiles of 3D Tiles (tileset.json), surfaces with "
        "heights of a "
        "GeoPackage, and footprints of buildings with --building-height. May be given several times. Heights "
        "without a vertical CRS are "
        "above sea "
        "level.");
    add(rows, {"--mesh-crs CRS", no_trait, "the one that its file states"}, &RegionOptions::mesh_crs,
        "Where meshes lie: EPSG:2056, or another that PROJ knows; with heights of a vertical CRS "
        "EPSG:2056+5728. x is the easting or longitude. Needs --mesh-file.");
    add(rows, {"--mesh-unit UNIT", no_trait, "the file's, or that of the CRS where it says nothing"},
        &RegionOptions::mesh_unit,
        "Take coordinates and heights of meshes in this unit: m, ft, us-ft, cm, dm or mm. Needs --mesh-file.",
        {"m", "ft", "us-ft", "cm", "dm", "mm"});
    add(rows, {"--lod LEVEL", no_trait, "the highest that each object has"}, &RegionOptions::mesh_lod,
        "Level of detail to take from CityJSON: 1, 2, 2.2 ... Needs --mesh-file of a CityJSON.");
    add(rows, {"--mesh-look LOOK", no_trait, "by what a file is of"}, &RegionOptions::mesh_look,
        "Colour meshes in the style natural as ground (LandXML and TINs of a GeoPackage are), as built: "
        "walls of plaster and roofs (CityJSON and footprints are), or plain: grey (others are). Files that "
        "state colours of their vertices are drawn in these, in the style plain, too, but for built and "
        "plain. Needs --mesh-file.",
        {"ground", "built", "plain"});
    add(rows, {"--crease DEG", no_trait, "30", "", view_limits::crease_deg}, &RegionOptions::crease_deg,
        "Draw meshes smooth where their triangles meet at less than this angle, in degrees: 0 draws all "
        "flat, "
        "180 all smooth. Needs --mesh-file.");
    add(rows, {"--cut-under", no_trait}, &RegionOptions::cut_under,
        "Cut the terrain out under meshes that are ground (a pit, a quarry, a cutting), inside their "
        "outline, "
        "and close the rim. Of a region of one grid that is not baked. Needs --mesh-file.");
    add(rows, {"--building-height FIELD", no_trait}, &RegionOptions::building_height,
        "Raise buildings from the polygons of a vector file (--mesh-file), whose field FIELD has the height "
        "of "
        "each over its base, in metres or in --mesh-unit. Walls go down to the lowest ground under the "
        "footprint.");
    add(rows, {"--building-base FIELD", no_trait, "the lowest ground under the footprint"},
        &RegionOptions::building_base,
        "Height above sea level of each building's base, in metres or in --mesh-unit, or above the "
        "vertical datum that --mesh-crs names, in its unit. Needs --building-height.");
}

RegionRows made_region_table() {
    RegionRows rows;
    add_sources(rows);
    add_reading(rows);
    add_meshes(rows);
    return rows;
}

std::vector<OptionRow<MemoryOptions>> made_memory_table() {
    std::vector<OptionRow<MemoryOptions>> rows;
    rows.push_back(option_row<MemoryOptions>(
        option_headings::detail, {"--gpu-memory MB", no_trait, "half of it, at most 2147", "", memory_mb},
        &MemoryOptions::gpu_memory_mb,
        "How much of the GPU's memory terrain and meshes may take, in megabytes, {}. Images over the ground "
        "take half of what is given."));
    rows.push_back(option_row<MemoryOptions>(
        option_headings::detail, {"--memory MB", no_trait, "64", "", memory_mb}, &MemoryOptions::memory_mb,
        "How much main memory terrain may take on its way to the GPU, in megabytes, {}. Clusters have half "
        "of it, and so have baked meshes that are drawn by clusters. Files other than .oro need more: all "
        "their heights are read at once; so are those of what is "
        "drawn by clusters."));
    return rows;
}

}  // namespace

const std::vector<OptionRow<RegionOptions>>& region_option_table() {
    static const RegionRows rows = made_region_table();
    return rows;
}

const std::vector<OptionRow<MemoryOptions>>& memory_option_table() {
    static const std::vector<OptionRow<MemoryOptions>> rows = made_memory_table();
    return rows;
}

const char* first_given_of_region(const RegionOptions& options) {
    return first_given(region_option_table(), options,
                       [](const OptionRow<RegionOptions>& row) { return row.name != "PATH"; });
}

bool names_any_mesh(const RegionOptions& options) {
    return !options.mesh_files.empty() || std::ranges::any_of(options.paths, is_mesh_file);
}

Result<void> check_without_meshes(const RegionOptions& options, const char* what) {
    if (!options.mesh_files.empty()) return refused("--mesh-file", "", what);
    const auto mesh = std::ranges::find_if(options.paths, is_mesh_file);
    if (mesh != options.paths.end()) return refused("PATH", *mesh, std::string("is a mesh, which ") + what);
    return {};
}

}  // namespace oro
