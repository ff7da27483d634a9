#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>

#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"
#include "geo/vectors/xml_text.h"

namespace oro {
namespace {

// Lengths as LandXML 1.2 and 2.0 name them. The US survey foot is 1200/3937 m.
Result<double> landxml_unit_m(const std::string& unit) {
    struct Unit {
        const char* name;
        double metres;
    };
    constexpr Unit units[] = {{"meter", 1.0},
                              {"metre", 1.0},
                              {"millimeter", 0.001},
                              {"centimeter", 0.01},
                              {"kilometer", 1e3},
                              {"foot", 0.3048},
                              {"USSurveyFoot", 1200.0 / 3937.0},
                              {"inch", 0.0254},
                              {"mile", 1609.344}};
    for (const Unit& known : units) {
        if (unit == known.name) return known.metres;
    }
    return Error{ErrorKind::failed, "", "has an unknown unit of length: " + shown_word(unit)};
}

struct LandXmlReader {
    const std::string_view bytes;
    SourceMesh mesh{};
    std::unordered_map<std::string, std::uint32_t> points{};  // of the surface being read, by id

    [[nodiscard]] Error fault(const pugi::xml_node& node, const std::string& why) const {
        const std::size_t at = std::min(XmlText::at(node), bytes.size());
        const auto line = 1 + std::ranges::count(bytes.substr(0, at), '\n');
        return mesh_fault("line", static_cast<std::size_t>(line), why);
    }

    Result<void> point(const pugi::xml_node& node) {
        const std::string text = text_of(node);
        std::string_view words = text;
        double north = 0.0, east = 0.0, height = 0.0;
        for (double* value : {&north, &east, &height}) {
            const std::string_view word = take_word(words);
            if (word.empty()) return fault(node, "a point has fewer than three numbers");
            if (!mesh_number(word, *value)) return fault(node, shown_word(word) + " is no number");
        }
        const std::string id = node.attribute("id").value();
        if (!points.emplace(id, static_cast<std::uint32_t>(mesh.vertices.size())).second)
            return fault(node, "the point " + shown_word(id) + " is there twice");
        mesh.vertices.emplace_back(east, north, height);
        return {};
    }

    Result<void> face(const pugi::xml_node& node) {
        if (node.attribute("i").as_int() == 1) {
            ++mesh.invisible;
            return {};
        }
        const std::string text = text_of(node);
        std::string_view words = text;
        std::vector<std::uint32_t> corners;  // three, or four of a grid's cell
        for (std::string_view word = take_word(words); !word.empty(); word = take_word(words)) {
            const auto found = points.find(std::string(word));
            if (found == points.end()) return fault(node, "there is no point " + shown_word(word));
            corners.push_back(found->second);
        }
        if (const char* const reason = add_polygon(corners, mesh)) return fault(node, reason);
        return {};
    }

    Result<void> surface(const pugi::xml_node& node) {
        points.clear();
        mesh.parts.push_back({node.attribute("name").value(), mesh.triangles.size()});
        const pugi::xml_node definition = child_named(node, "Definition");
        for (const pugi::xml_node list : definition.children()) {
            if (local_name(list) != "Pnts") continue;
            for (const pugi::xml_node child : list.children())
                if (local_name(child) == "P") ORO_CHECK(point(child));
        }
        for (const pugi::xml_node list : definition.children()) {
            if (local_name(list) != "Faces") continue;
            for (const pugi::xml_node child : list.children())
                if (local_name(child) == "F") ORO_CHECK(face(child));
        }
        return {};
    }
};

}  // namespace

Result<SourceMesh> read_landxml(std::string_view bytes) {
    ORO_TRY(const XmlText xml, XmlText::parse(bytes));
    if (local_name(xml.root()) != "LandXML")
        return Error{ErrorKind::failed, "", "is no LandXML: it is " + shown_word(local_name(xml.root()))};
    LandXmlReader reader{bytes};
    reader.mesh.format = "LandXML";
    reader.mesh.kind = MeshKind::survey;
    for (const pugi::xml_node system : child_named(xml.root(), "Units").children()) {
        if (const pugi::xml_attribute unit = system.attribute("linearUnit")) {
            reader.mesh.unit = unit.value();
            ORO_TRY(reader.mesh.metres_per_unit, landxml_unit_m(reader.mesh.unit));
        }
    }
    const std::string code = child_named(xml.root(), "CoordinateSystem").attribute("epsgCode").value();
    long long number = 0;
    const std::string_view digits = std::string_view(code).substr(code.starts_with("EPSG:") ? 5 : 0);
    // Some programs write 0, or words, where they know of none.
    if (whole_number_in(digits, number) && number > 0) reader.mesh.crs = "EPSG:" + std::to_string(number);
    for (const pugi::xml_node list : xml.root().children()) {
        if (local_name(list) != "Surfaces") continue;
        for (const pugi::xml_node child : list.children())
            if (local_name(child) == "Surface") ORO_CHECK(reader.surface(child));
    }
    return std::move(reader.mesh);
}

}  // namespace oro
