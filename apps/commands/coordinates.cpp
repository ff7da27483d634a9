#include "apps/commands/coordinates.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/view/view.h"
#include "core/base/file_there.h"
#include "geo/coordinates/crs_places.h"
#include "geo/opening/source_crs.h"

namespace oro {
namespace {

// An option's text that holds a place.
struct PlaceText {
    const char* option;  // "--at"
    std::string* text;
};

std::string degrees_text(std::initializer_list<double> angles_deg) {
    std::string all;
    for (const double angle_deg : angles_deg) {
        char text[40];
        // 0.1 micrometres.
        std::snprintf(text, sizeof text, "%.12f", angle_deg);
        all += (all.empty() ? "" : ",") + std::string(text);
    }
    return all;
}

Result<CrsPlaces> crs_named(const RegionOptions& region) {
    const bool is_of_source = region.coordinates == "source";
    std::string crs = region.coordinates;
    if (is_of_source) {
        RegionOptions whole = region;
        whole.bbox.clear();
        ORO_TRY(const RegionRequest request, region_request(whole));
        ORO_TRY(crs, one_source_crs(request));
    }
    // Where the data lie in their CRS, people may look, too.
    Result<CrsPlaces> places =
        CrsPlaces::of(crs, is_of_source ? CrsPlaces::Reach::anywhere : CrsPlaces::Reach::area_of_use);
    if (!places.ok()) return refused("--coordinates", region.coordinates, places.error().what);
    return places;
}

// Coordinates become degrees; other forms of places stay.
Result<void> take_place(const CrsPlaces& places, const PlaceText& place) {
    const auto coordinates = two_coordinates(*place.text);
    if (!coordinates) return {};
    const Result<Place> there = places.place((*coordinates)[0], (*coordinates)[1]);
    const bool may_be_degrees =
        places.is_projected() && std::abs((*coordinates)[0]) <= 90.0 && std::abs((*coordinates)[1]) <= 180.0;
    if (!there.ok())
        return refused(
            place.option, *place.text,
            there.error().what + (may_be_degrees ? "; if these are degrees, leave --coordinates out" : ""));
    *place.text = degrees_text({there->lat_deg, there->lon_deg});
    return {};
}

Result<void> take_box(const CrsPlaces& places, std::string& text) {
    const auto sides = four_coordinates(text);
    if (!sides) return refused("--bbox", text, "needs four numbers: XMIN,YMIN,XMAX,YMAX in " + places.name());
    const Result<BoundingBox> box = places.box((*sides)[0], (*sides)[1], (*sides)[2], (*sides)[3]);
    if (!box.ok()) return refused("--bbox", text, box.error().what);
    text = degrees_text({box->west_deg, box->south_deg, box->east_deg, box->north_deg});
    return {};
}

// All of one command. keeps: a command that goes on without a place or a box.
Result<void> take(RegionOptions& region, const std::vector<PlaceText>& texts, bool keeps = false) {
    if (region.coordinates.empty()) return {};
    const bool is_needed = !region.bbox.empty() || !texts.empty();
    if (!is_needed && !keeps)
        return refused("--coordinates", region.coordinates, "says nothing without a place or --bbox");
    if (is_needed || region.coordinates != "source") {
        ORO_TRY(const CrsPlaces places, crs_named(region));
        for (const PlaceText& place : texts) ORO_CHECK(take_place(places, place));
        if (!region.bbox.empty()) ORO_CHECK(take_box(places, region.bbox));
    }
    region.coordinates.clear();
    return {};
}

std::vector<PlaceText> places_of(ViewOptions& view) {
    std::vector<PlaceText> all;
    if (view.at) all.push_back({"--at", &*view.at});
    if (view.look_at) all.push_back({"--look-at", &*view.look_at});
    return all;
}

// A list of places with ; between them; a file's name stays.
Result<void> take_along(ProfileOptions& options) {
    std::vector<std::string> words;
    ORO_TRY(const bool is_file, is_there(options.along));
    const bool is_list = !is_file && options.along.find(';') != std::string::npos;
    for (std::size_t begin = 0; is_list && begin <= options.along.size();) {
        const std::size_t end = std::min(options.along.find(';', begin), options.along.size());
        words.push_back(options.along.substr(begin, end - begin));
        begin = end + 1;
    }
    std::vector<PlaceText> texts;
    for (std::string& word : words) texts.push_back({"--along", &word});
    ORO_CHECK(take(options.region, texts));
    if (!is_list) return {};
    options.along.clear();
    for (const std::string& word : words) options.along += (&word == words.data() ? "" : ";") + word;
    return {};
}

}  // namespace

Result<void> take_coordinates(CommandLine& line) {
    line.view.coordinates = line.view.region.coordinates;
    ORO_CHECK(take(line.view.region, places_of(line.view.view), true));
    ORO_CHECK(take(line.shot.region, places_of(line.shot.view)));
    ORO_CHECK(take(line.panorama.region, places_of(line.panorama.view)));
    ORO_CHECK(take(line.plan.region, places_of(line.plan.view)));
    ORO_CHECK(take(line.trade.region, places_of(line.trade.view)));
    ORO_CHECK(take(line.sun.region, places_of(line.sun.view)));
    ORO_CHECK(take(line.sight.region, {{"--from", &line.sight.from}, {"--to", &line.sight.to}}));
    if (!line.profile.region.coordinates.empty()) ORO_CHECK(take_along(line.profile));
    std::vector<PlaceText> observers;
    for (std::string& at : line.viewshed.at) observers.push_back({"--at", &at});
    ORO_CHECK(take(line.viewshed.region, observers));
    ORO_CHECK(take(line.horizon.region, {}));
    ORO_CHECK(take(line.film.region, {}));
    ORO_CHECK(take(line.compare.region, {}));
    ORO_CHECK(take(line.bake.region, {}));
    ORO_CHECK(take(line.exporting.region, {}));
    return take(line.info.region, {});
}

}  // namespace oro
