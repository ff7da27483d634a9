// CSV and TopoJSON by grammar, beside vector_grammar.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tests/geo/vectors/vector_grammar.h"

namespace oro::test {

class CsvGrammar final : public VectorGrammar {
  public:
    using VectorGrammar::VectorGrammar;

  private:
    std::string quoted(const std::string& text) {
        std::string all = "\"";
        for (const char c : text) all += c == '"' ? std::string("\"\"") : std::string(1, c);
        return all + "\"";
    }
    // A field whose text may hold what parts fields, which it then must not do.
    std::string field(const std::string& text) {
        const bool must = text.find_first_of(std::string("\"\n") + mark_) != std::string::npos;
        return must || chance(6) ? quoted(text) : text;
    }
    std::string coordinate(double most) {
        static constexpr std::array bad{"north", "",        "nan", "1e400", "12°",  "8.1.2",
                                        "--5",   "1.234,5", "8 1", "95000", "0x10", "1,2,3"};
        if (errs(6)) return one_of(bad);
        std::string text = number(most);
        const std::size_t point = text.find('.');
        if (point != std::string::npos && chance(4)) text[point] = ',';
        return text;
    }
    std::string words() {
        static constexpr std::array all{"", "Piz A", "a\"b", "two\nlines", "1;2", "x,y", " blank ", "é"};
        return one_of(all);
    }
    std::string place_line() {
        ++places_;
        std::string lat = coordinate(89.0), lon = coordinate(179.0);
        // Commas for decimals need quotation marks where commas part fields, or the table is refused.
        const auto number_field = [&](const std::string& text) {
            return text.find(mark_) != std::string::npos ? quoted(text) : text;
        };
        std::string line = field(words()) + mark_ + number_field(lat) + mark_ + number_field(lon);
        line += mark_ + (errs(6) ? std::string("high") : chance(3) ? "" : "1234.5");
        if (errs(9)) line = field("cut");
        return line + end();
    }
    std::string wkt_line() {
        static constexpr std::array<std::pair<const char*, std::size_t>, 7> whole{
            {{"POINT(8 46)", 1},
             {"LINESTRING(8 46,9 46,9 47)", 3},
             {"POLYGON((8 46,9 46,9 47,8 46))", 4},
             {"MULTIPOINT((1 2),(3 4))", 2},
             {"POINT Z (8 46 5)", 1},
             {"GEOMETRYCOLLECTION(POINT(1 2),LINESTRING(1 2,3 4))", 3},
             {"SRID=4326;POINT(8 46)", 1}}};
        static constexpr std::array bad{"POINT(8,5 46)", "POINT(8 46", "here",
                                        "POINT(8 46)x",  "((((",       "POINT(a b)"};
        static constexpr std::array empty{"", "POINT EMPTY", "GEOMETRYCOLLECTION EMPTY"};
        std::string wkt;
        if (errs(4)) {
            wkt = one_of(bad);
            ++places_;
        } else if (errs(6)) {
            wkt = one_of(empty);
        } else {
            const auto& [text, places] = whole[below(whole.size())];
            wkt = text;
            places_ += places;
        }
        return field(words()) + mark_ + (wkt.empty() ? wkt : field(wkt)) + end();
    }
    std::string end() {
        static constexpr std::array ends{"\n", "\r\n", "\n\n", "\n"};
        return one_of(ends);
    }
    std::string content() override {
        static constexpr std::array<char, 4> marks{',', ';', '\t', '|'};
        mark_ = marks[below(marks.size())];
        const bool is_wkt = chance(3);
        const std::string m(1, mark_);
        std::string text = chance(6) ? "sep=" + m + "\n" : "";
        if (is_wkt) {
            text += "name" + m + "WKT\nfirst" + m + "POINT(8 46)\n";
        } else {
            static constexpr std::array<std::pair<const char*, const char*>, 3> headings{
                {{"lat", "lon"}, {"Latitude", "LONGITUDE"}, {"lat (deg)", "\"lng\""}}};
            const auto& [lat, lon] = headings[below(headings.size())];
            text += "name" + m + lat + m + lon + m + "ele\nfirst" + m + "46" + m + "8\n";
        }
        ++places_;
        return text + repeated(0, 9, [&] { return is_wkt ? wkt_line() : place_line(); });
    }

    char mark_{','};
};

class TopoJsonGrammar final : public VectorGrammar {
  public:
    using VectorGrammar::VectorGrammar;

