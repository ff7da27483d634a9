// The models and the surroundings of a view by the names that options and view files have for them.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/options/view_settings.h"
#include "apps/report/option_words.h"
#include "core/earth/world_model.h"

namespace oro {

struct View;

// Choices and the names that options and view files have for them; "" for what no user may write.
template <class Choice, std::size_t count>
using Names = std::array<std::pair<const char*, Choice>, count>;

inline constexpr Names<Earth, 3> earth_names{
    {{"ellipsoid", Earth::ellipsoid}, {"sphere", Earth::sphere}, {"flat", Earth::flat}}};
// The third is for measuring alone.
inline constexpr Names<Precision, 3> precision_names{
    {{"relative", Precision::relative}, {"naive", Precision::naive}, {"", Precision::rounded_posts}}};
// Whether a view has the geoid.
inline constexpr Names<bool, 2> geoid_names{{{"egm96", true}, {"none", false}}};
inline constexpr Names<Air, 1> air_names{{{"standard", standard_air}}};
inline constexpr Names<AirLaw, 2> air_law_names{
    {{"constant", AirLaw::constant}, {"standard", AirLaw::standard}}};
inline constexpr Names<HeightStorage, 3> height_storage_names{
    {{"f32", HeightStorage::f32}, {"packed", HeightStorage::packed}, {"i16", HeightStorage::i16}}};
inline constexpr Names<Sea, 3> sea_names{{{"level", Sea::level}, {"low", Sea::low}, {"voids", Sea::voids}}};
inline constexpr Names<Rim, 2> rim_names{{{"skirt", Rim::skirt}, {"none", Rim::none}}};
inline constexpr Names<bool, 2> switch_names{{{"on", true}, {"off", false}}};
// As view files have --labels.
inline constexpr Names<std::optional<bool>, 3> label_switch_names{
    {{"style", std::nullopt}, {"on", true}, {"off", false}}};
inline constexpr Names<Show, 7> show_names{{{"visible", Show::visible},
                                            {"levels", Show::levels},
                                            {"meshlets", Show::meshlets},
                                            {"triangles", Show::triangles},
                                            {"overdraw", Show::overdraw},
                                            {"clusters", Show::clusters},
                                            {"groups", Show::groups}}};
inline constexpr Names<ImageValues, 3> image_value_names{{{"auto", ImageValues::by_file},
                                                          {"codes", ImageValues::codes},
                                                          {"reflectance", ImageValues::reflectance}}};
inline constexpr Names<Graticule, 2> graticule_names{
    {{"geographic", Graticule::geographic}, {"projected", Graticule::projected}}};
inline constexpr Names<Edges, 2> edge_names{{{"smooth", Edges::smooth}, {"steps", Edges::steps}}};

// What --mesh takes, and view files have.
inline std::vector<std::string> mesh_words() {
    return {"auto", "clusters", "grid"};
}

// What a name stands for. A usage error of that option for an unknown one.
template <class Choice, std::size_t count>
Result<Choice> choice_named(const std::string& option, const Names<Choice, count>& names,
                            const std::string& name) {
    for (const auto& [known, choice] : names) {
        if (*known != '\0' && name == known) return choice;
    }
    return refused(option, name, choose_words(words_of(names)));
}

// The name of a choice; "" where it has none.
template <class Choice, std::size_t count>
const char* name_in(const Names<Choice, count>& names, const Choice& choice) {
    for (const auto& [known, its] : names) {
        if (its == choice) return known;
    }
    return "";
}

// What asks for that air: "--air standard", "--refraction 0.13".
std::string air_option(const Air& air);
// How light goes to an eye: "k 0.091 at the eye's h of 3,000 m (standard air)".
std::string light_words(const Air& air, double eye_h_m);
nlohmann::ordered_json light_json(const Air& air, double eye_h_m);
// The models of a view: earth, geoid, refraction and air, precision, heights.
nlohmann::ordered_json models_json(const View& view);

}  // namespace oro
