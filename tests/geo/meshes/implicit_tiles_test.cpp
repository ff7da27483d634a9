// Implicit tiles: which are taken, where their files are, what their bits mean, and what is refused.
#include "geo/meshes/implicit_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/geo/meshes/made_tiles.h"

namespace oro {
namespace {

using test::content_of, test::firsts_of, test::glb_at, test::put_number;

std::string padded(std::string text, char with) {
    while (text.size() % 8 != 0) text += with;
    return text;
}

// A subtree's file of that JSON, with bytes behind it.
std::string subtree_of(const std::string& json, const std::string& binary = "") {
    std::string bytes = "subt";
    put_number(bytes, std::uint32_t{1});
    const std::string text = padded(json, ' '), rest = padded(binary, '\0');
    put_number(bytes, std::uint64_t{text.size()});
    put_number(bytes, std::uint64_t{rest.size()});
    return bytes + text + rest;
}

std::string constants(int tiles, int contents, int subtrees) {
    return R"({"tileAvailability":{"constant":)" + std::to_string(tiles) +
           R"(},"contentAvailability":[{"constant":)" + std::to_string(contents) +
           R"(}],"childSubtreeAvailability":{"constant":)" + std::to_string(subtrees) + "}}";
}

// Bits of tiles, contents and subtrees below, one after the other, each beginning with a byte of its own.
std::string bits_of(const std::vector<std::vector<bool>>& lists, std::string& binary) {
    std::string views;
    for (const std::vector<bool>& list : lists) {
        while (binary.size() % 8 != 0) binary += '\0';
        const std::size_t begin = binary.size(), bytes = (list.size() + 7) / 8;
        binary.resize(begin + bytes);
        for (std::size_t i = 0; i < list.size(); ++i)
            if (list[i]) binary[begin + i / 8] = static_cast<char>(binary[begin + i / 8] | (1 << (i % 8)));
        views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
                 std::to_string(begin) + R"(,"byteLength":)" + std::to_string(bytes) + "}";
    }
    return R"({"buffers":[{"byteLength":)" + std::to_string(binary.size()) + R"(}],"bufferViews":[)" + views +
           R"(],"tileAvailability":{"bitstream":0,"availableCount":1},"contentAvailability":[{"bitstream":1}],)"
           R"("childSubtreeAvailability":{"bitstream":2}})";
}

std::string tiling_of(const std::string& scheme, int levels, int subtree_levels) {
    return R"("implicitTiling":{"subdivisionScheme":")" + scheme + R"(","availableLevels":)" +
           std::to_string(levels) + R"(,"subtreeLevels":)" + std::to_string(subtree_levels) +
           R"(,"subtrees":{"uri":"s/{level}/{x}.{y}.{z}.subtree"}})";
}
const std::string templated = content_of("c/{level}.{x}.{y}.{z}.glb");

struct ImplicitTiles : test::FolderOfTiles {
    // Why tiles of that tiling are refused.
    std::string why(const std::string& tiling) {
        return refusal(R"({"refine":"ADD",)" + tiling + "," + templated + "}");
    }
    // ... whose first subtree has these bytes.
    std::string of_subtree(const std::string& bytes, int levels = 2) {
        write("s/0/0.0.0.subtree", bytes);
        const std::string line = why(tiling_of("QUADTREE", levels, 2));
        const std::string begin = "implicit tile 0/0/0 has its subtree in s/0/0.0.0.subtree, which ";
        return line.starts_with(begin) ? line.substr(begin.size()) : line;
    }
};

TEST_F(ImplicitTiles, TemplatesTakeTheNumbersOfATile) {
    EXPECT_EQ(uri_of("a/{level}/{x}-{y}{z}.glb", {3, 5, 6, 7}), "a/3/5-67.glb");
    EXPECT_EQ(uri_of("{levels}/{x", {3, 5, 6, 7}), "{levels}/{x");
    EXPECT_EQ((ImplicitTile{2, 1, 3, 0}.name(false)), "implicit tile 2/1/3");
}

// Of two levels in one subtree: children in Morton's order, x first.
TEST_F(ImplicitTiles, ReplacedTilesGiveWayToTheirChildren) {
    write("s/0/0.0.0.subtree", subtree_of(constants(1, 1, 0)));
    for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 2; ++y)
            write("c/1." + std::to_string(x) + "." + std::to_string(y) + ".0.glb",
                  glb_at(static_cast<float>(10 * x + y)));
    write("c/0.0.0.0.glb", glb_at(99.0F));
    const std::string tiles = tiling_of("QUADTREE", 2, 2) + "," + templated + "}";
    const auto replaced = read(R"({"refine":"REPLACE",)" + tiles);
    ASSERT_TRUE(replaced.ok()) << replaced.error().line();
    EXPECT_EQ(firsts_of(*replaced), (std::vector<double>{0.0, 10.0, 1.0, 11.0}));
    const auto added = read(R"({"refine":"ADD",)" + tiles);
    ASSERT_TRUE(added.ok()) << added.error().line();
    EXPECT_EQ(firsts_of(*added), (std::vector<double>{99.0, 0.0, 10.0, 1.0, 11.0}));
}

TEST_F(ImplicitTiles, TheRootsTransformMovesAll) {
    write("s/0/0.0.0.subtree", subtree_of(constants(1, 1, 0)));
    write("c/0.0.0.0.glb", glb_at(2.0F));
    const auto mesh = read(R"({"transform":[1,0,0,0,0,1,0,0,0,0,1,0,6378137.25,7,11,1],"refine":"ADD",)" +
                           tiling_of("QUADTREE", 1, 1) + "," + templated + "}");
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->vertices[0], glm::dvec3(6378139.25, 7.0, 11.0));
}

