// 3D Tiles as meshes: which tiles are taken, where they lie, and what is refused, with its file and tile.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include "geo/meshes/mesh_file.h"
#include "geo/pictures/png_bytes.h"
#include "tests/geo/meshes/made_tiles.h"

namespace oro {
namespace {

using test::b3dm_of, test::content_of, test::firsts_of, test::glb_at, test::put_number;

using Tilesets = test::FolderOfTiles;

TEST_F(Tilesets, TheLastOfReplacedTilesAreTaken) {
    for (int i = 0; i < 4; ++i) write("t/" + std::to_string(i) + ".glb", glb_at(static_cast<float>(10 * i)));
    const std::string leaves = R"("children":[{)" + content_of("t/1.glb") + R"(,"children":[{)" +
                               content_of("t/2.glb") + R"(}]},{)" + content_of("t/3.glb") + "}]";
    const auto replaced = read(R"({"refine":"REPLACE",)" + content_of("t/0.glb") + "," + leaves + "}");
    ASSERT_TRUE(replaced.ok()) << replaced.error().line();
    EXPECT_EQ(firsts_of(*replaced), (std::vector<double>{20.0, 30.0})) << "children refine as their parent";
    EXPECT_EQ(replaced->format, "3D Tiles");
    EXPECT_EQ(replaced->crs, "EPSG:4978");
    EXPECT_EQ(replaced->parts.at(0).name, "t/2.glb");
    const auto added = read(R"({"refine":"ADD",)" + content_of("t/0.glb") + "," + leaves + "}");
    ASSERT_TRUE(added.ok()) << added.error().line();
    EXPECT_EQ(firsts_of(*added), (std::vector<double>{0.0, 10.0, 20.0, 30.0}));
    const auto mixed =
        read(R"({"refine":"ADD",)" + content_of("t/0.glb") + R"(,"children":[{"refine":"replace",)" +
             content_of("t/1.glb") + R"(,"children":[{)" + content_of("t/2.glb") + "}]}]}");
    ASSERT_TRUE(mixed.ok()) << mixed.error().line();
    EXPECT_EQ(firsts_of(*mixed), (std::vector<double>{0.0, 20.0}));
    const auto several = read(R"({"refine":"ADD","contents":[{"uri":"t/0.glb"},{"uri":"t/3.glb"}]})");
    ASSERT_TRUE(several.ok()) << several.error().line();
    EXPECT_EQ(firsts_of(*several), (std::vector<double>{0.0, 30.0}));
}

// glTF's y is turned up before a tile's transform, parents' go first, and all is in double: 6,378,137.25 m +
// 0.125 m are kept, which float would round to half a metre.
TEST_F(Tilesets, TransformsAreMultipliedInDouble) {
    write("a.glb", glb_at(2.0F));
    const std::string turn = R"("transform":[0,1,0,0,-1,0,0,0,0,0,1,0,6378137.25,7,11,1])",
                      step = R"("transform":[1,0,0,0,0,1,0,0,0,0,1,0,0,-0.125,100,1])";
    const auto mesh =
        read(R"({"refine":"ADD",)" + turn + R"(,"children":[{)" + step + "," + content_of("a.glb") + "}]}");
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    // (2, 0, 0) steps to (2, -0.125, 100), and turns to (0.125, 2, 100).
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(6378137.375, 9.0, 111.0));
    EXPECT_EQ(mesh->vertices[1], glm::dvec3(6378137.375, 10.0, 111.0));
    // glTF's (2, 0, -1) lies 1 m north: (2, 1, 0).
    EXPECT_EQ(mesh->vertices[2], glm::dvec3(6378136.375, 9.0, 111.0));
}

TEST_F(Tilesets, BatchedModelsLieAroundTheirCentre) {
    write("a.b3dm", b3dm_of(glb_at(2.0F), R"({"BATCH_LENGTH":0,"RTC_CENTER":[4000000.5,3,5]})"));
    write("b.b3dm", b3dm_of(glb_at(7.0F), R"({"BATCH_LENGTH":0})"));
    const auto mesh = read(R"({"refine":"ADD","contents":[{"uri":"a.b3dm"},{"uri":"b.b3dm"}]})");
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(4000002.5, 3.0, 5.0));
    EXPECT_EQ(mesh->vertices[2], glm::dvec3(4000002.5, 4.0, 5.0));
    EXPECT_EQ(mesh->vertices[3], glm::dvec3(7.0, 0.0, 0.0));
}

