// Files of meshes by grammar: sound ones that writers may make, and those with one rule broken.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "geo/meshes/mesh_census.h"
#include "geo/meshes/mesh_file.h"

namespace oro {
namespace {

class MeshGrammar {
  public:
    explicit MeshGrammar(unsigned seed) : random_(seed) {}

    std::string text_of(const std::string& ending) {
        odds_ = below(2) == 0 ? 40 : 4000;
        has_colours_ = below(3) == 0;
        if (ending == "obj") return obj();
        if (ending == "ply") return ply();
        return ending == "stl" ? stl() : landxml();
    }

  private:
    std::size_t below(std::size_t end) { return random_() % end; }
    bool rarely() { return below(odds_) == 0; }
    template <class... Words>
    std::string one_of(Words... words) {
        const std::string all[] = {words...};
        return all[below(sizeof...(words))];
    }
    std::string number() {
        if (rarely())
            return one_of("nan", "inf", "-inf", "1e999", "1e-999", "0x10", "1,5", "", "--1", "1e",
                          "\xC3\xA9");
        if (rarely()) return one_of("1e15", "-1e300", "4.9e-324", "00007", "+3", ".5", "5.");
        return std::to_string(static_cast<double>(below(1000)) / 8.0);
    }
    std::string index(std::size_t vertices) {
        if (rarely())
            return one_of("0", "-0", "99999999999999999999", "-9223372036854775808", "4294967296", "1.5", "x",
                          "//");
        return std::to_string(1 + below(vertices));
    }
    std::string blank() { return rarely() ? one_of("\t", "  ", "\v", "\\\n") : " "; }
    std::string line_end() { return rarely() ? one_of("\r\n", "\n\n", " # x\n", "\\\n", "") : "\n"; }

    // Behind a vertex's place, in files that have them.
    std::string colour() {
        std::string text;
        for (std::size_t i = has_colours_ ? (rarely() ? below(5) : 3) : 0; i > 0; --i)
            text += blank() + (rarely() ? number() : one_of("0", "1", "0.5", "255", "-1"));
        return text;
    }

