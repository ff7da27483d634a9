// What the command line says, as it says it: nothing is looked up or opened yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/view_settings.h"

namespace oro {

// Which terrain.
struct RegionOptions {
    std::vector<std::string> paths;
    std::string bbox;
    std::string tile;
    std::string coordinates;  // the CRS of two plain numbers in places, and of bbox; "": degrees
    std::string height_unit;
    std::string source_crs;       // of files that state none
    std::string source_vertical;  // likewise, what heights refer to
    bool strict_datum{false};
    bool fill_voids{false};
    bool resample{false};
    std::string order;  // finest, listed; "": not said
    std::optional<double> feather_m;
    std::vector<std::string> mesh_files;  // triangle meshes on the ground
    std::string mesh_crs;                 // where they lie, of files that state nothing or something else
    std::string mesh_unit;
    std::string mesh_lod;  // of CityJSON
    std::string building_height, building_base;
    std::string mesh_look;             // ground, built, plain; "": by the file
    bool cut_under{false};             // terrain is cut out under meshes that are ground
    std::optional<double> crease_deg;  // where triangles of meshes meet at less they share their light
};

// From where, and how it looks.
struct ViewOptions : ViewSettings<OnCommandLine> {
    std::optional<std::string> at;
    std::optional<double> above_m;
    std::optional<double> altitude_m;
    std::optional<double> heading_deg;
    std::optional<double> pitch_deg;
    std::optional<double> roll_deg;
    std::optional<double> vertical_fov_deg;
    std::optional<std::string> look_at;
    std::optional<std::string> size;
    std::optional<std::string> sun;
    std::optional<std::string> sun_time;
    bool legend{false};                   // a strip below the picture
    std::vector<std::string> landcover;   // rasters of land cover, each FILE or FILE,TABLE
    std::vector<std::string> canopy;      // rasters of canopy heights, or "class" alone
    std::optional<double> canopy_held;    // share of it that the data hold already
    std::optional<std::string> detail;    // N or N,KM: ground between the posts
    bool takes_maps{false};               // not an option: whether a view that is a map may be opened
    bool on_summit{false};                // the eye stands on the highest post near --at
    std::optional<std::string> stand_on;  // ground, top: of meshes, too
    bool stands_at_place{false};          // not an option: whether --at alone is where the eye stands
    std::vector<std::string> names;       // vector files whose points are named
    std::optional<std::string> names_field;
    std::vector<std::string> overlay;  // vector files that lie on the ground
    std::optional<std::string> overlay_colour;
    std::optional<double> overlay_width_px;
    std::optional<double> overlay_fill;
    std::optional<std::string> time;
    std::optional<std::string> earth;
    std::optional<double> refraction_k;
    std::optional<std::string> air;
    std::optional<std::string> precision;
    std::optional<std::string> geoid;
    std::optional<std::string> accuracy;   // a bundle of options; single ones win over it
    std::optional<std::string> tolerance;  // pixels: the cheapest bundle that holds it
};

// How much memory drawing may take, MB of 10^6 bytes; nothing: as much as is reasonable here.
struct MemoryOptions {
    std::optional<int> gpu_memory_mb;
    std::optional<int> memory_mb;
};

struct ShotOptions {
    RegionOptions region;
    ViewOptions view;
    MemoryOptions memory;
    std::string view_file;
    std::string out;
    std::optional<double> unseen_ceiling_m;
    bool verify{false};
    bool layers{false};
    bool covers{false};      // not an option: the view has land cover
    bool has_meshes{false};  // likewise
    bool ortho{false};
    std::optional<std::string> crs;    // of a map; as GDAL takes it
    std::optional<double> resolution;  // of a map: a pixel, in the unit of its CRS
    bool no_legend{false};             // not even where --show has one by itself
    bool data_changed{false};
    bool no_paths{false};  // the picture tells no paths
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
    bool kml{false};                      // a PhotoOverlay beside the picture, a GroundOverlay beside a map
    bool geopose{false};                  // a GeoPose beside it
    bool stac{false};                     // a STAC item beside it
    std::vector<std::string> view_files;  // as given; view_file: the one that a picture is drawn from
};

struct FilmOptions {
    std::string path;  // of the camera: keys, a tour or a track
    RegionOptions region;
    ViewOptions view;
    MemoryOptions memory;
    std::string out;     // a folder, or an .mp4
    double fps{25.0};    // frames a second
    std::string frames;  // FIRST:LAST
    std::string shard;   // NUMBER/COUNT
    std::string format{"png"};
    std::string write_path;
    std::optional<int> line;                // of a file with several tracks, from 1
    std::optional<double> above_m;          // over the ground of a track
    std::optional<double> duration_s;       // of a track
    std::optional<double> speed_m_s;        // along a track
    std::optional<double> smoothing_m;      // of a track
    std::optional<std::string> look_ahead;  // along a track
    bool kml{false};
    bool geopose{false};
    bool stac{false};
    bool no_legend{false};
    bool no_paths{false};
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

struct CompareOptions {
    RegionOptions region;
    MemoryOptions memory;
    std::string view_file;
    std::string out;
    std::optional<double> unseen_ceiling_m;
    bool data_changed{false};
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

struct PlanOptions {
    RegionOptions region;
    ViewOptions view;
    std::string view_file;
    std::optional<double> unseen_ceiling_m;
    bool all{false};  // each effect by itself, and not the largest alone
    bool json{false};
    bool quiet{false};
};

struct TradeOptions {
    RegionOptions region;
    ViewOptions view;
    MemoryOptions memory;
    std::string view_file;
    int views{6};
    int repeats{3};
    std::string out{"."};  // folder
    std::string command;   // as it was typed
    bool overwrite{false};
    bool quiet{false};
};

struct SunOptions {
    RegionOptions region;  // none: over a plain horizon alone
    ViewOptions view;      // the place, and the air
    std::optional<std::string> date;
    std::optional<std::string> zone;
    bool json{false};
    bool quiet{false};
};

struct SightOptions {
    RegionOptions region;
    ViewOptions view;  // the air, land cover and the canopy alone
    std::string from;
    std::string to;
    std::optional<double> above_m;
    std::optional<double> altitude_m;
    std::optional<double> target_m;
    bool on_summit{false};         // the eye stands on the highest post near --from
    bool target_on_summit{false};  // the target is the highest post near --to
    bool json{false};
    bool quiet{false};
};

struct ProfileOptions {
    RegionOptions region;
    std::string along;
    std::optional<int> line;  // of a file with several, from 1
    std::optional<double> step_m;
    double climb_threshold_m{10.0};
    std::vector<std::string> names;  // files whose names stand for places
    std::string out;
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

struct ViewshedOptions {
    RegionOptions region;
    ViewOptions view;  // the air, land cover and the canopy alone
    std::vector<std::string> at;
    std::optional<double> above_m;
    std::optional<double> altitude_m;
    std::optional<double> target_m;
    std::optional<double> radius_km;
    std::optional<std::string> target_on;  // ground, canopy
    bool on_summit{false};                 // each observer stands on the highest post near its place
    std::string out;
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

struct PanoramaOptions {
    RegionOptions region;
    ViewOptions view;
    MemoryOptions memory;
    std::string view_file;
    std::string out;
    std::optional<int> width_px;
    std::string sector;                 // FROM,TO
    std::string elevation;              // LOW,HIGH
    std::optional<std::string> ridges;  // on, off
    bool data_changed{false};
    bool no_paths{false};
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
    bool kml{false};      // beside the picture
    bool geopose{false};  // beside the picture
    bool stac{false};     // beside the picture
};

struct WindowOptions {
    RegionOptions region;
    ViewOptions view;
    MemoryOptions memory;
    std::string view_file;
    bool no_paths{false};  // its pictures tell no paths
    bool kml{false};       // beside its pictures, and so are the next two
    bool geopose{false};
    bool stac{false};
    std::optional<bool> gpu_pages;        // nothing: off
    std::vector<std::string> gazetteers;  // files with names that places are found by
    std::string coordinates;  // not an option: the CRS that --coordinates names, for places typed later
    bool quiet{false};
};

struct BakingOptions {
    RegionOptions region;
    std::string out;
    std::string mesh{"grid"};  // or "clusters"
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

struct InfoOptions {
    RegionOptions region;
    bool check{false};
    bool json{false};
    bool quiet{false};
};

struct DoctorOptions {
    bool json{false};
};

struct CompletionOptions {
    std::string shell;
};

struct ManualOptions {
    std::string command;  // "": the program
};

}  // namespace oro
