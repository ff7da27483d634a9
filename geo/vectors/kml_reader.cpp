#include "geo/vectors/vector_readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "geo/vectors/layer_builder.h"
#include "geo/vectors/text_path.h"

namespace oro {
namespace {

constexpr std::size_t kml_looks_apart = 256;  // elements between two looks at the clock
constexpr std::string_view kml_blanks = " \t\r\n";
// What an element whose places are read is called from then on.
constexpr const char* taken = "-";
// The layer of elements whose features are not the file's own, but changes to another's.
constexpr std::size_t no_layer = std::numeric_limits<std::size_t>::max();

bool is_blank(char c) {
    return kml_blanks.find(c) != std::string_view::npos;
}

// Tuples of numbers with commas, between blanks; blanks beside a comma part nothing.
void add_tuples(std::string_view text, std::size_t begins_at, bool is_one_piece, TextPath& path) {
    std::size_t at = 0;
    const auto skip = [&] {
        while (at < text.size() && is_blank(text[at])) ++at;
    };
    for (skip(); at < text.size() && path.size() <= most_vector_places; skip()) {
        const std::size_t begin = at;
        std::array<std::string_view, 3> words;
        std::size_t count = 0, end = at;
        for (;;) {
            const std::size_t word = at;
            while (at < text.size() && !is_blank(text[at]) && text[at] != ',') ++at;
            if (count < words.size()) words[count] = text.substr(word, at - word);
            ++count, end = at;
            skip();
            if (at == text.size() || text[at] != ',') break;
            end = ++at;
            skip();
        }
        const std::size_t place_at = is_one_piece ? begins_at + begin : begins_at;
        if (count <= words.size())
            path.add(words[0], words[1], words[2], place_at);
        else
            path.add_fault(no_place::too_many, text.substr(begin, end - begin), place_at);
    }
}

// A place of a track: "8.1 46.2 1200".
void add_coord(std::string_view text, std::size_t at, TextPath& path) {
    std::array<std::string_view, 3> words;
    std::size_t count = 0;
    for (std::size_t begin = 0;
         (begin = text.find_first_not_of(kml_blanks, begin)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kml_blanks, begin), text.size());
        if (count < words.size()) words[count] = text.substr(begin, end - begin);
        ++count, begin = end;
    }
    if (count <= words.size())
        path.add(words[0], words[1], words[2], at);
    else
        path.add_fault(no_place::too_many, text, at);
}

bool is_geometry(std::string_view name) {
    static constexpr std::array names{"Point",         "LineString", "LinearRing", "Polygon",
                                      "MultiGeometry", "Track",      "MultiTrack", "Model"};
    return std::ranges::find(names, name) != names.end();
}

HeightAbove heights_of(const pugi::xml_node& geometry) {
    const std::string mode = text_of(child_named(geometry, "altitudeMode"));
    if (mode == "absolute") return HeightAbove::sea_level;
    return mode == "relativeToGround" ? HeightAbove::ground : HeightAbove::nothing;
}

class KmlReader {
  public:
    KmlReader(const XmlText& xml, const KmlLinks& links, FileWatch& watch, LeftOut& left_out)
        : xml_(xml), links_(links), watch_(watch), left_out_(left_out) {}

    Result<void> all(const std::string& name) {
        std::vector<std::size_t> open{0};  // layers of the elements that hold this one
        layers_.emplace_back(name, ShapeSplitter::of_wgs84());
        const pugi::xml_node root = xml_.root();
        pugi::xml_node node = root;
        while (node) {
            ORO_CHECK(look());
            open.push_back(enter(node, open.back()));
            if (node.first_child()) {
                node = node.first_child();
                continue;
            }
            open.pop_back();
            while (node && node != root && !node.next_sibling()) node = node.parent(), open.pop_back();
            node = node == root ? pugi::xml_node() : node.next_sibling();
        }
        if (watch_.spent()) return Error{ErrorKind::failed, "", watch_.fault()};
        return {};
    }

    void finish(VectorFile& file) {
        for (LayerBuilder& layer : layers_) layer.finish(file);
    }

  private:
    Result<void> look() {
        if (count_++ % kml_looks_apart == 0 && watch_.spent())
            return Error{ErrorKind::failed, "", watch_.fault()};
        if (places_ <= most_vector_places) return {};
        return Error{ErrorKind::failed, "",
                     "has more than " + std::to_string(most_vector_places) + " places, which is the limit"};
    }

    // Reads what begins with an element; gives the number of the layer of what it holds.
    std::size_t enter(const pugi::xml_node& node, std::size_t layer) {
        const std::string_view name = local_name(node);
        if (name == "Update") return no_layer;
        const bool has_layer = layer != no_layer;
        if (has_layer && (name == "Document" || name == "Folder")) {
            layers_.emplace_back(text_of(child_named(node, "name")), ShapeSplitter::of_wgs84());
            return layers_.size() - 1;
        }
        if (has_layer && (name == "Placemark" || name == "GroundOverlay" || name == "PhotoOverlay")) {
            const std::size_t before = layers_[layer].splitter().places();
            feature(node, layers_[layer]);
            places_ += layers_[layer].splitter().places() - before;
        } else if (name == "NetworkLink") {
            if (!has_layer || !links_ || !links_(target_of(node)))
                left_out_.add("links to other files, which are not followed", {1, 0, XmlText::at(node), ""});
        } else if (name == "coordinates" || name == "coord" ||
                   (name == "Location" && local_name(node.parent()) == "Model")) {
            stray(node, name);
        }
        return layer;
    }