    std::string obj() {
        std::string text;
        const std::size_t vertices = 3 + below(9);
        for (std::size_t i = 0; i < vertices; ++i)
            text +=
                "v" + blank() + number() + blank() + number() + blank() + number() + colour() + line_end();
        for (std::size_t i = below(6); i > 0; --i) {
            if (below(4) == 0)
                text += one_of("o a", "g", "usemtl b", "vn 0 0 1", "l 1 2", "s off", "vt 0") + line_end();
            text += "f";
            for (std::size_t corners = rarely() ? below(3) : 3 + below(6); corners > 0; --corners)
                text += blank() + (below(3) == 0 ? "-" : "") + index(vertices) +
                        one_of("", "", "/1", "//2", "/1/1");
            text += line_end();
        }
        return text;
    }
    std::string colour_lines() {
        std::string text;
        for (const char* const part : {"red", "green", "blue"})
            if (has_colours_ && !rarely())
                text += "property " + one_of("uchar", "ushort", "float", "int") + " " + part + "\n";
        return text;
    }
    std::string ply() {
        const std::size_t vertices = 3 + below(9), faces = below(6);
        const std::string count =
            rarely() ? one_of("0", "-1", "18446744073709551616", "") : std::to_string(vertices);
        const std::string vertex_lines = "element vertex " + count + line_end() +
                                         "property double x\nproperty float y\n" +
                                         (rarely() ? "" : "property double z\n") + colour_lines();
        const std::string list =
            "property list " + (rarely() ? "float" : one_of("uchar", "int", "uint8", "char")) + " " +
            one_of("int", "uint", "double", "uchar") + " vertex_ind" + one_of("ex", "ices") + "\n";
        const std::string face_lines = "element face " + std::to_string(faces) + "\n" + list;
        std::string vertex_rows, face_rows;
        for (std::size_t i = 0; i < vertices; ++i)
            vertex_rows += number() + blank() + number() + blank() + number() + colour() + line_end();
        for (std::size_t i = 0; i < faces; ++i) {
            const std::size_t corners = rarely() ? below(3) : 3 + below(6);
            face_rows += std::to_string(corners + (rarely() ? 1 : 0));
            for (std::size_t k = 0; k < corners; ++k) face_rows += blank() + index(vertices - 1);
            face_rows += line_end();
        }
        const bool faces_first = below(4) == 0;
        return "ply\nformat ascii 1.0\ncomment x" + line_end() + (faces_first ? face_lines : vertex_lines) +
               (faces_first ? vertex_lines : face_lines) + (rarely() ? "" : "end_header\n") +
               (faces_first ? face_rows : vertex_rows) + (faces_first ? vertex_rows : face_rows);
    }
    std::string stl() {
        std::string text = "solid " + one_of("", "a b", "\xC3\xA9") + "\n";
        for (std::size_t i = below(6); i > 0; --i) {
            text += "facet normal 0 0 1\nouter loop\n";
            for (std::size_t corners = rarely() ? below(5) : 3; corners > 0; --corners)
                text += "vertex" + blank() + number() + blank() + number() + blank() + number() + line_end();
            text += rarely() ? "endfacet\n" : "endloop\nendfacet\n";
        }
        return text + (rarely() ? "" : "endsolid\n");
    }
    std::string landxml() {
        const std::string prefix = below(4) == 0 ? "l:" : "";
        const auto tag = [&](const std::string& name, const std::string& content) {
            return "<" + prefix + name + (rarely() ? "" : ">") + content +
                   (rarely() ? "" : "</" + prefix + name.substr(0, name.find(' ')) + ">");
        };
        const std::size_t vertices = 3 + below(9);
        std::string points, faces;
        for (std::size_t i = 0; i < vertices; ++i)
            points += tag("P id=\"" + (rarely() ? index(vertices) : std::to_string(i + 1)) + "\"",
                          number() + blank() + number() + blank() + number());
        for (std::size_t i = below(6); i > 0; --i) {
            std::string corners;
            for (std::size_t k = rarely() ? below(6) : 3; k > 0; --k) corners += index(vertices) + blank();
            faces += tag("F" + one_of("", "", " i=\"1\"", " i=\"0\"", " n=\"0 1 2\""), corners);
        }
        const std::string unit = rarely() ? one_of("cubit", "") : one_of("meter", "foot", "USSurveyFoot");
        return one_of("", "<?xml version=\"1.0\"?>", "<!DOCTYPE x [<!ENTITY a \"b\">]>") +
               tag("LandXML",
                   tag("Units", "<Metric linearUnit=\"" + unit + "\"/>") +
                       tag("Surfaces", tag("Surface name=\"&a;&lt;\"",
                                           tag("Definition", tag("Faces", faces) + tag("Pnts", points)))));
    }

    std::size_t odds_{40};  // one in so many rules is broken
    bool has_colours_{};
    std::mt19937 random_;
};

// Each ends in a mesh whose corners are there and finite, or in one line that says why not.
TEST(MeshGrammar, EachFileEndsInAMeshOrOneLine) {
    const unsigned seed = 5252;
    SCOPED_TRACE("seed " + std::to_string(seed));
    MeshGrammar grammar(seed);
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "mesh_grammar";
    std::filesystem::create_directories(folder);
    for (const std::string ending : {"obj", "ply", "stl", "landxml"}) {
        int read_whole = 0;
        const std::string path = (folder / ("x." + ending)).string();
        for (int round = 0; round < 250; ++round) {
            const std::string text = grammar.text_of(ending);
            std::ofstream(path, std::ios::binary) << text;
            const auto mesh = read_mesh(path);
            if (!mesh.ok()) {
                ASSERT_FALSE(mesh.error().what.empty()) << text;
                ASSERT_EQ(mesh.error().line().find('\n'), std::string::npos) << text;
                continue;
            }
            ++read_whole;
            ASSERT_FALSE(mesh->triangles.empty()) << text;
            for (const SourceTriangle& triangle : mesh->triangles) {
                for (const std::uint32_t corner : triangle) {
                    ASSERT_LT(corner, mesh->vertices.size()) << text;
                    const glm::dvec3& at = mesh->vertices[corner];
                    ASSERT_TRUE(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z)) << text;
                }
            }
            const MeshCensus census = census_of(*mesh);
            EXPECT_LE(census.degenerate + census.duplicates, census.triangles) << text;
        }
        // A grammar that breaks each file, or none, tests nothing.
        EXPECT_GT(read_whole, 60) << ending;
        EXPECT_LT(read_whole, 245) << ending;
    }
}

}  // namespace
}  // namespace oro
