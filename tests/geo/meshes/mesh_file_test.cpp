// Files of triangle meshes: what they hold in double, what their triangles are like, and what is wrong with
// them.
#include "geo/meshes/mesh_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "geo/meshes/mesh_census.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

std::string mesh_written(const std::string& name, const std::string& bytes) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "meshes";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

// The reason why a file is refused; "" where it is read.
std::string refusal(const std::string& name, const std::string& bytes) {
    const auto read = read_mesh(mesh_written(name, bytes));
    return read.ok() ? "" : read.error().what;
}

template <class T>
std::string raw_bytes(T value, bool big_endian = false) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

// Two triangles over a square metre far from the origin, where float keeps half metres.
const std::string square_obj =
    "v 2600000.001 1200000.002 431.003\nv 2600001 1200000 431\nv 2600001 1200001 432\n"
    "v 2600000 1200001 432\no yard\nf 1/1/1 2//2 3\nf -4 -2 -1\n";

std::string binary_ply(bool big_endian) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
        "_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const double x : {5212345.678, 5212346.0, 5212345.0})
        bytes += raw_bytes(x, big_endian) + raw_bytes(x / 2.0, big_endian) + raw_bytes(1.5F, big_endian);
    bytes += '\3';
    for (const int corner : {0, 1, 2}) bytes += raw_bytes(corner, big_endian);
    return bytes;
}

std::string binary_stl(std::uint32_t promised, int triangles) {
    std::string bytes = std::string("solid by a program").append(80 - 18, ' ') + raw_bytes(promised);
    for (int i = 0; i < triangles; ++i) {
        for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.25F})
            bytes += raw_bytes(number);
        bytes += std::string(2, '\0');
    }
    return bytes;
}

std::string landxml(const std::string& faces) {
    return "<LandXML><Units><Metric linearUnit=\"meter\"/></Units><CoordinateSystem epsgCode=\"2056\"/>"
           "<Surfaces><Surface name=\"EG\"><Definition surfType=\"TIN\"><Pnts>\n"
           "<P id=\"1\">1200000.002 2600000.001 431.5</P><P id=\"a\">1200000 2600009 432</P>\n"
           "<P id=\"7\">1200009 2600000 433</P></Pnts><Faces>" +
           faces + "</Faces></Definition></Surface></Surfaces></LandXML>";
}

TEST(MeshFile, ObjKeepsDoubles) {
    const auto mesh = read_mesh(mesh_written("square.OBJ", square_obj));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(2600000.001, 1200000.002, 431.003));
    const ScratchVector<SourceTriangle> triangles{{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(mesh->triangles, triangles);
    ASSERT_EQ(mesh->parts.size(), 1U);
    EXPECT_EQ(mesh->parts[0].name, "yard");
}

TEST(MeshFile, PlyOfBothByteOrdersAndOfTextIsTheSame) {
    const std::string text =
        "ply\r\nformat ascii 1.0\r\ncomment c\r\nelement vertex 3\r\nproperty double x\r\nproperty double "
        "y\r\n"
        "property float z\r\nelement face 1\r\nproperty list uchar int vertex_index\r\nend_header\r\n"
        "5212345.678 2606172.839 1.5\r\n5212346 2606173 1.5\r\n5212345 2606172.5 1.5\r\n3 0 1 2\r\n";
    for (const std::string& bytes : {text, binary_ply(false), binary_ply(true)}) {
        const auto mesh = read_mesh(mesh_written("one.ply", bytes));
        ASSERT_TRUE(mesh.ok()) << mesh.error().line();
        ASSERT_EQ(mesh->vertices.size(), 3U);
        EXPECT_EQ(mesh->vertices[0], glm::dvec3(5212345.678, 2606172.839, 1.5));
        EXPECT_EQ(mesh->triangles, (ScratchVector<SourceTriangle>{{0, 1, 2}}));
    }
}

TEST(MeshFile, StlOfBothKindsWeldsCorners) {
    const auto binary = read_mesh(mesh_written("two.stl", binary_stl(2, 2)));
    ASSERT_TRUE(binary.ok()) << binary.error().line();
    EXPECT_EQ(binary->vertices.size(), 3U);
    EXPECT_EQ(binary->triangles.size(), 2U);
    EXPECT_EQ(binary->vertices[2], glm::dvec3(0.0, 1.0, 0.25));
    const auto text = read_mesh(mesh_written(
        "text.stl",
        "solid wall\nfacet normal 0 0 1\nouter loop\nvertex 0.1 0 0\nvertex 1 0 0\nvertex 1 1e0 0\n"
        "endloop\nendfacet\nendsolid wall\n"));
    ASSERT_TRUE(text.ok()) << text.error().line();
    EXPECT_EQ(text->vertices[0], glm::dvec3(0.1, 0.0, 0.0));
}

// Order north, east, height; a face with i="1" is not to be seen.
TEST(MeshFile, LandXmlHasItsOrderAndInvisibleFaces) {
    const auto mesh =
        read_mesh(mesh_written("eg.xml", landxml("<F n=\"0 0 0\">1 a 7</F><F i=\"1\">7 a 1</F>")));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(2600000.001, 1200000.002, 431.5));
    EXPECT_EQ(mesh->triangles, (ScratchVector<SourceTriangle>{{0, 1, 2}}));
    EXPECT_EQ(mesh->invisible, 1U);
    EXPECT_EQ(mesh->crs, "EPSG:2056");
    EXPECT_EQ(mesh->parts.at(0).name, "EG");
}

