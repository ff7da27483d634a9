#include "apps/commands/command_line.h"

#include <CLI/CLI.hpp>

#include "apps/command_line/described_command.h"
#include "apps/command_line/help.h"
#include "apps/command_line/option_group.h"
#include "apps/commands/fetching.h"
#include "apps/commands/options.h"
#include "apps/commands/sight_command_line.h"
#include "apps/completion/completion.h"
#include "apps/view/view_option_table.h"

namespace oro {
namespace {

constexpr const char* hidden = "";
constexpr const char* draw_view =
    "Take data, eye and settings from a picture that orograph wrote, or from its view in a .json file. "
    "Looks, detail and --size may be changed; the eye and the part of the data may not.";

// of_map: what the same is of a map, where the command draws maps.
void add_kml(OptionGroup& group, bool& kml, const std::string& of_map = "") {
    group.flag("--kml", kml,
               "Write NAME.kml beside each picture: a PhotoOverlay, which shows it in its place in Google "
               "Earth and others" +
                   of_map + ".");
}

void add_geopose(OptionGroup& group, bool& geopose, const std::string& of_map = "") {
    group.flag("--geopose", geopose,
               "Write NAME.geopose.json beside each picture: the eye's place and direction" + of_map +
                   " as an OGC GeoPose.");
}

void add_stac(OptionGroup& group, bool& stac) {
    group.flag(
        "--stac", stac,
        "Write NAME.stac.json beside each picture: a STAC item, by which catalogues of images find it.");
}

void add_shot(CLI::App& app, ShotOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "shot", "Write a picture of terrain that tells where it was taken from and can be drawn again");
    OptionGroup picture(command, "The picture");
    picture.option("--out", options.out, "FILE",
                   "The picture to write: .png, .jpg or .tif. With --view it may be left out: then the "
                   "picture is drawn again and compared with the file.");
    picture
        .option(
            "--view", options.view_files, "FILE",
            std::string(draw_view) +
                " Several views (give it again, or a list in a .json) are drawn one after the other; --out "
                "numbers them: view-%04d.png.")
        .allow_extra_args(false);
    add_time(command, "The picture", options.view);
    picture.flag("--verify", options.verify,
                 "Measure how far the picture is from full detail, in metres and pixels, and write "
                 "NAME.error.png beside it.");
    picture.flag("--layers", options.layers,
                 "Write what each pixel shows as TIFFs beside the picture: NAME.longitude.tif and latitude, "
                 "height (above sea level), ellipsoidal-height, distance, slope, source and shadow.");
    add_kml(picture, options.kml, "; of a map a GroundOverlay");
    add_geopose(picture, options.geopose, " (of a map its middle and its axes)");
    add_stac(picture, options.stac);
    picture.flag(
        "--ortho", options.ortho,
        "Draw a map from straight above instead, of all the data or of --bbox: a GeoTIFF with opacity "
        "(or .png, .jpg), and a world file beside it.");
    picture.option(
        "--crs", options.crs, "CRS",
        "The map's coordinate reference system, as GDAL takes it: EPSG:2056. Default: UTM on WGS84. "
        "Needs --ortho.");
    picture.number("--resolution", options.resolution, "UNITS",
                   "A side of the map's pixels in the unit of its CRS: metres of UTM, degrees of EPSG:4326. "
                   "Default: about the data's. Not with --size. Needs --ortho.");
    CLI::Option& legend = picture.flag(
        "--legend", options.view.legend,
        "Add a strip below the picture: north, scale, colours, eye, sun and where the data come from. "
        "Pictures of --show have it by themselves.");
    picture.flag("--no-legend", options.no_legend, "Leave this strip out. Not with --legend.")
        .excludes(&legend);
    add_unseen_ceiling(command, "The picture", options.unseen_ceiling_m);
    add_no_paths(command, "The picture", options.no_paths);
    add_data_changed(command, options.data_changed);
    picture.flag("--overwrite", options.overwrite, "Replace files that are there.");
    add_region_options(command, options.region);
    add_view_options(command, options.view);
    add_memory_options(command, options.memory);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "errors, and the table of --verify");
    set_help(command, {{"shot PATH... --out FILE [OPTIONS]", "shot --view PICTURE [--out FILE] [OPTIONS]"},
                       "",
                       "docs/commands/shot.md"});
    list_later(command,
               {"--time", "--layers", "--kml", "--geopose", "--stac", "--ortho", "--crs", "--resolution",
                "--legend", "--no-legend", "--unseen-ceiling", "--no-paths", "--data-changed"});
}

