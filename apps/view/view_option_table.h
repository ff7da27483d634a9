// The table of a view's options. A plain option is a field of ViewSettings (apps/options/view_settings.h) and
// a row here: the row parses, checks, writes and reads it, compares it, and is its help and its
// documentation.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/options/option_table.h"
#include "apps/options/options.h"
#include "apps/report/json_fields.h"
#include "apps/view/model_names.h"
#include "apps/view/view.h"

namespace oro {

struct ViewOption : OptionRow<ViewOptions> {
    // Changes a view where the option was given. Errors: a value that is none (usage). Empty where more than
    // one field follows from it: apps/view/view_options.cpp does that.
    std::function<Result<void>(const ViewOptions&, View&)> apply;
    // Writes it into a view's JSON, and reads it there. Reading throws JsonFault. Both are empty where it has
    // no key of its own: apps/view/view_file.cpp does that.
    std::function<void(const View&, nlohmann::ordered_json&)> put;
    std::function<void(const nlohmann::json&, View&)> read;
};

// The rows of all options of a view, in the order of help. They are made when they are first asked for.
const std::vector<ViewOption>& view_option_table();

// True for options of the eye, which a view from a file has itself.
inline bool is_of_eye(const ViewOption& option) {
    return option.text.is(of_eye);
}
// True for options that change the colours or the light of a picture.
inline bool is_look(const ViewOption& option) {
    return option.text.is(changes_looks);
}

// What the name stands for that a field of a view's JSON has. Throws JsonFault.
template <class Choice, std::size_t count>
Choice choice_in(const nlohmann::json& json, const char* field, const Names<Choice, count>& names) {
    const std::string chosen = json_string(json, field);
    const Result<Choice> found = choice_named(field, names, chosen);
    if (!found.ok())
        throw JsonFault{"'" + std::string(field) + "' is '" + chosen + "': " + found.error().what};
    return *found;
}

// What help prints of --stand-on.
inline constexpr const char* stand_on_sentence =
    "What heights over the ground count from: the ground itself, or the top of a mesh that stands there (a "
    "roof). Needs --mesh-file.";
// What help prints of --on-summit. who_stands: "the eye stands"; place_option: "--at".
std::string on_summit_sentence(const std::string& who_stands, const std::string& place_option);

}  // namespace oro
