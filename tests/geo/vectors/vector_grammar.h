// Vector files by grammar: elements of GPX, KML and GeoJSON in legal and illegal order, with values legal and
// illegal, each with the number of places that were written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace oro::test {

struct GrammarFile {
    std::string text;
    std::size_t places{};  // that stand in it, drawable or not
    bool is_legal{};       // all of it: nothing may be left out
};

// What the three grammars share.
class VectorGrammar {
  public:
    explicit VectorGrammar(std::uint64_t seed) : random_(seed) {}
    virtual ~VectorGrammar() = default;

    GrammarFile file() {
        legal_ = chance(4);
        places_ = 0;
        std::string text = content();
        return {std::move(text), places_, legal_};
    }

  protected:
    virtual std::string content() = 0;

    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }
    bool chance(std::size_t one_in) { return below(one_in) == 0; }
    bool errs(std::size_t one_in) { return !legal_ && chance(one_in); }
    template <std::size_t count>
    std::string one_of(const std::array<const char*, count>& words) {
        return words[below(count)];
    }
    std::string number(double most) {
        const double value = std::uniform_real_distribution(-most, most)(random_);
        static constexpr std::array formats{"%.6f", "%.9f", "%.12e", "%.17g", "%.2f"};
        char text[64];
        std::snprintf(text, sizeof text, formats[below(formats.size())], value);
        return text;
    }
    template <class What>
    std::string repeated(std::size_t least, std::size_t most, What&& what) {
        std::string all;
        for (std::size_t i = least + below(most - least + 1); i > 0; --i) all += what();
        return all;
    }

    bool legal_{};
    std::size_t places_{};

  private:
    std::mt19937_64 random_;
};

class GpxGrammar final : public VectorGrammar {
  public:
    using VectorGrammar::VectorGrammar;

  private:
    std::string coordinate(double most) {
        static constexpr std::array bad{"45,80",   "north", "",    "nan",  "-inf",  "1e400",
                                        "12°",     "8.1.2", "--5", "0x10", "45 80", "95.5",
                                        "1000000", "+-1.0", " ",   "1e",   "N46.5", "&amp;"};
        return errs(6) ? one_of(bad) : number(most);
    }
    std::string place(const char* name) {
        ++places_;
        std::string text = std::string("<") + name;
        if (!errs(20)) text += " lat=\"" + coordinate(89.0) + "\"";
        if (!errs(20)) text += " lon=\"" + coordinate(179.0) + "\"";
        text += ">";
        if (chance(3)) text += "<ele>" + (errs(4) ? "high" : number(1000.0)) + "</ele>";
        if (chance(6)) text += "<name>a &lt; b</name>";
        if (chance(9)) text += "<extensions><x:y xmlns:x=\"u\"><x:z>1</x:z></x:y></extensions>";
        if (errs(8)) text += anything();
        return text + "</" + name + ">";
    }
    std::string many(const char* name, std::size_t least) {
        return repeated(legal_ ? least : 0, 5, [&] { return errs(9) ? anything() : place(name); });
    }
    std::string segment() { return "<trkseg>" + many("trkpt", 2) + "</trkseg>"; }
    std::string track() {
        return "<trk><name>t</name>" + repeated(0, 3, [&] { return errs(9) ? anything() : segment(); }) +
               "</trk>";
    }
    std::string route() { return "<rte>" + many("rtept", 2) + "</rte>"; }
    std::string anything() {
        if (depth_ > 5) return place("trkpt");
        ++depth_;
        std::string text;
        switch (below(9)) {
            case 0:
                text = place("wpt");
                break;
            case 1:
                text = place("trkpt");
                break;
            case 2:
                text = place("rtept");
                break;
            case 3:
                text = segment();
                break;
            case 4:
                text = track();
                break;
            case 5:
                text = route();
                break;
            case 6:
                text = "<metadata><bounds minlat=\"1\" minlon=\"2\" maxlat=\"3\" maxlon=\"x\"/></metadata>";
                break;
            case 7:
                text = "<extensions>" + anything() + "</extensions>";
                break;
            default:
                text = "<![CDATA[ <trkpt> ]]><!-- <wpt> -->&#65;";
        }
        --depth_;
        return text;
    }
    std::string content() override {
        std::string text = "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\" creator=\"g\">\n";
        places_ += 1;
        text += "<wpt lat=\"46\" lon=\"8\"/>\n";
        text += repeated(0, 4, [&] { return place("wpt") + "\n"; });
        text += repeated(0, 3, [&] { return errs(4) ? anything() : route(); });
        text += repeated(0, 3, [&] { return errs(4) ? anything() : track(); });
        return text + "</gpx>\n";
    }

