#include "apps/fetch/places_fetching.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/vectors/named_points.h"

namespace oro {
namespace {

// A server counts and sorts before it sends the first byte.
constexpr double answer_s = 200.0;

std::string word_of(const nlohmann::json& tags, const char* name) {
    const auto found = tags.find(name);
    return found != tags.end() && found->is_string() ? found->get<std::string>() : "";
}

// What an answer is that is no JSON.
std::string instead_of_json(const std::string& answer) {
    const std::size_t at = answer.find_first_not_of(" \t\r\n");
    if (at == std::string::npos) return "the answer is empty";
    if (answer.starts_with("\x1f\x8b")) return "the answer is packed (gzip), which was not asked for";
    if (answer[at] == '<') return "the answer is a page of the web or XML, and no JSON";
    return "";
}

nlohmann::ordered_json properties_of(const nlohmann::json& tags, const std::string& name) {
    nlohmann::ordered_json properties = json_object("name", name);
    if (const auto ele_m = metres_from(word_of(tags, "ele"))) properties["ele"] = *ele_m;
    for (const char* const field : {"natural", "place", "population", "prominence", "mountain_pass"})
        if (const std::string word = word_of(tags, field); !word.empty()) properties[field] = word;
    return properties;
}

}  // namespace

void PlacesFound::add_element(const nlohmann::json& element) {
    const auto tags = element.is_object() ? element.find("tags") : element.end();
    const std::string name =
        element.is_object() && tags != element.end() && tags->is_object() ? word_of(*tags, "name") : "";
    if (name.empty() || word_of(element, "type") != "node") {
        ++left_out_;
        return;
    }
    const std::int64_t id = json_whole(element, "id", 0, std::numeric_limits<std::int64_t>::max());
    const double lat_deg = json_number(element, "lat", -90.0, 90.0);
    const double lon_deg = json_number(element, "lon", -180.0, 180.0);
    if (!ids_.insert(id).second) return;
    Found& found = places_.emplace_back();
    found.id = id;
    found.ele_m = metres_from(word_of(*tags, "ele")).value_or(-std::numeric_limits<double>::infinity());
    found.feature = json_object("type", "Feature", "id", "node/" + std::to_string(id), "geometry",
                                json_object("type", "Point", "coordinates", json_list(lon_deg, lat_deg)),
                                "properties", properties_of(*tags, name));
}

Result<void> PlacesFound::add(const std::string& answer, const std::string& shown) {
    const auto wrong = [&](const std::string& what) { return Error{ErrorKind::failed, shown, what}; };
    if (const std::string instead = instead_of_json(answer); !instead.empty()) return wrong(instead);
    try {
        const nlohmann::json json = parsed_json(answer);
        const nlohmann::json& elements = json_field(json, "elements");
        if (!elements.is_array()) return wrong("'elements' of the answer is no list");
        // What is there then is not all; the server sends it with 200.
        if (const std::string remark = word_of(json, "remark"); !remark.empty())
            return wrong("the server did not finish: " + remark + " (a smaller box may help)");
        for (const nlohmann::json& element : elements) add_element(element);
        const auto about = json.find("osm3s");
        const std::string time =
            about != json.end() && about->is_object() ? word_of(*about, "timestamp_osm_base") : "";
        if (time_.empty() || (!time.empty() && time < time_)) time_ = time;
        return {};
    } catch (const JsonFault& fault) {
        return wrong("the answer is cut, or is none of an Overpass server: " + fault.what);
    } catch (const nlohmann::json::exception& fault) {
        return wrong(std::string("the answer is cut, or is none of an Overpass server: ") + fault.what());
    }
}

std::string PlacesFound::geojson(const PlacesSource& source, const std::vector<BoundingBox>& boxes) const {
    std::vector<const Found*> sorted;
    for (const Found& found : places_) sorted.push_back(&found);
    std::ranges::sort(sorted, {}, [](const Found* one) { return std::tuple(-one->ele_m, one->id); });
    nlohmann::ordered_json areas = json_list();
    for (const BoundingBox& box : boxes)
        areas.push_back(json_list(box.west_deg, box.south_deg, box.east_deg, box.north_deg));
    const nlohmann::ordered_json collection =
        json_object("type", "FeatureCollection", "licence", source.licence, "attribution", source.attribution,
                    "source", source.url, "query", source.query, "boxes", areas, "time", time_);
    // A feature a line, so that people find their way.
    std::string text = json_text(collection, false);
    text.back() = ',';
    text += "\n\"features\": [";
    const char* before = "\n";
    for (const Found* const found : sorted) {
        text += before + json_text(found->feature, false);
        before = ",\n";
    }
    return text + "\n]}\n";
}

Result<PlacesFound> fetch_places(const PlacesSource& source, const std::vector<BoundingBox>& boxes,
                                 const std::string& path, const FetchLimits& limits) {
    FetchLimits patient = limits;
    patient.transfer.most_bytes = source.most_bytes;
    patient.transfer.stall_s = std::max(patient.transfer.stall_s, answer_s);
    PlacesFound found;
    for (const BoundingBox& box : boxes) {
        const std::string url = url_of(source, box);
        Result<std::string> answer =
            fetch_text(url, path, patient, [](const std::string&) { return Result<void>(); });
        // The query makes the address long, and says nothing to people.
        if (!answer.ok() && answer.error().where == url)
            return Error{answer.error().kind, source.url, answer.error().what};
        if (!answer.ok()) return answer.error();
        ORO_CHECK(found.add(*answer, source.url));
    }
    return found;
}

}  // namespace oro
