#include "geo/region/region_description.h"

#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/json_bounds.h"
#include "geo/region/source_fields.h"
#include "geo/sources/source_words.h"

namespace oro {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::int64_t description_format = 1;
// A source has some 30 values; more than 100,000 of them do not fit into the longest description.
constexpr JsonBounds bounds{.most_values = 5'000'000, .most_bytes = std::numeric_limits<std::size_t>::max()};

// A fingerprint has 64 bits, of which other readers of JSON keep 53.
std::string fingerprint_text(std::uint64_t fingerprint) {
    char digits[20];
    std::snprintf(digits, sizeof digits, "%016" PRIx64, fingerprint);
    return digits;
}

ordered_json source_text(const SourceReport& s) {
    ordered_json text = ordered_json::object();
    put_source_words(text, s);
    if (!s.horizontal_datum.is_wgs84)
        text["horizontal_datum"] = horizontal_fields<ordered_json>(s.horizontal_datum);
    text["attribution"] = s.attribution;
    text["rows"] = s.rows;
    text["columns"] = s.columns;
    text["lat_spacing_deg"] = s.lat_spacing_deg;
    text["lon_spacing_deg"] = s.lon_spacing_deg;
    text["spacing_m"] = s.spacing_m;
    if (s.nominal_spacing_deg > 0.0) text["nominal_spacing_deg"] = s.nominal_spacing_deg;
    text["box_deg"] = ordered_json::array();
    for (const double side_deg : {s.box.west_deg, s.box.south_deg, s.box.east_deg, s.box.north_deg})
        text["box_deg"].push_back(side_deg);
    text["lowest_m"] = s.lowest_m;
    text["highest_m"] = s.highest_m;
    if (s.stored) text["stored"] = stored_fields<ordered_json>(*s.stored);
    if (s.resampling) text["resampling"] = resampling_fields<ordered_json>(*s.resampling);
    put_source_findings(text, s);
    if (s.posts_hash) text["posts_print"] = fingerprint_text(*s.posts_hash);
    return text;
}

// What is wrong in a description; thrown and caught within this file.
struct Fault {
    std::string what;
};

// A value of a description, and where in it: "sources[3].box_deg".
class Field {
  public:
    Field(const json& value, std::string name) : value_(value), name_(std::move(name)) {}

    [[nodiscard]] Field operator[](const char* name) const {
        const std::string full = name_.empty() ? name : name_ + "." + name;
        if (!value_.is_object()) throw Fault{full + ": there is no object that could hold it"};
        const auto found = value_.find(name);
        if (found == value_.end()) throw Fault{full + " is missing"};
        return {*found, full};
    }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool has(const char* name) const { return value_.is_object() && value_.contains(name); }
    [[nodiscard]] std::vector<Field> elements() const {
        require(value_.is_array(), "a list");
        std::vector<Field> all;
        for (std::size_t i = 0; i < value_.size(); ++i)
            all.emplace_back(value_[i], name_ + "[" + std::to_string(i) + "]");
        return all;
    }
    [[nodiscard]] std::string text() const {
        require(value_.is_string(), "text");
        auto text = value_.get<std::string>();
        if (text.find('\0') != std::string::npos) throw Fault{name_ + " holds a zero byte"};
        return text;
    }
    [[nodiscard]] std::uint64_t fingerprint() const {
        const std::string digits = text();
        std::uint64_t fingerprint = 0;
        const char* const end = digits.data() + digits.size();
        const auto read = std::from_chars(digits.data(), end, fingerprint, 16);
        require(digits.size() == 16 && read.ec == std::errc() && read.ptr == end, "16 hexadecimal digits");
        return fingerprint;
    }
    [[nodiscard]] std::vector<std::string> texts() const {
        std::vector<std::string> all;
        for (const Field& element : elements()) all.push_back(element.text());
        return all;
    }
    [[nodiscard]] double number() const {
        require(value_.is_number(), "a number");
        const auto number = value_.get<double>();
        require(std::isfinite(number), "a finite number");
        return number;
    }
    [[nodiscard]] std::optional<double> number_if_any(const char* name) const {
        return has(name) ? std::optional((*this)[name].number()) : std::nullopt;
    }
    [[nodiscard]] bool flag() const {
        require(value_.is_boolean(), "true or false");
        return value_.get<bool>();
    }
    [[nodiscard]] std::uint64_t count() const {
        require(value_.is_number_unsigned(), "a whole number from 0 on");
        return value_.get<std::uint64_t>();
    }
    [[nodiscard]] int side() const {
        const std::uint64_t number = count();
        require(number <= std::uint64_t{std::numeric_limits<int>::max()}, "at most 2^31 - 1");
        return static_cast<int>(number);
    }