    int depth_{};
};

class KmlGrammar final : public VectorGrammar {
  public:
    using VectorGrammar::VectorGrammar;

  private:
    std::string tuple() {
        ++places_;
        static constexpr std::array bad{"north,46", "8,nan",     "inf,46",   "1e400,46",  "8",        "8,,5",
                                        "8,46,1,2", "8,95",      "800,46",   "0x8,46",    "8.1.2,46", "8;46",
                                        "8°,46°",   "8,46,high", "--8,46,0", "8,46,,,,9", "N8,E46"};
        if (errs(6)) return one_of(bad);
        std::string text = number(179.0) + (chance(9) ? " , " : ",") + number(89.0);
        if (chance(2)) text += "," + number(1000.0);
        return text;
    }
    std::string coordinates(std::size_t least, std::size_t most) {
        static constexpr std::array between{" ", "\n", "\t ", "\r\n"};
        return "<coordinates>" +
               repeated(legal_ ? least : 0, most, [&] { return tuple() + one_of(between); }) +
               "</coordinates>";
    }
    // The first place again at the end.
    std::string ring() {
        ++places_;
        const std::string first = number(179.0) + "," + number(89.0) + " ";
        std::string text = "<LinearRing><coordinates>" + first;
        text += repeated(legal_ ? 3 : 0, 5, [&] { return tuple() + " "; });
        if (legal_ || chance(2)) text += first, ++places_;
        return text + "</coordinates></LinearRing>";
    }
    std::string mode() {
        static constexpr std::array modes{"absolute", "relativeToGround", "clampToGround", "nonsense"};
        return chance(3) ? "<altitudeMode>" + one_of(modes) + "</altitudeMode>" : "";
    }
    std::string coord() {
        ++places_;
        static constexpr std::array bad{"",     "8",        "north 46", "8 46 1 2",
                                        "8,46", "nan 46 0", "8 1e400",  "8 95 0"};
        return "<gx:coord>" +
               (errs(5) ? one_of(bad) : number(179.0) + " " + number(89.0) + " " + number(900.0)) +
               "</gx:coord>";
    }
    std::string track() {
        std::string text = "<gx:Track>" + mode();
        text += repeated(
            0, 4, [&] { return "<when>" + std::string(errs(4) ? "" : "2010-05-28T02:02:09Z") + "</when>"; });
        text += repeated(legal_ ? 2 : 0, 5, [&] { return errs(9) ? anything() : coord(); });
        return text + "</gx:Track>";
    }
    std::string model() {
        ++places_;
        return "<Model>" + mode() + "<Location><longitude>" + (errs(6) ? "8,1" : number(179.0)) +
               "</longitude>" + (errs(9) ? "" : "<latitude>" + number(89.0) + "</latitude>") +
               "<altitude>0</altitude></Location><Link><href>m.dae</href></Link></Model>";
    }
    std::string geometry() {
        if (errs(12)) return anything();
        ++depth_;
        std::string text;
        switch (below(depth_ > 6 ? 4 : 8)) {
            case 0:
                text = "<Point>" + mode() + coordinates(1, 1) + "</Point>";
                break;
            case 1:
                text = "<LineString>" + mode() + coordinates(2, 6) + (errs(8) ? anything() : "") +
                       "</LineString>";
                break;
            case 2:
                text = "<LinearRing>" + coordinates(2, 6) + "</LinearRing>";
                break;
            case 3:
                text = track();
                break;
            case 4:
                text = model();
                break;
            case 5:
                text = polygon();
                break;
            case 6:
                text = "<gx:MultiTrack>" + repeated(legal_ ? 1 : 0, 3, [&] { return track(); }) +
                       "</gx:MultiTrack>";
                break;
            default:
                text = "<MultiGeometry>" + repeated(legal_ ? 1 : 0, 4, [&] { return geometry(); }) +
                       "</MultiGeometry>";
        }
        --depth_;
        return text;
    }
    std::string polygon() {
        std::string text = "<Polygon>" + mode();
        if (!errs(6)) text += "<outerBoundaryIs>" + ring() + (errs(6) ? ring() : "") + "</outerBoundaryIs>";
        text += repeated(0, 2, [&] { return "<innerBoundaryIs>" + ring() + "</innerBoundaryIs>"; });
        if (errs(6)) text += anything();
        return text + "</Polygon>";
    }
    std::string placemark() {
        ++depth_;
        std::string text = "<Placemark><name>p</name>";
        if (chance(4)) text += "<ExtendedData><Data name=\"k\"><value>v</value></Data></ExtendedData>";
        if (errs(6)) text += anything();
        text += geometry();
        if (errs(9)) text += geometry();
        --depth_;
        return text + "</Placemark>\n";
    }
    std::string container() {
        ++depth_;
        static constexpr std::array names{"Folder", "Document"};
        const std::string name = one_of(names);
        std::string text = "<" + name + "><name>c</name>";
        text += repeated(0, 3, [&] { return depth_ < 6 && chance(3) ? container() : placemark(); });
        if (errs(4)) text += anything();
        --depth_;
        return text + "</" + name + ">\n";
    }
    std::string anything() {
        if (depth_ > 9) return coordinates(0, 3);
        ++depth_;
        std::string text;
        switch (below(14)) {
            case 0:
                text = coordinates(0, 4);
                break;
            case 1:
                text = coord();
                break;
            case 2:
                text = model();
                break;
            case 3:
                text = placemark();
                break;
            case 4:
                text = container();
                break;
            case 5:
                text = geometry();
                break;
            case 6:
                text = ring();
                break;
            case 7:
                text = "<Style>" + anything() + "</Style>";
                break;
            case 8:
                text = "<Update><Change>" + placemark() + "</Change></Update>";
                break;
            case 9:
                text = "<NetworkLink><Link><href>http://127.0.0.1:1/x.kml</href></Link></NetworkLink>";
                break;
            case 10:
                text = "<outerBoundaryIs>" + geometry() + "</outerBoundaryIs>";
                break;
            case 11:
                text = "<when>" + anything() + "</when>";
                break;
            case 12:
                text = "<ExtendedData><Data><value>" + anything() + "</value></Data></ExtendedData>";
                break;
            default:
                text = "<![CDATA[<coordinates>8,46</coordinates>]]><!-- <Point> --><name/>&undeclared;";
        }
        --depth_;
        return text;
    }
    std::string content() override {
        std::string text =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
            "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">";
        ++places_;
        text += "<Document><Placemark><Point><coordinates>8,46</coordinates></Point></Placemark>\n";
        text += repeated(0, 4, [&] { return chance(3) ? container() : placemark(); });
        if (errs(2)) text += anything();
        return text + "</Document></kml>";
    }

