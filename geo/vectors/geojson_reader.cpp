#include "geo/vectors/vector_readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "geo/vectors/json_text.h"
#include "geo/vectors/layer_builder.h"
#include "geo/vectors/text_path.h"

namespace oro {
namespace {

using Kind = JsonValue::Kind;
using Members = std::vector<std::pair<std::string, JsonValue>>;

constexpr std::size_t geojson_looks_apart = 256;
constexpr const char* misfit = "geometries whose coordinates do not fit their type";
constexpr const char* unknown_kind = "geometries of a kind that is not known here";
constexpr const char* misplaced = "coordinates where there should be none";

const JsonValue* member(const Members& members, std::string_view name) {
    const auto found = std::ranges::find(members, name, &Members::value_type::first);
    return found == members.end() ? nullptr : &found->second;
}

bool is_nested(const JsonValue& value) {
    return value.is(Kind::array) || value.is(Kind::object);
}

bool has_nested(const JsonValue& list) {
    bool found = false;
    list.each([&](const JsonValue& one) { return !(found = is_nested(one)); });
    return found;
}

// The places of coordinates that may be nested in any way: lists that hold no list, and what stands beside
// lists.
std::size_t places_in(const JsonValue& coordinates) {
    if (!coordinates.is(Kind::array)) return coordinates.is(Kind::null) ? 0 : 1;
    if (!has_nested(coordinates)) {
        bool any = false;
        coordinates.each([&](const JsonValue&) { return !(any = true); });
        return any ? 1 : 0;
    }
    std::size_t all = 0;
    coordinates.each([&](const JsonValue& one) {
        all += std::max<std::size_t>(1, places_in(one));
        return true;
    });
    return all;
}

std::size_t places_within(const JsonValue& value);

// The places in a member of that name, if it is one of those that hold some.
std::size_t places_of_member(const std::string& name, const JsonValue& value) {
    if (name == "coordinates") return places_in(value);
    return name == "geometry" || name == "geometries" || name == "features" ? places_within(value) : 0;
}

// All places that are written anywhere where GeoJSON has some.
std::size_t places_within(const JsonValue& value) {
    std::size_t all = 0;
    for (const auto& [name, one] : value.members()) all += places_of_member(name, one);
    value.each([&](const JsonValue& one) {
        all += places_within(one);
        return true;
    });
    return all;
}

// Calls what(value) for each element of a list until it returns false; for what is no list, as if it were
// the only element of one.
template <class What>
void each_of(const JsonValue& list, What&& what) {
    if (list.is(Kind::array))
        list.each(what);
    else if (!list.is(Kind::null))
        what(list);
}

// Positions of more than three numbers that are taken without the others.
struct LongPositions {
    std::size_t count{};
    std::size_t first_at{};  // byte of the text
};

// Whether whole numbers are decimals that were written with commas: [10,1,45,8] for 10.1 and 45.8, of
// degrees; [10,1,45,8,400] and [10,1,45,8,400,5] with a height.
bool looks_like_decimal_commas(std::span<const std::string_view> words) {
    if (words.size() < 4 || words.size() > 6) return false;
    const auto is_whole = [](std::string_view word) {
        return word.find_first_not_of("0123456789-") == std::string_view::npos;
    };
    const bool parts_have_signs = words[1].starts_with('-') || words[3].starts_with('-') ||
                                  (words.size() == 6 && words[5].starts_with('-'));
    if (parts_have_signs || !std::ranges::all_of(words, is_whole)) return false;
    const double lon_deg = written_number(words[0]).value, lat_deg = written_number(words[2]).value;
    return std::abs(lon_deg) <= 180.0 && std::abs(lat_deg) <= 90.0;
}

void add_place(const JsonValue& value, TextPath& path, LongPositions& longer) {
    if (!value.is(Kind::array)) {
        path.add_fault(no_place::no_numbers, value.source().substr(0, 60), value.at());
        return;
    }
    if (has_nested(value)) {
        for (std::size_t i = places_in(value); i > 0; --i)
            path.add_fault(no_place::no_numbers, value.source().substr(0, 60), value.at());
        return;
    }
    constexpr std::size_t looked_at = 7;
    std::array<std::string_view, looked_at> words;
    std::size_t count = 0;
    value.each([&](const JsonValue& number) {
        words[count++] = number.source();
        return count < words.size();
    });
    if (looks_like_decimal_commas(std::span(words).first(count))) {
        path.add_fault(no_place::too_many, value.source().substr(0, 60), value.at());
        return;
    }
    if (count > 3 && longer.count++ == 0) longer.first_at = value.at();
    path.add(words[0], words[1], words[2], value.at());
}

// The places of a list; nothing where it is no list of lists.
bool path_in(const JsonValue& list, TextPath& path, LongPositions& longer) {
    if (!list.is(Kind::array)) return false;
    bool any = false;
    list.each([&](const JsonValue&) { return !(any = true); });
    if (any && !has_nested(list)) return false;
    list.each([&](const JsonValue& place) {
        add_place(place, path, longer);
        return path.size() <= most_vector_places;
    });
    return true;
}

class GeoJsonReader {
  public:
    GeoJsonReader(LayerBuilder& layer, FileWatch& watch, LeftOut& left_out)
        : layer_(layer), watch_(watch), left_out_(left_out) {}