void add_panorama(CLI::App& app, PanoramaOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "panorama", "Write a picture all around a place, with rulers and the names of what is seen");
    OptionGroup picture(command, "The picture");
    picture.option("--out", options.out, "FILE",
                   "The file to write: .png, .jpg, .tif, or .svg, in which names and figures are text.");
    picture.option(
        "--sector", options.sector, "FROM,TO",
        "Show these azimuths alone, in degrees clockwise from north: 300,60 is from the north-west "
        "to the north-east. Default: all around, from north to north.");
    picture.option("--elevation", options.elevation, "LOW,HIGH",
                   "Show these angles above level, in degrees, -75 to 75. Default: from 10 degrees below the "
                   "skyline's lowest place to some sky above its highest.");
    picture.whole_number(
        "--width", options.width_px, 100, 50000, "PIXELS",
        "Width of the picture, 100 to 50000 (default 20 for each degree). Its height follows.");
    picture.choice("--ridges", options.ridges, {"on", "off"},
                   "Draw lines where nearer ground ends before farther ground or the sky (default on).");
    picture.option(
        "--view", options.view_file, "FILE",
        "Take data, eye and settings from a panorama that orograph wrote. Looks, detail and --width "
        "may be changed.");
    add_time(command, "The picture", options.view);
    add_kml(picture, options.kml);
    add_geopose(picture, options.geopose);
    add_stac(picture, options.stac);
    add_no_paths(command, "The picture", options.no_paths);
    add_data_changed(command, options.data_changed);
    picture.flag("--overwrite", options.overwrite, "Replace a file that is there.");
    add_region_options(command, options.region);
    add_view_options(command, options.view);
    command.get_option("--at")->description(
        "Where the eye is: latitude,longitude as in 46.57,7.99, or in another way that shot takes; or a name "
        "of --names.");
    command.get_option("--above")->description(
        "Height of the eye over the ground there (default 2). Needs --at. Not with --altitude.");
    describe_standard_air(command);
    hide(command, {"--heading", "--pitch", "--roll", "--look-at", "--fov", "--size", "--labels", "--show",
                   "--graticule", "--tolerance"});
    add_memory_options(command, options.memory);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "errors");
    set_help(command, {{"panorama PATH... --at PLACE --out FILE [OPTIONS]",
                        "panorama --view PICTURE --out FILE [OPTIONS]"},
                       "The Earth's curvature always counts.",
                       "docs/commands/panorama.md"});
    list_later(command,
               {"--ridges", "--time", "--kml", "--geopose", "--stac", "--no-paths", "--data-changed"});
}

// How a camera follows a track.
void add_track_options(CLI::App& command, FilmOptions& options) {
    OptionGroup track(command, "Along a track");
    track.number("--above", options.above_m, "METRES",
                 "Height of the eye over the ground, 1 to 1000000 (default 150).");
    track.option("--look-ahead", options.look_ahead, "DISTANCE",
                 "Look at the ground of the track so far ahead: metres, or seconds of the film as in 10s "
                 "(default 500).");
    track.number("--smoothing", options.smoothing_m, "METRES",
                 "Even the track out: each place is the mean of so much of it, 0 to 100000 (default 200).");
    CLI::Option& duration = track.number("--duration", options.duration_s, "SECONDS",
                                         "How long the film lasts, 0.1 to 1000000 (default 60).");
    track
        .number("--speed", options.speed_m_s, "METRES",
                "Metres of the track in each second instead. Not with --duration.")
        .excludes(&duration);
    track.whole_number("--line", options.line, 1, 1000000000, "N",
                       "Which track of a file that has several, from 1. Default: the only one.");
}