// Many files are named .xml: only LandXML is a mesh.
TEST(MeshFile, LooksIntoXml) {
    EXPECT_TRUE(is_mesh_file(mesh_written(
        "l.xml", "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- <gpx> -->\n" + landxml("<F>1 a 7</F>"))));
    EXPECT_TRUE(is_mesh_file(mesh_written("m.XML", "<lx:LandXML xmlns:lx=\"a\"/>")));
    EXPECT_FALSE(is_mesh_file(mesh_written("g.xml", "<?xml version=\"1.0\"?><gpx><!-- <LandXML> --></gpx>")));
    EXPECT_FALSE(is_mesh_file(mesh_written("k.xml", "<!DOCTYPE LandXML><kml/>")));
    EXPECT_FALSE(is_mesh_file(mesh_written("c.xml", "<!-- <LandXML>")));
    EXPECT_FALSE(is_mesh_file(mesh_written("e.xml", "")));
    EXPECT_FALSE(is_mesh_file("no/such/file.xml"));
    EXPECT_TRUE(is_mesh_file("no/such/file.stl"));
}

TEST(MeshFile, LandXmlHasCellsOfGridsAndNoCrsZero) {
    std::string text = landxml("<F>1 a 7 9</F>");
    text.replace(text.find("2056"), 4, "0");
    text.replace(text.find("</Pnts>"), 0, "<P id=\"9\">1200009 2600009 433</P>");
    const auto mesh = read_mesh(mesh_written("grid.xml", text));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->triangles.size(), 2U);
    EXPECT_EQ(mesh->crs, "");
}

TEST(MeshFile, RefusesBadInputInOneLine) {
    EXPECT_EQ(refusal("a.obj", ""), "no triangles");
    EXPECT_EQ(refusal("b.obj", "v 0 0 0\n"), "no triangles");
    EXPECT_EQ(refusal("c.obj", "v 0 0 0\nf 1 1 2\n"),
              "line 2: the corner 2 is none of the 1 vertices before it");
    EXPECT_EQ(refusal("d.obj", "v 0 0 0\nf 1 1 -2\n"),
              "line 2: the corner -2 is none of the 1 vertices before it");
    EXPECT_EQ(refusal("e.obj", "v 0 0 x\n"), "line 1: x is no number");
    EXPECT_EQ(refusal("f.obj", "v 0 0 nan\nf 1 1 1\n"),
              "no triangles: each has a vertex that is no finite place");
    EXPECT_EQ(refusal("g.xml", landxml("<F>1 a 8</F>")), "line 3: there is no point 8");
    EXPECT_EQ(refusal("h.xml", "<CityMap/>"), "is no LandXML: it is CityMap");
    EXPECT_EQ(refusal("i.stl", binary_stl(4294967295U, 1)),
              "is no whole STL: its header promises 4294967295 triangles, which take 214748364834 bytes; the "
              "file has 134");
    EXPECT_EQ(refusal("j.ply",
                      "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n0 0 0\n"),
              "byte 109: the header promises 4000000000 of vertex, more than the file can hold");
}