  private:
    void require(bool fine, const char* expected) const {
        if (!fine) throw Fault{name_ + " must be " + expected + ", and is " + one_line(said())};
    }
    [[nodiscard]] std::string said() const { return value_.is_number() ? value_.dump() : value_.type_name(); }

    const json& value_;
    std::string name_;
};

BoundingBox box_of(const Field& field) {
    const std::vector<Field> corners = field.elements();
    if (corners.size() != 4)
        throw Fault{"a box must have 4 numbers, and has " + std::to_string(corners.size())};
    return {corners[0].number(), corners[1].number(), corners[2].number(), corners[3].number()};
}

// Of regions on a net alone.
PostsCrs posts_crs_of(const Field& field) {
    PostsCrs crs{field["wkt"].text(), {}};
    const std::vector<Field> numbers = field["crs_from_post"].elements();
    if (numbers.size() != crs.crs_from_post.size())
        throw Fault{field.name() + ".crs_from_post must have 6 numbers, and has " +
                    std::to_string(numbers.size())};
    for (std::size_t i = 0; i < numbers.size(); ++i) crs.crs_from_post[i] = numbers[i].number();
    return crs;
}

SeamReport seams_of(const Field& field) {
    return {field["shared_posts"].count(), field["disagreeing_posts"].count(),
            field["largest_difference_m"].number()};
}

// A fact by its words, of which there are only a few.
template <class Fact>
Fact known(const Field& field, std::optional<Fact> (*of_words)(const std::string&)) {
    const std::string words = field.text();
    const std::optional<Fact> fact = of_words(words);
    if (!fact) throw Fault{field.name() + " is " + one_line(words) + ", which this program does not know"};
    return *fact;
}

// WGS84 has none.
HorizontalDatum horizontal_of(const Field& source) {
    HorizontalDatum datum;
    if (!source.has("horizontal_datum")) return datum;
    const Field field = source["horizontal_datum"];
    datum.is_wgs84 = false;
    datum.name = field["name"].text();
    datum.operation = field["operation"].text();
    datum.accuracy_m = field.number_if_any("accuracy_m");
    datum.ballpark = field["ballpark"].flag();
    datum.unchanged = field["unchanged"].flag();
    datum.one_to_two_metres = field["one_to_two_metres"].flag();
    datum.missing_grids = field["missing_grids"].texts();
    datum.accuracy_with_grids_m = field.number_if_any("accuracy_with_grids_m");
    datum.frame_epoch = field.number_if_any("frame_epoch");
    datum.coordinate_epoch = field.number_if_any("coordinate_epoch");
    return datum;
}

std::optional<StoredRange> stored_of(const Field& source) {
    if (!source.has("stored")) return std::nullopt;
    const Field field = source["stored"];
    return StoredRange{field["lowest_m"].number(), field["highest_m"].number(), field["whole_file"].flag()};
}

std::optional<PostShown> post_of(const Field& resampling, const char* name) {
    if (!resampling.has(name)) return std::nullopt;
    const Field field = resampling[name];
    return PostShown{field["lat_deg"].number(), field["lon_deg"].number(), field["own_H_m"].number(),
                     field.number_if_any("shown_H_m")};
}

std::optional<Resampling> resampling_of(const Field& source) {
    if (!source.has("resampling")) return std::nullopt;
    const Field field = source["resampling"];
    Resampling found;
    found.posts = field["posts"].count();
    found.compared = field["compared"].count();
    found.unshown = field["unshown"].count();
    found.hidden = field["hidden"].count();
    found.rms_m = field["rms_m"].number();
    found.worst = post_of(field, "worst");
    if (found.worst && !found.worst->shown_H_m)
        throw Fault{field.name() + ".worst has no shown_H_m to be compared with"};
    found.highest = post_of(field, "highest");
    found.lowest = post_of(field, "lowest");
    return found;
}

SourceReport source_of(const Field& field) {
    SourceReport s;
    s.path = field["path"].text();
    set_format(s, field["format"].text());
    s.crs = field["crs"].text();
    s.horizontal_datum = horizontal_of(field);
    s.vertical_datum = datum_of_words(field["vertical_datum"].text());
    s.height_unit = unit_of_words(field["height_unit"].text());
    s.posts_are = known(field["posts_are"], posts_of_words);
    if (field.has("listed")) s.listed = field["listed"].side();
    s.attribution = field["attribution"].text();
    s.rows = field["rows"].side();
    s.columns = field["columns"].side();
    s.lat_spacing_deg = field["lat_spacing_deg"].number();
    s.lon_spacing_deg = field["lon_spacing_deg"].number();
    s.spacing_m = field["spacing_m"].number();
    s.nominal_spacing_deg = field.number_if_any("nominal_spacing_deg").value_or(0.0);
    s.box = box_of(field["box_deg"]);
    s.lowest_m = field["lowest_m"].number();
    s.highest_m = field["highest_m"].number();
    s.stored = stored_of(field);
    s.resampling = resampling_of(field);
    s.voids = field["voids"].count();
    s.implausible = field["implausible"].count();
    s.placement = placement_of_words(field["placement"].text());
    s.seams = seams_of(field["seams"]);
    if (field.has("posts_print")) s.posts_hash = field["posts_print"].fingerprint();
    return s;
}

json parsed(const std::string& text) {
    if (auto much = beyond_json_bounds(text, bounds)) throw Fault{std::move(*much)};
    return json::parse(text);
}

RegionGrid region_of(const Field& field) {
    const std::uint64_t format = field["orograph_region"].count();
    if (format != description_format)
        throw Fault{"its format is " + std::to_string(format) + ", this program reads " +
                    std::to_string(description_format)};
    RegionGrid region;
    for (const Field& source : field["sources"].elements()) region.sources.push_back(source_of(source));
    region.seams = seams_of(field["seams"]);
    region.geoid = field["geoid"].text();
    if (field.has("posts_crs")) region.posts_crs = posts_crs_of(field["posts_crs"]);
    region.missing_cells = field["missing_cells"].texts();
    region.voids = field["voids"].count();
    // What was baked from a part of a baked region may not tell these apart from voids.
    region.classifies_voids = region.voids == 0 || field.has("outside");
    if (field.has("outside")) region.outside = field["outside"].count();
    region.in_missing = field["in_missing"].count();
    if (region.outside > region.voids || region.in_missing > region.voids - region.outside)
        throw Fault{"it tells of more posts without a source than without a height"};
    region.filled = field["filled"].count();
    region.void_method = known(field["void_method"], void_method_of_words);
    region.posts_hash = field["posts_print"].fingerprint();
    region.notes = field["notes"].texts();
    return region;
}

}  // namespace

