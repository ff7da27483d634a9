#include "geo/vectors/kml_tour.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/open_file.h"
#include "core/light/utc_time.h"
#include "geo/files/foreign_text.h"
#include "geo/files/text_encoding.h"
#include "geo/vectors/text_path.h"
#include "geo/vectors/xml_text.h"

namespace oro {
namespace {

constexpr std::size_t most_stops = 1'000'000;
constexpr double longest_flight_s = 1e6;

Result<std::string> text_of_kml(const std::string& file) {
    ORO_TRY(const OpenFile opened, OpenFile::open(file, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, opened.size());
    if (size > longest_vector_text)
        return Error{ErrorKind::failed, file, "is longer than 1 GiB, which is the limit"};
    std::string bytes(size, '\0');
    ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(bytes))));
    auto text = utf8_xml(std::move(bytes));
    if (!text.ok()) return Error{text.error().kind, file, text.error().what};
    return text;
}

class TourReader {
  public:
    TourReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

    Result<std::vector<TourStop>> stops_of(const pugi::xml_node& playlist) const {
        std::vector<TourStop> stops;
        for (const pugi::xml_node part : playlist.children()) {
            const std::string_view name = local_name(part);
            if (name != "FlyTo" && name != "Wait") continue;
            if (stops.size() >= most_stops)
                return Error{ErrorKind::failed, file_, "has more than 1,000,000 stops, which is the limit"};
            ORO_TRY(const double duration_s, number(part, "duration", 0.0, 0.0, longest_flight_s));
            if (name == "Wait") {
                if (!stops.empty()) stops.push_back({duration_s, stops.back().view});
                continue;
            }
            const pugi::xml_node camera = child_named(part, "Camera"), look = child_named(part, "LookAt");
            if (!camera && !look) continue;
            ORO_TRY(const TourView view, camera ? view_of(camera, false) : view_of(look, true));
            stops.push_back({duration_s, view});
        }
        return stops;
    }

  private:
    Result<TourView> view_of(const pugi::xml_node& from, bool looks_at) const {
        TourView view;
        view.looks_at = looks_at;
        ORO_TRY(view.lat_deg, number(from, "latitude", 0.0, -90.0, 90.0));
        ORO_TRY(view.lon_deg, number(from, "longitude", 0.0, -180.0, 180.0));
        ORO_TRY(view.height_m, number(from, "altitude", 0.0, -1e7, 2e9));
        ORO_TRY(view.heading_deg, number(from, "heading", 0.0, -360.0, 360.0));
        ORO_TRY(view.tilt_deg, number(from, "tilt", 0.0, -180.0, 180.0));
        ORO_TRY(view.roll_deg, number(from, "roll", 0.0, -180.0, 180.0));
        ORO_TRY(view.range_m, number(from, "range", 0.0, 0.0, 1e9));
        const std::string mode = text_of(child_named(from, "altitudeMode"));
        if (mode == "absolute")
            view.heights = HeightAbove::sea_level;
        else if (!mode.starts_with("relativeTo"))
            view.height_m = 0.0;
        const std::string when = text_of(child_named(child_named(from, "TimeStamp"), "when"));
        if (const Result<std::int64_t> utc_s = utc_time_from(when); utc_s.ok()) view.time_utc_s = *utc_s;
        return view;
    }

    Result<double> number(const pugi::xml_node& from, const char* name, double usual, double low,
                          double high) const {
        const pugi::xml_node node = child_named(from, name);
        if (!node) return usual;
        const std::string word = text_of(node);
        const WrittenNumber written = written_number(word);
        if (written.fault == nullptr && written.value >= low && written.value <= high) return written.value;
        const auto line = 1 + std::ranges::count(text_.substr(0, XmlText::at(node)), '\n');
        return Error{ErrorKind::failed, file_,
                     "line " + std::to_string(line) + ": '" + name + "' is '" + foreign_text(word) +
                         "', no number that it may be"};
    }

    const std::string& file_;
    std::string_view text_;
};

}  // namespace

Result<std::vector<TourStop>> read_kml_tour(const std::string& file) {
    ORO_TRY(const std::string text, text_of_kml(file));
    const Result<XmlText> xml = XmlText::parse(text);
    if (!xml.ok()) return Error{xml.error().kind, file, xml.error().what};
    const pugi::xml_node root = xml->root();
    for (pugi::xml_node node = root; node; node = next_in(root, node)) {
        if (local_name(node) == "Tour") return TourReader(file, text).stops_of(child_named(node, "Playlist"));
    }
    return std::vector<TourStop>();
}

}  // namespace oro
