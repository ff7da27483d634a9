#include "apps/view/model_names.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/report/figures.h"
#include "apps/report/option_words.h"

namespace oro {
namespace {

template <class Choice, std::size_t count>
using Names = std::array<std::pair<const char*, Choice>, count>;

constexpr Names<Earth, 3> earths{
    {{"ellipsoid", Earth::ellipsoid}, {"sphere", Earth::sphere}, {"flat", Earth::flat}}};
// The third is for measuring alone.
constexpr Names<Precision, 3> precisions{
    {{"relative", Precision::relative}, {"naive", Precision::naive}, {"", Precision::rounded_posts}}};
constexpr Names<bool, 2> geoids{{{"egm96", true}, {"none", false}}};
constexpr Names<Air, 1> airs{{{"standard", standard_air}}};
constexpr Names<AirLaw, 2> air_laws{{{"constant", AirLaw::constant}, {"standard", AirLaw::standard}}};
constexpr Names<HeightStorage, 3> storages{
    {{"f32", HeightStorage::f32}, {"packed", HeightStorage::packed}, {"i16", HeightStorage::i16}}};
constexpr Names<Sea, 3> seas{{{"level", Sea::level}, {"low", Sea::low}, {"voids", Sea::voids}}};
constexpr Names<Rim, 2> rims{{{"skirt", Rim::skirt}, {"none", Rim::none}}};
constexpr Names<std::optional<bool>, 3> labels_of_view{{{"style", {}}, {"on", true}, {"off", false}}};
constexpr Names<Show, 7> shows{{{"visible", Show::visible},
                                {"levels", Show::levels},
                                {"meshlets", Show::meshlets},
                                {"triangles", Show::triangles},
                                {"overdraw", Show::overdraw},
                                {"clusters", Show::clusters},
                                {"groups", Show::groups}}};
constexpr Names<ImageValues, 3> values_of_images{{{"auto", ImageValues::by_file},
                                                  {"codes", ImageValues::codes},
                                                  {"reflectance", ImageValues::reflectance}}};
constexpr Names<Edges, 2> edges_of_ground{{{"smooth", Edges::smooth}, {"steps", Edges::steps}}};

template <class Choice, std::size_t count>
Result<Choice> named(const char* option, const Names<Choice, count>& names, const std::string& name) {
    for (const auto& [known, choice] : names) {
        if (*known != '\0' && name == known) return choice;
    }
    return refused(option, name, choose_words(words_of(names)));
}

template <class Choice, std::size_t count>
const char* name_in(const Names<Choice, count>& names, Choice choice) {
    for (const auto& [known, its] : names) {
        if (its == choice) return known;
    }
    return "";
}

}  // namespace

Result<Earth> earth_named(const std::string& name) {
    return named("--earth", earths, name);
}
Result<Precision> precision_named(const std::string& name) {
    return named("--precision", precisions, name);
}
Result<bool> geoid_named(const std::string& name) {
    return named("--geoid", geoids, name);
}
Result<HeightStorage> heights_named(const std::string& name) {
    return named("--heights", storages, name);
}
Result<Sea> sea_named(const std::string& name) {
    return named("--sea", seas, name);
}
Result<Rim> rim_named(const std::string& name) {
    return named("--rim", rims, name);
}
Result<Show> show_named(const std::string& name) {
    return named("--show", shows, name);
}
Result<Edges> edges_named(const std::string& name) {
    return named("--edges", edges_of_ground, name);
}
Result<ImageValues> drape_values_named(const std::string& name) {
    return named("--drape-values", values_of_images, name);
}
Result<std::optional<bool>> labels_named(const std::string& name) {
    return named("--labels", labels_of_view, name);
}
Result<Air> air_named(const std::string& name) {
    return named("--air", airs, name);
}
Result<AirLaw> air_law_named(const std::string& name) {
    return named("air", air_laws, name);
}

std::vector<std::string> earth_words() {
    return words_of(earths);
}
std::vector<std::string> precision_words() {
    return words_of(precisions);
}
std::vector<std::string> sea_words() {
    return words_of(seas);
}
std::vector<std::string> rim_words() {
    return words_of(rims);
}
std::vector<std::string> show_words() {
    return words_of(shows);
}
std::vector<std::string> edges_words() {
    return words_of(edges_of_ground);
}
const char* name_of(Sea sea) {
    return name_in(seas, sea);
}
const char* name_of(Rim rim) {
    return name_in(rims, rim);
}
const char* name_of(Show show) {
    return name_in(shows, show);
}
const char* name_of(Edges edges) {
    return name_in(edges_of_ground, edges);
}
std::vector<std::string> drape_values_words() {
    return words_of(values_of_images);
}
const char* name_of(ImageValues values) {
    return name_in(values_of_images, values);
}
std::vector<std::string> geoid_words() {
    return words_of(geoids);
}
std::vector<std::string> heights_words() {
    return words_of(storages);
}
std::vector<std::string> air_words() {
    return words_of(airs);
}
const char* name_of(HeightStorage heights) {
    return name_in(storages, heights);
}

std::string air_option(const Air& air) {
    if (air == standard_air) return "--air standard";
    char text[40];
    std::snprintf(text, sizeof text, "--refraction %g", air.k);
    return text;
}

std::string light_words(const Air& air, double eye_h_m) {
    if (air.k == 0.0) return "straight, without refraction";
    char k[40];
    std::snprintf(k, sizeof k, "%g", air.k);
    if (air.law == AirLaw::constant) return "k " + std::string(k) + " at all heights";
    const double here = air.k_at(eye_h_m);
    const std::string law =
        air == standard_air ? "standard air" : "by standard air, " + std::string(k) + " at sea level";
    return "k " + std::string(here < 0.0 ? "-" : "") + about(std::abs(here)) + " at the eye's h of " +
           metres(eye_h_m) + " m (" + law + ")";
}

nlohmann::ordered_json light_json(const Air& air, double eye_h_m) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["k"] = air.k_at(eye_h_m);
    json["refraction"] = air.k;
    json["air"] = name_in(air_laws, air.law);
    json["eye_h_m"] = eye_h_m;
    return json;
}

nlohmann::ordered_json models_json(const View& view) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["earth"] = name_in(earths, view.model.earth);
    json["geoid"] = name_in(geoids, view.has_geoid);
    json["refraction"] = view.model.air.k;
    json["air"] = name_in(air_laws, view.model.air.law);
    json["precision"] = name_in(precisions, view.model.precision);
    json["heights"] = name_in(storages, view.heights);
    return json;
}

}  // namespace oro
