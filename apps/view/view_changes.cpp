#include "apps/view/view_changes.h"

#include <algorithm>

#include "apps/report/figures.h"
#include "apps/report/progress_bar.h"
#include "geo/files/letter_case.h"
#include "geo/pixels/picture_difference.h"

namespace oro {
namespace {

using OfSource = Fingerprints::OfSource;

constexpr std::size_t most_named = 8;

// Takes the pairs that `same` finds out of both lists, and hands them on.
template <class Same, class Paired>
void take_pairs(std::vector<OfSource>& told, std::vector<OfSource>& here, Same same, Paired paired) {
    for (auto one = told.begin(); one != told.end();) {
        const auto other =
            std::ranges::find_if(here, [&](const OfSource& source) { return same(*one, source); });
        if (other == here.end()) {
            ++one;
            continue;
        }
        paired(*one);
        here.erase(other);
        one = told.erase(one);
    }
}

// The sources that are to blame for another region. Those of the same posts are the same, whatever they are
// called now. On another grid all posts are laid otherwise: there only a name tells anything.
std::vector<Error> sources_that_changed(const Fingerprints& told, const Fingerprints& here,
                                        const std::string& file) {
    std::vector<OfSource> was = told.sources, is = here.sources;
    std::vector<Error> lines;
    const bool same_grid = told.grid == here.grid;
    const auto named_alike = [](const OfSource& a, const OfSource& b) {
        return !a.name.empty() && a.name == b.name;
    };
    take_pairs(
        was, is, [](const OfSource& a, const OfSource& b) { return a.posts && a.posts == b.posts; },
        [](const OfSource&) {});
    take_pairs(was, is, named_alike, [&](const OfSource& source) {
        if (same_grid)
            lines.push_back({ErrorKind::failed, source.name,
                             "its heights are others than those that " + file + " was drawn from"});
    });
    // Without names on one side, what is left over tells nothing.
    const auto nameless = [](const OfSource& source) { return source.name.empty(); };
    if (std::ranges::any_of(was, nameless) || std::ranges::any_of(is, nameless)) return lines;
    for (const OfSource& source : was)
        lines.push_back({ErrorKind::failed, source.name,
                         "is not among the data, and " + file + " was drawn from it, too"});
    for (const OfSource& source : is)
        lines.push_back(
            {ErrorKind::failed, source.name, "is among the data, and " + file + " was drawn without it"});
    return lines;
}

void add_data(const Fingerprints& told, const Fingerprints& here, const std::string& file,
              std::vector<Change>& changes) {
    if (!told.posts || !here.posts || *told.posts == *here.posts) return;
    std::vector<Error> lines = sources_that_changed(told, here, file);
    if (lines.empty())
        lines.push_back({ErrorKind::failed, file,
                         told.grid == here.grid ? "was drawn from other heights than its data have now"
                                                : "was drawn from another grid of posts than its data make "
                                                  "now"});
    if (lines.size() > most_named) {
        const std::size_t more = lines.size() - most_named;
        lines.resize(most_named);
        lines.push_back({ErrorKind::failed, file, counted(more, "more source", "more sources") + " changed"});
    }
    for (Error& line : lines) changes.push_back({ChangeOf::data, std::move(line)});
}

void add_geoid(const Fingerprints& told, const Fingerprints& here, const std::string& file,
               std::vector<Change>& changes) {
    if (told.undulation == here.undulation) return;
    if (told.grid != here.grid) return;  // another place has another N
    const std::string what = told.geoid == here.geoid
                                 ? "the geoid grid is another than " + file +
                                       " was drawn with: " + here.geoid + " has other heights"
                                 : "the geoid is another than " + file + " was drawn with: that was " +
                                       told.geoid + ", this is " + here.geoid;
    changes.push_back({ChangeOf::geoid, {ErrorKind::failed, "geoid", what}});
}

// Files that a view names one by one: images, vectors.
void add_files(const std::vector<OfSource>& told, const std::vector<OfSource>& here, const std::string& what,
               const std::string& file, std::vector<Change>& changes) {
    for (std::size_t i = 0; i < std::min(told.size(), here.size()); ++i) {
        const OfSource &was = told[i], &is = here[i];
        if (was.posts == is.posts) continue;
        changes.push_back({ChangeOf::data,
                           {ErrorKind::failed, is.name.empty() ? was.name : is.name,
                            "is another " + what + " than the one that " + file + " was drawn with"}});
    }
}

// What nobody can tell any more, or nobody could ever.
std::string unknown_of(const View& view) {
    const std::string cannot = ": whether its data are those that it was drawn from cannot be checked";
    if (!view.told->prints) return view.told->file + ": carries no fingerprints" + cannot;
    if (!view.told->prints->posts)
        return view.told->file + ": was drawn from a region baked before there were fingerprints" + cannot;
    if (!view.prints->posts)
        return view.told->file + ": the data are a region baked before there were fingerprints" + cannot;
    return "";
}

// The pixels of a picture that keeps them; a note, whatever stands in the way of reading them.
std::string edited_pixels(const View& view) {
    const ToldView& told = *view.told;
    if (!is_from_picture(view) || !told.prints || !told.prints->pixels) return "";
    const auto print = print_of_pixels(told.file, told.width_px, told.height_px);
    if (!print.ok()) return print.error().line();
    if (!*print || **print == *told.prints->pixels) return "";
    return told.file + ": its pixels were changed after it was drawn";
}

void say_unknown(const View& view, bool quiet) {
    if (const std::string unknown = unknown_of(view); !unknown.empty()) say(quiet, "note: " + unknown);
}

// True where none of the sources that a view was drawn from has been found, by its posts or by its name, and
// the grid is another: what somebody named are data of another place.
bool shares_no_source(const Fingerprints& told, const Fingerprints& here) {
    const auto alike = [](const OfSource& a, const OfSource& b) {
        return (!a.name.empty() && a.name == b.name) || (a.posts && a.posts == b.posts);
    };
    const auto is_there = [&](const OfSource& source) {
        return std::ranges::any_of(here.sources, [&](const OfSource& other) { return alike(source, other); });
    };
    return told.grid != here.grid && !told.sources.empty() && std::ranges::none_of(told.sources, is_there);
}

}  // namespace

bool is_from_picture(const View& view) {
    return view.told && !lower_case(view.told->file).ends_with(".json");
}

std::vector<Change> changes_of(const View& view) {
    std::vector<Change> changes;
    if (!view.told || !view.told->prints || !view.prints) return changes;
    const Fingerprints &told = *view.told->prints, &here = *view.prints;
    add_data(told, here, view.told->file, changes);
    add_geoid(told, here, view.told->file, changes);
    add_files(told.images, here.images, "image", view.told->file, changes);
    add_files(told.vectors, here.vectors, "vector file", view.told->file, changes);
    if (told.program != here.program)
        changes.push_back({ChangeOf::program,
                           {ErrorKind::failed, view.told->file,
                            "was drawn by version " + told.program + " of the program, and this is " +
                                here.program + ": pixels may differ by rounding"}});
    return changes;
}

void say_changes(const View& view, bool quiet) {
    if (!view.told) return;
    for (const Change& change : changes_of(view)) say(quiet, "note: " + change.line.line());
    say_unknown(view, quiet);
    say_edited(view, quiet);
}

void say_edited(const View& view, bool quiet) {
    if (const std::string edited = edited_pixels(view); !edited.empty()) say(quiet, "note: " + edited);
}

Result<void> check_unchanged(View& view, const Region& region, bool data_changed, bool quiet) {
    if (!view.told) return {};
    if (view.told->prints && view.told->prints->data_changed) view.prints->data_changed = true;
    std::vector<Error> refused;
    for (const Change& change : changes_of(view)) {
        if (change.of == ChangeOf::program || data_changed)
            say(quiet, "note: " + change.line.line());
        else
            refused.push_back(change.line);
        if (change.of != ChangeOf::program) view.prints->data_changed = true;
    }
    say_unknown(view, quiet);
    if (refused.empty()) return {};
    if (shares_no_source(*view.told->prints, *view.prints))
        ORO_CHECK(nothing_in_view(view, region, view.told->file));
    for (std::size_t i = 0; i + 1 < refused.size(); ++i) say(false, refused[i].line());
    refused.back().what += " (--data-changed goes on)";
    return refused.back();
}

}  // namespace oro