    int depth_{};
};

class GeoJsonGrammar final : public VectorGrammar {
  public:
    using VectorGrammar::VectorGrammar;

  private:
    // Members in any order, with commas.
    std::string object(std::vector<std::string> members) {
        std::string text;
        while (!members.empty()) {
            const auto which = members.begin() + static_cast<std::ptrdiff_t>(below(members.size()));
            text += (text.empty() ? "" : chance(3) ? ",\n " : ",") + *which;
            members.erase(which);
        }
        return "{" + text + "}";
    }
    static std::string quoted_member(const std::string& name, const std::string& value) {
        return "\"" + name + "\":" + value;
    }
    template <class What>
    std::string list(std::size_t least, std::size_t most, What&& what) {
        std::string text;
        for (std::size_t i = least + below(most - least + 1); i > 0; --i)
            text += (text.empty() ? "" : ",") + what();
        return "[" + text + "]";
    }
    std::string value(double most) {
        static constexpr std::array bad{"\"45,80\"", "null", "NaN",  "-Infinity", "1e400", "true",
                                        "\"north\"", "950",  "\"\"", "\"8\"",     "1.2.3", "--5"};
        return errs(8) ? one_of(bad) : number(most);
    }
    std::string place() {
        ++places_;
        std::string text = "[" + value(179.0);
        if (!errs(20)) text += "," + value(89.0);
        if (chance(2)) text += "," + number(1000.0);
        if (chance(9)) text += ",7";
        return text + "]";
    }
    // Beside a place that is one, something that is none.
    std::string place_or_none() {
        static constexpr std::array bad{"null", "\"8,46\"", "8", "{\"lon\":8,\"lat\":46}", "false"};
        if (!errs(15)) return place();
        ++places_;
        return one_of(bad);
    }
    std::string places(std::size_t least, std::size_t most) {
        std::string text = "[" + place();
        for (std::size_t i = least + below(most - least + 1); i > 1; --i) text += "," + place_or_none();
        return text + "]";
    }
    std::string ring() {
        ++places_;
        const std::string first = "[" + number(179.0) + "," + number(89.0) + "]";
        std::string text = "[" + first;
        for (std::size_t i = (legal_ ? 3 : 0) + below(3); i > 0; --i) text += "," + place_or_none();
        if (legal_ || chance(2)) text += "," + first, ++places_;
        return text + "]";
    }
    std::string coordinates(std::size_t kind) {
        switch (kind) {
            case 0:
                return place();
            case 1:
                return places(1, 4);
            case 2:
                return places(legal_ ? 2 : 1, 5);
            case 3:
                return list(1, 3, [&] { return places(legal_ ? 2 : 1, 4); });
            case 4:
                return list(1, 3, [&] { return ring(); });
            default:
                return list(1, 2, [&] { return list(1, 2, [&] { return ring(); }); });
        }
    }
    std::string geometry() {
        static constexpr std::array types{"Point",           "MultiPoint", "LineString",
                                          "MultiLineString", "Polygon",    "MultiPolygon"};
        static constexpr std::array odd{"\"Circle\"", "\"point\"",   "7",
                                        "null",       "\"Feature\"", "\"Topology\""};
        if (errs(15)) return anything();
        if (depth_ < 6 && chance(6)) {
            ++depth_;
            const std::string parts = list(legal_ ? 1 : 0, 3, [&] { return geometry(); });
            --depth_;
            std::vector<std::string> members{"\"type\":\"GeometryCollection\"", "\"geometries\":" + parts};
            if (errs(9)) members.push_back("\"coordinates\":" + coordinates(below(6)));
            return object(members);
        }
        const std::size_t kind = below(types.size());
        std::vector<std::string> members;
        if (!errs(15))
            members.push_back("\"type\":" + (errs(9) ? one_of(odd) : "\"" + std::string(types[kind]) + "\""));
        if (!errs(15)) members.push_back("\"coordinates\":" + coordinates(errs(6) ? below(6) : kind));
        if (errs(15)) members.push_back("\"coordinates\":" + coordinates(kind));
        if (errs(15)) members.push_back("\"geometries\":[" + geometry() + "]");
        if (chance(9)) members.emplace_back("\"bbox\":[1,2,3,4]");
        return object(members);
    }
    std::string feature() {
        std::vector<std::string> members{
            "\"properties\":{\"name\":\"\\u00e9\\\"\",\"coordinates\":[8,46],\"n\":NaN}"};
        if (!errs(15)) members.emplace_back("\"type\":\"Feature\"");
        if (!errs(15)) members.push_back("\"geometry\":" + geometry());
        if (errs(15)) members.push_back("\"geometry\":" + geometry());
        if (errs(15)) members.push_back("\"geometry\":[" + geometry() + "]");
        if (errs(15)) members.push_back("\"coordinates\":" + coordinates(below(6)));
        if (chance(6)) members.emplace_back("\"id\":7");
        return object(members);
    }
    std::string collection() {
        ++depth_;
        std::vector<std::string> members{"\"type\":\"FeatureCollection\""};
        members.push_back("\"features\":" + list(0, 3, [&] { return errs(9) ? anything() : feature(); }));
        if (errs(9)) members.push_back("\"geometry\":" + geometry());
        if (errs(9)) members.push_back("\"features\":" + feature());
        --depth_;
        return object(members);
    }
    std::string anything() {
        if (depth_ > 6) return "null";
        ++depth_;
        std::string text;
        switch (below(7)) {
            case 0:
                text = feature();
                break;
            case 1:
                text = geometry();
                break;
            case 2:
                text = collection();
                break;
            case 3:
                text = "[" + geometry() + "," + feature() + "]";
                break;
            case 4:
                text = "\"features\"";
                break;
            case 5:
                text = "{}";
                break;
            default:
                text = "null";
        }
        --depth_;
        return text;
    }
    std::string content() override {
        ++places_;
        std::string features =
            "[{\"type\":\"Feature\",\"properties\":null,\"geometry\":{\"type\":\"Point\",\"coordinates\":[8,"
            "46]}}";
        for (std::size_t i = below(6); i > 0; --i)
            features += ",\n" + (errs(6) ? anything() : depth_ == 0 && errs(9) ? collection() : feature());
        std::vector<std::string> members{"\"type\":\"FeatureCollection\"", "\"features\":" + features + "]"};
        if (errs(6)) members.push_back("\"coordinates\":" + coordinates(below(6)));
        return object(members) + "\n";
    }

    int depth_{};
};

}  // namespace oro::test