TEST_F(Tilesets, FurtherTilesetsAreReadWhereTheyLie) {
    write("sub/t/a.glb", glb_at(2.0F));
    write("b.glb", glb_at(5.0F));
    write("sub/more.json",
          R"({"asset":{"version":"1.0"},"geometricError":1,"root":{"refine":"ADD","transform":)"
          R"([1,0,0,0,0,1,0,0,0,0,1,0,0,0,7,1],"content":{"url":"t/a.glb"},)"
          R"("children":[{"content":{"uri":"../b.glb?v=2"}}]}})");
    const auto mesh = read(R"({"refine":"REPLACE","transform":[1,0,0,0,0,1,0,0,0,0,1,0,100,0,0,1],)"
                           R"("content":{"uri":"sub/more.json"}})");
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    ASSERT_EQ(mesh->triangles.size(), 2U);
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(102.0, 0.0, 7.0));
    EXPECT_EQ(mesh->vertices[3], glm::dvec3(105.0, 0.0, 7.0));
}

// Half of the light of red is the code 188.
TEST_F(Tilesets, ColoursOfMaterialsAreKept) {
    const std::string half_red = R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0,0,1]}})",
                      textured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
                      texture = R"("textures":[{"source":0}],"images":[{"uri":"a.png"}],)";
    write("a.glb", glb_at(0.0F, half_red));
    write("b.glb", glb_at(5.0F));
    write("c.glb", glb_at(9.0F, textured, texture));
    const auto mesh =
        read(R"({"refine":"ADD","contents":[{"uri":"b.glb"},{"uri":"a.glb"},{"uri":"c.glb"}]})");
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    ASSERT_EQ(mesh->colours.size(), 9U);
    EXPECT_EQ(mesh->colours[0], VertexColour{});
    EXPECT_EQ(mesh->colours[3], (VertexColour{188, 0, 0, 1}));
    EXPECT_EQ(mesh->colours[8], VertexColour{});
    EXPECT_EQ(mesh->notes,
              std::vector<std::string>{"its texture a.png cannot be opened: No such file or directory: "
                                       "drawn without it"});
}

// A texture beside its tile, in a folder below the set's: a texel of red.
TEST_F(Tilesets, TexturesOfTilesAreRead) {
    const std::vector<std::uint8_t> red_texel{255, 0, 0};
    const auto png = png_bytes(red_texel, 1, 1);
    ASSERT_TRUE(png.ok());
    write("t/a.png", {png->begin(), png->end()});
    std::string glb = glb_at(0.0F, R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
                             R"("textures":[{"source":0}],"images":[{"uri":"a.png"}],)");
    // The same numbers are places and coordinates: three of VEC3 hold three of VEC2.
    const std::string places = R"({"POSITION":0})", both = R"({"POSITION":0,"TEXCOORD_0":1})",
                      accessor = R"("type":"VEC3"}],)",
                      two =
                          R"("type":"VEC3"},{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}],)";
    for (const auto& [was, now] : {std::pair(places, both), {accessor, two}}) {
        glb.replace(glb.find(was), was.size(), now);
        const auto more = static_cast<std::uint32_t>(now.size() - was.size());
        for (const std::size_t at : {std::size_t{8}, std::size_t{12}}) {
            std::uint32_t size = 0;
            std::memcpy(&size, glb.data() + at, sizeof size);
            size += more;
            std::memcpy(glb.data() + at, &size, sizeof size);
        }
    }
    for (const bool is_b3dm : {false, true}) {
        write(is_b3dm ? "t/a.b3dm" : "t/a.glb", is_b3dm ? b3dm_of(glb, R"({"BATCH_LENGTH":0})") : glb);
        const auto mesh = read("{" + content_of(is_b3dm ? "t/a.b3dm" : "t/a.glb") + "}");
        ASSERT_TRUE(mesh.ok()) << mesh.error().line();
        ASSERT_EQ(mesh->colours.size(), 3U);
        EXPECT_EQ(mesh->colours[0], (VertexColour{255, 0, 0, 1}));
        EXPECT_EQ(mesh->textures.at(0).name, "a.png");
    }
}