void add_film(CLI::App& app, FilmOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "film",
        "Write the pictures of a camera's flight, numbered or as a movie, and go on where it stopped");
    OptionGroup film(command, "The film");
    film.option("FLIGHT", options.path, "",
                "The camera's path: keys in a .json file, a tour of a .kml file, or a track of a vector "
                "file (GPX, KML, GeoJSON, GeoPackage, shapefile ...).")
        .required();
    film.option("--out", options.out, "FOLDER",
                "Write frame-000001.png and so on into this folder; or an .mp4 file, with ffmpeg. Frames of "
                "the same film that are there already stay.");
    film.number("--fps", options.fps, "N", "Frames in each second of the film, 0.01 to 1000 (default 25).");
    film.option("--frames", options.frames, "RANGE", "Draw these frames alone, FIRST:LAST as in 121:240.");
    film.option(
        "--shard", options.shard, "PART",
        "Draw a part of the frames, NUMBER/COUNT: 2/4 draws the second of each four. Several machines "
        "then draw a film together.");
    film.choice("--format", options.format, {"png", "jpg", "tif"}, "The format of frames (default png).");
    film.option("--write-path", options.write_path, "FILE",
                "Write the camera's path as keys into this .json file. Without --out nothing is drawn.");
    add_time(command, "The film", options.view);
    add_kml(film, options.kml);
    add_geopose(film, options.geopose);
    add_stac(film, options.stac);
    film.flag("--legend", options.view.legend,
              "Add a strip below each frame: north, scale, colours, eye, sun and where the data come from.");
    film.flag("--no-legend", options.no_legend, "Leave out the strip that films of --show have.")
        .excludes(command.get_option("--legend"));
    add_no_paths(command, "The film", options.no_paths);
    film.flag("--overwrite", options.overwrite, "Replace files that are there.");
    add_track_options(command, options);
    add_region_options(command, options.region);
    add_film_view_options(command, options.view);
    hide(command, {"--tolerance"});
    add_memory_options(command, options.memory);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "errors");
    set_help(command,
             {{"film FLIGHT PATH... --out FOLDER [OPTIONS]", "film FLIGHT PATH... --out FILE.mp4 [OPTIONS]"},
              "A film that was stopped goes on when the same command is given again.",
              "docs/commands/film.md"});
    list_later(command, {"--format", "--line", "--time", "--kml", "--geopose", "--stac", "--legend",
                         "--no-legend", "--no-paths"});
}

void add_compare(CLI::App& app, CompareOptions& options) {
    CLI::App& command =
        *app.add_subcommand("compare", "Measure how far a picture is from full detail, in metres and pixels");
    OptionGroup picture(command, "The picture");
    picture
        .option("PICTURE", options.view_file, "",
                "A picture that orograph wrote, or its view in a .json file. It is drawn again, and stays as "
                "it is.")
        .required();
    picture.option("--out", options.out, "FILE",
                   "Write a picture of the errors, a .png. Without it they are told in figures only.");
    add_unseen_ceiling(command, "The picture", options.unseen_ceiling_m);
    add_data_changed(command, options.data_changed);
    picture.flag("--overwrite", options.overwrite, "Replace a file that is there.");
    add_region_options(command, options.region);
    command.get_option("PATH")->description("The picture's elevation data, where they have moved.");
    hide_region_options(command);
    add_memory_options(command, options.memory);
    list_first(command, {"--gpu-memory", "--memory"});
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the table and errors");
    set_help(command, {{"compare PICTURE [PATH...] [OPTIONS]"}, "", "docs/commands/compare.md"});
}

