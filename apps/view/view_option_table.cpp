#include "apps/view/view_option_table.h"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>

#include "apps/report/json_fields.h"
#include "apps/view/accuracy.h"
#include "apps/view/model_names.h"
#include "render/device/raster_request.h"

namespace oro {
namespace {

namespace limits = view_limits;

using ViewRows = std::vector<ViewOption>;

// Of values that are written as they are.
struct NoNames {};
template <class NamesOfIt>
constexpr bool has_names = !std::is_same_v<NamesOfIt, NoNames>;
template <class Value>
constexpr bool is_optional = requires(Value value) {
    value.has_value();
};

// What was given becomes the value.
template <class Asked, class NamesOfIt, class Value>
Result<void> take(const std::string& option, const Limits& allowed, const Asked& asked,
                  const NamesOfIt& names, Value& value) {
    if (!was_given(asked)) return {};
    if constexpr (has_names<NamesOfIt>) {
        ORO_TRY(value, choice_named(option, names, *asked));
    } else if constexpr (std::is_same_v<Asked, std::optional<double>> ||
                         std::is_same_v<Asked, std::optional<int>>) {
        ORO_CHECK(within(option, *asked, allowed));
        value = *asked;
    } else if constexpr (is_optional<Asked>) {
        value = *asked;
    } else {
        value = asked;
    }
    return {};
}

// An optional value that there is none of is not written.
template <class NamesOfIt, class Value>
void put_value(const char* key, const NamesOfIt& names, const Value& value, nlohmann::ordered_json& json) {
    if constexpr (is_optional<Value>) {
        if (value) put_value(key, names, *value, json);
    } else if constexpr (has_names<NamesOfIt>) {
        json[key] = name_in(names, value);
    } else {
        json[key] = value;
    }
}

std::string listed_word(const char* key, const std::vector<std::string>& words, const nlohmann::json& json) {
    std::string word = json_string(json, key);
    if (std::ranges::find(words, word) == words.end())
        throw JsonFault{"'" + std::string(key) + "' is '" + word + "', none of " + listed(words)};
    return word;
}

template <class NamesOfIt, class Value>
void read_value(const OptionText& text, const std::vector<std::string>& words, const NamesOfIt& names,
                const nlohmann::json& json, Value& value) {
    if constexpr (is_optional<Value>) {
        read_value(text, words, names, json, value.emplace());
    } else if constexpr (has_names<NamesOfIt>) {
        value = choice_in(json, text.json, names);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        value = listed_word(text.json, words, json);
    } else if constexpr (std::is_same_v<Value, bool>) {
        value = json_flag(json, text.json);
    } else if constexpr (std::is_same_v<Value, int>) {
        value = static_cast<int>(json_whole(json, text.json, static_cast<std::int64_t>(text.limits.low),
                                            static_cast<std::int64_t>(text.limits.high)));
    } else {
        value = json_number(json, text.json, text.limits.low, text.limits.high);
    }
}

// Rows under one heading.
class Rows {
  public:
    Rows(const char* heading, ViewRows& rows) : heading_(heading), rows_(rows) {}

    // An option that other code looks at.
    template <class Value, class Owner>
    ViewOption& add(const OptionText& text, Value Owner::*given, const char* help,
                    std::vector<std::string> words = {}) {
        ViewOption& row = rows_.emplace_back();
        static_cast<OptionRow<ViewOptions>&>(row) =
            option_row<ViewOptions>(heading_, text, given, help, std::move(words));
        return row;
    }
    // An option that is one value of a view: `in_view` is its member, or leads there.
    template <class Value, class Owner, class Place>
    ViewOption& setting(const OptionText& text, Value Owner::*given, Place in_view, const char* help,
                        std::vector<std::string> words = {}) {
        return connect(add(text, given, help, std::move(words)), given, in_view, NoNames{}, NoNames{});
    }
    // One of some names, in JSON, too.
    template <class Value, class Owner, class Place, class NamesOfIt>
    void choice(const OptionText& text, Value Owner::*given, Place in_view, const NamesOfIt& names,
                const char* help) {
        connect(add(text, given, help, words_of(names)), given, in_view, names, names);
    }
    // On or off; true or false in JSON.
    template <class Value, class Owner, class Place>
    void on_off(const OptionText& text, Value Owner::*given, Place in_view, const char* help) {
        connect(add(text, given, help, words_of(switch_names)), given, in_view, switch_names, NoNames{});
    }