TEST_F(Tilesets, RefusesInOneLine) {
    write("a.glb", glb_at(0.0F));
    const std::string a = content_of("a.glb");
    EXPECT_EQ(refusal("{" + a + "}", R"("extensionsRequired":["MAXAR_content_geojson"],)"),
              "needs the extension MAXAR_content_geojson, which is not read");
    EXPECT_EQ(refusal(R"({"refine":"MIX",)" + a + "}"), "the root refines by MIX: REPLACE and ADD are read");
    EXPECT_EQ(refusal(R"({"transform":[1,0,0],)" + a + "}"),
              "the root has a transform that is no list of 16 numbers");
    EXPECT_EQ(refusal(R"({"content":{}})"), "the root has a content without a uri");
    for (const std::string uri : {"https://example.org/a.glb", "../a.glb", "/etc/a.glb", "t/../../a.glb", ""})
        EXPECT_EQ(refusal("{" + content_of(uri) + "}"),
                  "the root has its content at " + uri + ": only files below the tileset's folder are read");
    EXPECT_EQ(refusal(R"({"children":[5]})"), "tile 0 is no JSON object");
    EXPECT_NE(
        refusal("{" + content_of("none.glb") + "}").find("the root has its content in none.glb, which "),
        std::string::npos)
        << refusal("{" + content_of("none.glb") + "}");
    write("p.pnts", "pnts....");
    EXPECT_EQ(refusal(R"({"children":[{)" + content_of("p.pnts") + "}]}"),
              "tile 0 has its content in p.pnts, which is of points (pnts), which are not read");
    write("d.glb", glb_at(0.0F, "", R"("extensionsRequired":["KHR_draco_mesh_compression"],)"));
    EXPECT_EQ(
        refusal("{" + content_of("d.glb") + "}"),
        "the root has its content in d.glb, which needs the extension KHR_draco_mesh_compression, which "
        "is not read");
    write("c.b3dm", b3dm_of(glb_at(0.0F), "{}").substr(0, 60));
    EXPECT_EQ(
        refusal("{" + content_of("c.b3dm") + "}"),
        "the root has its content in c.b3dm, which is cut off: its header promises more bytes than it has");
    write("self.json", R"({"asset":{"version":"1.0"},"geometricError":1,"root":)"
                       R"({"content":{"uri":"self.json"}}})");
    EXPECT_NE(refusal("{" + content_of("self.json") + "}")
                  .find("self.json, which is a tileset that it is itself below"),
              std::string::npos);
    EXPECT_EQ(refusal("{}"), "no triangles");
    EXPECT_EQ(refusal("5"), "is no set of 3D Tiles: it has no root");
}

TEST_F(Tilesets, OtherVersionsAndUpAxesAreRefused) {
    const auto why = [&](const std::string& asset) {
        const auto mesh =
            read_mesh(write("tileset.json", R"({"asset":)" + asset + R"(,"geometricError":9,"root":{}})"));
        return mesh.ok() ? "" : mesh.error().what;
    };
    EXPECT_EQ(why(R"({"version":"2.0"})"), "is 3D Tiles 2.0: 1.0 and 1.1 are read");
    EXPECT_EQ(why("{}"), "is 3D Tiles without a version: 1.0 and 1.1 are read");
    EXPECT_EQ(why(R"({"version":"1.0","gltfUpAxis":"Z"})"), "has models whose up axis is Z: Y is read");
}