void add_view(CLI::App& app, WindowOptions& options) {
    CLI::App& command = *app.add_subcommand("view", "Fly over terrain in a window");
    OptionGroup window(command, "The window");
    window.option(
        "--view", options.view_file, "FILE",
        "Begin with data, eye and settings of a picture that orograph wrote, or of its view in a .json file. "
        "Looks, detail and --size may be changed; the eye and the part of the data may not.");
    window
        .option(
            "--gazetteer", options.gazetteers, "FILE",
            "Find places by the names in this file, too: a dump of GeoNames, a table (CSV) with the columns "
            "name, lat and lon, or points of GeoJSON, GPX, KML, GeoPackage, a shapefile ... May be given "
            "several times.")
        .allow_extra_args(false);  // what follows the file is elevation data
    window.choice(
        "--gpu-pages", options.gpu_pages, {"on", "off"},
        "Let the GPU choose the pages of terrain while the eye moves, where nothing is drawn but "
        "ground without shadows and images. The picture is the same. It is quicker where the processor "
        "takes longer than the GPU (default: off).");
    add_no_paths(command, "The window", options.no_paths);
    add_kml(window, options.kml);
    add_geopose(window, options.geopose);
    add_stac(window, options.stac);
    add_region_options(command, options.region);
    add_view_options(command, options.view);
    command.get_option("--size")->description("Size of the window in pixels (default 1280x720).");
    add_time(command, hidden, options.view);
    hide(command, {"--tolerance"});
    add_memory_options(command, options.memory);
    add_quiet(command, options.quiet, "errors");
    set_help(
        command,
        {{"view PATH... [OPTIONS]", "view --view PICTURE [OPTIONS]"},
         "Drag takes hold of the ground, the wheel goes nearer, a right drag goes round a place; W A S D "
         "move, E and Q go up and down. A right click tells what is there, in the window and on standard "
         "output. G goes to a place that you type. P writes a picture into the working folder. ? shows "
         "all keys, Ctrl-Q leaves.",
         "docs/commands/view.md"});
    list_later(command, {"--gazetteer", "--gpu-pages", "--no-paths", "--kml", "--geopose", "--stac"});
}

void add_plan(CLI::App& app, PlanOptions& options) {
    CLI::App& command =
        *app.add_subcommand("plan", "Predict how far off a picture would be, and why, before it is drawn");
    OptionGroup view(command, "The picture");
    view.option("--view", options.view_file, "FILE", draw_view);
    add_unseen_ceiling(command, "The picture", options.unseen_ceiling_m);
    view.flag("--all", options.all,
              "List every effect, with its size, whether the view needs it, and what leaves it out. Without "
              "this: how good the picture is, and its three largest errors.");
    add_time(command, hidden, options.view);
    add_region_options(command, options.region);
    add_view_options(command, options.view);
    command.get_option("--tolerance")
        ->description(
            "How far off the picture may be, 0.001 to 1000, e.g. 1px (default 1px). Errors are judged by "
            "it.");
    hide_looks(command);
    hide(command, {"--samples", "--pipeline", "--mesh", "--mesh-level"});
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"plan PATH... [OPTIONS]", "plan --view PICTURE [OPTIONS]"},
                       "Nothing is drawn or written.",
                       "docs/commands/plan.md"});
    list_later(command, {"--unseen-ceiling"});
    list_first(command, {"--tau", "--tolerance"});
}