    // A collection, a feature or a geometry, at the top or in a collection. False: it is to end.
    bool item(const JsonValue& value) {
        if (count_++ % geojson_looks_apart == 0 && watch_.spent()) return false;
        if (layer_.splitter().places() > most_vector_places) return false;
        const Members members = value.members();
        const JsonValue* const type_member = member(members, "type");
        const std::string type = type_member ? type_member->text() : "";
        if (type == "FeatureCollection" || (type != "Feature" && member(members, "features") != nullptr))
            return collection(members);
        if (type == "Feature" || member(members, "geometry") != nullptr)
            feature(value, members);
        else if (member(members, "coordinates") != nullptr || member(members, "geometries") != nullptr)
            bare_geometry(value);
        else
            left_out_.add("features that are none", {1, places_within(value), value.at(), ""});
        return true;
    }

    [[nodiscard]] const LongPositions& longer() const { return longer_; }

  private:
    bool collection(const Members& members) {
        bool goes_on = true;
        for (const auto& [name, value] : members) {
            if (!goes_on) break;
            if (name == "features")
                each_of(value, [&](const JsonValue& one) { return goes_on = item(one); });
            else
                leave_out_misplaced(name, value);
        }
        return goes_on;
    }

    // Coordinates that stand where none belong.
    void leave_out_misplaced(const std::string& name, const JsonValue& value) {
        const std::size_t places = places_of_member(name, value);
        if (places > 0) left_out_.add(misplaced, {places, places, value.at(), ""});
    }

    [[nodiscard]] ShapeTarget target() {
        const HeightAbove stated = layer_.splitter().heights();
        return layer_.target(stated == HeightAbove::nothing ? HeightAbove::ellipsoid : stated, left_out_);
    }

    void feature(const JsonValue& feature, const Members& members) {
        const ShapeTarget to = target();
        bool has_geometry = false;
        for (const auto& [name, value] : members) {
            if (name == "geometry" && !value.is(Kind::null)) {
                has_geometry = true;
                geometry(value, to);
            } else if (name == "properties") {
                for (const auto& [field, said] : value.members()) {
                    if (!field.empty()) layer_.number_of(field);  // one that is null is a field, too
                    layer_.say(field, said.is(Kind::number) ? without_power(said.words()) : said.words());
                }
            } else {
                leave_out_misplaced(name, value);
            }
        }
        if (!has_geometry) left_out_.add("features without a geometry", {1, 0, feature.at(), ""});
        if (const JsonValue* const id = member(members, "id")) layer_.say("id", id->words());
        layer_.end_record();
    }

    void bare_geometry(const JsonValue& value) {
        geometry(value, target());
        layer_.end_record();
    }

    void geometry(const JsonValue& value, const ShapeTarget& to) {
        const Members members = value.members();
        const JsonValue* const type_member = member(members, "type");
        const std::string type = type_member ? type_member->text() : "";
        static constexpr std::array simple{"Point",           "MultiPoint", "LineString",
                                           "MultiLineString", "Polygon",    "MultiPolygon"};
        const bool is_collection = type == "GeometryCollection";
        if (!is_collection && std::ranges::find(simple, type) == simple.end()) {
            const std::string word = type.empty() ? std::string(value.source().substr(0, 60)) : type;
            left_out_.add(unknown_kind, {1, places_within(value), value.at(), word});
            return;
        }
        bool has_any = false;
        for (const auto& [name, one] : members) {
            if (is_collection && name == "geometries") {
                each_of(one, [&](const JsonValue& part) {
                    geometry(part, to);
                    return has_any = true;
                });
            } else if (!is_collection && name == "coordinates" && !has_any) {
                has_any = true;
                coordinates(type, one, to);
            } else {
                leave_out_misplaced(name, one);
            }
        }
        if (!has_any) left_out_.add("geometries without coordinates", {1, 0, value.at(), ""});
    }