    // Where a network link leads; Url is KML 2.0's name of its Link.
    static std::string target_of(const pugi::xml_node& network_link) {
        const pugi::xml_node link = child_named(network_link, "Link");
        return text_of(child_named(link ? link : child_named(network_link, "Url"), "href"));
    }

    // Places that no geometry of a feature has taken.
    void stray(const pugi::xml_node& node, std::string_view name) {
        TextPath path;
        if (name == "coordinates")
            add_tuples(text_of(node), XmlText::at(node), false, path);
        else
            path.add_fault(no_place::half, "", XmlText::at(node));
        if (path.size() > 0)
            left_out_.add("places that stand where KML has none",
                          {path.size(), path.size(), XmlText::at(node), ""});
    }

    void feature(const pugi::xml_node& node, LayerBuilder& layer) {
        bool has_geometry = false;
        for (const pugi::xml_node child : node.children()) {
            const std::string_view name = local_name(child);
            if (is_geometry(name)) {
                has_geometry = true;
                geometry(child, layer);
            } else if (name == "LatLonBox" || name == "LatLonQuad") {
                has_geometry = true;
                name == "LatLonBox" ? box(child, layer) : ring_geometry(child, layer);
            }
        }
        if (!has_geometry) {
            const pugi::xml_node camera = child_named(node, "Camera");
            if (camera && child_named(camera, "longitude") && child_named(camera, "latitude"))
                location(camera, heights_of(camera), layer);
            else
                left_out_.add("features without a geometry", {1, 0, XmlText::at(node), ""});
        }
        say_fields(node, layer);
        layer.end_record();
    }

    static void say_fields(const pugi::xml_node& node, LayerBuilder& layer) {
        for (const pugi::xml_node child : node.children()) {
            const std::string_view name = local_name(child);
            if (name == "ExtendedData")
                say_extended(child, layer);
            else if (name == "TimeStamp")
                layer.say("timestamp", text_of(child_named(child, "when")));
            else if (name == "TimeSpan")
                layer.say("begin", text_of(child_named(child, "begin"))),
                    layer.say("end", text_of(child_named(child, "end")));
            else if (name == "Icon")
                layer.say("icon", text_of(child_named(child, "href")));
            else if (is_geometry(name))
                layer.say("altitudeMode", text_of(child_named(child, "altitudeMode")));
            else if (!name.empty() && !has_elements(child))
                layer.say(name, text_of(child));
        }
    }

    static void say_extended(const pugi::xml_node& data, LayerBuilder& layer) {
        for (const pugi::xml_node child : data.children()) {
            const std::string_view name = local_name(child);
            if (name == "Data")
                layer.say(child.attribute("name").value(), text_of(child_named(child, "value")));
            if (name == "SchemaData") {
                for (const pugi::xml_node one : child.children()) {
                    if (local_name(one) == "SimpleData")
                        layer.say(one.attribute("name").value(), text_of(one));
                }
            }
        }
    }

    void geometry(const pugi::xml_node& whole, LayerBuilder& layer) {
        std::vector<pugi::xml_node> open{whole};
        while (!open.empty()) {
            const pugi::xml_node node = open.back();
            const std::string_view name = local_name(node);
            open.pop_back();
            if (name == "MultiGeometry" || name == "MultiTrack") {
                const std::size_t before = open.size();
                for (const pugi::xml_node child : node.children()) {
                    if (is_geometry(local_name(child))) open.push_back(child);
                }
                std::reverse(open.begin() + static_cast<std::ptrdiff_t>(before), open.end());
                if (open.size() == before) without_coordinates(node);
            } else if (name == "Polygon") {
                polygon(node, layer);
            } else if (name == "Track") {
                track(node, layer);
            } else if (name == "Model") {
                const pugi::xml_node place = child_named(node, "Location");
                place ? location(place, heights_of(node), layer) : without_coordinates(node);
            } else {
                simple(node, layer);
            }
        }
    }

    void without_coordinates(const pugi::xml_node& node) {
        left_out_.add("geometries without coordinates", {1, 0, XmlText::at(node), ""});
    }

    // The places in an element's `coordinates`, once.
    TextPath path_in(const pugi::xml_node& node) {
        TextPath path;
        pugi::xml_node coordinates = child_named(node, "coordinates");
        if (!coordinates) return path;
        const pugi::xml_node only = coordinates.first_child();
        if (only && !only.next_sibling())
            add_tuples(only.value(), xml_.content_at(coordinates), true, path);
        else
            add_tuples(text_of(coordinates), XmlText::at(coordinates), false, path);
        coordinates.set_name(taken);
        return path;
    }