void add_trade(CLI::App& app, TradeOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "trade", "Measure what accuracy costs: draw pictures with many settings, compare time and error");
    OptionGroup report(command, "The report");
    report.option("--out", options.out, "FOLDER",
                  "Write trade.csv and trade.html into this folder. Default: the working folder.");
    report.whole_number("--views", options.views, 1, 1000, "N",
                        "Draw from so many places, 1 to 1000 (default 6): the first sees all the data, the "
                        "others are chosen at all heights. With --at or --view there is that one alone.");
    report.whole_number("--repeats", options.repeats, 1, 1000, "N",
                        "Draw each picture so many times, 1 to 1000 (default 3). The median time counts.");
    report.option("--view", options.view_file, "FILE", draw_view);
    add_time(command, "The report", options.view);
    report.flag("--overwrite", options.overwrite, "Replace files that are there.");
    add_region_options(command, options.region);
    add_view_options(command, options.view);
    command.get_option("--size")->description("Size of the pictures in pixels (default 640x360).");
    hide(command, {"--names",        "--names-field", "--overlay", "--overlay-colour", "--overlay-width",
                   "--overlay-fill", "--tau",         "--earth",   "--refraction",     "--air",
                   "--precision",    "--geoid",       "--heights", "--accuracy",       "--tolerance",
                   "--labels",       "--edges",       "--samples", "--show",           "--mesh",
                   "--mesh-level",   "--graticule",   "--detail"});
    add_memory_options(command, options.memory);
    add_quiet(command, options.quiet, "the table and errors");
    set_help(command,
             {{"trade PATH... [OPTIONS]", "trade --view PICTURE [OPTIONS]"},
              "The settings to compare are --tau, --earth, --refraction, --air, --precision, --geoid, "
              "--heights and --accuracy. trade sets them itself.",
              "docs/commands/trade.md"});
    list_later(command, {"--time"});
}

void add_sun(CLI::App& app, SunOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "sun", "Tell when the sun first and last shows at a place, over its terrain and a plain horizon");
    OptionGroup day(command, "The day");
    day.option("--date", options.date, "DATE", "The day, e.g. 2026-06-21 (default: today).");
    day.option(
        "--zone", options.zone, "ZONE",
        "Distance from UTC of the day and of the times that are told, e.g. +02:00. Default: the day is "
        "from midnight by the sun to midnight, the times are UTC.");
    add_region_options(command, options.region);
    command.get_option("PATH")->description(
        "Files or folders of elevation data, as of shot. Without any: over a plain horizon alone.");
    add_some_view_options(command, options.view, {"--at", "--above", "--altitude", "--on-summit"});
    add_names_of_places(command, "The eye", options.view.names, "--at Eiger");
    command.get_option("--at")->description(
        "The place: latitude,longitude as in 46.57,7.99, or in another way that shot takes; or a name of "
        "--names.");
    command.get_option("--above")->description(
        "Height of the eye over the ground there (default 2). Needs elevation data. Not with --altitude.");
    command.get_option("--altitude")
        ->description("Height of the eye above sea level instead. Needs elevation data. Not with --above.");
    add_air_options(command, options.view);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"sun --at PLACE [PATH...] [OPTIONS]"}, "", "docs/commands/sun.md"});
    list_first(command, {"--altitude", "--on-summit"});
}

void add_bake(CLI::App& app, BakePartOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "bake", "Write elevation data into one file (.oro) that opens at once, however large it is");
    OptionGroup file(command, "The file");
    file.option("--out", options.out, "FILE", "The .oro file to write.");
    file.choice("--mesh", options.mesh, {"grid", "clusters"},
                "What is drawn of it: blocks of the grid (default), or clusters beside them, which take some "
                "seconds a tile to build, and a fraction of the triangles.");
    CLI::Option& shard = file.option("--shard", options.shard, "PART",
                                     "Do a part of what takes long, NUMBER/COUNT as in 2/4, and write it "
                                     "beside the file: FILE.oro.part-2of4. "
                                     "Several machines then bake a region together.");
    file.flag("--join", options.join,
              "Bake from the parts that --shard has written, all of them. The file has the bytes of one that "
              "one "
              "machine bakes. Not with --shard.")
        .excludes(&shard);
    file.flag("--overwrite", options.overwrite, "Replace a file that is there.");
    add_region_options(command, options.region);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "errors");
    set_help(command, {{"bake PATH... --out FILE.oro [OPTIONS]"},
                       "When a bake is stopped half-way, FILE.oro.partial and FILE.oro.partial-stitched "
                       "stay. Give the same command again: it goes on from there and removes them.",
                       "docs/commands/bake.md"});
}

