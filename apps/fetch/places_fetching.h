// Named places from servers that search OpenStreetMap, as GeoJSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "geo/fetch/fetch_file.h"
#include "geo/fetch/places_source.h"

namespace oro {

// Places of OpenStreetMap from answers of a server of the Overpass API.
class PlacesFound {
  public:
    // Adds the places of an answer (JSON), each element of OpenStreetMap once. What has no name, or is no
    // point, is left out. Errors (failed, `shown` stands for the answer): what it is instead (a page of the
    // web, packed, cut); one in which the server says that it did not finish.
    Result<void> add(const std::string& answer, const std::string& shown);
    [[nodiscard]] std::size_t count() const { return places_.size(); }
    [[nodiscard]] std::size_t left_out() const { return left_out_; }
    // A FeatureCollection: points with `name`, `ele` (metres above the sea, where it is a number of them),
    // `natural`, `place`, `population`, `prominence` and `mountain_pass`, the highest first; and, beside
    // `features`, whence they come: `licence`, `attribution`, `source`, `query`, `boxes`, and `time`, that of
    // the data.
    [[nodiscard]] std::string geojson(const PlacesSource& source,
                                      const std::vector<BoundingBox>& boxes) const;

  private:
    struct Found {
        double ele_m{};  // for the order; lowest where it is not known
        std::int64_t id{};
        nlohmann::ordered_json feature;
    };
    void add_element(const nlohmann::json& element);

    std::vector<Found> places_;
    std::set<std::int64_t> ids_;
    std::size_t left_out_{};
    std::string time_;  // of the oldest answer
};

// Asks for the places in boxes, none of which crosses the antimeridian, one request after the other. While an
// answer comes, it lies beside `path`. Errors: the server's, after all retries; those of an answer.
Result<PlacesFound> fetch_places(const PlacesSource& source, const std::vector<BoundingBox>& boxes,
                                 const std::string& path, const FetchLimits& limits);

}  // namespace oro