// The extension of 3D Tiles 1.0, several contents, a subtree that is JSON alone with its bits in a file
// beside it.
TEST_F(ImplicitTiles, AreReadAsTheExtensionHasThem) {
    std::string bits(8, '\0');
    bits[0] = 0b00101;  // the root, and its second child: of all five
    write("s/bits.bin", bits);
    write("s/0/0.0.0.subtree",
          R"({"buffers":[{"uri":"../bits.bin","byteLength":1}],"bufferViews":[{"buffer":0,"byteLength":1}],)"
          R"("tileAvailability":{"bufferView":0},"contentAvailability":{"bufferView":0},)"
          R"("childSubtreeAvailability":{"constant":0}})");
    write("c/1.1.0.0.glb", glb_at(5.0F));
    const auto mesh = read(
        R"({"refine":"REPLACE",)" + templated +
            R"(,"extensions":{"3DTILES_implicit_tiling":{"subdivisionScheme":"QUADTREE","maximumLevel":1,)"
            R"("subtreeLevels":2,"subtrees":{"uri":"s/{level}/{x}.{y}.0.subtree"}}}})",
        R"("extensionsRequired":["3DTILES_implicit_tiling"],)");
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(firsts_of(*mesh), (std::vector<double>{5.0}));
}

// Random trees: what is taken is what a tree of their own says, by coordinates that are halved step by step,
// with no code of Morton's order.
struct TileKey {
    std::uint32_t level, x, y, z;
    auto operator<=>(const TileKey&) const = default;
};