    void coordinates(const std::string& type, const JsonValue& list, const ShapeTarget& to) {
        bool any = false;
        list.each([&](const JsonValue&) { return !(any = true); });
        if (!any && (list.is(Kind::array) || list.is(Kind::null))) {
            left_out_.add("geometries without coordinates", {1, 0, list.at(), ""});
            return;
        }
        const std::string_view one = std::string_view(type).substr(type.starts_with("Multi") ? 5 : 0);
        if (one.size() == type.size()) {
            part(one, list, to);
        } else if (!list.is(Kind::array)) {
            left_out_.add(misfit, {1, places_in(list), list.at(), type});
        } else if (!has_nested(list)) {
            left_out_.add(misfit, {1, places_in(list), list.at(), type});
        } else {
            list.each([&](const JsonValue& each) {
                part(one, each, to);
                return to.shapes->size() <= most_vector_places;
            });
        }
    }

    // A point, line or polygon, alone or of several.
    void part(std::string_view type, const JsonValue& list, const ShapeTarget& to) {
        bool fits = false;
        if (type == "Point") {
            fits = !has_nested(list) || !list.is(Kind::array);
            TextPath path;
            if (fits) add_place(list, path, longer_), layer_.splitter().add_point(path, to);
        } else if (type == "LineString") {
            TextPath path;
            fits = path_in(list, path, longer_);
            if (fits && path.size() == 0)
                left_out_.add("geometries without coordinates", {1, 0, list.at(), ""});
            if (fits) layer_.splitter().add_line(path, to);
        } else {
            std::vector<TextPath> rings;
            fits = list.is(Kind::array);
            list.each([&](const JsonValue& ring) {
                return fits = fits && path_in(ring, rings.emplace_back(), longer_);
            });
            if (fits && rings.empty()) left_out_.add("geometries without coordinates", {1, 0, list.at(), ""});
            if (fits) layer_.splitter().add_polygon(rings, to);
        }
        if (!fits)
            left_out_.add(misfit,
                          {1, std::max<std::size_t>(1, places_in(list)), list.at(), std::string(type)});
    }

    LayerBuilder& layer_;
    FileWatch& watch_;
    LeftOut& left_out_;
    std::size_t count_{};
    LongPositions longer_;
};

std::string words_of(const LongPositions& longer, std::string_view text) {
    const bool is_one = longer.count == 1;
    return std::to_string(longer.count) + (is_one ? " position has" : " positions have") +
           " more than three numbers, " + (is_one ? "in line " : "the first in line ") +
           std::to_string(1 + std::ranges::count(text.substr(0, longer.first_at), '\n')) +
           ": the first two are the place, the third is the height, and the others are not used";
}

// Where the value begins: behind what makes a program of it.
std::size_t value_begin(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    for (const std::string_view call : {"loadGeoJSON(", "jsonp("}) {
        if (text.substr(first).starts_with(call)) return first + call.size();
    }
    return first;
}

}  // namespace

Result<void> read_geojson(std::string_view text, const std::string& name, const VectorCrs& asked,
                          FileWatch& watch, VectorFile& file, LeftOut& left_out) {
    const auto fault = [](const std::string& what) { return Error{ErrorKind::failed, "", what}; };
    const std::size_t first = value_begin(text);
    ORO_TRY(const std::size_t end, check_json(text, first));
    if (const std::size_t more = text.find_first_not_of(" \t\r\n);\x1a", end); more != std::string_view::npos)
        return fault("is no whole JSON: line " +
                     std::to_string(1 + std::ranges::count(text.substr(0, more), '\n')) +
                     ": more follows after its end");
    const JsonValue root(text, std::min(text.find_first_not_of(" \t\r\n", first), text.size()));
    if (!root.is(Kind::object)) return fault("is JSON, but no GeoJSON: it is no object");
    const Members members = root.members();
    if (const JsonValue* const type = member(members, "type"); type && type->text() == "Topology")
        return read_topojson(root, asked, watch, file, left_out);
    static constexpr std::array known{"features", "geometry", "coordinates", "geometries"};
    if (std::ranges::none_of(known, [&](const char* one) { return member(members, one) != nullptr; })) {
        const JsonValue* const type = member(members, "type");
        return fault("is JSON, but no GeoJSON" +
                     (type ? ": its type is '" + foreign_text(type->text()) + "'" : std::string()));
    }
    ORO_TRY(ShapeSplitter splitter,
            splitter_as_asked(asked, file, [&] { return splitter_of_geojson(root); }));
    const JsonValue* const own = member(members, "name");
    const std::string layer_name = own && own->is(Kind::text) ? own->text() : name;
    LayerBuilder layer(layer_name, std::move(splitter));
    GeoJsonReader reader(layer, watch, left_out);
    const bool is_whole = reader.item(root);
    if (watch.spent()) return fault(watch.fault());
    if (!is_whole || layer.splitter().places() > most_vector_places)
        return fault("has more than " + std::to_string(most_vector_places) + " places, which is the limit");
    if (const LongPositions& longer = reader.longer(); longer.count > 0)
        file.notes.push_back(file.file + ": " + words_of(longer, text));
    layer.finish(file);
    return {};
}

}  // namespace oro
