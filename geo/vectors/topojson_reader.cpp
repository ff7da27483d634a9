#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/files/foreign_text.h"
#include "geo/vectors/json_text.h"
#include "geo/vectors/layer_builder.h"
#include "geo/vectors/text_path.h"
#include "geo/vectors/vector_readers.h"

namespace oro {
namespace {

using TopologyMembers = std::vector<std::pair<std::string, JsonValue>>;

constexpr std::size_t topology_looks_apart = 256;
// Neighbours share an arc, and so do some layers: an arc that comes up far more often was made to.
constexpr std::size_t most_times_an_arc = 64;
constexpr std::size_t most_places_unasked = 1'000'000;
constexpr const char* no_such_arc = "geometries with an arc that is not there";
constexpr const char* wrong_arcs = "geometries whose arcs do not fit their type";

Error topology_fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

Error too_many_places() {
    return topology_fault("has more than " + std::to_string(most_vector_places) +
                          " places, which is the limit");
}

const JsonValue* topology_member(const TopologyMembers& members, std::string_view name) {
    const auto found = std::ranges::find(members, name, &TopologyMembers::value_type::first);
    return found == members.end() ? nullptr : &found->second;
}

// The first words of a list, as they are written; how many it has in all.
std::size_t words_in(const JsonValue& list, std::span<std::string_view> words) {
    std::size_t count = 0;
    list.each([&](const JsonValue& one) {
        if (count < words.size()) words[count] = one.source();
        return ++count <= words.size();
    });
    return count;
}

// From the whole numbers of a file to coordinates: x = x0 + sx * i.
struct Quantization {
    std::array<double, 2> scale{1.0, 1.0}, translate{0.0, 0.0};
};

Result<std::optional<Quantization>> quantization_in(const TopologyMembers& topology) {
    const JsonValue* const transform = topology_member(topology, "transform");
    if (transform == nullptr || transform->is(JsonValue::Kind::null)) return std::optional<Quantization>();
    Quantization quantization;
    const TopologyMembers members = transform->members();
    for (const auto& [name, numbers] :
         {std::pair{"scale", &quantization.scale}, std::pair{"translate", &quantization.translate}}) {
        const JsonValue* const list = topology_member(members, name);
        std::array<std::string_view, 2> words;
        if (list == nullptr || words_in(*list, words) != 2)
            return topology_fault(std::string("is TopoJSON whose transform has no ") + name +
                                  " of two numbers");
        for (std::size_t i = 0; i < 2; ++i) {
            const WrittenNumber number = written_number(words[i]);
            if (number.fault != nullptr)
                return topology_fault(std::string("is TopoJSON whose transform has the ") + name + " '" +
                                      foreign_text(words[i].substr(0, 40)) + "', which is no number");
            (*numbers)[i] = number.value;
        }
    }
    return std::optional<Quantization>(quantization);
}

// Appends a position to a path: as it stands, or, where the file is quantized, from whole numbers; those of
// an arc count from the position before, `from`. After a word that is no number nothing of an arc is known.
class Positions {
  public:
    Positions(const std::optional<Quantization>& quantization, bool of_arc)
        : quantization_(quantization), of_arc_(of_arc) {}

    void add(const JsonValue& position, TextPath& path) {
        std::array<std::string_view, 3> words;
        const bool is_list = position.is(JsonValue::Kind::array);
        if (is_list) words_in(position, words);
        if (!is_list || words[0].empty() || words[0].front() == '[' || words[0].front() == '{') {
            path.add_fault(no_place::no_numbers, position.source().substr(0, 60), position.at());
            is_lost_ = true;
            return;
        }
        path.add(words[0], words[1], words[2], position.at());
        if (!quantization_) return;
        double& x = path.x.back();
        double& y = path.y.back();
        const bool is_number = std::isfinite(x) && std::isfinite(y);
        is_lost_ = is_lost_ || !is_number;
        if (is_number && of_arc_ && is_lost_) {
            path.faults.push_back({path.size() - 1, lost, std::string(position.source().substr(0, 60))});
            x = y = std::numeric_limits<double>::quiet_NaN();
            return;
        }
        if (of_arc_) x = from_[0] += x, y = from_[1] += y;
        x = quantization_->translate[0] + quantization_->scale[0] * x;
        y = quantization_->translate[1] + quantization_->scale[1] * y;
    }

  private:
    static constexpr const char* lost = "that count from one that is no number";

    const std::optional<Quantization>& quantization_;
    bool of_arc_;
    bool is_lost_{};
    std::array<double, 2> from_{};
};

struct Arc {
    TextPath path;
    bool is_used{};
};

class TopologyReader {
  public:
    TopologyReader(const JsonValue& root, const VectorCrs& asked, FileWatch& watch, VectorFile& file,
                   LeftOut& left_out)
        : root_(root),
          asked_(asked),
          topology_(root.members()),
          watch_(watch),
          file_(file),
          left_out_(left_out) {}

