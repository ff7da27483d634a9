#include "apps/commands/shot/shot_views.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/report/json_fields.h"
#include "apps/view/view_paths.h"
#include "geo/files/letter_case.h"
#include "geo/files/text_encoding.h"

namespace oro {
namespace {

// The list of views in a file's text; null where it is no list.
Result<nlohmann::json> list_in(const std::string& file) {
    if (!lower_case(file).ends_with(".json")) return nlohmann::json();
    ORO_TRY(std::string bytes, read_text_file(file));
    const auto text = utf8_text(std::move(bytes));
    if (!text.ok()) return Error{text.error().kind, file, text.error().what};
    const std::size_t first = text->find_first_not_of(" \t\r\n");
    if (first == std::string::npos || (*text)[first] != '[') return nlohmann::json();
    try {
        return parsed_json(*text);
    } catch (const JsonFault& fault) {
        return Error{ErrorKind::failed, file, "holds no list of views that can be read: " + fault.what};
    } catch (const nlohmann::json::exception& e) {
        return Error{ErrorKind::failed, file,
                     std::string("holds no list of views that can be read: ") + e.what()};
    }
}

}  // namespace

Result<std::vector<ListedView>> listed_views(const std::vector<std::string>& files) {
    std::vector<ListedView> views;
    for (const std::string& file : files) {
        ORO_TRY(const nlohmann::json list, list_in(file));
        if (!list.is_array()) {
            if (files.size() == 1) return views;
            ORO_TRY(View view, read_view(file));
            views.push_back({std::move(view), file});
            continue;
        }
        if (list.empty()) return Error{ErrorKind::failed, file, "holds an empty list of views"};
        for (std::size_t i = 0; i < list.size(); ++i) {
            ORO_TRY(View view, view_from_json(list[i].dump(), file + ", view " + std::to_string(i + 1)));
            ORO_CHECK(lead_from_working_folder(view, file));
            views.push_back({std::move(view), file});
        }
    }
    return views;
}

Result<std::string> numbered_name(const std::string& pattern, std::size_t count, std::size_t number) {
    const auto fault = [&](const std::string& what) {
        return refused("--out", pattern,
                       what + " of " + std::to_string(count) +
                           " views: %04d stands for their numbers, as in "
                           "view-%04d.png");
    };
    if (pattern.empty())
        return refused(
            "--out", "",
            "is missing: name the pictures of " + std::to_string(count) + " views, as in view-%04d.png");
    std::string name;
    bool has_number = false;
    for (std::size_t at = 0; at < pattern.size(); ++at) {
        if (pattern[at] != '%') {
            name += pattern[at];
            continue;
        }
        if (at + 1 < pattern.size() && pattern[at + 1] == '%') {
            name += '%';
            ++at;
            continue;
        }
        const std::size_t end = std::min(pattern.find_first_not_of("0123456789", at + 1), pattern.size());
        const std::string width = pattern.substr(at + 1, end - at - 1);
        if (has_number || end == pattern.size() || pattern[end] != 'd' || width.size() > 2)
            return fault("is no name for the pictures");
        const std::string digits = std::to_string(number);
        const auto columns = static_cast<std::size_t>(width.empty() ? 0 : std::stoi(width));
        if (columns > digits.size())
            name += std::string(columns - digits.size(), width.front() == '0' ? '0' : ' ');
        name += digits;
        has_number = true;
        at = end;
    }
    if (!has_number) return fault("is one picture, not the pictures");
    return name;
}

}  // namespace oro
