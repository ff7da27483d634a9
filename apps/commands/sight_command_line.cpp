#include "apps/commands/sight_command_line.h"

#include <CLI/CLI.hpp>
#include <string>

#include "apps/command_line/help.h"
#include "apps/command_line/option_group.h"
#include "apps/commands/options.h"
#include "apps/view/view_option_table.h"

namespace oro {
namespace {

// What grows on the ground of commands without a picture.
void add_canopy(OptionGroup& group, ViewOptions& options) {
    group
        .option(
            "--canopy", options.canopy, "FILE",
            "Let what grows on the ground hide, as a closed surface: a raster of canopy heights in metres, "
            "in any CRS, or several; or class: heights of the classes of --landcover, which are invented. "
            "Heights are counted from the ground.")
        .allow_extra_args(false);
    group.number(
        "--canopy-held", options.canopy_held, "SHARE",
        "How much of the canopy's height the elevation data hold already, 0 to 1 (default 0.5 of SRTM, "
        "else 0): so much is not added. Needs --canopy.");
}

void add_realisations(OptionGroup& group, const char* what_n_does, const char* what_a_seed_gives,
                      RealisationOptions& options) {
    group.whole_number("--realisations", options.count, 2, 10000, "N", what_n_does);
    group.number(
        "--accuracy", options.le90_m, "METRES",
        "For --realisations: 90 % of the heights are off by at most this. Default: 16 of SRTM tiles; "
        "else it must be given.");
    group.number("--correlation", options.correlation_m, "METRES",
                 "For --realisations: over this distance the correlation of errors falls to 0.37. Default: "
                 "two posts.");
    group.whole_number(
        "--seed", options.seed, 0, 1000000, "N",
        std::string("For --realisations: which simulations. ") + what_a_seed_gives + " Default: 1.");
    group.whole_number("--finer", options.finer, 1, 4, "N",
                       "For --realisations: N posts in place of one each way, 1 to 4, so that the ground "
                       "between posts is simulated, too. Takes N x N times as long. Default: 1.");
}

}  // namespace

void add_sight(CLI::App& app, SightOptions& options, RealisationOptions& realisations) {
    CLI::App& command =
        *app.add_subcommand("sight", "Tell whether one place is seen from another, and by how many metres");
    OptionGroup line(command, "The line");
    line.option(
        "--from", options.from, "PLACE",
        "Where the eye is: latitude,longitude as in 46.57,7.99, or in another way that shot takes; or a "
        "name of --names.");
    line.option("--to", options.to, "PLACE", "What is looked at, as --from.");
    CLI::Option& above = line.number("--above", options.above_m, "METRES",
                                     "Height of the eye over the ground at --from (default 2). Not with "
                                     "--altitude.");
    line.number("--altitude", options.altitude_m, "METRES",
                "Height of the eye above sea level instead. Not with --above.")
        .excludes(&above);
    line.flag("--on-summit", options.on_summit, on_summit_sentence("the eye stands", "--from"));
    line.flag("--target-on-summit", options.target_on_summit,
              "Look at the highest post at most two posts from --to. How far that is, is told.");
    add_names_of_places(command, "The line", options.view.names, "--to Eiger");
    line.choice("--stand-on", options.view.stand_on, {"ground", "top"}, stand_on_sentence);
    line.number("--target", options.target_m, "METRES",
                "Height of what is looked at over the ground at --to (default 0: the ground itself).");
    line.option("--landcover", options.view.landcover, "FILE",
                "Name the land cover at both ends and at the obstacle: as shot --landcover.")
        .allow_extra_args(false);
    add_canopy(line, options.view);
    add_realisations(line,
                     "Tell how probable it is that the target is seen, by N simulations of the ground as it "
                     "may truly be where heights have errors, 2 to 10000.",
                     "The same seed gives the same answer.", realisations);
    add_region_options(command, options.region);
    add_air_options(command, options.view);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"sight PATH... --from PLACE --to PLACE [OPTIONS]"},
                       "The Earth's curvature always counts. Hidden is an answer, too: the exit code is 0.",
                       "docs/commands/sight.md"});
    list_first(command, {"--refraction"});
}

void add_profile(CLI::App& app, ProfileOptions& options) {
    CLI::App& command =
        *app.add_subcommand("profile", "Tell how high the ground is along a line, as text, table or drawing");
    OptionGroup line(command, "The line");
    line.option(
        "--along", options.along, "LINE",
        "A file with a line (GPX, KML, GeoJSON, GeoPackage, shapefile ...); or two places or more with ; "
        "between them, as in \"46.57,7.99; 46.62,8.05\". From place to place it is the shortest way.");
    add_names_of_places(command, "The line", options.names, "--along \"Eiger; Bern\"");
    line.whole_number("--line", options.line, 1, 1000000000, "N",
                      "Which line of a file that has several, from 1. Default: the only one.");
    line.number("--step", options.step_m, "METRES",
                "Ask for heights so far apart. Default: wherever the line passes from one triangle of the "
                "ground to the next: between those the ground is straight.");
    line.number("--climb-threshold", options.climb_threshold_m, "METRES",
                "Rises and falls of so many metres or more make the ascent and the descent, as guides count "
                "them, 0 to 10000 (default 10). The sum of every one is told beside them.");
    line.option("--out", options.out, "FILE",
                "The file to write: .csv, .svg or .geojson. Without it the sums alone are told.");
    line.flag("--overwrite", options.overwrite, "Replace a file that is there.");
    add_region_options(command, options.region);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command,
             {{"profile PATH... --along LINE [--out FILE] [OPTIONS]"}, "", "docs/commands/profile.md"});
}