TEST(MeshFile, LeavesOutTrianglesThatAreNotFinite) {
    const auto mesh =
        read_mesh(mesh_written("inf.obj", square_obj + "v inf 0 0\no shed\nf 1 2 5\nf 2 3 4\n"));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->triangles.size(), 3U);
    EXPECT_EQ(mesh->not_finite, 1U);
    EXPECT_EQ(mesh->parts.at(1).first_triangle, 2U);
}

// Each cut, and each of many damaged bytes, ends in a mesh whose corners are there or in an error.
TEST(MeshFile, CutAndDamagedFilesEndInAnAnswer) {
    const unsigned int seed = 52;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::pair<std::string, std::string> files[] = {{"x.obj", square_obj},
                                                         {"x.ply", binary_ply(false)},
                                                         {"y.ply", binary_ply(true)},
                                                         {"x.stl", binary_stl(2, 2)},
                                                         {"x.xml", landxml("<F>1 a 7</F>")}};
    for (const auto& [name, bytes] : files) {
        std::vector<std::string> damaged;
        for (std::size_t length = 0; length < bytes.size(); ++length)
            damaged.push_back(bytes.substr(0, length));
        for (int i = 0; i < 300; ++i) {
            damaged.push_back(bytes);
            damaged.back()[random() % bytes.size()] = static_cast<char>(random() % 256);
        }
        for (const std::string& text : damaged) {
            const auto read = read_mesh(mesh_written(name, text));
            if (!read.ok()) {
                EXPECT_FALSE(read.error().what.empty());
                continue;
            }
            for (const SourceTriangle& triangle : read->triangles)
                for (const std::uint32_t corner : triangle) ASSERT_LT(corner, read->vertices.size());
            census_of(*read);
        }
    }
    // The last byte of a binary file is not there.
    const std::string whole = binary_ply(false);
    EXPECT_NE(refusal("cut.ply", whole.substr(0, whole.size() - 1)).find("a list is longer than the file"),
              std::string::npos);
}

// GDAL writes them, this reads them again: doubles, holes, and what has no heights.
TEST(MeshFile, GeoPackagesHoldSurfacesWithHeights) {
    const std::string tin =
        "TIN Z (((2600000.001 1200000.002 431.003,2600001 1200000 431,2600001 1200001 432,2600000.001 "
        "1200000.002 431.003)),((2600000.001 1200000.002 431.003,2600001 1200001 432,2600000 1200001 "
        "432,2600000.001 1200000.002 431.003)))";
    const std::string walls =
        "POLYHEDRALSURFACE Z (((0 0 0,0 0 5,4 0 5,4 0 0,0 0 0)),((4 0 0,4 0 5,4 4 5,4 4 0,4 0 0)))";
    const std::string roof =
        "MULTIPOLYGON Z (((0 0 9,6 0 9,6 6 9,0 6 9,0 0 9),(2 2 9,2 4 9,4 4 9,4 2 9,2 2 9)))";
    const auto mesh = read_mesh(
        test::geopackage("surfaces.gpkg", 2056,
                         {{tin, "a"}, {walls, "b"}, {roof, "c"}, {"POLYGON ((0 0,1 0,1 1,0 0))", "d"}}));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(2600000.001, 1200000.002, 431.003));
    // 2 of the TIN, 2 of each wall, 4 + 4 corners and one hole: 8 of the roof.
    EXPECT_EQ(mesh->triangles.size(), 2U + 4U + 8U);
    EXPECT_EQ(mesh->vertices.size(), 4U + 6U + 8U);
    EXPECT_EQ(mesh->crs, "EPSG:2056");
    EXPECT_EQ(mesh->format, "GeoPackage");
    const auto flat = read_mesh(test::geopackage("flat.gpkg", 0, {{"POLYGON ((0 0,1 0,1 1,0 0))", "d"}}));
    ASSERT_FALSE(flat.ok());
    EXPECT_NE(flat.error().what.find("have no heights"), std::string::npos) << flat.error().what;
    EXPECT_NE(refusal("no.gpkg", "nothing").find("is no GeoPackage of vectors"), std::string::npos);
}

