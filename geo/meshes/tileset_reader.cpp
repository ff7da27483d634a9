// The finest tiles of a set of 3D Tiles 1.0 and 1.1 as one mesh, in ECEF:
// https://docs.ogc.org/cs/22-025r4/22-025r4.html
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/meshes/implicit_tiles.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"
#include "geo/meshes/path_beside.h"
#include "geo/meshes/tile_json.h"
#include "geo/vectors/json_text.h"

namespace oro {
namespace {

// Those that change nothing of what is read.
bool is_known_tile_extension(const std::string& name) {
    constexpr std::array<std::string_view, 5> known{"3DTILES_content_gltf", "3DTILES_bounding_volume_S2",
                                                    "3DTILES_metadata", "3DTILES_batch_table_hierarchy",
                                                    "3DTILES_implicit_tiling"};
    return std::ranges::find(known, name) != known.end();
}

// What a content of tiles is of, by its first four bytes; "" for what is read or is unknown.
std::string_view what_is_not_read(std::string_view bytes) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kinds{
        {{"i3dm", "instances (i3dm)"},
         {"pnts", "points (pnts)"},
         {"cmpt", "several tiles in one (cmpt)"},
         {"vctr", "vectors (vctr)"},
         {"subt", "a subtree of implicit tiles"}}};
    for (const auto& [magic, words] : kinds)
        if (bytes.starts_with(magic)) return words;
    return "";
}

// Turns the mesh's places; glTF's were turned to z up when they were read.
void move(const glm::dmat4& transform, SourceMesh& mesh) {
    for (glm::dvec3& vertex : mesh.vertices) vertex = glm::dvec3(transform * glm::dvec4(vertex, 1.0));
}

// The model in a batched model (b3dm), and where its middle is.
struct BatchedModel {
    std::string_view glb;
    glm::dvec3 centre_m{0.0};
};

Result<BatchedModel> batched_model(std::string_view bytes) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::size_t head = 28;
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return static_cast<std::size_t>(value);
    };
    if (bytes.size() < head) return tileset_fault("is cut off: a b3dm has 28 bytes and more");
    if (number(4) != 1)
        return tileset_fault("is a b3dm of version " + std::to_string(number(4)) + ": 1 is read");
    const std::size_t features = number(12), begin = head + features + number(16) + number(20) + number(24);
    if (number(8) > bytes.size() || begin > number(8))
        return tileset_fault("is cut off: its header promises more bytes than it has");
    BatchedModel model{bytes.substr(begin, number(8) - begin)};
    if (features == 0) return model;
    const std::string_view text = bytes.substr(head, features);
    ORO_CHECK(check_json(text, 0));
    const JsonValue table(text, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const auto centre = TileMembers(table).find("RTC_CENTER");
    if (!centre) return model;
    int part = 0;
    bool is_sound = centre->is(JsonValue::Kind::array);
    centre->each([&](const JsonValue& one) {
        is_sound = is_sound && part < 3 && mesh_number(one.source(), model.centre_m[part]);
        return ++part < 4;
    });
    if (!is_sound || part != 3) return tileset_fault("has an RTC_CENTER that is no list of three numbers");
    return model;
}

class TilesetReader {
  public:
    explicit TilesetReader(const FileBeside& beside) : beside_(beside) {
        mesh_.format = "3D Tiles", mesh_.crs = ecef_crs;
    }

    // folder: of the tileset, from the first one's; with its slash.
    Result<void> read(std::string_view text, const std::string& folder, const glm::dmat4& above) {
        const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
        ORO_CHECK(check_json(text, begin));
        const std::size_t at = text.find_first_not_of(" \t\r\n", begin);
        const JsonValue root(text, at == std::string_view::npos ? begin : at);
        const TileMembers members(root);
        const auto tile = members.find("root"), asset = members.find("asset");
        const auto version = asset ? TileMembers(*asset).find("version") : std::nullopt;
        const std::string stated = version ? version->words() : "";
        if (!tile || !tile->is(JsonValue::Kind::object))
            return tileset_fault("is no set of 3D Tiles: it has no root");
        if (stated != "1.0" && stated != "1.1" && stated != "0.0")
            return tileset_fault("is 3D Tiles " +
                                 (stated.empty() ? "without a version" : shown_word(stated)) +
                                 ": 1.0 and 1.1 are read");
        const auto up = TileMembers(*asset).find("gltfUpAxis");
        if (up && up->words() != "Y")
            return tileset_fault("has models whose up axis is " + shown_word(up->words()) + ": Y is read");
        for (const JsonValue& one : members.list("extensionsRequired"))
            if (!is_known_tile_extension(one.words()))
                return tileset_fault("needs the extension " + shown_word(one.words()) +
                                     ", which is not read");
        return read_tile(*tile, {folder, "the root"}, above, true);
    }

    SourceMesh take() {
        for (std::string& note : notes_) mesh_.notes.push_back(std::move(note));
        return std::move(mesh_);
    }

