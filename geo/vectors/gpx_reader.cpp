#include "geo/vectors/vector_readers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "geo/vectors/layer_builder.h"
#include "geo/vectors/text_path.h"

namespace oro {
namespace {

constexpr std::size_t gpx_looks_apart = 256;  // elements between two looks at the clock
constexpr int deepest_field = 16;

bool is_gpx_place(std::string_view name) {
    return name == "wpt" || name == "rtept" || name == "trkpt";
}

// What an element says of itself: the texts of its elements, those of extensions with the names of all that
// they stand in.
void say_fields(const pugi::xml_node& node, const std::string& prefix, LayerBuilder& layer, int depth = 0) {
    int links = 0;
    for (const pugi::xml_node child : node.children()) {
        const std::string_view name = local_name(child);
        if (name.empty() || is_gpx_place(name) || name == "trkseg" || depth > deepest_field) continue;
        if (name == "extensions") {
            say_fields(child, prefix, layer, depth + 1);
            continue;
        }
        if (name == "link" && prefix.empty()) {
            const std::string link = "link" + std::to_string(++links) + "_";
            layer.say(link + "href", child.attribute("href").value());
            say_fields(child, link, layer, depth + 1);
            continue;
        }
        // As OGR calls extensions: with their name space, but not its own.
        std::string field = child.name();
        if (field.starts_with("ogr:")) field.erase(0, 4);
        for (char& c : field) {
            if (c == ':') c = '_';
        }
        if (has_elements(child))
            say_fields(child, prefix + field + "_", layer, depth + 1);
        else
            layer.say(prefix + field, name == "ele" ? without_power(text_of(child)) : text_of(child));
    }
}

class GpxReader {
  public:
    GpxReader(FileWatch& watch, LeftOut& left_out) : watch_(watch), left_out_(left_out) {}

    Result<void> all(const pugi::xml_node& root) {
        for (const pugi::xml_node child : root.children()) {
            const std::string_view name = local_name(child);
            if (name == "wpt") waypoint(child);
            if (name == "rte") route(child);
            if (name == "trk") track(child);
            ORO_CHECK(look());
        }
        leave_out_strays(root);
        return watch_.spent() ? Error{ErrorKind::failed, "", watch_.fault()} : Result<void>();
    }

    // What looks wrong and is read all the same; "" for nothing.
    [[nodiscard]] std::string doubt(std::string_view text) const {
        if (null_islands_ == 0) return "";
        const bool is_one = null_islands_ == 1;
        return std::to_string(null_islands_) + (is_one ? " place of a line lies" : " places of lines lie") +
               " at 0 N 0 E, far from " +
               (is_one ? "its neighbours, in line " : "their neighbours, the first in line ") +
               std::to_string(1 + std::ranges::count(text.substr(0, first_null_island_at_), '\n')) +
               ": a receiver without a fix may have written that; the line goes there and back";
    }

    void finish(VectorFile& file) { waypoints_.finish(file), routes_.finish(file), tracks_.finish(file); }

  private:
    Result<void> look() {
        if (count_++ % gpx_looks_apart == 0 && watch_.spent())
            return Error{ErrorKind::failed, "", watch_.fault()};
        const std::size_t places =
            waypoints_.splitter().places() + routes_.splitter().places() + tracks_.splitter().places();
        if (places <= most_vector_places) return {};
        return Error{ErrorKind::failed, "",
                     "has more than " + std::to_string(most_vector_places) + " places, which is the limit"};
    }

    static void add_place(const pugi::xml_node& node, TextPath& path) {
        const std::string height = text_of(child_named(node, "ele"));
        path.add(node.attribute("lon").value(), node.attribute("lat").value(), height, XmlText::at(node));
    }

    // A receiver without a fix writes 0 N 0 E between places that are thousands of kilometres away.
    void look_for_null_island(const TextPath& path) {
        constexpr double near_deg = 1e-4, far_deg = 5.0;
        for (std::size_t i = 0; i < path.size(); ++i) {
            const auto is_far = [&](std::size_t k) { return std::hypot(path.x[k], path.y[k]) > far_deg; };
            if (!(std::hypot(path.x[i], path.y[i]) < near_deg)) continue;
            const bool before = i > 0, behind = i + 1 < path.size();
            if (!(before || behind) || (before && !is_far(i - 1)) || (behind && !is_far(i + 1))) continue;
            if (null_islands_++ == 0) first_null_island_at_ = path.at[i];
        }
    }

    void waypoint(const pugi::xml_node& node) {
        TextPath path;
        add_place(node, path);
        ++taken_;
        waypoints_.splitter().add_point(path, waypoints_.target(HeightAbove::sea_level, left_out_));
        say_fields(node, "", waypoints_);
        waypoints_.end_record();
    }

    // The places of one name directly in an element, as a line.
    void line(const pugi::xml_node& node, std::string_view of, LayerBuilder& layer) {
        TextPath path;
        for (const pugi::xml_node child : node.children()) {
            if (local_name(child) == of) add_place(child, path);
        }
        taken_ += path.size();
        look_for_null_island(path);
        if (path.size() > 0) layer.splitter().add_line(path, layer.target(HeightAbove::sea_level, left_out_));
    }

    void route(const pugi::xml_node& node) {
        line(node, "rtept", routes_);
        say_fields(node, "", routes_);
        routes_.end_record();
    }

    void track(const pugi::xml_node& node) {
        line(node, "trkpt", tracks_);  // where there is no segment, which GPX wants
        for (const pugi::xml_node child : node.children()) {
            if (local_name(child) == "trkseg") line(child, "trkpt", tracks_);
        }
        say_fields(node, "", tracks_);
        tracks_.end_record();
    }

    // Places that stand where GPX has none.
    void leave_out_strays(const pugi::xml_node& root) {
        std::size_t all = is_gpx_place(local_name(root)) ? 1 : 0;
        std::size_t looked = 0;
        for (pugi::xml_node node = next_in(root, root); node; node = next_in(root, node)) {
            if (is_gpx_place(local_name(node))) ++all;
            if (++looked % 65536 == 0 && watch_.spent()) return;
        }
        if (all > taken_)
            left_out_.add("places that stand where GPX has none",
                          {all - taken_, all - taken_, LeftOutPart::nowhere, ""});
    }

    FileWatch& watch_;
    LeftOut& left_out_;
    LayerBuilder waypoints_{"waypoints", ShapeSplitter::of_wgs84()},
        routes_{"routes", ShapeSplitter::of_wgs84()}, tracks_{"tracks", ShapeSplitter::of_wgs84()};
    std::size_t taken_{};
    std::size_t count_{};
    std::size_t null_islands_{}, first_null_island_at_{};
};

}  // namespace

Result<void> read_gpx(const XmlText& xml, std::string_view text, FileWatch& watch, VectorFile& file,
                      LeftOut& left_out) {
    GpxReader reader(watch, left_out);
    ORO_CHECK(reader.all(xml.root()));
    if (const std::string doubt = reader.doubt(text); !doubt.empty())
        file.notes.push_back(file.file + ": " + doubt);
    reader.finish(file);
    return {};
}

}  // namespace oro
