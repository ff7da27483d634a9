// The table of a view's options. A plain option is a field of ViewSettings (apps/options/view_settings.h) and
// a row here: the row parses, checks, writes and reads it, compares it, and is its help and its
// documentation.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/options/option_table.h"
#include "apps/options/options.h"
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

// True for options of the eye, which a view from a file has itself: all under that heading but --size.
bool is_of_eye(const ViewOption& option);
// True for options that change the colours or the light of a picture.
inline bool is_look(const ViewOption& option) {
    return option.text.is(changes_looks);
}

// What help prints of --on-summit. who_stands: "the eye stands"; place_option: "--at".
std::string on_summit_sentence(const std::string& who_stands, const std::string& place_option);

}  // namespace oro