// Tiles of which each is there by chance, and has a content by chance, and the subtrees that say so.
class RandomTree {
  public:
    RandomTree(bool is_octree, std::uint32_t levels, std::mt19937& random)
        : is_octree_(is_octree),
          levels_(levels),
          subtree_levels_(static_cast<std::uint32_t>(1 + random() % 3)) {
        tiles_.insert(TileKey{0, 0, 0, 0});
        grow({0, 0, 0, 0}, random);
    }
    [[nodiscard]] std::uint32_t subtree_levels() const { return subtree_levels_; }
    [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }
    [[nodiscard]] std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> files;
        for (const TileKey& root : tiles_)
            if (root.level % subtree_levels_ == 0) files[name_of("", root)] = subtree_at(root);
        return files;
    }
    // Contents that are to be taken, sorted.
    [[nodiscard]] std::vector<std::string> taken(bool replaced) const {
        std::vector<std::string> names;
        for (const TileKey& key : with_content_)
            if (!replaced || !has_children(key)) names.push_back(name_of("c", key));
        std::ranges::sort(names);
        return names;
    }

  private:
    static std::string name_of(const std::string& begin, const TileKey& key) {
        return uri_of(begin + "{level}.{x}.{y}.{z}", {key.level, key.x, key.y, key.z});
    }
    void grow(const TileKey& key, std::mt19937& random) {
        if (random() % 2 == 0) with_content_.insert(key);
        if (key.level + 1 >= levels_) return;
        for (std::uint32_t child = 0; child < (is_octree_ ? 8U : 4U); ++child) {
            if (random() % 3 == 0) continue;
            const TileKey below{key.level + 1, 2 * key.x + child % 2, 2 * key.y + child / 2 % 2,
                                2 * key.z + child / 4};
            tiles_.insert(below);
            grow(below, random);
        }
    }
    [[nodiscard]] bool has_children(const TileKey& key) const {
        return std::ranges::any_of(tiles_, [&](const TileKey& one) {
            return one.level == key.level + 1 && one.x / 2 == key.x && one.y / 2 == key.y &&
                   one.z / 2 == key.z;
        });
    }
    // Tiles of so many levels of a subtree.
    [[nodiscard]] std::size_t count_of(std::uint32_t levels) const {
        std::size_t all = 0;
        for (std::uint32_t level = 0, count = 1; level < levels; ++level, count *= is_octree_ ? 8 : 4)
            all += count;
        return all;
    }
    // The place of a tile below another among the bits of its level: one digit of base 4 or 8 a level.
    [[nodiscard]] std::size_t place_of(const TileKey& key, const TileKey& root) const {
        std::size_t place = 0;
        for (std::uint32_t level = root.level + 1; level <= key.level; ++level) {
            const std::uint32_t up = key.level - level;
            const std::size_t digit = (key.x >> up) % 2 + 2 * ((key.y >> up) % 2) + 4 * ((key.z >> up) % 2);
            place = place * (is_octree_ ? 8 : 4) + digit;
        }
        return place;
    }
    static bool is_below(const TileKey& key, const TileKey& root) {
        const std::uint32_t up = key.level - root.level;
        return key.level >= root.level && key.x >> up == root.x && key.y >> up == root.y &&
               key.z >> up == root.z;
    }
    [[nodiscard]] std::string subtree_at(const TileKey& root) const {
        const std::size_t all = count_of(subtree_levels_);
        std::vector<std::vector<bool>> lists{std::vector<bool>(all), std::vector<bool>(all),
                                             std::vector<bool>(count_of(subtree_levels_ + 1) - all)};
        for (const TileKey& key : tiles_) {
            if (!is_below(key, root) || key.level > root.level + subtree_levels_) continue;
            const std::uint32_t level = key.level - root.level;
            const std::size_t place = place_of(key, root);
            if (level == subtree_levels_) {
                lists[2][place] = true;
                continue;
            }
            lists[0][count_of(level) + place] = true;
            lists[1][count_of(level) + place] = with_content_.contains(key);
        }
        std::string binary;
        const std::string json = bits_of(lists, binary);
        return subtree_of(json, binary);
    }

    bool is_octree_;
    std::uint32_t levels_, subtree_levels_;
    std::set<TileKey> tiles_, with_content_;
};

TEST_F(ImplicitTiles, OfRandomTreesThoseWithoutChildrenAreTaken) {
    const unsigned seed = 5240;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    int trees_of_several_subtrees = 0;
    for (int round = 0; round < 60; ++round) {
        const bool is_octree = round % 2 == 0, replaced = round % 3 != 0;
        const auto levels = static_cast<std::uint32_t>(2 + round % 4);
        const RandomTree tree(is_octree, levels, random);
        const std::map<std::string, std::string> files = tree.files();
        trees_of_several_subtrees += files.size() > 1 ? 1 : 0;
        std::vector<std::string> taken;
        std::size_t counted = 0;
        ImplicitWalk walk;
        walk.subtree = [&](const std::string& uri) -> Result<std::string> {
            const auto found = files.find(uri);
            if (found == files.end()) return Error{ErrorKind::failed, "", "is not there"};
            return std::string(found->second);
        };
        walk.content = [&](const ImplicitTile&, const std::string& uri) -> Result<void> {
            taken.push_back(uri);
            return {};
        };
        walk.count = [&]() -> Result<void> {
            ++counted;
            return {};
        };
        const auto walked = walk_implicit_tiles(
            {is_octree, tree.subtree_levels(), levels, "{level}.{x}.{y}.{z}", {"c{level}.{x}.{y}.{z}"}},
            replaced, walk);
        ASSERT_TRUE(walked.ok()) << walked.error().line();
        EXPECT_EQ(counted, tree.tiles());
        std::ranges::sort(taken);
        EXPECT_EQ(taken, tree.taken(replaced)) << "round " << round;
    }
    EXPECT_GT(trees_of_several_subtrees, 20);
}