void add_layers(OptionGroup& written, ExportOptions& options) {
    written.choice("--layer", options.layer, {"H", "slope", "canopy"},
                   "What the GeoTIFF has at each sample: heights above sea level (default), the slope of the "
                   "ground in degrees by Horn's formula, or the heights of --canopy. Needs cog.");
    written
        .option("--canopy", options.canopy, "FILE",
                "What --layer canopy takes: rasters of canopy heights in metres, or class: heights of the "
                "classes of --landcover, which are invented.")
        .allow_extra_args(false);
}

void add_export(CLI::App& app, ExportOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "export", "Write the ground in formats of others: GeoTIFF, 3D Tiles, tiles for maps and globes");
    OptionGroup written(command, "The export");
    written.choice("--to", options.to, {"cog", "terrain-rgb", "3dtiles", "quantized-mesh", "gltf"},
                   "The format: a Cloud Optimized GeoTIFF of the data's own samples, PNG tiles for web maps "
                   "whose colours are heights, 3D Tiles with levels whose error is proven, tiles of terrain "
                   "for globes, or one glTF model.");
    written.option("--out", options.out, "PATH",
                   "What to write: a file of cog (.tif) or gltf (.glb), a folder of the others.");
    add_layers(written, options);
    written.option("--zoom", options.zoom, "RANGE",
                   "Write these zooms of a web map, LOW:HIGH of 0 to 22, as in 5:12, or of a globe, 0:HIGH. "
                   "Default: up to the "
                   "one whose pixels or quads are as close as the data, of a web map from the one that shows "
                   "all the data in a "
                   "tile. Needs terrain-rgb or quantized-mesh.");
    written.number(
        "--hole-height", options.hole_height_m, "METRES",
        "Height of places without ground, -10000 to 10000 (default 0). Needs terrain-rgb or quantized-mesh.");
    written.number(
        "--max-error", options.max_error_m, "METRES",
        "How far a model, or the finest 3D Tiles, may be from the ground, 0 to 100000: the larger, "
        "the fewer triangles. Default: 0 (every sample) of a model, a fifth of the way between "
        "samples of 3D Tiles. Needs gltf or 3dtiles.");
    written
        .option(
            "--drape", options.drape, "FILE",
            "Colour 3D Tiles or a model by an image with a CRS: an orthophoto, a satellite scene or a map. "
            "Several lie one over the other, the last on top. Needs gltf or 3dtiles.")
        .allow_extra_args(false);
    written
        .option("--landcover", options.landcover, "FILE",
                "Colour 3D Tiles or a model by land cover: a raster of classes, as in shot --landcover. Also "
                "for --canopy class.")
        .allow_extra_args(false);
    written.option("--shard", options.shard, "PART",
                   "Make a part of the tiles, NUMBER/COUNT as in 2/4, and keep it in FOLDER.tiles. Without "
                   "it the tiles that are there are taken, and those that are missing are made.");
    written.flag(
        "--no-normals", options.no_normals,
        "Leave normals out of 3D Tiles, a fifth of their size, where the viewer's shader makes its own.");
    written.whole_number(
        "--detail", options.detail, 1, most_halvings, "N",
        "Invent ground between the posts, by N halvings of the way from post to post, 1 to 6, "
        "as shot --detail does: 2^N posts in place of one each way. Needs cog.");
    written.flag("--overwrite", options.overwrite,
                 "Replace a file that is there, or a folder that holds such tiles and nothing else.");
    add_region_options(command, options.region);
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"export PATH... --to cog --out FILE.tif [OPTIONS]",
                        "export PATH... --to terrain-rgb --out FOLDER [OPTIONS]",
                        "export PATH... --to 3dtiles --out FOLDER [OPTIONS]",
                        "export PATH... --to quantized-mesh --out FOLDER [OPTIONS]",
                        "export PATH... --to gltf --out FILE.glb [OPTIONS]"},
                       "",
                       "docs/commands/export.md"});
}