    Result<void> all() {
        ORO_TRY(quantization_, quantization_in(topology_));
        ORO_CHECK(read_arcs());
        const JsonValue* const objects = topology_member(topology_, "objects");
        if (objects == nullptr || !objects->is(JsonValue::Kind::object))
            return topology_fault("is TopoJSON without objects");
        for (const auto& [name, object] : objects->members()) {
            ORO_TRY(ShapeSplitter splitter,
                    splitter_as_asked(asked_, file_, [&] { return splitter_of_geojson(root_); }));
            LayerBuilder layer(name, std::move(splitter));
            layer_ = &layer;
            top(object);
            if (watch_.spent()) return topology_fault(watch_.fault());
            if (put_together_ > most_together_)
                return topology_fault("puts its arcs together to more than " +
                                      std::to_string(most_together_) + " places, which is the limit");
            layer.finish(file_);
        }
        leave_out_unused();
        return {};
    }

  private:
    Result<void> read_arcs() {
        const JsonValue* const list = topology_member(topology_, "arcs");
        if (list == nullptr) return {};
        std::size_t places = 0;
        list->each([&](const JsonValue& one) {
            Arc& arc = arcs_.emplace_back();
            Positions positions(quantization_, true);
            one.each([&](const JsonValue& position) {
                positions.add(position, arc.path);
                return ++places <= most_vector_places;
            });
            return places <= most_vector_places &&
                   (arcs_.size() % topology_looks_apart != 0 || !watch_.spent());
        });
        if (watch_.spent()) return topology_fault(watch_.fault());
        most_together_ = std::min(most_vector_places, most_places_unasked + most_times_an_arc * places);
        return places > most_vector_places ? too_many_places() : Result<void>();
    }

    // An object: a geometry, or a collection each of whose geometries is a feature.
    void top(const JsonValue& object) {
        const TopologyMembers members = object.members();
        const JsonValue* const geometries = topology_member(members, "geometries");
        if (geometries == nullptr || type_of(members) != "GeometryCollection") {
            feature(object, members);
            return;
        }
        geometries->each([&](const JsonValue& one) {
            feature(one, one.members());
            return goes_on();
        });
    }

    [[nodiscard]] bool goes_on() {
        return put_together_ <= most_together_ && (++count_ % topology_looks_apart != 0 || !watch_.spent());
    }

    static std::string type_of(const TopologyMembers& members) {
        const JsonValue* const type = topology_member(members, "type");
        return type == nullptr ? "" : type->text();
    }

    void feature(const JsonValue& value, const TopologyMembers& members) {
        const JsonValue* const type = topology_member(members, "type");
        const HeightAbove stated = layer_->splitter().heights();
        const ShapeTarget to =
            layer_->target(stated == HeightAbove::nothing ? HeightAbove::ellipsoid : stated, left_out_);
        if (type != nullptr && type->is(JsonValue::Kind::null))
            left_out_.add("features without a geometry", {1, 0, value.at(), ""});
        else
            geometry(value, members, to);
        if (const JsonValue* const properties = topology_member(members, "properties"))
            for (const auto& [field, said] : properties->members())
                layer_->say(field,
                            said.is(JsonValue::Kind::number) ? without_power(said.words()) : said.words());
        if (const JsonValue* const id = topology_member(members, "id")) layer_->say("id", id->words());
        layer_->end_record();
    }

    void geometry(const JsonValue& value, const TopologyMembers& members, const ShapeTarget& to) {
        const std::string type = type_of(members);
        const bool is_point = type == "Point" || type == "MultiPoint",
                   is_collection = type == "GeometryCollection";
        static constexpr std::array of_arcs{"LineString", "MultiLineString", "Polygon", "MultiPolygon"};
        if (!is_point && !is_collection && std::ranges::find(of_arcs, type) == of_arcs.end()) {
            left_out_.add(
                "geometries of a kind that is not known here",
                {1, 0, value.at(), type.empty() ? std::string(value.source().substr(0, 60)) : type});
            return;
        }
        const JsonValue* const parts = topology_member(members, is_point        ? "coordinates"
                                                                : is_collection ? "geometries"
                                                                                : "arcs");
        bool any = false;
        if (parts != nullptr) parts->each([&](const JsonValue&) { return !(any = true); });
        // What stands in the place of a point is one that is none.
        any = any || (type == "Point" && parts != nullptr && !parts->is(JsonValue::Kind::array) &&
                      !parts->is(JsonValue::Kind::null));
        if (!any) {
            left_out_.add("geometries without coordinates", {1, 0, value.at(), ""});
        } else if (is_collection) {
            parts->each([&](const JsonValue& one) {
                geometry(one, one.members(), to);
                return goes_on();
            });
        } else if (is_point) {
            points(type, *parts, to);
        } else {
            arcs(type, *parts, to);
        }
    }

    void points(const std::string& type, const JsonValue& coordinates, const ShapeTarget& to) {
        const auto point = [&](const JsonValue& position) {
            TextPath path;
            Positions(quantization_, false).add(position, path);
            ++put_together_;
            layer_->splitter().add_point(path, to);
            return goes_on();
        };
        if (type == "Point")
            point(coordinates);
        else
            coordinates.each(point);
    }