  private:
    template <class What>
    std::string list(std::size_t least, std::size_t most, What&& what) {
        std::string text;
        for (std::size_t i = least + below(most - least + 1); i > 0; --i)
            text += (text.empty() ? "" : ",") + what();
        return "[" + text + "]";
    }
    std::string value(double most) {
        static constexpr std::array bad{"null", "\"8\"", "1e400", "true", "NaN", "9999999"};
        if (errs(12)) return one_of(bad);
        return is_quantized_ ? std::to_string(static_cast<int>(below(9)) - 4) : number(most);
    }
    std::string position() {
        static constexpr std::array bad{"null", "8", "[null]", "[8]", "[[8,46]]", "{}"};
        if (errs(20)) return one_of(bad);
        std::string text = "[" + value(179.0) + "," + value(89.0);
        if (chance(6)) text += "," + number(900.0);
        return text + "]";
    }
    std::string arc(std::size_t least) {
        std::size_t places = 0;
        std::string text = list(legal_ ? least : 0, 5, [&] { return ++places, position(); });
        arcs_.push_back({places, false});
        return text;
    }
    // A list of arcs whose places are counted: where one follows another the first of its places is no new
    // one.
    std::string arc_list() {
        static constexpr std::array bad{"null", "99", "-99", "\"0\"", "0.5", "[0]"};
        std::size_t places = 0;
        std::string text = list(1, 3, [&]() -> std::string {
            if (errs(9)) return one_of(bad);
            const std::size_t which = below(arcs_.size());
            arcs_[which].second = true;
            const std::size_t own = arcs_[which].first;
            places += places > 0 && own > 0 ? own - 1 : own;
            return chance(3) ? "-" + std::to_string(which + 1) : std::to_string(which);
        });
        places_ += places;
        return text;
    }
    std::string geometry() {
        static constexpr std::array types{"Point",   "MultiPoint",   "LineString",        "MultiLineString",
                                          "Polygon", "MultiPolygon", "GeometryCollection"};
        const std::size_t kind = below(depth_ > 3 ? 6 : 7);
        std::string text = R"({"type":")" + std::string(types[kind]) + R"(",)";
        if (chance(3)) text += R"("properties":{"name":"a\"b","n":NaN},)";
        if (kind == 6) {
            ++depth_;
            text += R"("geometries":)" + list(legal_ ? 1 : 0, 3, [&] { return geometry(); }) + "}";
            --depth_;
            return text;
        }
        if (kind < 2) {
            const auto one = [&] { return ++places_, position(); };
            if (kind == 0) {
                const std::string coordinates = one();
                if (coordinates == "null") --places_;  // no place, and none that is wrong
                return text + R"("coordinates":)" + coordinates + "}";
            }
            return text + R"("coordinates":)" + list(1, 3, one) + "}";
        }
        const auto arcs = [&] { return arc_list(); };
        const auto rings = [&] { return list(1, 2, arcs); };
        return text + R"("arcs":)" +
               (kind == 2                ? arc_list()
                : kind == 3 || kind == 4 ? list(1, 2, arcs)
                                         : list(1, 2, rings)) +
               "}";
    }
    std::string content() override {
        is_quantized_ = chance(2);
        arcs_.clear();
        // A legal line has two places, and a legal ring four of which the last is the first.
        const std::string arcs = list(1, 4, [&] { return arc(2); });
        std::string text = R"({"type":"Topology",)";
        if (is_quantized_) text += R"("transform":{"scale":[0.01,0.01],"translate":[8,46]},)";
        ++places_;
        text += R"("objects":{"first":{"type":"Point","coordinates":[0,0]})";
        for (std::size_t i = below(4); i > 0; --i) {
            text += ",\n\"o" + std::to_string(i) + "\":";
            text += chance(2) ? geometry()
                              : R"({"type":"GeometryCollection","geometries":)" +
                                    list(legal_ ? 1 : 0, 4, [&] { return geometry(); }) + "}";
        }
        for (const auto& [places, is_used] : arcs_)
            if (!is_used) places_ += places;
        // Rings of chance are not closed, and an arc may be of no use.
        legal_ = false;
        return text + "},\n\"arcs\":" + arcs + "}\n";
    }

    std::vector<std::pair<std::size_t, bool>> arcs_;  // the places of each, and whether a geometry has it
    bool is_quantized_{};
    int depth_{};
};

}  // namespace oro::test
