#include "apps/view/view_paths.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/view/style.h"

namespace oro {
namespace fs = std::filesystem;

namespace {

// What GDAL calls a name (/vsizip/..., NETCDF:"a.nc":v) leads from nowhere.
bool is_plain_path(const std::string& path) {
    std::error_code unreadable;
    return !path.starts_with("/vsi") && fs::exists(path, unreadable);
}

// `path` without the dots and a last slash; absolute.
fs::path tidied(const fs::path& path) {
    const fs::path tidy = path.lexically_normal();
    return tidy.has_filename() ? tidy : tidy.parent_path();
}

// The way from one absolute folder to a file; nothing where they share the root alone.
std::optional<fs::path> way(const fs::path& from, const fs::path& to) {
    auto step = from.begin(), other = to.begin();
    std::ptrdiff_t shared = 0;
    for (; step != from.end() && other != to.end() && *step == *other; ++step, ++other) ++shared;
    if (shared < 2) return std::nullopt;  // the root is one
    return to.lexically_relative(from);
}

std::ptrdiff_t steps_up(const fs::path& relative) {
    return std::count(relative.begin(), relative.end(), "..");
}

// As named, or as it really lies where links lead elsewhere: the one with fewer steps up, if it leads there.
std::string from_folder(const fs::path& folder, const std::string& named) {
    if (!is_plain_path(named)) return named;
    std::error_code failed;
    const fs::path here = fs::current_path(failed);
    if (failed) return named;
    const fs::path as_named = tidied(here / named);
    const auto leads = [&](const fs::path& relative) {
        std::error_code unreadable;
        return fs::equivalent(folder / relative, named, unreadable);
    };
    std::optional<fs::path> best = way(folder, as_named);
    if (best && !leads(*best)) best.reset();
    // Links before the last name are followed, not the last itself.
    const fs::path whole = (here / named).has_filename() ? here / named : (here / named).parent_path();
    const fs::path last = whole.filename();
    const bool is_dots = last == "." || last == "..";
    const fs::path really =
        is_dots ? fs::canonical(whole, failed) : fs::canonical(whole.parent_path(), failed) / last;
    if (!failed) {
        const auto other = way(folder, really);
        if (other && leads(*other) && (!best || steps_up(*other) < steps_up(*best))) best = other;
    }
    if (best) return best->string();
    const fs::path absolute = fs::canonical(named, failed);
    return failed || fs::path(named).is_absolute() ? named : absolute.string();
}

}  // namespace

View view_told_by(const View& view, const std::string& picture) {
    View told = view;
    told.paths_from_own_file = true;
    if (!told.tells_paths) {
        told.region.paths.clear();
        if (is_style_path(told.style)) told.style = fs::path(told.style).filename().string();
        return told;
    }
    std::error_code failed;
    const fs::path parent = fs::path(picture).parent_path();
    const fs::path folder = fs::canonical(parent.empty() ? fs::path(".") : parent, failed);
    if (failed) {
        told.paths_from_own_file = false;
        return told;
    }
    for (std::string& path : told.region.paths) path = from_folder(folder, path);
    if (is_style_path(told.style)) told.style = from_folder(folder, told.style);
    return told;
}

void lead_from_working_folder(View& view, const std::string& file) {
    if (!view.paths_from_own_file) return;
    view.paths_from_own_file = false;
    const fs::path folder = fs::path(file).parent_path();
    const auto lead = [&](std::string& path) {
        if (fs::path(path).is_absolute()) return;
        const std::string joined = (folder / path).string();
        if (is_plain_path(joined) || path.find(':') == std::string::npos) path = joined;
    };
    for (std::string& path : view.region.paths) lead(path);
    if (is_style_path(view.style)) lead(view.style);
}

}  // namespace oro