    void arcs(const std::string& type, const JsonValue& list, const ShapeTarget& to) {
        const bool is_multi = type.starts_with("Multi"), is_line = type.ends_with("LineString");
        const auto part = [&](const JsonValue& one) {
            if (is_line)
                line(one, to);
            else
                polygon(one, to);
            return goes_on();
        };
        if (is_multi)
            list.each(part);
        else
            part(list);
    }

    // The first thing that is wrong with a geometry's arcs; `reason` is null where nothing is.
    struct WrongArcs {
        const char* reason{};
        std::string word;
    };

    void line(const JsonValue& list, const ShapeTarget& to) {
        TextPath path;
        WrongArcs wrong;
        put_together(list, path, wrong);
        if (wrong.reason != nullptr)
            left_out_.add(wrong.reason, {1, path.size(), list.at(), wrong.word});
        else if (path.size() == 0)
            left_out_.add("geometries without coordinates", {1, 0, list.at(), ""});
        else
            layer_->splitter().add_line(path, to);
    }

    void polygon(const JsonValue& list, const ShapeTarget& to) {
        std::vector<TextPath> rings;
        WrongArcs wrong;
        if (!list.is(JsonValue::Kind::array)) wrong = {wrong_arcs, std::string(list.source().substr(0, 60))};
        std::size_t places = 0;
        list.each([&](const JsonValue& ring) {
            put_together(ring, rings.emplace_back(), wrong);
            places += rings.back().size();
            return goes_on();
        });
        if (wrong.reason != nullptr)
            left_out_.add(wrong.reason, {1, places, list.at(), wrong.word});
        else if (places == 0)
            left_out_.add("geometries without coordinates", {1, 0, list.at(), ""});
        else
            layer_->splitter().add_polygon(rings, to);
    }

    // The number of an arc, from 0, and whether it is taken from its end: ~number is that.
    struct ArcNumber {
        std::size_t number{};
        bool is_reversed{};
    };
    [[nodiscard]] static std::optional<ArcNumber> arc_number(const JsonValue& value) {
        if (!value.is(JsonValue::Kind::number)) return std::nullopt;
        const WrittenNumber written = written_number(value.source());
        if (written.fault != nullptr || std::abs(written.value) > 1e9 ||
            written.value != std::floor(written.value))
            return std::nullopt;
        const auto number = static_cast<std::int64_t>(written.value);
        return ArcNumber{static_cast<std::size_t>(number < 0 ? ~number : number), number < 0};
    }

    // Puts the arcs of a list together: each begins where the one before ends.
    void put_together(const JsonValue& list, TextPath& path, WrongArcs& wrong) {
        const auto is_wrong = [&](const char* reason, const JsonValue& value) {
            if (wrong.reason == nullptr) wrong = {reason, std::string(value.source().substr(0, 60))};
        };
        if (!list.is(JsonValue::Kind::array)) is_wrong(wrong_arcs, list);
        list.each([&](const JsonValue& one) {
            const auto named = arc_number(one);
            if (!named || named->number >= arcs_.size()) {
                is_wrong(named ? no_such_arc : wrong_arcs, one);
                return goes_on();
            }
            Arc& arc = arcs_[named->number];
            arc.is_used = true;
            append(arc.path, named->is_reversed, path);
            return goes_on();
        });
    }

    void append(const TextPath& arc, bool is_reversed, TextPath& path) {
        const std::size_t skipped = path.size() > 0 ? 1 : 0;
        auto fault_of = [&](std::size_t place) {
            const auto found = std::ranges::lower_bound(arc.faults, place, {}, &TextPath::Fault::place);
            return found != arc.faults.end() && found->place == place ? &*found : nullptr;
        };
        for (std::size_t i = skipped; i < arc.size(); ++i) {
            const std::size_t from = is_reversed ? arc.size() - 1 - i : i;
            if (const TextPath::Fault* const fault = fault_of(from))
                path.faults.push_back({path.size(), fault->why, fault->word});
            path.x.push_back(arc.x[from]), path.y.push_back(arc.y[from]), path.z.push_back(arc.z[from]);
            path.at.push_back(arc.at[from]);
        }
        put_together_ += arc.size();
    }

    // Arcs that no geometry has, of which there should be none.
    void leave_out_unused() {
        for (const Arc& arc : arcs_)
            if (!arc.is_used && arc.path.size() > 0)
                left_out_.add("arcs that no line or polygon has",
                              {1, arc.path.size(), arc.path.at.front(), ""});
    }

    const JsonValue& root_;
    const VectorCrs& asked_;
    const TopologyMembers topology_;
    FileWatch& watch_;
    VectorFile& file_;
    LeftOut& left_out_;
    std::optional<Quantization> quantization_;
    std::vector<Arc> arcs_;
    LayerBuilder* layer_{};
    std::size_t count_{};
    std::size_t put_together_{};  // places of all geometries until now
    std::size_t most_together_{most_vector_places};
};

}  // namespace

Result<void> read_topojson(const JsonValue& root, const VectorCrs& asked, FileWatch& watch, VectorFile& file,
                           LeftOut& left_out) {
    return TopologyReader(root, asked, watch, file, left_out).all();
}

}  // namespace oro
