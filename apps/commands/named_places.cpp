#include "apps/commands/named_places.h"

#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/place_texts.h"
#include "apps/report/progress_bar.h"
#include "apps/search/gazetteer.h"
#include "apps/search/place_by_name.h"
#include "geo/places/place.h"

namespace oro {
namespace {

// Whose names stand for places.
struct NameFiles {
    std::vector<std::string> names;
    std::string names_field{"name"};
    std::vector<std::string> gazetteers;

    [[nodiscard]] bool empty() const { return names.empty() && gazetteers.empty(); }
    // "peaks.geojson", "peaks.geojson and 2 files more"
    [[nodiscard]] std::string words() const {
        const std::string& first = names.empty() ? gazetteers.front() : names.front();
        const std::size_t more = names.size() + gazetteers.size() - 1;
        return std::filesystem::path(first).filename().string() +
               (more == 0 ? std::string() : " and " + std::to_string(more) + " more");
    }
};

// The places of the files, read when they are first asked for.
class PlacesOfFiles {
  public:
    explicit PlacesOfFiles(NameFiles files) : files_(std::move(files)) {}

    [[nodiscard]] const NameFiles& files() const { return files_; }
    Result<const std::vector<SearchPlace>*> places() {
        if (read_) return &*read_;
        std::vector<SearchPlace> all;
        const auto add = [&](std::vector<SearchPlace>&& more) {
            all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
        };
        for (const std::string& file : files_.names) {
            ORO_TRY(std::vector<SearchPlace> more, read_named_places(file, files_.names_field));
            add(std::move(more));
        }
        for (const std::string& file : files_.gazetteers) {
            ORO_TRY(Gazetteer more, read_gazetteer(file));
            add(std::move(more.places));
        }
        read_ = std::move(all);
        return &*read_;
    }

  private:
    NameFiles files_;
    std::optional<std::vector<SearchPlace>> read_;
};

constexpr const char* way_to_names =
    "names need --names FILE, which holds them: a GPX, a GeoJSON, or what orograph fetch --source peaks gets";

void tell_found(const PlaceText& place, const SearchPlace& found, bool quiet) {
    char at[80];
    std::snprintf(at, sizeof at, "%.5f,%.5f", found.lat_deg, found.lon_deg);
    say(quiet, "note: " + std::string(place.option) + " " + *place.text + ": taken for " + found.name +
                   ", at " + at);
}

// A text that is no place, or one that a name may be meant by, too.
Result<void> take_name(PlacesOfFiles& names, const PlaceText& place, bool quiet) {
    const Result<Place> read = parse_place(*place.text, way_to_names);
    const bool is_short_geohash =
        read.ok() && read->form == "geohash" && place.text->find(':') == std::string::npos;
    if ((read.ok() && !is_short_geohash) || !may_be_name(*place.text)) return {};
    if (names.files().empty() && read.ok()) return {};
    if (names.files().empty()) return refused(place.option, *place.text, read.error().what);
    ORO_TRY(const std::vector<SearchPlace>* const places, names.places());
    const Result<NamedPlaceFound> found = place_by_name(*place.text, *places, names.files().words());
    if (read.ok() && !(found.ok() && found->is_whole)) return {};
    if (!found.ok()) return refused(place.option, *place.text, found.error().what);
    if (!found->is_whole) tell_found(place, found->place, quiet);
    *place.text = degrees_text({found->place.lat_deg, found->place.lon_deg});
    return {};
}

Result<void> take_names(NameFiles files, const std::vector<PlaceText>& texts, bool quiet) {
    PlacesOfFiles names(std::move(files));
    for (const PlaceText& place : texts)
        if (!place.text->empty()) ORO_CHECK(take_name(names, place, quiet));
    return {};
}

NameFiles name_files_of(const ViewOptions& view) {
    return {view.names, view.names_field.value_or("name"), {}};
}

Result<void> take_of_view(ViewOptions& view, bool quiet, std::vector<std::string> gazetteers = {}) {
    NameFiles files = name_files_of(view);
    files.gazetteers = std::move(gazetteers);
    return take_names(std::move(files), place_texts_of(view), quiet);
}

}  // namespace

Result<void> take_named_places(CommandLine& line) {
    ORO_CHECK(take_of_view(line.shot.view, line.shot.quiet));
    ORO_CHECK(take_of_view(line.panorama.view, line.panorama.quiet));
    ORO_CHECK(take_of_view(line.view.view, line.view.quiet, line.view.gazetteers));
    ORO_CHECK(take_of_view(line.plan.view, line.plan.quiet));
    ORO_CHECK(take_of_view(line.trade.view, line.trade.quiet));
    ORO_CHECK(take_of_view(line.sun.view, line.sun.quiet));
    line.sun.view.names.clear();  // it draws none
    ORO_CHECK(take_names(name_files_of(line.sight.view),
                         {{"--from", &line.sight.from}, {"--to", &line.sight.to}}, line.sight.quiet));
    std::vector<PlaceText> observers;
    for (std::string& at : line.viewshed.at) observers.push_back({"--at", &at});
    ORO_CHECK(take_names(name_files_of(line.viewshed.view), observers, line.viewshed.quiet));
    ORO_CHECK(take_names(name_files_of(line.horizon.view), {{"--at", &line.horizon.at}}, line.horizon.quiet));
    if (line.profile.along.empty()) return {};
    ORO_TRY(AlongTexts along, AlongTexts::of(line.profile.along));
    ORO_CHECK(take_names({line.profile.names, "name", {}}, along.texts(), line.profile.quiet));
    line.profile.along = along.joined();
    return {};
}

}  // namespace oro