  private:
    struct Where {
        std::string folder;
        std::string tile;  // "the root", "tile 0/2"
        [[nodiscard]] Where child(std::size_t number) const {
            const std::string own = std::to_string(number);
            return {folder, tile == "the root" ? "tile " + own : tile + "/" + own};
        }
    };
    // A reason with what it is about.
    [[nodiscard]] static Error fault_at(const Where& where, const std::string& why) {
        return tileset_fault((where.folder.empty() ? "" : where.folder + ": ") + where.tile + " " + why);
    }

    [[nodiscard]] static Result<glm::dmat4> transform_of(const TileMembers& tile, const Where& where) {
        const auto list = tile.find("transform");
        glm::dmat4 matrix(1.0);
        if (!list) return matrix;
        int part = 0;
        bool is_sound = list->is(JsonValue::Kind::array);
        list->each([&](const JsonValue& one) {
            is_sound = is_sound && part < 16 && mesh_number(one.source(), matrix[part / 4][part % 4]);
            return ++part < 17;
        });
        if (!is_sound || part != 16) return fault_at(where, "has a transform that is no list of 16 numbers");
        return matrix;
    }

    // Whether the children of a tile take its place, and are not added to it.
    [[nodiscard]] static Result<bool> is_replaced(const TileMembers& tile, const Where& where,
                                                  bool otherwise) {
        const auto refine = tile.find("refine");
        if (!refine) return otherwise;
        std::string word = refine->words();
        std::ranges::transform(word, word.begin(),
                               [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        if (word != "REPLACE" && word != "ADD")
            return fault_at(where, "refines by " + shown_word(word) + ": REPLACE and ADD are read");
        return word == "REPLACE";
    }

    [[nodiscard]] static Result<void> check_extensions(const TileMembers& tile, const Where& where) {
        const auto extensions = tile.find("extensions");
        const auto has = [&](std::string_view name) {
            return extensions && TileMembers(*extensions).find(name).has_value();
        };
        if (has("3DTILES_multiple_contents"))
            return fault_at(where, "needs the extension 3DTILES_multiple_contents, which is not read");
        return {};
    }

    Result<void> count_tile() {
        constexpr std::size_t most_tiles = 1'000'000;
        if (++tiles_ > most_tiles) return tileset_fault("has more than 1,000,000 tiles");
        return {};
    }

    Result<void> read_tile(const JsonValue& tile, const Where& where, const glm::dmat4& above,
                           bool replaced) {
        ORO_CHECK(count_tile());
        if (!tile.is(JsonValue::Kind::object)) return fault_at(where, "is no JSON object");
        const TileMembers members(tile);
        ORO_CHECK(check_extensions(members, where));
        ORO_TRY(const glm::dmat4 own, transform_of(members, where));
        const glm::dmat4 transform = above * own;
        ORO_TRY(const bool replaced_below, is_replaced(members, where, replaced));
        const std::vector<JsonValue> children = members.list("children");
        ORO_TRY(const std::vector<std::string> contents, uris_of(members, where));
        ORO_TRY(const bool is_implicit,
                read_implicit_tiles(members, contents, where, transform, replaced_below));
        if (is_implicit) return {};
        if (children.empty() || !replaced_below)
            for (const std::string& uri : contents) ORO_CHECK(read_content(uri, where, transform));
        for (std::size_t i = 0; i < children.size(); ++i)
            ORO_CHECK(read_tile(children[i], where.child(i), transform, replaced_below));
        return {};
    }

    // Of a tile's contents.
    [[nodiscard]] static Result<std::vector<std::string>> uris_of(const TileMembers& tile,
                                                                  const Where& where) {
        std::vector<JsonValue> contents = tile.list("contents");
        if (const auto one = tile.find("content"); one && !one->is(JsonValue::Kind::null))
            contents.push_back(*one);
        std::vector<std::string> uris;
        for (const JsonValue& content : contents) {
            const TileMembers members(content);
            auto uri = members.find("uri");
            if (!uri) uri = members.find("url");  // before 1.0
            if (!uri) return fault_at(where, "has a content without a uri");
            uris.push_back(uri->text());
        }
        return uris;
    }

    // False where the tile has none.
    Result<bool> read_implicit_tiles(const TileMembers& tile, const std::vector<std::string>& contents,
                                     const Where& where, const glm::dmat4& transform, bool replaced) {
        Result<std::optional<ImplicitTiling>> tiling = implicit_tiling_of(tile, contents);
        if (!tiling.ok()) return fault_at(where, tiling.error().what);
        if (!*tiling) return false;
        ImplicitWalk walk;
        walk.subtree = [&](const std::string& uri) { return file_at(where.folder, uri); };
        walk.buffer = [&](const std::string& subtree, const std::string& uri) -> Result<std::string> {
            const std::string path = path_beside(where.folder, subtree).value_or("");
            Result<std::string> bytes = file_at(std::string(folder_of_path(path)), uri);
            if (!bytes.ok())
                return tileset_fault("has a buffer in " + shown_word(uri) + ", which " + bytes.error().what);
            return bytes;
        };
        walk.content = [&](const ImplicitTile& one, const std::string& uri) {
            return read_content(uri, {where.folder, one.name((*tiling)->is_octree)}, transform);
        };
        walk.count = [&] { return count_tile(); };
        ORO_CHECK(walk_implicit_tiles(**tiling, replaced, walk));
        return true;
    }

    // The bytes of a file that one in `folder` names.
    Result<std::string> file_at(const std::string& folder, const std::string& uri) {
        const std::optional<std::string> path = path_beside(folder, uri);
        if (!path) return tileset_fault("is not below the tileset's folder: only files there are read");
        ORO_TRY(std::string bytes, beside_(*path));
        if ((bytes_ += bytes.size()) > most_mesh_bytes)
            return tileset_fault("has tiles of more than 1 GiB; a mesh may have so much");
        return bytes;
    }

    Result<void> read_content(const std::string& uri, const Where& where, const glm::dmat4& transform) {
        const std::optional<std::string> path = path_beside(where.folder, uri);
        if (!path)
            return fault_at(where, "has its content at " + shown_word(uri) +
                                       ": only files below the tileset's folder are read");
        Result<std::string> bytes = beside_(*path);
        if (!bytes.ok())
            return fault_at(where, "has its content in " + *path + ", which " + bytes.error().what);
        if ((bytes_ += bytes->size()) > most_mesh_bytes)
            return tileset_fault("has tiles of more than 1 GiB; a mesh may have so much");
        const Result<void> read = add_content(*bytes, *path, where, transform);
        if (read.ok()) return {};
        // What an external tileset says names its tile itself.
        return fault_at(where, "has its content in " + *path + ", which " + read.error().what);
    }

    Result<void> add_content(const std::string& bytes, const std::string& path, const Where& where,
                             const glm::dmat4& transform) {
        if (const std::string_view what = what_is_not_read(bytes); !what.empty())
            return tileset_fault("is of " + std::string(what) + ", which are not read");
        if (is_tileset(bytes)) {
            constexpr std::size_t deepest = 64;
            if (std::ranges::find(on_way_, path) != on_way_.end())
                return tileset_fault("is a tileset that it is itself below");
            if (on_way_.size() >= deepest) return tileset_fault("is a tileset more than 64 deep");
            on_way_.push_back(path);
            ORO_CHECK(read(bytes, std::string(folder_of_path(path)), transform));
            on_way_.pop_back();
            return {};
        }
        BatchedModel model{bytes};
        if (bytes.starts_with("b3dm")) {
            ORO_TRY(model, batched_model(bytes));
        }
        const std::string folder(folder_of_path(path));
        ORO_TRY(SourceMesh part, read_gltf(model.glb, [&](const std::string& name) -> Result<std::string> {
                    return beside_(folder + name);
                }));
        // A model of its own that says where it is needs no transform.
        if (part.crs.empty()) {
            for (glm::dvec3& vertex : part.vertices) vertex += model.centre_m;
            move(transform, part);
        }
        return add(part, path, where);
    }

    Result<void> add(const SourceMesh& part, const std::string& path, const Where& where) {
        constexpr std::size_t most = 50'000'000;
        if (mesh_.triangles.size() + part.triangles.size() > most || mesh_.vertices.size() > most)
            return tileset_fault("brings the set above 50,000,000 triangles, at " + where.tile);
        mesh_.parts.push_back({path, mesh_.triangles.size()});
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.insert(mesh_.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const auto& [a, b, c] : part.triangles)
            mesh_.triangles.push_back({first + a, first + b, first + c});
        if (!part.colours.empty() || !mesh_.colours.empty()) {
            mesh_.colours.resize(first);
            mesh_.colours.insert(mesh_.colours.end(), part.colours.begin(), part.colours.end());
            mesh_.colours.resize(mesh_.vertices.size());
        }
        mesh_.textures.insert(mesh_.textures.end(), part.textures.begin(), part.textures.end());
        mesh_.texels += part.texels, mesh_.textured_vertices += part.textured_vertices;
        constexpr std::size_t most_notes = 3;
        for (const std::string& note : part.notes)
            if (notes_.size() < most_notes && std::ranges::find(notes_, note) == notes_.end())
                notes_.push_back(note);
        return {};
    }

    const FileBeside& beside_;
    std::vector<std::string> on_way_;  // tilesets from the first one's first to the one that is read
    std::size_t tiles_{}, bytes_{};
    std::vector<std::string> notes_;
    SourceMesh mesh_;
};

}  // namespace

bool is_tileset(std::string_view bytes) {
    constexpr std::size_t most_looked_at = 65536;
    const std::string_view head = bytes.substr(0, most_looked_at);
    const std::size_t begin = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return begin != std::string_view::npos && head[begin] == '{' &&
           head.find("\"geometricError\"") != std::string_view::npos &&
           head.find("\"asset\"") != std::string_view::npos;
}

Result<SourceMesh> read_tileset(std::string_view bytes, const FileBeside& beside) {
    TilesetReader reader(beside);
    ORO_CHECK(reader.read(bytes, "", glm::dmat4(1.0)));
    return reader.take();
}

}  // namespace oro
