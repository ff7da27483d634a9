#include "apps/commands/options.h"

#include <CLI/CLI.hpp>

namespace oro {
namespace {

// What of the world is modelled, and how exactly.
void add_model_options(CLI::App& command, ViewOptions& options) {
    command
        .add_option("--earth", options.earth,
                    "The Earth's figure: ellipsoid (WGS84, the default), sphere, or flat from the eye on")
        ->check(CLI::IsMember({"ellipsoid", "sphere", "flat"}));
    command.add_option("--refraction", options.refraction_k,
                       "Coefficient of refraction of the air, -1 to 0.9 (default 0; by day usually 0.13)");
    command
        .add_option(
            "--precision", options.precision,
            "relative: posts are placed relative to the eye (default); naive: in float32 ECEF, to see "
            "what that costs")
        ->check(CLI::IsMember({"relative", "naive"}));
    command
        .add_option("--geoid", options.geoid,
                    "What heights are above: egm96 (default), or none: the ellipsoid")
        ->check(CLI::IsMember({"egm96", "none"}));
    command
        .add_option("--heights", options.heights,
                    "Heights on the GPU: f32 (default), or i16: half the bytes, coarser steps")
        ->check(CLI::IsMember({"f32", "i16"}));
}

// The parser takes 010 for eight and 0x10 for sixteen, as C does.
std::string plain_whole_number(std::string& text) {
    const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
    if (text.size() == sign || text.find_first_not_of("0123456789", sign) != std::string::npos)
        return "'" + text + "' is no whole number in decimal digits";
    const std::size_t first = text.find_first_not_of('0', sign);
    text.erase(sign, (first == std::string::npos ? text.size() - 1 : first) - sign);
    return {};
}

}  // namespace

CLI::Option* only_decimal(CLI::Option* option) {
    return option->transform(CLI::Validator(plain_whole_number, ""));
}

void add_region_options(CLI::App& command, RegionOptions& options) {
    command.add_option("PATH", options.paths,
                       "Elevation data: files, folders, .zip, .gz; what GDAL opens and .hgt; or one .oro");
    CLI::Option* bbox = command.add_option(
        "--bbox", options.bbox, "Region as west,south,east,north in degrees; west > east crosses 180");
    command
        .add_option("--tile", options.tile, "Region as a cell N46E008 or a range of cells N46E006:N47E010")
        ->excludes(bbox);
    command.add_option("--height-unit", options.height_unit, "Unit of the heights, over what the files say")
        ->check(CLI::IsMember({"m", "ft", "us-ft", "cm"}));
    command.add_flag("--strict-datum", options.strict_datum,
                     "Refuse when a vertical datum cannot be honoured");
    command.add_flag("--fill-voids", options.fill_voids,
                     "Fill void posts from their neighbours instead of leaving holes");
}

void add_view_options(CLI::App& command, ViewOptions& options) {
    command.add_option(
        "--at", options.at,
        "The eye's place: 46.57,7.99 (lat,lon), DMS, UTM, MGRS, geohash, geo:46.57,7.99 or a cell N46E008");
    CLI::Option* above = command.add_option("--above", options.above_m,
                                            "The eye's height over the ground, metres (default 2)");
    command.add_option("--altitude", options.altitude_m, "The eye's height above sea level (H), metres")
        ->excludes(above);
    command.add_option("--heading", options.heading_deg, "Degrees clockwise from true north");
    command.add_option("--pitch", options.pitch_deg, "Degrees: 0 level, negative down");
    command.add_option("--roll", options.roll_deg, "Degrees: positive tilts the right side down");
    command.add_option("--fov", options.vertical_fov_deg, "Vertical field of view, degrees (default 45)");
    command.add_option("--look-at", options.look_at,
                       "Look at this place on the ground instead of along a heading and pitch");
    command.add_option("--size", options.size, "Picture size, WIDTHxHEIGHT pixels (default 1280x720)");
    command.add_option("--sun", options.sun,
                       "Light from azimuth,elevation in degrees (default: the style's)");
    command.add_option("--exaggeration", options.exaggeration, "Heights times this (default 1)");
    only_decimal(command.add_option("--samples", options.samples,
                                    "Samples per pixel, 1 to 64, for smooth edges (default 1)"));
    command.add_option("--style", options.style,
                       "Style: a name in data/styles or a .json file (default: default)");
    command
        .add_option(
            "--pipeline", options.pipeline,
            "How triangles are drawn: mesh shaders, compute, or auto (default: the faster, measured once)")
        ->check(CLI::IsMember({"auto", "mesh", "compute"}));
    command.add_option(
        "--tau", options.tau_px,
        "Largest error of what is drawn, pixels (default 1, in a window 0.5; 0: every post that there is)");
    add_model_options(command, options);
    command
        .add_option("--accuracy", options.accuracy,
                    "A bundle of --tau, --heights and --refraction; single ones win over it")
        ->check(CLI::IsMember({"draft", "balanced", "survey"}));
    command.add_option("--tolerance", options.tolerance,
                       "Largest error on the picture, e.g. 1px: takes the cheapest bundle that holds it");
    command.add_option("--time", options.time,
                       "The picture's time, e.g. 2026-11-21T09:00:00Z (default: now)");
}

void add_no_paths(CLI::App& command, bool& no_paths) {
    command.add_flag(
        "--no-paths", no_paths,
        "Leave the paths of data and style out of the picture; --view then needs the data named");
}

void add_memory_options(CLI::App& command, MemoryOptions& options) {
    only_decimal(command.add_option(
                     "--gpu-memory", options.gpu_memory_mb,
                     "Megabytes of terrain on the GPU at most (default: half of its memory, at most 2 GiB)"))
        ->check(CLI::Range(16, 1000000));
    only_decimal(
        command.add_option(
            "--memory", options.memory_mb,
            "Megabytes of terrain on its way to the GPU at most (default 64); a baked region needs no more, "
            "tiles are held in memory besides"))
        ->check(CLI::Range(16, 1000000));
}

}  // namespace oro