void add_viewshed(CLI::App& app, ViewshedOptions& options, RealisationOptions& realisations,
                  ObserversOptions& observers) {
    CLI::App& command =
        *app.add_subcommand("viewshed", "Write which places are seen from one or several others (GeoTIFF)");
    OptionGroup shed(command, "The viewshed");
    shed.option("--at", options.at, "PLACE",
                "Where the observer is: latitude,longitude as in 46.57,7.99, or in another way that shot "
                "takes; or a name of --names. Give it again for each further observer.")
        .allow_extra_args(false);  // what follows the place is elevation data
    add_names_of_places(command, "The viewshed", options.view.names, "--at Eiger");
    shed.option("--observers", observers.file, "FILE",
                "Observers of a table instead of --at, thousands of them: a .csv with columns lat and lon, "
                "and above (or height, agl, eye) where each has its height, in metres above the ground; or "
                "the points of a vector file.")
        .allow_extra_args(false);
    shed.option("--table", observers.table, "FILE",
                "Write how many posts each of the --observers sees, a line each (.csv).")
        .allow_extra_args(false);
    CLI::Option& above = shed.number("--above", options.above_m, "METRES",
                                     "Height of observers over the ground (default 2). Not with --altitude.");
    shed.number("--altitude", options.altitude_m, "METRES",
                "Height of observers above sea level instead. Not with --above.")
        .excludes(&above);
    shed.flag("--on-summit", options.on_summit, on_summit_sentence("each observer stands", "its --at"));
    shed.choice("--stand-on", options.view.stand_on, {"ground", "top"}, stand_on_sentence);
    shed.number("--target", options.target_m, "METRES",
                "Height of what is looked at over the ground of each post (default 0: the ground itself).");
    shed.option("--landcover", options.view.landcover, "FILE",
                "Land cover for --canopy class: as shot --landcover.")
        .allow_extra_args(false);
    add_canopy(shed, options.view);
    shed.choice(
        "--target-on", options.target_on, {"ground", "canopy", "top"},
        "What targets stand on: the ground, under trees too; the top of the canopy, which needs --canopy; or "
        "the top of meshes, roofs, which needs --mesh-file (default ground).");
    shed.number("--radius", options.radius_km, "KM", "How far to look, 0.01 to 1000 (default 20).");
    add_realisations(shed,
                     "Write a further band: how probable it is that a post is seen, by N simulations of the "
                     "ground as it may truly be where heights have errors, 2 to 10000.",
                     "The same seed gives the same file.", realisations);
    shed.option("--out", options.out, "FILE", "The GeoTIFF to write (.tif).");
    shed.flag("--overwrite", options.overwrite, "Replace a file that is there.");
    add_region_options(command, options.region);
    add_air_options(command, options.view);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"viewshed PATH... --at PLACE --out FILE.tif [OPTIONS]"},
                       "The Earth's curvature always counts.",
                       "docs/commands/viewshed.md"});
}

void add_horizon(CLI::App& app, HorizonOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "horizon", "Tell how high the horizon stands around a place, or write it of each point (GeoTIFFs)");
    OptionGroup horizon(command, "The horizon");
    horizon.option(
        "--at", options.at, "PLACE",
        "Print the horizon around this place alone, in each azimuth how high it stands and where it "
        "is: latitude,longitude as in 46.57,7.99, or in another way that shot takes; or a name of "
        "--names.");
    add_names_of_places(command, "The horizon", options.view.names, "--at Eiger");
    horizon.whole_number("--directions", options.directions, 3, 720, "N",
                         "Azimuths to look in, evenly spaced from north clockwise, 3 to 720 (default 36).");
    horizon.number("--radius", options.radius_km, "KM",
                   "How far to look, 0.01 to 500 (default 50). With --bbox data are read as far around it.");
    CLI::Option& above =
        horizon.number("--above", options.above_m, "METRES",
                       "Height of eyes over the ground of each post (default 0: on the ground), or at --at "
                       "(default 2). Not with --altitude.");
    horizon
        .number("--altitude", options.altitude_m, "METRES",
                "Height of the eye above sea level instead. Needs --at. Not with --above.")
        .excludes(&above);
    horizon.flag("--on-summit", options.on_summit, on_summit_sentence("the eye stands", "--at"));
    horizon.option(
        "--out", options.out, "FILE",
        "NAME.tif: NAME.horizon.tif and NAME.sky-view.tif are written. With --at a table, NAME.csv; "
        "it may be left out.");
    horizon.flag("--overwrite", options.overwrite, "Replace files that are there.");
    add_region_options(command, options.region);
    add_air_options(command, options.view);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"horizon PATH... --out FILE.tif [OPTIONS]", "horizon PATH... --at PLACE [OPTIONS]"},
                       "The Earth's curvature always counts.",
                       "docs/commands/horizon.md"});
}

}  // namespace oro