TEST_F(ImplicitTiles, RefusesInOneLine) {
    EXPECT_EQ(why(R"("implicitTiling":{})"),
              "the root has implicit tiles by no scheme: QUADTREE and OCTREE are read");
    EXPECT_EQ(why(tiling_of("KDTREE", 1, 1)),
              "the root has implicit tiles by KDTREE: QUADTREE and OCTREE are read");
    EXPECT_EQ(why(tiling_of("QUADTREE", 0, 1)),
              "the root has implicit tiles without a number of levels from 1 to 32");
    EXPECT_EQ(why(tiling_of("QUADTREE", 33, 1)),
              "the root has implicit tiles without a number of levels from 1 to 32");
    EXPECT_EQ(why(tiling_of("OCTREE", 9, 9)),
              "the root has implicit tiles whose subtreeLevels is no number from 1 to 8");
    EXPECT_EQ(why(R"("implicitTiling":{"subdivisionScheme":"OCTREE","availableLevels":1,"subtreeLevels":1})"),
              "the root has implicit tiles without a template of subtrees");
}

TEST_F(ImplicitTiles, RefusesSubtreesThatCannotBeRead) {
    EXPECT_EQ(of_subtree("subt"), "is cut off: a subtree has 24 bytes and more");
    std::string other = subtree_of(constants(1, 0, 0));
    other[4] = 2;
    EXPECT_EQ(of_subtree(other), "is a subtree of version 2: 1 is read");
    EXPECT_EQ(of_subtree(subtree_of(constants(1, 0, 0)).substr(0, 60)),
              "is cut off: its header promises more bytes than it has");
    EXPECT_EQ(of_subtree("{}"), "has no tileAvailability");
    EXPECT_EQ(of_subtree(constants(2, 0, 0)), "has a tileAvailability whose constant is not 0 or 1");
    EXPECT_EQ(of_subtree(R"({"tileAvailability":{"bitstream":0}})"), "has a tileAvailability without bits");
    EXPECT_EQ(of_subtree(R"({"buffers":[{"byteLength":1}]})"),
              "has a buffer without a uri, and no bytes of its own");
    EXPECT_EQ(of_subtree(subtree_of(R"({"buffers":[{"byteLength":9}]})", "12345678")),
              "has a buffer of 9 bytes, of which 8 are there");
    EXPECT_EQ(
        of_subtree(subtree_of(R"({"buffers":[{"byteLength":1}],"bufferViews":[{"buffer":0,"byteOffset":1,)"
                              R"("byteLength":1}]})",
                              "1")),
        "has a buffer view beyond its buffer");
    EXPECT_EQ(
        of_subtree(subtree_of(R"({"buffers":[{"byteLength":0}],"bufferViews":[{"buffer":0,"byteLength":0}],)"
                              R"("tileAvailability":{"bitstream":0}})")),
        "has a tileAvailability of 0 bytes, expected 1");
    EXPECT_EQ(of_subtree(R"({"buffers":[{"uri":"http://example.org/b","byteLength":1}]})"),
              "has a buffer in http://example.org/b, which is not below the tileset's folder: only files "
              "there are read");
}

TEST_F(ImplicitTiles, RefusesTreesThatContradictThemselves) {
    EXPECT_EQ(of_subtree(constants(0, 0, 0)), "implicit tile 0/0/0 has a subtree without it");
    std::string binary;
    EXPECT_EQ(of_subtree(subtree_of(bits_of({{true, false, false, false, false},
                                             {false, false, true, false, false},
                                             std::vector<bool>(16)},
                                            binary),
                                    binary)),
              "implicit tile 1/1/0 has a content and is not there");
    binary.clear();
    std::vector<bool> below(16);
    below[7] = true;
    EXPECT_EQ(of_subtree(subtree_of(
                  bits_of({{true, false, false, true, false}, std::vector<bool>(5), below}, binary), binary)),
              "implicit tile 2/3/1 is there, and the tile above it is not");
    EXPECT_EQ(of_subtree(constants(1, 0, 0), 1), "implicit tile 1/0/0 is there, below the last of 1 levels");
    // A subtree that names itself for all tiles below it ends with the levels.
    EXPECT_EQ(of_subtree(constants(1, 0, 1)).substr(0, 22), "implicit tile 2/0/0 ha");
    EXPECT_NE(
        of_subtree(constants(1, 1, 0)).find("implicit tile 0/0/0 has its content in c/0.0.0.0.glb, which "),
        std::string::npos);
}

// Trees without end are told of: a subtree for all, each with all tiles and subtrees. 4^11 / 3 tiles are 1.4
// million.
TEST_F(ImplicitTiles, TooManyTilesAreRefused) {
    const auto why = [&](int levels, int subtree_levels) {
        return refusal(
            R"({"refine":"ADD","implicitTiling":{"subdivisionScheme":"QUADTREE","availableLevels":)" +
            std::to_string(levels) + R"(,"subtreeLevels":)" + std::to_string(subtree_levels) +
            R"(,"subtrees":{"uri":"all.subtree"}},)" + templated + "}");
    };
    write("all.subtree", subtree_of(constants(1, 0, 0)));
    EXPECT_EQ(why(11, 11), "has more than 1,000,000 tiles");
    write("all.subtree", subtree_of(constants(1, 0, 1)));
    EXPECT_EQ(why(32, 8), "implicit tile 32/0/0 is there, below the last of 32 levels");
}

// Sets by grammar, with some rules broken: each ends in a mesh whose corners are there, or in one line.
TEST_F(ImplicitTiles, EachByGrammarEndsInAMeshOrOneLine) {
    const unsigned seed = 5241;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&](std::size_t end) { return random() % end; };
    const auto availability = [&](std::size_t views) {
        return below(3) == 0
                   ? R"({"constant":)" + std::to_string(below(20) == 0 ? 7 : below(2)) + "}"
                   : R"({"bitstream":)" + std::to_string(below(views + (below(20) == 0 ? 2 : 0) + 1)) + "}";
    };
    for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 2; ++y)
            write("c/1." + std::to_string(x) + "." + std::to_string(y) + ".0.glb", glb_at(1.0F));
    write("c/0.0.0.0.glb", glb_at(1.0F));
    int read_whole = 0;
    for (int i = 0; i < 600; ++i) {
        std::string binary(8 * (1 + below(4)), '\0');
        for (char& byte : binary) byte = static_cast<char>(below(2) == 0 ? 255 : below(256));
        std::string views;
        const std::size_t count = 1 + below(3);
        for (std::size_t k = 0; k < count; ++k)
            views += (k > 0 ? "," : "") + std::string(R"({"buffer":)") + (below(40) == 0 ? "1" : "0") +
                     R"(,"byteOffset":)" + std::to_string(below(10)) + R"(,"byteLength":)" +
                     std::to_string(below(30) == 0 ? 99 : 1 + below(6)) + "}";
        std::string json =
            R"({"buffers":[{"byteLength":)" + std::to_string(below(30) == 0 ? 1000000000000 : binary.size()) +
            R"(}],"bufferViews":[)" + views + R"(],"tileAvailability":)" + availability(count) +
            R"(,"contentAvailability":[)" + availability(count) + R"(],"childSubtreeAvailability":)" +
            (below(2) == 0 ? R"({"constant":0})" : availability(count)) + "}";
        if (below(20) == 0) json.resize(below(json.size()));
        std::string bytes = subtree_of(json, binary);
        if (below(6) == 0) bytes[below(bytes.size())] = static_cast<char>(below(256));
        write("s/0/0.0.0.subtree", bytes);
        const auto mesh = read(R"({"refine":)" + std::string(below(2) == 0 ? R"("ADD",)" : R"("REPLACE",)") +
                               tiling_of(below(2) == 0 ? "QUADTREE" : "OCTREE",
                                         1 + static_cast<int>(below(3)), 1 + static_cast<int>(below(3))) +
                               "," + templated + "}");
        if (!mesh.ok()) {
            ASSERT_FALSE(mesh.error().what.empty()) << json;
            ASSERT_EQ(mesh.error().line().find('\n'), std::string::npos) << json;
            continue;
        }
        ++read_whole;
        for (const SourceTriangle& triangle : mesh->triangles)
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh->vertices.size()) << json;
    }
    std::printf("%d of 600 read whole\n", read_whole);
    EXPECT_GT(read_whole, 10);
    EXPECT_LT(read_whole, 500);
}

}  // namespace
}  // namespace oro