std::string region_description(const RegionGrid& region) {
    ordered_json all = ordered_json::object();
    all["orograph_region"] = description_format;
    all["sources"] = ordered_json::array();
    for (const SourceReport& source : region.sources) all["sources"].push_back(source_text(source));
    all["seams"] = seam_fields<ordered_json>(region.seams);
    all["geoid"] = region.geoid;
    if (region.posts_crs) {
        all["posts_crs"]["wkt"] = region.posts_crs->wkt;
        all["posts_crs"]["crs_from_post"] = region.posts_crs->crs_from_post;
    }
    all["missing_cells"] = region.missing_cells;
    all["voids"] = region.voids;
    if (region.classifies_voids) all["outside"] = region.outside;
    all["in_missing"] = region.in_missing;
    all["filled"] = region.filled;
    all["void_method"] = void_method_words(region.void_method);
    all["posts_print"] = fingerprint_text(region.posts_hash);
    all["notes"] = region.notes;
    return all.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Result<RegionGrid> region_from_description(const std::string& text, const std::string& where) {
    const auto refused = [&](const std::string& reason) {
        return Error{ErrorKind::failed, where, "its description cannot be read: " + reason};
    };
    try {
        const json all = parsed(text);
        return region_of({all, ""});
    } catch (const Fault& fault) {
        return refused(fault.what);
    } catch (const json::exception& fault) {
        // Less the library's own numbering: "[json.exception.parse_error.101] parse error at line 1, ...".
        const std::string what = fault.what();
        const std::size_t bracket = what.find("] ");
        return refused(bracket == std::string::npos ? what : what.substr(bracket + 2));
    }
}

}  // namespace oro
