#include "apps/commands/coordinates.h"

#include <cmath>
#include <string>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/place_texts.h"
#include "apps/view/view.h"
#include "geo/coordinates/crs_places.h"
#include "geo/opening/source_crs.h"

namespace oro {
namespace {

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

// A list of places with ; between them; a file's name stays.
Result<void> take_along(ProfileOptions& options) {
    ORO_TRY(AlongTexts along, AlongTexts::of(options.along));
    ORO_CHECK(take(options.region, along.texts()));
    options.along = along.joined();
    return {};
}

}  // namespace

Result<void> take_coordinates(CommandLine& line) {
    line.view.coordinates = line.view.region.coordinates;
    ORO_CHECK(take(line.view.region, place_texts_of(line.view.view), true));
    ORO_CHECK(take(line.shot.region, place_texts_of(line.shot.view)));
    ORO_CHECK(take(line.panorama.region, place_texts_of(line.panorama.view)));
    ORO_CHECK(take(line.plan.region, place_texts_of(line.plan.view)));
    ORO_CHECK(take(line.trade.region, place_texts_of(line.trade.view)));
    ORO_CHECK(take(line.sun.region, place_texts_of(line.sun.view)));
    ORO_CHECK(take(line.sight.region, {{"--from", &line.sight.from}, {"--to", &line.sight.to}}));
    if (!line.profile.region.coordinates.empty()) ORO_CHECK(take_along(line.profile));
    std::vector<PlaceText> observers;
    for (std::string& at : line.viewshed.at) observers.push_back({"--at", &at});
    ORO_CHECK(take(line.viewshed.region, observers));
    std::vector<PlaceText> around;
    if (!line.horizon.at.empty()) around.push_back({"--at", &line.horizon.at});
    ORO_CHECK(take(line.horizon.region, around));
    ORO_CHECK(take(line.film.region, {}));
    ORO_CHECK(take(line.compare.region, {}));
    ORO_CHECK(take(line.bake.region, {}));
    ORO_CHECK(take(line.exporting.region, {}));
    return take(line.info.region, {});
}

}  // namespace oro