void add_batch(CLI::App& app, BatchOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "batch", "Run the commands of a list, and go on where it stopped; several machines may share it");
    OptionGroup list(command, "The list");
    list.option("JOBS", options.jobs, "",
                "A file with a JSON object on each line: {\"command\": \"shot\", \"path\": \"alps\", \"at\": "
                "\"46.57,7.99\", \"out\": \"a.png\"}. Names are those of the command's options.")
        .required();
    list.option(
        "--each", options.each, "FILE",
        "Do each line for each place of this file: a table (.csv) whose first line names its fields, or "
        "points of GPX, KML, GeoJSON or GeoPackage. {name} in a line is the place's name, and so is each "
        "field; {lat}, {lon} and {number} are there, too.");
    list.option(
        "--shard", options.shard, "PART",
        "Do a part of the list, NUMBER/COUNT: 2/4 does the second of each four lines. Several machines "
        "then do a list together.");
    list.option("--log", options.log, "FILE",
                "Keep the record of what is done in this file. Default: JOBS.done, beside the list.");
    list.flag("--check", options.check, "Look at each line, tell what is to be done, and do nothing.");
    list.flag("--overwrite", options.overwrite, "Replace files that are there, and are not of the same job.");
    add_json(command, options.json);
    add_quiet(command, options.quiet, "what the commands print, and errors");
    set_help(command,
             {{"batch JOBS [OPTIONS]"},
              "A line that fails is told, and the rest is done. What is done already is not done again.",
              "docs/commands/batch.md"});
}

void add_serve(CLI::App& app, ServeOptions& options) {
    CLI::App& command = *app.add_subcommand("serve", "Serve a folder to browsers on this machine, read-only");
    OptionGroup served(command, "The folder");
    served.option("FOLDER", options.folder, "", "The folder to serve, with all in it.").required();
    served.whole_number("--port", options.port, 0, 65535, "PORT",
                        "Listen at this port, 0 to 65535 (default 8080). 0 is any that is free.");
    served.option("--host", options.host, "ADDRESS",
                  "Listen at this address of the machine (default 127.0.0.1: nobody else reaches it). "
                  "0.0.0.0 is all of them: then everybody in the network can read the folder.");
    served.flag("--cors", options.any_origin, "Let pages of other sites read what is served.");
    add_quiet(command, options.quiet, "the address and errors");
    set_help(command, {{"serve FOLDER [OPTIONS]"}, "", "docs/commands/serve.md"});
}

void add_info(CLI::App& app, InfoOptions& options) {
    CLI::App& command =
        *app.add_subcommand("info", "Tell what elevation data are, what they cover and what is missing");
    add_region_options(command, options.region);
    OptionGroup(command, "Elevation data")
        .flag("--check", options.check,
              "Read all of a .oro file, and name the first damaged byte, or what it says of itself that its "
              "heights are not. Other files are always read whole.");
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"info PATH... [OPTIONS]"}, "", "docs/commands/info.md"});
}