    // A point, a line, or a ring that stands for a line.
    void simple(const pugi::xml_node& node, LayerBuilder& layer) {
        const TextPath path = path_in(node);
        const ShapeTarget to = layer.target(heights_of(node), left_out_);
        if (path.size() == 0)
            without_coordinates(node);
        else if (local_name(node) == "Point")
            layer.splitter().add_point(path, to);
        else
            layer.splitter().add_line(path, to);
    }

    void polygon(const pugi::xml_node& node, LayerBuilder& layer) {
        std::vector<TextPath> rings;
        const auto take = [&](const pugi::xml_node& ring_node) {
            TextPath ring = path_in(ring_node);
            if (ring.size() > 0) rings.push_back(std::move(ring));
        };
        take(child_named(child_named(node, "outerBoundaryIs"), "LinearRing"));
        if (rings.empty()) {
            // Holes of nothing are told where they stand.
            without_coordinates(node);
            return;
        }
        for (const pugi::xml_node child : node.children()) {
            if (local_name(child) != "innerBoundaryIs") continue;
            for (const pugi::xml_node ring : child.children()) {
                if (local_name(ring) == "LinearRing") take(ring);
            }
        }
        layer.splitter().add_polygon(rings, layer.target(heights_of(node), left_out_));
    }

    void ring_geometry(const pugi::xml_node& node, LayerBuilder& layer) {
        const TextPath path = path_in(node);
        if (path.size() == 0)
            without_coordinates(node);
        else
            layer.splitter().add_polygon({path}, layer.target(HeightAbove::nothing, left_out_));
    }

    void track(const pugi::xml_node& node, LayerBuilder& layer) {
        TextPath path;
        for (pugi::xml_node child : node.children()) {
            if (local_name(child) != "coord") continue;
            add_coord(text_of(child), XmlText::at(child), path);
            child.set_name(taken);
        }
        if (path.size() == 0)
            without_coordinates(node);
        else
            layer.splitter().add_line(path, layer.target(heights_of(node), left_out_));
    }

    // The longitude, latitude and altitude of a model or a camera, as a point.
    void location(pugi::xml_node node, HeightAbove heights, LayerBuilder& layer) {
        TextPath path;
        path.add(text_of(child_named(node, "longitude")), text_of(child_named(node, "latitude")),
                 text_of(child_named(node, "altitude")), XmlText::at(node));
        if (local_name(node) == "Location") node.set_name(taken);
        layer.splitter().add_point(path, layer.target(heights, left_out_));
    }

    // The corners of an image: turned about its middle, against the clock.
    void box(const pugi::xml_node& node, LayerBuilder& layer) {
        std::array<WrittenNumber, 4> sides;
        static constexpr std::array names{"west", "south", "east", "north"};
        for (std::size_t i = 0; i < sides.size(); ++i) {
            sides[i] = written_number(text_of(child_named(node, names[i])));
            if (sides[i].fault == nullptr) continue;
            left_out_.add(std::string("overlays with corners ") + sides[i].fault,
                          {1, 0, XmlText::at(node), ""});
            return;
        }
        const WrittenNumber rotation = written_number(text_of(child_named(node, "rotation")));
        const double west = sides[0].value, east = sides[2].value + (sides[2].value < west ? 360.0 : 0.0);
        const double lon = (west + east) / 2.0, lat = (sides[1].value + sides[3].value) / 2.0;
        const double turn = (rotation.fault ? 0.0 : rotation.value) * std::numbers::pi / 180.0;
        const double narrow = std::cos(lat * std::numbers::pi / 180.0);
        TextPath ring;
        for (const auto& [right, up] : {std::pair{1, 1}, {1, -1}, {-1, -1}, {-1, 1}}) {
            const double x = right * (east - west) / 2.0 * narrow,
                         y = up * (sides[3].value - sides[1].value) / 2.0;
            ring.x.push_back(lon + (turn == 0.0 ? right * (east - west) / 2.0
                                                : (x * std::cos(turn) - y * std::sin(turn)) / narrow));
            ring.y.push_back(lat + x * std::sin(turn) + y * std::cos(turn));
            ring.z.push_back(std::numeric_limits<double>::quiet_NaN());
            ring.at.push_back(XmlText::at(node));
        }
        layer.splitter().add_polygon({ring}, layer.target(HeightAbove::nothing, left_out_));
    }

    const XmlText& xml_;
    const KmlLinks& links_;
    FileWatch& watch_;
    LeftOut& left_out_;
    std::vector<LayerBuilder> layers_;
    std::size_t places_{};
    std::size_t count_{};
};

}  // namespace

Result<void> read_kml(const XmlText& xml, const std::string& name, const KmlLinks& links, FileWatch& watch,
                      VectorFile& file, LeftOut& left_out) {
    KmlReader reader(xml, links, watch, left_out);
    ORO_CHECK(reader.all(name));
    reader.finish(file);
    return {};
}

}  // namespace oro
