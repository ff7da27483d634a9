#include "apps/view/view_paths.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/view/style.h"
#include "core/base/file_there.h"

namespace oro {
namespace fs = std::filesystem;

namespace {

// What GDAL calls a name (/vsizip/..., NETCDF:"a.nc":v) leads from nowhere.
Result<bool> is_plain_path(const std::string& path) {
    if (path.starts_with("/vsi")) return false;
    return is_there(path);
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

// Empty where it is gone.
Result<fs::path> working_folder() {
    std::error_code failed;
    fs::path here = fs::current_path(failed);
    if (is_no_answer(failed)) return no_answer("the working folder", failed);
    return failed ? fs::path() : here;
}

// `path`, absolute, as it lies behind all links; empty where nothing is there.
Result<fs::path> without_links(const fs::path& path) {
    std::error_code failed;
    fs::path really = fs::canonical(path, failed);
    if (is_no_answer(failed)) return no_answer(path.string(), failed);
    return failed ? fs::path() : really;
}

// As named, or as it really lies where links lead elsewhere: the one with fewer steps up, if it leads there.
Result<std::string> from_folder(const fs::path& folder, const std::string& named) {
    ORO_TRY(const bool plain, is_plain_path(named));
    if (!plain) return named;
    ORO_TRY(const fs::path here, working_folder());
    if (here.empty()) return named;
    const fs::path as_named = tidied(here / named);
    const auto leads = [&](const fs::path& relative) {
        return is_same_file((folder / relative).string(), named);
    };
    std::optional<fs::path> best = way(folder, as_named);
    if (best) {
        ORO_TRY(const bool there, leads(*best));
        if (!there) best.reset();
    }
    // Links before the last name are followed, not the last itself.
    const fs::path whole = (here / named).has_filename() ? here / named : (here / named).parent_path();
    const fs::path last = whole.filename();
    const bool is_dots = last == "." || last == "..";
    ORO_TRY(fs::path really, without_links(is_dots ? whole : whole.parent_path()));
    if (!really.empty()) {
        if (!is_dots) really /= last;
        const auto other = way(folder, really);
        if (other && (!best || steps_up(*other) < steps_up(*best))) {
            ORO_TRY(const bool there, leads(*other));
            if (there) best = other;
        }
    }
    if (best) return best->string();
    if (fs::path(named).is_absolute()) return named;
    ORO_TRY(const fs::path absolute, without_links(named));
    return absolute.empty() ? named : absolute.string();
}

// The paths of a view's land cover and canopy: their files, and a table that is a user's own.
std::vector<std::string*> cover_paths(View& view) {
    std::vector<std::string*> paths;
    for (std::string& file : view.cover_choice.files) paths.push_back(&file);
    if (is_table_path(view.cover_choice.table)) paths.push_back(&view.cover_choice.table);
    for (std::string& file : view.canopy_choice.files) paths.push_back(&file);
    return paths;
}

}  // namespace

Result<View> view_as_written_in(const View& view, const std::string& picture) {
    View written = view;
    written.paths_from_own_file = true;
    if (!written.tells_paths) {
        written.region.paths.clear();
        if (written.fingerprints) {
            for (Fingerprints::OfSource& source : written.fingerprints->sources) source.name.clear();
            for (Fingerprints::OfSource& image : written.fingerprints->images) image.name.clear();
            for (Fingerprints::OfSource& cover : written.fingerprints->cover) cover.name.clear();
            for (Fingerprints::OfSource& canopy : written.fingerprints->canopy) canopy.name.clear();
            for (Fingerprints::OfSource& vectors : written.fingerprints->vectors) vectors.name.clear();
        }
        for (std::string& image : written.drape) image = fs::path(image).filename().string();
        for (std::string* const file : cover_paths(written)) *file = fs::path(*file).filename().string();
        for (std::string* const file : written.vectors.paths()) *file = fs::path(*file).filename().string();
        for (std::string& mesh : written.region.meshes.files) mesh = fs::path(mesh).filename().string();
        if (is_style_path(written.style)) written.style = fs::path(written.style).filename().string();
        return written;
    }
    const fs::path parent = fs::path(picture).parent_path();
    ORO_TRY(const fs::path folder, without_links(parent.empty() ? fs::path(".") : parent));
    if (folder.empty()) {
        written.paths_from_own_file = false;
        return written;
    }
    for (std::string& path : written.region.paths) {
        ORO_TRY(path, from_folder(folder, path));
    }
    for (std::string& mesh : written.region.meshes.files) {
        ORO_TRY(mesh, from_folder(folder, mesh));
    }
    for (std::string& image : written.drape) {
        ORO_TRY(image, from_folder(folder, image));
    }
    for (std::string* const file : cover_paths(written)) {
        ORO_TRY(*file, from_folder(folder, *file));
    }
    for (std::string* const file : written.vectors.paths()) {
        ORO_TRY(*file, from_folder(folder, *file));
    }
    if (is_style_path(written.style)) {
        ORO_TRY(written.style, from_folder(folder, written.style));
    }
    return written;
}

Result<void> lead_from_working_folder(View& view, const std::string& file) {
    if (!view.paths_from_own_file) return {};
    view.paths_from_own_file = false;
    const fs::path folder = fs::path(file).parent_path();
    const auto lead = [&](std::string& path) -> Result<void> {
        if (fs::path(path).is_absolute()) return {};
        const std::string joined = (folder / path).string();
        ORO_TRY(const bool plain, is_plain_path(joined));
        if (plain || path.find(':') == std::string::npos) path = joined;
        return {};
    };
    for (std::string& path : view.region.paths) ORO_CHECK(lead(path));
    for (std::string& mesh : view.region.meshes.files) ORO_CHECK(lead(mesh));
    for (std::string& image : view.drape) ORO_CHECK(lead(image));
    for (std::string* const path : cover_paths(view)) ORO_CHECK(lead(*path));
    for (std::string* const path : view.vectors.paths()) ORO_CHECK(lead(*path));
    if (is_style_path(view.style)) ORO_CHECK(lead(view.style));
    return {};
}

}  // namespace oro