  private:
    template <class Given, class Place, class NamesOfIt, class NamesInJson>
    static ViewOption& connect(ViewOption& row, Given given, Place in_view, const NamesOfIt& names,
                               const NamesInJson& in_json) {
        const OptionText text = row.text;
        row.apply = [name = row.name, text, given, in_view, names](const ViewOptions& options, View& view) {
            return take(name, text.limits, options.*given, names, std::invoke(in_view, view));
        };
        if (*text.json == '\0') return row;
        using Value = std::remove_cvref_t<decltype(std::invoke(in_view, std::declval<View&>()))>;
        if constexpr (!std::is_same_v<Value, std::vector<std::string>>) {
            row.put = [text, in_view, in_json](const View& view, nlohmann::ordered_json& json) {
                put_value(text.json, in_json, std::invoke(in_view, view), json);
            };
            row.read = [text, words = row.words, in_view, in_json](const nlohmann::json& json, View& view) {
                if (text.is(in_every_view) || json.contains(text.json))
                    read_value(text, words, in_json, json, std::invoke(in_view, view));
            };
        }
        return row;
    }

    const char* heading_;
    ViewRows& rows_;
};

void add_places(Rows eye) {
    eye.add({"--at PLACE", shown_first | of_eye, "all the data"}, &ViewOptions::at,
            "The place to look at, in the middle of the picture: latitude,longitude as in 46.57,7.99; or "
            "degrees, minutes and seconds, UTM, MGRS, a geohash, geo:46.57,7.99; a cell (N46E008); or a "
            "name of --names. "
            "With --above, --altitude, --on-summit or --look-at: where the eye is.");
    eye.add({"--above METRES", shown_first | of_eye, "2 with --look-at or --on-summit"},
            &ViewOptions::above_m,
            "Stand at --at: height of the eye over the ground there. Needs --at. Not with --altitude.");
    eye.add({"--altitude METRES", of_eye, "", "", {}, "--above"}, &ViewOptions::altitude_m,
            "Height of the eye above sea level instead. Needs --at. Not with --above.");
    eye.add({"--on-summit", of_eye}, &ViewOptions::on_summit, "").sentence =
        on_summit_sentence("the eye stands", "--at");
    eye.add({"--stand-on ground|top", of_eye, "ground"}, &ViewOptions::stand_on, stand_on_sentence,
            {"ground", "top"});
}

void add_directions(Rows eye) {
    eye.setting(
        {"--heading DEGREES", shown_first | of_eye | in_every_view, "0", "heading_deg", {-360, 360}},
        &ViewOptions::heading_deg, [](auto& view) -> auto& { return view.camera.attitude.heading_deg; },
        "Where the eye looks, clockwise from true north, {}: 90 is east.");
    eye.setting(
        {"--pitch DEGREES",
         shown_first | of_eye | in_every_view,
         "0; down to a place that it looks at, or to the data",
         "pitch_deg",
         {-90, 90}},
        &ViewOptions::pitch_deg, [](auto& view) -> auto& { return view.camera.attitude.pitch_deg; },
        "How far up or down it looks: 0 is level, -90 straight down, 90 straight up.");
    eye.setting(
        {"--roll DEGREES", of_eye | in_every_view, "0", "roll_deg", {-180, 180}}, &ViewOptions::roll_deg,
        [](auto& view) -> auto& { return view.camera.attitude.roll_deg; },
        "Tilt of the eye, {}: above 0 its right side goes down.");
    eye.add({"--look-at PLACE", shown_first | of_eye}, &ViewOptions::look_at,
            "Stand at --at and look at this place on the ground. Needs --at. Not with --heading or --pitch.");
    eye.setting(
        {"--fov DEGREES", shown_first | of_eye | in_every_view, "45; of a cell or all the data 30", "fov_deg",
         limits::fov_deg},
        &ViewOptions::vertical_fov_deg, [](auto& view) -> auto& { return view.camera.vertical_fov_deg; },
        "Angle of view from the bottom of the picture to its top, {}.");
    eye.add({"--size WIDTHxHEIGHT", shown_first, "1280x720", "", limits::side_px}, &ViewOptions::size,
            "Size of the picture in pixels, each side {}.");
}

void add_style_and_images(Rows looks) {
    looks.setting({"--style NAME", shown_first | changes_looks, "natural"}, &ViewOptions::style, &View::style,
                  "Colours of the ground and the sky: a style that comes with the program, a .json file of "
                  "your own, or a .txt file: a colour table as gdaldem color-relief reads it.");
    looks.setting({"--drape FILE", shown_first | changes_looks}, &ViewOptions::drape, &View::drape,
                  "Lay an image over the ground: an orthophoto, a satellite scene or a map, any raster with "
                  "a CRS in a format that terrain is read from. Several are drawn one over the other, the "
                  "last on top.");
    looks.setting({"--drape-opacity SHARE", changes_looks, "1: all", "", limits::drape_opacity},
                  &ViewOptions::drape_opacity, &View::drape_opacity,
                  "How much images hide of the style's colours, {}. Needs --drape.");
    looks.choice({"--drape-values", changes_looks, "auto"}, &ViewOptions::drape_values, &View::drape_values,
                 image_value_names,
                 "What the values of images are: codes of sRGB, as a picture program writes them, or "
                 "reflectance, linear light that is stretched from its darkest to its brightest. auto: bytes "
                 "are codes; other numbers are what their ICC profile says, and reflectance without one. "
                 "Needs --drape.");
    looks.add({"--landcover FILE", changes_looks}, &ViewOptions::landcover,
              "Colour the ground by land cover: a raster whose pixels are codes of classes, in any CRS, or "
              "polygons "
              "with a field of codes. "
              "FILE,TABLE says of which product: worldcover, corine, nlcd, cci, or a .json file of your own; "
              "without TABLE the codes tell. Several files of one table are drawn one over the other, the "
              "last on top. "
              "Layers and read-outs name the class. For styles that are coloured by cover: natural.");
    looks.add(
        {"--canopy FILE", no_trait}, &ViewOptions::canopy,
        "Raise the ground to the top of what grows on it, as a closed surface that is seen, casts shadows "
        "and hides: a raster of canopy heights in metres, in any CRS, or several, the last on top; or "
        "class: heights of the classes of --landcover, which are invented. The eye stands on the ground.");
    looks.add({"--canopy-held SHARE", no_trait, "0.5 of SRTM, else 0", "", {0.0, 1.0}},
              &ViewOptions::canopy_held,
              "How much of the canopy's height the elevation data hold already, {}: so much is not added. "
              "Needs --canopy.");
    looks.add({"--detail N", no_trait, "0: none"}, &ViewOptions::detail,
              "Invent ground between the posts near the eye, by N halvings of the way from post to post, 0 "
              "to 6: a smooth surface through the posts, and noise of the size that the ground itself has. "
              "Posts stay where they are; water, ice and built land stay as they are. N,KM says how far "
              "from the eye (else 5 km). The legend tells how many metres are invented.");
}

void add_vectors(Rows looks) {
    looks.setting(
        {"--names FILE", shown_first | changes_looks}, &ViewOptions::names,
        [](auto& view) -> auto& { return view.vectors.names; },
        "Name the points of a vector file (GPX, KML, GeoJSON, GeoPackage, shapefile, CSV ...) that the "
        "eye sees, with height and distance; a name may stand for its place: --at Eiger. A window shows them "
        "while the eye rests. Several may be given.");
    looks.setting(
        {"--names-field FIELD", changes_looks, "name"}, &ViewOptions::names_field,
        [](auto& view) -> auto& { return view.vectors.names_field; },
        "The field of such files that holds the name. Needs --names or --overlay.");
    looks.setting(
        {"--overlay FILE", shown_first | changes_looks}, &ViewOptions::overlay,
        [](auto& view) -> auto& { return view.vectors.overlay; },
        "Lay the lines and polygons of a vector file on the ground, and name its points. A window "
        "shows them while the eye rests. Several may be given.");
    looks.add({"--overlay-colour COLOUR", changes_looks, "#e2252b"}, &ViewOptions::overlay_colour,
              "Colour of these lines. A feature with a field stroke has that colour. Needs --overlay.");
    looks.setting(
        {"--overlay-width PIXELS", changes_looks, "2", "", limits::overlay_width_px},
        &ViewOptions::overlay_width_px, [](auto& view) -> auto& { return view.vectors.overlay_width_px; },
        "Width of these lines, {}. A feature with a field stroke-width has that width. Needs --overlay.");
    looks.setting(
        {"--overlay-fill SHARE", changes_looks, "0.2", "", limits::overlay_fill}, &ViewOptions::overlay_fill,
        [](auto& view) -> auto& { return view.vectors.overlay_fill; },
        "How much of the ground the areas of polygons hide, {}. Features with the fields fill and "
        "fill-opacity are filled as these say. Needs --overlay.");
    looks.choice({"--graticule", changes_looks, "", "graticule"}, &ViewOptions::graticule, &View::graticule,
                 graticule_names,
                 "Lay lines with their values over the ground, as far apart as the view asks for: "
                 "geographic, of latitude and longitude; projected, of easting and northing in the CRS of "
                 "the data. A window shows them while the eye rests.");
}

void add_light(Rows looks) {
    looks.add(
        {"--sun AZIMUTH,ELEVATION", changes_looks, "the style's; of natural the usual sun of the place"},
        &ViewOptions::sun,
        "Where light comes from, in degrees: clockwise from north, and above the horizon; 315,45 is from the "
        "north-west. Below 0 there is no direct light. Not with --sun-time.");
    looks.add({"--sun-time TIME", shown_first | changes_looks, "", "", {}, "--sun"}, &ViewOptions::sun_time,
              "Light as the sun gives it at the eye at this time, e.g. 2026-06-21T05:30+02:00; view is the "
              "picture's own time. Not with --sun.");
    looks.setting({"--visibility KM", changes_looks, "the style's; 150 in natural", "visibility_km",
                   limits::visibility_km},
                  &ViewOptions::visibility_km, &View::visibility_km,
                  "How clear the air is: how far away at sea level something black can be told from the sky, "
                  "{}. For styles with air: natural.");
    looks.on_off({"--shadows", changes_looks, "as the style has it; on in natural", "shadows"},
                 &ViewOptions::shadows, &View::shadows,
                 "Whether terrain casts shadows, from beyond the picture, too. For styles that the sun "
                 "lights.");
    looks.on_off({"--sky-openness", changes_looks, "as the style has it; on in natural", "sky_openness"},
                 &ViewOptions::sky_openness, &View::sky_openness,
                 "Whether ground that sees less of the sky (valleys, gullies) gets less of its light. For "
                 "styles that the sun lights.");
}

void add_surroundings(Rows looks) {
    looks.on_off(
        {"--trees", changes_looks,
         "as the style has it; on in natural; off in panoramas, with --canopy and with --drape", "trees"},
        &ViewOptions::trees, &View::trees,
        "Whether the style's invented trees stand on the ground and hide what is behind them. off "
        "shows towns, meshes and tracks in forests. on is for styles that know the ground's materials: "
        "natural. Only with on has a panorama trees, as they would hide what it names, and a view "
        "with --canopy or --drape, which show the ground's own.");
    looks.choice({"--sea", changes_looks, "level", "sea"}, &ViewOptions::sea, &View::sea, sea_names,
                 "What a style with water draws as the sea: level, ground that is level, as lakes are; low, "
                 "too, what is up to 5 m above sea level and all below it; voids, what has no height.");
    looks.choice({"--rim", changes_looks, "skirt", "rim"}, &ViewOptions::rim, &View::rim, rim_names,
                 "What a style with voids draws below the region's rim: skirt, walls down to the ellipsoid; "
                 "or none.");
}

void add_drawing(Rows looks) {
    looks.on_off({"--labels", changes_looks, "as the style has it; on in contours"}, &ViewOptions::labels,
                 &View::labels,
                 "Whether every fifth contour line has its height written on it, in pictures and maps; a "
                 "window has none. For styles with contour lines.");
    looks.setting({"--contour-interval METRES", changes_looks, "as the view asks for, or the style says",
                   "contour_interval_m", limits::contour_interval_m},
                  &ViewOptions::contour_interval_m, &View::contour_interval_m,
                  "How far apart contour lines stand in height, {}. Every fifth is thicker, and has its "
                  "height written on it. For styles with contour lines: contours.");
    looks.choice({"--edges", changes_looks, "as the style has it", "edges"}, &ViewOptions::edges,
                 &View::edges, edge_names,
                 "Edges of the ground before the sky and before farther ground, in pictures of one sample: "
                 "smooth, each pixel shows what it has of both; or steps, it shows what is in its middle.");
    looks.choice(
        {"--show", changes_looks, "", "show"}, &ViewOptions::show, &View::show, show_names,
        "Show how the picture was made, in the place of colours: visible, whether the last round "
        "drew it or one before; levels, how coarse; meshlets or triangles, each in a colour of its "
        "own; overdraw, how many triangles cover a pixel; clusters or groups of them, each in a "
        "colour of its own, of meshes or of a file that was baked with clusters. Where meshes are drawn "
        "by clusters, levels are theirs, and the ground is plain. A legend says which colour is what. For "
        "pictures of one sample.");
    looks.setting({"--samples N", in_every_view, "1", "samples", {1, 64}}, &ViewOptions::samples,
                  &View::samples,
                  "How many samples make a pixel, {}. More make edges smoother, and take longer.");
    looks.setting(
        {"--exaggeration FACTOR", in_every_view, "1, as high as in nature", "exaggeration", {0.01, 100}},
        &ViewOptions::exaggeration, &View::exaggeration, "Multiply all heights by this, {}.");
}

void add_triangles(Rows detail) {
    detail.setting({"--tau PIXELS", no_trait, "1; in a window 0.5", "tau_px", {0, 1000}},
                   &ViewOptions::tau_px, &View::tau_px,
                   "How far left-out detail may move anything on the picture, {}. 0 leaves nothing out.");
    detail.setting({"--pipeline", no_trait, "auto", "pipeline"}, &ViewOptions::pipeline, &View::pipeline,
                   "How the GPU draws triangles: with mesh shaders or with compute shaders. auto takes the "
                   "faster, measured once on this machine.",
                   words_of(raster_requests));
    ViewOption& mesh = detail.setting(
        {"--mesh", no_trait, "auto", "mesh"}, &ViewOptions::mesh, &View::mesh,
        "What triangles are taken from: clusters, which take the fewest, of a file that was baked with them, "
        "or the grid. auto takes clusters where the view can be drawn by them.",
        mesh_words());
    // Only what was drawn by clusters says so.
    mesh.put = [](const View& view, nlohmann::ordered_json& json) {
        if (view.mesh == "clusters") json["mesh"] = view.mesh;
    };
    detail.setting({"--mesh-level N", no_trait, "", "mesh_level", {0, 80}}, &ViewOptions::mesh_level,
                   &View::mesh_level,
                   "Draw the clusters of one level of the graph, wherever the eye is: 0 is the original, "
                   "80 the most; beyond the last level of a graph its coarsest are drawn. Needs a file that "
                   "was baked with clusters. Not "
                   "with --tau, which asks for the clusters that a view needs.");
}

void add_models(Rows detail) {
    detail.choice(
        {"--earth", no_trait, "ellipsoid", "earth"}, &ViewOptions::earth,
        [](auto& view) -> auto& { return view.model.earth; }, earth_names,
        "Shape of the Earth: ellipsoid (WGS84, as GPS has it), sphere, or flat around the eye. The last two "
        "are there to show how far off they are.");
    detail.add({"--refraction K", no_trait, "0", "", limits::refraction_k}, &ViewOptions::refraction_k,
               "How much the air bends light (a surveyor's coefficient of refraction), the same at all "
               "heights, {}: 0 is not at all, 0.13 is usual by day. Not with --air.");
    detail.add({"--air", no_trait, "", "", {}, "--refraction"}, &ViewOptions::air,
               "standard: air that bends light less the higher the eye is, by 0.13 at sea level, 0.091 at "
               "3,000 m and nothing from space. Not with --refraction.",
               words_of(air_names));
    detail.choice(
        {"--precision", no_trait, "relative", "precision"}, &ViewOptions::precision,
        [](auto& view) -> auto& { return view.model.precision; }, precision_names,
        "relative: positions are counted from the eye, and exact near it. naive: they are counted from the "
        "Earth's centre with 7 digits, to show how far off that is.");
    detail.choice({"--geoid", no_trait, "egm96", "geoid"}, &ViewOptions::geoid, &View::has_geoid, geoid_names,
                  "egm96: sea level is where the EGM96 model has it. none: it is the ellipsoid itself, to "
                  "show how far off that is.");
    detail.choice({"--heights", no_trait, "f32", "heights"}, &ViewOptions::heights, &View::heights,
                  height_storage_names,
                  "How the GPU keeps heights: f32 in steps of 0.5 mm, packed for the same picture in less "
                  "than half of the memory, or i16 in half the memory and coarser steps.");
}

// "draft is --tau 4 --heights i16 --refraction 0, balanced is ... and survey is ..."
std::string bundle_words() {
    std::vector<std::string> all;
    for (const AccuracyBundle& bundle : accuracy_bundles())
        all.push_back(std::string(bundle.name) + " is " + bundle.options);
    return joined(all, " and ");
}

void add_accuracy(Rows detail) {
    detail.add({"--accuracy", shown_first}, &ViewOptions::accuracy, "", accuracy_words()).sentence =
        "Set several options together: " + bundle_words() + ". Options given one by one win over it.";
    detail.add({"--tolerance PIXELS", no_trait}, &ViewOptions::tolerance,
               "Take the cheapest --accuracy that is predicted to be off by no more than this, 0.001 to "
               "1000, e.g. 1px. Not with --accuracy.");
}

ViewRows made_view_table() {
    ViewRows rows;
    const Rows eye(option_headings::eye, rows), looks(option_headings::looks, rows),
        detail(option_headings::detail, rows);
    add_places(eye);
    add_directions(eye);
    add_style_and_images(looks);
    add_vectors(looks);
    add_light(looks);
    add_surroundings(looks);
    add_drawing(looks);
    add_triangles(detail);
    add_models(detail);
    add_accuracy(detail);
    return rows;
}

}  // namespace

const std::vector<ViewOption>& view_option_table() {
    static const ViewRows rows = made_view_table();
    return rows;
}

std::string on_summit_sentence(const std::string& who_stands, const std::string& place_option) {
    return "Published places of summits lie beside those of the data: with this " + who_stands +
           " on the highest post at most two posts from " + place_option + ". How far that is, is told.";
}

}  // namespace oro