void add_fetch(CLI::App& app, FetchOptions& options) {
    CLI::App& command =
        *app.add_subcommand("fetch", "Get elevation, land cover and names of peaks from public servers");
    OptionGroup data(command, "The data");
    data.option(
        "--source", options.source, "NAME",
        "Where to get them: skadi, glo30, glo90, terrarium, opentopography (heights), worldcover (land "
        "cover), canopy, peaks, passes, settlements (names), or one of your own table.");
    data.option("--tile", options.tiles, "CELL",
                "A whole-degree cell by its south-west corner, e.g. N46E008, or all from one to another: "
                "N46E006:N47E010. Give it again for each further one.")
        .allow_extra_args(false);
    data.option("--bbox", options.bbox, "WEST,SOUTH,EAST,NORTH",
                "All tiles that a box in degrees touches, e.g. 7.5,46.2,8.5,46.9.");
    data.option(
        "--out", options.out, "FOLDER",
        "The folder to write tiles into; it is made if need be. Of names, the GeoJSON file to write.");
    data.option("--sources", options.sources_file, "FILE",
                "A table of further sources. Those of the same name replace the program's.");
    data.option("--key-file", options.key_file, "FILE",
                "The file that holds your key, for a source that needs one, and that you alone may read. "
                "Without this the key is taken from the environment or from your folder of settings.");
    data.flag("--overwrite", options.overwrite, "Replace a file of names that exists.");
    data.flag("--cache", options.cache,
              "Fetch nothing: tell which tiles --fetch of other commands has put into your cache, and remove "
              "those used longest ago beyond its limit.");
    data.number("--cache-limit", options.cache_limit_gb, "GB",
                "The cache's limit in this run (default 20, or what your table of sources says).");
    data.flag("--dry-run", options.dry_run, "Ask no server: tell what is wanted, and what is there.");
    data.whole_number("--retries", options.retries, 0, 20, "N",
                      "Further requests of a tile whose server is busy or silent (default 4). Between them "
                      "is ever more time, or as much as the server asks for, 60 s at most.");
    data.whole_number("--jobs", options.jobs, 1, 16, "N", "Requests at a time (default 4).");
    add_json(command, options.json);
    add_quiet(command, options.quiet, "the result and errors");
    set_help(command, {{"fetch --source NAME --tile CELL --out FOLDER [OPTIONS]",
                        "fetch --source NAME --bbox WEST,SOUTH,EAST,NORTH --out FOLDER [OPTIONS]",
                        "fetch --cache [OPTIONS]"},
                       "What is there and whole is kept. A tile that was broken off is gone on with.",
                       "docs/commands/fetch.md"});
}

void add_doctor(CLI::App& app, DoctorOptions& options) {
    CLI::App& command =
        *app.add_subcommand("doctor", "Tell what this machine can draw, what it lacks and what helps");
    add_json(command, options.json);
    set_help(command, {{"doctor [OPTIONS]"}, "", "docs/commands/doctor.md"});
}

void add_completion(CLI::App& app, CompletionOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "completion", "Print the script by which a shell completes the words of commands");
    OptionGroup(command, "The shell")
        .choice("SHELL", options.shell, completion_shells(), "bash, zsh or fish.")
        .option_text("")
        ->required();
    hide_command(command);
    set_help(command,
             {{"completion SHELL"},
              "An installation has these scripts where the shells look for them. For a program that was "
              "not installed: source <(orograph completion bash), or orograph completion fish | source.",
              "docs/commands/completion.md"});
}

// The last one: its argument is the name of another.
void add_manual(CLI::App& app, ManualOptions& options) {
    std::vector<std::string> names;
    for (const DescribedCommand& command : described_commands(app))
        if (command.is_listed) names.push_back(command.name);
    CLI::App& command = *app.add_subcommand("manual", "Print a page of the manual, as man(1) reads it");
    OptionGroup(command, "The page")
        .choice("COMMAND", options.command, names, "The command. Without it the page is that of the program.")
        .option_text("");
    hide_command(command);
    set_help(command, {{"manual [COMMAND]"},
                       "An installation has these pages where man(1) looks for them.",
                       "docs/commands/completion.md"});
}

}  // namespace

void add_commands(CLI::App& app, CommandLine& line) {
    set_program_help(app);
    add_shot(app, line.shot);
    add_panorama(app, line.panorama);
    add_film(app, line.film);
    add_view(app, line.view);
    add_compare(app, line.compare);
    add_plan(app, line.plan);
    add_trade(app, line.trade);
    add_sun(app, line.sun);
    add_sight(app, line.sight, line.realisations);
    add_profile(app, line.profile);
    add_viewshed(app, line.viewshed, line.realisations, line.observers);
    add_horizon(app, line.horizon);
    add_bake(app, line.bake);
    add_export(app, line.exporting);
    add_batch(app, line.batch);
    add_serve(app, line.serve);
    add_info(app, line.info);
    add_fetch(app, line.fetch);
    add_fetching(app, line.fetching);
    add_doctor(app, line.doctor);
    add_completion(app, line.completion);
    add_manual(app, line.manual);
}

}  // namespace oro