MeshCensus census_of_obj(const std::string& text) {
    const auto mesh = read_mesh(mesh_written("census.obj", text));
    EXPECT_TRUE(mesh.ok());
    return mesh.ok() ? census_of(*mesh) : MeshCensus{};
}

TEST(MeshCensus, CountsWhatIsInASquare) {
    const MeshCensus square = census_of_obj(square_obj);
    EXPECT_EQ(square.triangles, 2U);
    EXPECT_EQ(square.vertices, 4U);
    EXPECT_EQ(square.rim_edges, 4U);
    EXPECT_EQ(square.rims, 1U);
    EXPECT_EQ(square.turned_edges, 0U);
    // One triangle the other way; the first again, and both ways round; one without an area.
    const MeshCensus bad = census_of_obj(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0 0\nf 1 2 3\nf 1 4 3\nf 2 3 1\nf 3 2 1\nf 1 5 2\n");
    EXPECT_EQ(bad.turned_edges, 1U);
    EXPECT_EQ(bad.duplicates, 2U);
    EXPECT_EQ(bad.degenerate, 1U);
    EXPECT_EQ(bad.rims, 1U);
}

// Degrees are no metres: a house of 11 m is no point of a lattice of 54 m.
TEST(MeshCensus, OfDegreesCountsMetres) {
    const auto mesh = read_mesh(test::geopackage(
        "degrees.gpkg", 4326,
        {{"POLYHEDRALSURFACE Z (((8 46 5,8.0001 46 5,8.0001 46.0001 5,8 46.0001 5,8 46 5)))", "roof"}}));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    const MeshCensus census = census_of(*mesh);
    EXPECT_EQ(census.vertices, 4U);
    EXPECT_EQ(census.degenerate, 0U);
    EXPECT_EQ(census.rims, 1U);
}

TEST(MeshCensus, ClosedAndCrowdedMeshes) {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\n";
    const MeshCensus closed = census_of_obj(corners + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    EXPECT_EQ(closed.rim_edges, 0U);
    EXPECT_EQ(closed.rims, 0U);
    const MeshCensus fan = census_of_obj(corners + "f 1 2 3\nf 1 2 4\nf 1 2 5\n");
    EXPECT_EQ(fan.crowded_edges, 1U);
    EXPECT_EQ(fan.rim_edges, 6U);
    // Two corners joined by three ways of two edges: one is a rim with another, the third ends there.
    EXPECT_EQ(fan.open_chains, 1U);
    EXPECT_EQ(fan.rims, 1U);
}

// Triangles as the README of the data has them. Of Olympus six are degenerate on the lattice: so says the
// README, and so does a count in whole numbers.
TEST(MeshFile, RealSurveys) {
    const auto found = test::real_data("meshes");
    if (!found) GTEST_SKIP() << "needs meshes";
    const std::filesystem::path& folder = *found;
    const auto olympus = read_mesh((folder / "olympus-new.xml").string());
    ASSERT_TRUE(olympus.ok()) << olympus.error().line();
    EXPECT_EQ(olympus->triangles.size(), 24612U);
    EXPECT_EQ(olympus->metres_per_unit, 0.3048);
    const MeshCensus census = census_of(*olympus);
    EXPECT_EQ(census.degenerate, 6U);
    const auto subdivision = read_mesh((folder / "subdivision-2.0.xml").string());
    ASSERT_TRUE(subdivision.ok()) << subdivision.error().line();
    ASSERT_EQ(subdivision->parts.size(), 2U);
    const std::size_t second = subdivision->parts[1].first_triangle;
    const std::size_t other = subdivision->triangles.size() - second;
    EXPECT_EQ(std::max(second, other), 5241U);
    EXPECT_EQ(std::min(second, other), 1284U);
}

}  // namespace
}  // namespace oro
