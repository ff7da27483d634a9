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
void take_pairs(std::vector<OfSource>& recorded, std::vector<OfSource>& here, Same same, Paired paired) {
    for (auto one = recorded.begin(); one != recorded.end();) {
        const auto other =
            std::ranges::find_if(here, [&](const OfSource& source) { return same(*one, source); });
        if (other == here.end()) {
            ++one;
            continue;
        }
        paired(*one);
        here.erase(other);
        one = recorded.erase(one);
    }
}

// The sources that are to blame for another region. Those of the same posts are the same, whatever they are
// called now. On another grid all posts are laid otherwise: there only a name tells anything.
std::vector<Error> sources_that_changed(const Fingerprints& recorded, const Fingerprints& here,
                                        const std::string& file) {
    std::vector<OfSource> was = recorded.sources, is = here.sources;
    std::vector<Error> lines;
    const bool same_grid = recorded.grid == here.grid;
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

void add_data(const Fingerprints& recorded, const Fingerprints& here, const std::string& file,
              std::vector<Change>& changes) {
    if (!recorded.posts || recorded.posts == here.posts) return;
    std::vector<Error> lines = sources_that_changed(recorded, here, file);
    if (lines.empty())
        lines.push_back({ErrorKind::failed, file,
                         recorded.grid == here.grid
                             ? "was drawn from other heights than its data have now"
                             : "was drawn from another grid of posts than its data make "
                               "now"});
    if (lines.size() > most_named) {
        const std::size_t more = lines.size() - most_named;
        lines.resize(most_named);
        lines.push_back({ErrorKind::failed, file, counted(more, "more source", "more sources") + " changed"});
    }
    for (Error& line : lines) changes.push_back({ChangeOf::data, std::move(line)});
}

void add_geoid(const Fingerprints& recorded, const Fingerprints& here, const std::string& file,
               std::vector<Change>& changes) {
    if (recorded.undulation == here.undulation) return;
    if (recorded.grid != here.grid) return;  // another place has another N
    const std::string what = recorded.geoid == here.geoid
                                 ? "the geoid grid is another than " + file +
                                       " was drawn with: " + here.geoid + " has other heights"
                                 : "the geoid is another than " + file + " was drawn with: that was " +
                                       recorded.geoid + ", this is " + here.geoid;
    changes.push_back({ChangeOf::geoid, {ErrorKind::failed, "geoid", what}});
}

// Files that a view names one by one: images, vectors.
void add_files(const std::vector<OfSource>& recorded, const std::vector<OfSource>& here,
               const std::string& what, const std::string& file, std::vector<Change>& changes) {
    for (std::size_t i = 0; i < std::min(recorded.size(), here.size()); ++i) {
        const OfSource &was = recorded[i], &is = here[i];
        if (was.posts == is.posts) continue;
        changes.push_back({ChangeOf::data,
                           {ErrorKind::failed, is.name.empty() ? was.name : is.name,
                            "is another " + what + " than the one that " + file + " was drawn with"}});
    }
}

// What nobody can tell any more, or nobody could ever.
std::string unknown_of(const View& view) {
    const std::string cannot = ": whether its data are those that it was drawn from cannot be checked";
    const std::optional<Fingerprints>& recorded = view.recorded->fingerprints;
    return recorded && recorded->posts ? "" : view.recorded->file + ": carries no fingerprints" + cannot;
}

// The pixels of a picture that keeps them; a note, whatever stands in the way of reading them.
std::string edited_pixels(const View& view) {
    const RecordedView& recorded = *view.recorded;
    if (!is_from_picture(view) || !recorded.fingerprints || !recorded.fingerprints->pixels) return "";
    const auto fingerprint = fingerprint_of_pixels(recorded.file, recorded.width_px, recorded.height_px);
    if (!fingerprint.ok()) return fingerprint.error().line();
    if (!*fingerprint || **fingerprint == *recorded.fingerprints->pixels) return "";
    return recorded.file + ": its pixels were changed after it was drawn";
}

void say_unknown(const View& view, bool quiet) {
    if (const std::string unknown = unknown_of(view); !unknown.empty()) say(quiet, "note: " + unknown);
}

// True where none of the sources that a view was drawn from has been found, by its posts or by its name, and
// the grid is another: what somebody named are data of another place.
bool shares_no_source(const Fingerprints& recorded, const Fingerprints& here) {
    const auto alike = [](const OfSource& a, const OfSource& b) {
        return (!a.name.empty() && a.name == b.name) || (a.posts && a.posts == b.posts);
    };
    const auto is_there = [&](const OfSource& source) {
        return std::ranges::any_of(here.sources, [&](const OfSource& other) { return alike(source, other); });
    };
    return recorded.grid != here.grid && !recorded.sources.empty() &&
           std::ranges::none_of(recorded.sources, is_there);
}

}  // namespace

bool is_from_picture(const View& view) {
    return view.recorded && !lower_case(view.recorded->file).ends_with(".json");
}

std::vector<Change> changes_of(const View& view) {
    std::vector<Change> changes;
    if (!view.recorded || !view.recorded->fingerprints || !view.fingerprints) return changes;
    const Fingerprints &recorded = *view.recorded->fingerprints, &here = *view.fingerprints;
    add_data(recorded, here, view.recorded->file, changes);
    add_geoid(recorded, here, view.recorded->file, changes);
    add_files(recorded.images, here.images, "image", view.recorded->file, changes);
    add_files(recorded.cover, here.cover, "land cover", view.recorded->file, changes);
    add_files(recorded.canopy, here.canopy, "canopy", view.recorded->file, changes);
    add_files(recorded.vectors, here.vectors, "vector file", view.recorded->file, changes);
    if (recorded.program != here.program)
        changes.push_back({ChangeOf::program,
                           {ErrorKind::failed, view.recorded->file,
                            "was drawn by version " + recorded.program + " of the program, and this is " +
                                here.program + ": pixels may differ by rounding"}});
    return changes;
}

void say_changes(const View& view, bool quiet) {
    if (!view.recorded) return;
    for (const Change& change : changes_of(view)) say(quiet, "note: " + change.line.line());
    say_unknown(view, quiet);
    say_edited(view, quiet);
}

void say_edited(const View& view, bool quiet) {
    if (const std::string edited = edited_pixels(view); !edited.empty()) say(quiet, "note: " + edited);
}

Result<void> check_unchanged(View& view, const Region& region, bool data_changed, bool quiet) {
    if (!view.recorded) return {};
    if (view.recorded->fingerprints && view.recorded->fingerprints->data_changed)
        view.fingerprints->data_changed = true;
    std::vector<Error> refused;
    for (const Change& change : changes_of(view)) {
        if (change.of == ChangeOf::program || data_changed)
            say(quiet, "note: " + change.line.line());
        else
            refused.push_back(change.line);
        if (change.of != ChangeOf::program) view.fingerprints->data_changed = true;
    }
    say_unknown(view, quiet);
    if (refused.empty()) return {};
    if (shares_no_source(*view.recorded->fingerprints, *view.fingerprints))
        ORO_CHECK(nothing_in_view(view, region, view.recorded->file));
    for (std::size_t i = 0; i + 1 < refused.size(); ++i) say(false, refused[i].line());
    refused.back().what += " (--data-changed goes on)";
    return refused.back();
}

}  // namespace oro
