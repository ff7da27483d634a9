#include "apps/commands/options.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/command_line/option_group.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/options/view_limits.h"
#include "apps/report/option_words.h"
#include "apps/view/accuracy.h"
#include "apps/view/model_names.h"
#include "render/device/raster_request.h"

namespace oro {

void add_on_summit(OptionGroup& group, bool& on_summit, const std::string& who_stands,
                   const std::string& place_option) {
    group.flag("--on-summit", on_summit,
               "Published places of summits lie beside those of the data: with this " + who_stands +
                   " on the highest post at most two posts from " + place_option +
                   ". How far that is, is told.");
}

namespace {

// "0.05 to 120"
std::string span(const Limits& limits) {
    char text[80];
    std::snprintf(text, sizeof text, "%.15g to %.15g", limits.low, limits.high);
    return text;
}

void add_eye_options(CLI::App& command, ViewOptions& options) {
    OptionGroup eye(command, "The eye");
    eye.option(
        "--at", options.at, "PLACE",
        "The place to look at, in the middle of the picture: latitude,longitude as in 46.57,7.99; or "
        "degrees, "
        "minutes and seconds, UTM, MGRS, a geohash, geo:46.57,7.99; all of a cell (N46E008). With --above, "
        "--altitude, --on-summit or --look-at: where the eye is. Default: all the data.");
    CLI::Option& above = eye.number(
        "--above", options.above_m, "METRES",
        "Stand at --at: height of the eye over the ground there (2 with --look-at or --on-summit). Needs "
        "--at. Not with --altitude.");
    eye.number("--altitude", options.altitude_m, "METRES",
               "Height of the eye above sea level instead. Needs --at. Not with --above.")
        .excludes(&above);
    add_on_summit(eye, options.on_summit, "the eye stands", "--at");
    eye.number("--heading", options.heading_deg, "DEGREES",
               "Where the eye looks, clockwise from true north, " + span(view_limits::heading_deg) +
                   ": 90 is east (default 0).");
    eye.number("--pitch", options.pitch_deg, "DEGREES",
               "How far up or down it looks: 0 is level, -90 straight down, 90 straight up. Default: 0; "
               "down to a place that it looks at, or to the data.");
    eye.number("--roll", options.roll_deg, "DEGREES",
               "Tilt of the eye, " + span(view_limits::roll_deg) +
                   ": above 0 its right side goes down (default 0).");
    eye.option(
        "--look-at", options.look_at, "PLACE",
        "Stand at --at and look at this place on the ground. Needs --at. Not with --heading or --pitch.");
    eye.number("--fov", options.vertical_fov_deg, "DEGREES",
               "Angle of view from the bottom of the picture to its top, " + span(view_limits::fov_deg) +
                   " (default 45; of a cell or all the data 30).");
    eye.option(
        "--size", options.size, "WIDTHxHEIGHT",
        "Size of the picture in pixels, each side " + span(view_limits::side_px) + " (default 1280x720).");
}

void add_vector_options(OptionGroup& looks, ViewOptions& options) {
    looks
        .option("--names", options.names, "FILE",
                "Name the points of a vector file (GPX, KML, GeoJSON, GeoPackage) that the eye sees, with "
                "height and distance. A window shows them while the eye rests. May be given several times.")
        .allow_extra_args(false);  // what follows its file is elevation data
    looks.option("--names-field", options.names_field, "FIELD",
                 "The field of such files that holds the name (default: name). Needs --names or --overlay.");
    looks
        .option("--overlay", options.overlay, "FILE",
                "Lay the lines and polygons of a vector file on the ground, and name its points. A "
                "window shows them while the eye rests. May be given several times.")
        .allow_extra_args(false);
    looks.option("--overlay-colour", options.overlay_colour, "COLOUR",
                 "Colour of these lines, such as #e2252b (default). A feature with a field stroke has that "
                 "colour. Needs --overlay.");
    looks.number("--overlay-width", options.overlay_width_px, "PIXELS",
                 "Width of these lines, " + span(view_limits::overlay_width_px) +
                     " (default 2). A feature with a field stroke-width has that width. Needs --overlay.");
    looks.number("--overlay-fill", options.overlay_fill, "SHARE",
                 "How much of the ground the areas of polygons hide, " + span(view_limits::overlay_fill) +
                     " (default 0.2). Features with the fields fill and fill-opacity are filled as these "
                     "say. Needs --overlay.");
}

void add_show(OptionGroup& looks, ViewOptions& options) {
    looks.choice(
        "--show", options.show, show_words(),
        "Show how the picture was made, in the place of colours: visible, whether the last round drew it "
        "or one before; levels, how coarse; meshlets or triangles, each in a colour of its own; overdraw, "
        "how many triangles cover a pixel; clusters or groups of them, each in a colour of its own, of a "
        "file that was baked with clusters. A legend says which colour is what. For pictures of one sample.");
}

void add_drape_options(OptionGroup& looks, ViewOptions& options) {
    looks
        .option("--drape", options.drape, "FILE",
                "Lay an image over the ground: an orthophoto, a satellite scene or a map, any raster with a "
                "CRS in a format that terrain is read from. Several are drawn one over the other, the last "
                "on top.")
        .allow_extra_args(false);  // what follows its file is elevation data
    looks.number("--drape-opacity", options.drape_opacity, "SHARE",
                 "How much images hide of the style's colours, " + span(view_limits::drape_opacity) +
                     " (default 1: all). Needs --drape.");
    looks.choice(
        "--drape-values", options.drape_values, drape_values_words(),
        "What the values of images are: codes of sRGB, as a picture program writes them, or reflectance, "
        "linear light that is stretched from its darkest to its brightest. auto (default): bytes are codes; "
        "other numbers are what their ICC profile says, and reflectance without one. Needs --drape.");
}

void add_look_options(CLI::App& command, ViewOptions& options) {
    OptionGroup looks(command, "Looks");
    looks.option(
        "--style", options.style, "NAME",
        "Colours of the ground and the sky: a style that comes with the program (default: natural), "
        "a .json file of your own, or a .txt file: a colour table as gdaldem color-relief reads it.");
    add_drape_options(looks, options);
    add_vector_options(looks, options);
    CLI::Option& sun = looks.option(
        "--sun", options.sun, "AZIMUTH,ELEVATION",
        "Where light comes from, in degrees: clockwise from north, and above the horizon; 315,45 is from the "
        "north-west. Below 0 there is no direct light. Default: the style's. Not with --sun-time.");
    looks
        .option("--sun-time", options.sun_time, "TIME",
                "Light as the sun gives it at the eye at this time, e.g. 2026-06-21T05:30+02:00; view is the "
                "picture's own time. Not with --sun.")
        .excludes(&sun);
    looks.number(
        "--visibility", options.visibility_km, "KM",
        "How clear the air is: how far away at sea level something black can be told from the sky, " +
            span(view_limits::visibility_km) + ". Default: the style's. For styles with air.");
    looks.choice(
        "--sea", options.sea, sea_words(),
        "What a style with water draws as the sea: level (default), ground that is level, as lakes "
        "are; low, too, what is up to 5 m above sea level and all below it; voids, what has no height.");
    looks.choice("--rim", options.rim, rim_words(),
                 "What a style with voids draws below the region's rim: skirt (default), walls down to the "
                 "ellipsoid; or none.");
    looks.choice(
        "--shadows", options.shadows, {"on", "off"},
        "Whether terrain casts shadows, from beyond the picture, too. Default: as the style has it.");
    looks.choice(
        "--sky-openness", options.sky_openness, {"on", "off"},
        "Whether ground that sees less of the sky gets less of its light. Default: as the style has it.");
    looks.choice("--labels", options.labels, {"on", "off"},
                 "Whether every fifth contour line has its height written on it, in pictures; a window has "
                 "none. Default: as the style has it.");
    looks.choice("--edges", options.edges, edges_words(),
                 "Edges of the ground before the sky and before farther ground, in pictures of one sample: "
                 "smooth, each pixel shows what it has of both; or steps, it shows what is in its middle. "
                 "Default: as the style has it.");
    add_show(looks, options);
    looks.whole_number("--samples", options.samples, static_cast<int>(view_limits::samples.low),
                       static_cast<int>(view_limits::samples.high), "N",
                       "How many samples make a pixel, " + span(view_limits::samples) +
                           " (default 1). More make edges smoother, and take longer.");
    looks.number("--exaggeration", options.exaggeration, "FACTOR",
                 "Multiply all heights by this, " + span(view_limits::exaggeration) +
                     ". Default: 1, as high as in nature.");
}

// "draft (--tau 4 --heights i16 --refraction 0), balanced (...) or survey (...)"
std::string bundle_words() {
    std::vector<std::string> all;
    for (const AccuracyBundle& bundle : accuracy_bundles())
        all.push_back(std::string(bundle.name) + " is " + bundle.options);
    return joined(all, " and ");
}

// How light goes. `values` says what K means there.
template <class Options>
void add_air_options(OptionGroup& detail, Options& options, const std::string& values) {
    CLI::Option& refraction =
        detail.number("--refraction", options.refraction_k, "K",
                      "How much the air bends light (a surveyor's coefficient of refraction), the same at "
                      "all heights, " +
                          span(view_limits::refraction_k) + ": " + values + ". Not with --air.");
    detail
        .choice("--air", options.air, air_words(),
                "standard: air that bends light less the higher the eye is, by 0.13 at sea level, 0.091 at "
                "3,000 m and nothing from space. Not with --refraction.")
        .excludes(&refraction);
}

// What of the world is modelled, and how exactly.
void add_model_options(OptionGroup& detail, ViewOptions& options) {
    detail.choice("--earth", options.earth, earth_words(),
                  "Shape of the Earth: ellipsoid (WGS84, as GPS has it; default), sphere, or flat around the "
                  "eye. The last two are there to show how far off they are.");
    add_air_options(detail, options, "0 is not at all (default), 0.13 is usual by day");
    detail.choice("--precision", options.precision, precision_words(),
                  "relative (default): positions are counted from the eye, and exact near it. naive: they "
                  "are counted from the Earth's centre with 7 digits, to show how far off that is.");
    detail.choice("--geoid", options.geoid, geoid_words(),
                  "egm96 (default): sea level is where the EGM96 model has it. none: it is the ellipsoid "
                  "itself, to show how far off that is.");
    detail.choice(
        "--heights", options.heights, heights_words(),
        "How the GPU keeps heights: f32 in steps of 0.5 mm (default), packed for the same picture in "
        "less than half of the memory, or i16 in half the memory and coarser steps.");
    detail.choice(
        "--accuracy", options.accuracy, accuracy_words(),
        "Set several options together: " + bundle_words() + ". Options given one by one win over it.");
    detail.option("--tolerance", options.tolerance, "PIXELS",
                  "Take the cheapest --accuracy that is predicted to be off by no more than this, 0.001 to "
                  "1000, e.g. 1px. Not with --accuracy.");
}

}  // namespace

void add_region_options(CLI::App& command, RegionOptions& options) {
    OptionGroup data(command, "Elevation data");
    data.option("PATH", options.paths, "...",
                "Files or folders: SRTM tiles (.hgt), GeoTIFF and other rasters, also in .zip, .tar.gz or "
                ".gz; or one file that orograph bake wrote (.oro).");
    CLI::Option& bbox = data.option("--bbox", options.bbox, "WEST,SOUTH,EAST,NORTH",
                                    "Take only the part between these edges, in degrees. West may be more "
                                    "than east: the part then crosses the 180th meridian. Not with --tile.");
    data.option("--tile", options.tile, "CELL",
                "Take only a cell of one degree, e.g. N46E008, or a range of them, N46E006:N47E010. Not with "
                "--bbox.")
        .excludes(&bbox);
    data.choice("--height-unit", options.height_unit, {"m", "ft", "us-ft", "cm", "dm", "mm"},
                "Take heights in this unit, whatever a file says: m, ft, us-ft, cm, dm or mm. Default: the "
                "file's, or metres where it says nothing. ft is the international foot, us-ft the US survey "
                "foot.")
        .option_text("UNIT");
    data.option("--source-crs", options.source_crs, "CRS",
                "Where files lie that state no coordinate reference system: EPSG:2056, or another that PROJ "
                "knows. Files that state one keep it.");
    data.option(
        "--source-vertical", options.source_vertical, "CRS",
        "What heights refer to, of files that do not say it: EPSG:5728 (Switzerland, LN02), EPSG:4979 "
        "(above the ellipsoid), or another. Default: sea level (EGM96).");
    data.flag("--strict-datum", options.strict_datum,
              "Stop where heights cannot be converted from a file's vertical datum (what they are heights "
              "above), or where PROJ lacks a grid or a way for its horizontal datum. Without this they count "
              "as heights above sea level (EGM96), places are as good as they can be, and a note says so.");
    data.flag("--resample", options.resample,
              "Bring the points of files in a CRS of their own (a projected one, say) onto latitudes and "
              "longitudes. Without this they stay where that CRS has them, with the heights of their file; "
              "resampled, summits lose some metres. For --earth, --precision, and to compare.");
    data.choice(
        "--order", options.order, {"finest", "listed"},
        "Which file is the ground where several have some: the one with the closest points (finest, the "
        "default), or the one named first (listed; of a folder by the order of names).");
    data.number(
        "--feather", options.feather_m, "METRES",
        "Let heights go over smoothly to those of a coarser file below, within so many metres inside the rim "
        "of a finer one. Without this they meet in a step as high as they differ.");
    data.flag(
        "--fill-voids", options.fill_voids,
        "Give void posts (points that a file leaves empty) a height from their neighbours. Without this "
        "they are holes. Not for what lies outside a raster, nor for missing tiles.");
}

void add_view_options(CLI::App& command, ViewOptions& options) {
    add_eye_options(command, options);
    add_look_options(command, options);
    OptionGroup detail(command, "Detail and models");
    detail.number("--tau", options.tau_px, "PIXELS",
                  "How far left-out detail may move anything on the picture, " + span(view_limits::tau_px) +
                      ". Default: 1; in a window 0.5. 0 leaves nothing out.");
    detail.choice("--pipeline", options.pipeline, words_of(raster_requests),
                  "How the GPU draws triangles: with mesh shaders or with compute shaders. auto (default) "
                  "takes the faster, measured once on this machine.");
    detail.choice(
        "--mesh", options.mesh, mesh_words(),
        "What triangles are taken from: clusters, which take the fewest, of a file that was baked with "
        "them, or the grid. auto (default) takes clusters where the view can be drawn by them.");
    detail.whole_number("--mesh-level", options.mesh_level, static_cast<int>(view_limits::mesh_level.low),
                        static_cast<int>(view_limits::mesh_level.high), "N",
                        "Draw the clusters of one level of the graph, wherever the eye is: 0 is the "
                        "original, beyond the last the coarsest are drawn. Needs a file that was baked with "
                        "clusters. Not with --tau, which asks for the clusters that a view needs.");
    add_model_options(detail, options);
}

void add_place_options(CLI::App& command, ViewOptions& options) {
    OptionGroup eye(command, "The eye");
    eye.option("--at", options.at, "PLACE",
               "The place: latitude,longitude as in 46.57,7.99, or in another way that shot takes.");
    CLI::Option& above = eye.number("--above", options.above_m, "METRES",
                                    "Height of the eye over the ground there (default 2). Needs elevation "
                                    "data. Not with --altitude.");
    eye.number("--altitude", options.altitude_m, "METRES",
               "Height of the eye above sea level instead. Needs elevation data. Not with --above.")
        .excludes(&above);
    add_on_summit(eye, options.on_summit, "the eye stands", "--at");
    OptionGroup detail(command, "Detail and models");
    add_air_options(detail, options, "0 is not at all, 0.13 is usual by day (default: --air standard)");
}

void add_air_options(CLI::App& command, AirOptions& options) {
    OptionGroup detail(command, "Detail and models");
    add_air_options(detail, options, "0 is not at all, 0.13 is usual by day (default: --air standard)");
}

void add_time(CLI::App& command, const std::string& heading, ViewOptions& options) {
    OptionGroup(command, heading)
        .option("--time", options.time, "TIME",
                "The time that is written down, e.g. 2026-11-21T09:00:00Z (default: now). It does not move "
                "the sun: --sun-time does.");
}

void add_no_paths(CLI::App& command, const std::string& heading, bool& no_paths) {
    OptionGroup(command, heading)
        .flag("--no-paths", no_paths,
              "Keep the paths of data and style out of pictures. To draw one again with --view, name the "
              "data, too.");
}

void add_unseen_ceiling(CLI::App& command, const std::string& heading, std::optional<double>& ceiling_m) {
    OptionGroup(command, heading)
        .number("--unseen-ceiling", ceiling_m, "METRES",
                "How high ground could be where there are no data, above sea level, " +
                    span(view_limits::unseen_ceiling_m) +
                    " (default 9000). A note tells how far such ground could change the picture.");
}

void add_data_changed(CLI::App& command, bool& data_changed) {
    OptionGroup(command, "The picture")
        .flag("--data-changed", data_changed,
              "Go on although the data or the geoid are others than those that the picture was drawn from.");
}

void add_memory_options(CLI::App& command, MemoryOptions& options) {
    constexpr int least_mb = 16, most_mb = 1000000;
    OptionGroup detail(command, "Detail and models");
    detail.whole_number(
        "--gpu-memory", options.gpu_memory_mb, least_mb, most_mb, "MB",
        "How much of the GPU's memory terrain may take, in megabytes, 16 to 1000000. "
        "Default: half of it, at most 2147. Images over the ground take half of what is given.");
    detail.whole_number(
        "--memory", options.memory_mb, least_mb, most_mb, "MB",
        "How much main memory terrain may take on its way to the GPU, in megabytes, 16 to 1000000 (default "
        "64). Clusters have half of it. Files other than .oro need more: all their heights are read at once; "
        "so are those of what is drawn by clusters.");
}

}  // namespace oro