// Sets by grammar, with some rules broken: each ends in a mesh whose corners are there, or in one line.
class TilesetGrammar {
  public:
    explicit TilesetGrammar(unsigned seed) : random_(seed) {}
    std::string set() {
        return R"({"asset":{"version":)" + one_of(R"("1.0")", R"("1.1")", R"("1.1")", "1.1", "null") +
               R"(},"geometricError":)" + one_of("1", "1e999", "\"x\"") + R"(,"root":)" + tile(0) + "}";
    }

  private:
    std::size_t below(std::size_t end) { return random_() % end; }
    template <class... Words>
    std::string one_of(Words... words) {
        const std::string all[] = {words...};
        return all[below(sizeof...(words))];
    }
    std::string number() {
        return below(40) == 0 ? one_of("1e999", "null", "-0", "\"1\"", "[]") : one_of("0", "1", "-1", "0.5");
    }
    std::string tile(int depth) {
        std::string text = R"({"refine":)" +
                           one_of(R"("ADD")", R"("REPLACE")", R"("ADD")", below(30) == 0 ? "7" : R"("add")");
        if (below(3) == 0) {
            text += R"(,"transform":[)";
            for (std::size_t i = below(60) == 0 ? below(18) : 16; i > 0; --i)
                text += number() + (i > 1 ? "," : "");
            text += "]";
        }
        if (below(2) == 0)
            text += R"(,"content":)" + (below(40) == 0 ? one_of("null", "5", "[]", "{}")
                                                       : R"({"uri":")" +
                                                             one_of("a.glb", "a.glb", "b.b3dm", "more.json",
                                                                    below(40) == 0 ? "tileset.json" : "a.glb",
                                                                    below(40) == 0 ? "%2e%2e/x" : "a.glb") +
                                                             R"("})");
        if (depth < 5 && below(4) != 0) {
            text += R"(,"children":[)";
            for (std::size_t i = below(4); i > 0; --i) text += tile(depth + 1) + (i > 1 ? "," : "");
            text += "]";
        }
        if (below(200) == 0) text += R"(,"implicitTiling":{})";
        return text + "}";
    }
    std::mt19937 random_;
};

TEST_F(Tilesets, EachByGrammarEndsInAMeshOrOneLine) {
    const unsigned seed = 5231;
    SCOPED_TRACE("seed " + std::to_string(seed));
    TilesetGrammar grammar(seed);
    write("a.glb", glb_at(2.0F));
    write("b.b3dm", b3dm_of(glb_at(3.0F), R"({"RTC_CENTER":[1,2,3]})"));
    write("more.json", R"({"asset":{"version":"1.0"},"geometricError":1,"root":{"refine":"ADD",)" +
                           content_of("a.glb") + "}}");
    int read_whole = 0;
    for (int i = 0; i < 400; ++i) {
        const std::string text = grammar.set();
        const auto mesh = read_mesh(write("tileset.json", text));
        if (!mesh.ok()) {
            ASSERT_FALSE(mesh.error().what.empty()) << text;
            ASSERT_EQ(mesh.error().line().find('\n'), std::string::npos) << text;
            continue;
        }
        ++read_whole;
        for (const SourceTriangle& triangle : mesh->triangles)
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh->vertices.size()) << text;
    }
    EXPECT_GT(read_whole, 40);
    EXPECT_LT(read_whole, 360);
}

// Each cut, and each of many damaged bytes, of a batched model ends in an answer.
TEST_F(Tilesets, DamagedModelsEndInAnAnswer) {
    const unsigned seed = 5232;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::string sound = b3dm_of(glb_at(3.0F), R"({"RTC_CENTER":[1,2,3]})");
    for (int i = 0; i < 400; ++i) {
        std::string bytes = sound;
        if (i % 3 == 0)
            bytes.resize(random() % bytes.size());
        else
            bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
        write("x.b3dm", bytes);
        const auto mesh = read("{" + content_of("x.b3dm") + "}");
        if (!mesh.ok()) {
            EXPECT_FALSE(mesh.error().what.empty());
            continue;
        }
        for (const SourceTriangle& triangle : mesh->triangles)
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh->vertices.size());
    }
}

}  // namespace
}  // namespace oro
