#include "apps/view/model_names.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
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
constexpr Names<HeightStorage, 2> storages{{{"f32", HeightStorage::f32}, {"i16", HeightStorage::i16}}};

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

std::vector<std::string> earth_words() {
    return words_of(earths);
}
std::vector<std::string> precision_words() {
    return words_of(precisions);
}
std::vector<std::string> geoid_words() {
    return words_of(geoids);
}
std::vector<std::string> heights_words() {
    return words_of(storages);
}
const char* name_of(HeightStorage heights) {
    return name_in(storages, heights);
}

nlohmann::ordered_json models_json(const View& view) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["earth"] = name_in(earths, view.model.earth);
    json["geoid"] = name_in(geoids, view.has_geoid);
    json["refraction"] = view.model.refraction_k;
    json["precision"] = name_in(precisions, view.model.precision);
    json["heights"] = name_in(storages, view.heights);
    return json;
}

}  // namespace oro
