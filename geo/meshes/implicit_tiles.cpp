#include "geo/meshes/implicit_tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "geo/meshes/mesh_words.h"

namespace oro {
namespace {

constexpr std::uint32_t most_levels = 32;
constexpr std::size_t most_buffers = 1000, most_views = 100000;

// A whole number from 0 to `most`; nothing where it is none.
std::optional<std::size_t> count_of(const std::optional<JsonValue>& value, std::size_t most) {
    long long number = -1;
    if (!value || !whole_number_in(value->source(), number) || number < 0) return std::nullopt;
    const auto count = static_cast<unsigned long long>(number);
    return count <= most ? std::optional(static_cast<std::size_t>(count)) : std::nullopt;
}

std::string template_in(const std::optional<JsonValue>& holder) {
    if (!holder) return "";
    const auto uri = TileMembers(*holder).find("uri");
    return uri ? uri->text() : "";
}

// Bits of which each says whether something is there: all alike, or the first of each byte its lowest.
class Availability {
  public:
    Availability() = default;
    explicit Availability(bool all) : all_(all) {}
    explicit Availability(std::string_view bytes) : bytes_(bytes) {}
    [[nodiscard]] bool operator[](std::size_t bit) const {
        return bytes_.data() == nullptr ? all_
                                        : (static_cast<unsigned char>(bytes_[bit / 8]) >> bit % 8 & 1U) != 0;
    }

  private:
    bool all_{};
    std::string_view bytes_;
};

// Where the tiles of a level of a subtree begin among its bits, and how many there are.
struct SubtreeShape {
    std::uint32_t children{};  // of a tile: 4 or 8
    std::uint32_t levels{};
    [[nodiscard]] std::size_t count(std::uint32_t level) const {
        return std::size_t{1} << (level * static_cast<std::uint32_t>(std::countr_zero(children)));
    }
    [[nodiscard]] std::size_t first(std::uint32_t level) const { return (count(level) - 1) / (children - 1); }
};

// The tile with that number in Morton's order among those of a level below another one.
ImplicitTile tile_below(const ImplicitTile& root, std::uint32_t level, std::size_t number, bool is_octree) {
    ImplicitTile tile{root.level + level, root.x << level, root.y << level, root.z << level};
    const std::uint32_t axes = is_octree ? 3 : 2;
    for (std::uint32_t bit = 0; bit < level; ++bit) {
        tile.x |= static_cast<std::uint32_t>(number >> (axes * bit) & 1U) << bit;
        tile.y |= static_cast<std::uint32_t>(number >> (axes * bit + 1) & 1U) << bit;
        if (is_octree) tile.z |= static_cast<std::uint32_t>(number >> (axes * bit + 2) & 1U) << bit;
    }
    return tile;
}

// What a subtree's file says. Its bytes stay where they were read.
struct Subtree {
    std::vector<std::string> buffers;
    Availability tiles, subtrees;
    std::vector<Availability> contents;
};

// The JSON and the binary part of a subtree's file, which may be JSON alone.
struct SubtreeParts {
    std::string_view json;
    std::optional<std::string_view> binary;
};

Result<SubtreeParts> parts_of(std::string_view bytes) {
    if (!bytes.starts_with("subt")) return SubtreeParts{bytes, std::nullopt};
    static_assert(std::endian::native == std::endian::little);
    constexpr std::size_t head = 24;
    if (bytes.size() < head) return tileset_fault("is cut off: a subtree has 24 bytes and more");
    std::uint32_t version = 0;
    std::array<std::uint64_t, 2> lengths{};
    std::memcpy(&version, bytes.data() + 4, sizeof version);
    std::memcpy(lengths.data(), bytes.data() + 8, sizeof lengths);
    if (version != 1)
        return tileset_fault("is a subtree of version " + std::to_string(version) + ": 1 is read");
    const std::size_t rest = bytes.size() - head;
    if (lengths[0] > rest || lengths[1] > rest - lengths[0])
        return tileset_fault("is cut off: its header promises more bytes than it has");
    return SubtreeParts{bytes.substr(head, lengths[0]), bytes.substr(head + lengths[0], lengths[1])};
}

class SubtreeReader {
  public:
    SubtreeReader(const ImplicitTiling& tiling, const ImplicitWalk& walk, std::string uri)
        : walk_(walk), uri_(std::move(uri)), shape_{tiling.is_octree ? 8U : 4U, tiling.subtree_levels} {}

    Result<void> read(std::string_view bytes, Subtree& subtree) {
        ORO_TRY(const SubtreeParts parts, parts_of(bytes));
        ORO_CHECK(check_json(parts.json, 0));
        const std::size_t begin = parts.json.find_first_not_of(" \t\r\n");
        const TileMembers members(JsonValue(parts.json, std::min(begin, parts.json.size())));
        ORO_CHECK(read_buffers(members, parts, subtree));
        const std::size_t tiles = shape_.first(shape_.levels);
        ORO_TRY(subtree.tiles, availability(members.find("tileAvailability"), "tileAvailability", tiles));
        ORO_TRY(subtree.subtrees, availability(members.find("childSubtreeAvailability"),
                                               "childSubtreeAvailability", shape_.count(shape_.levels)));
        std::vector<JsonValue> contents = members.list("contentAvailability");
        // As the extension of 3D Tiles 1.0 has it.
        if (const auto one = members.find("contentAvailability"); one && one->is(JsonValue::Kind::object))
            contents.push_back(*one);
        for (const JsonValue& one : contents) {
            ORO_TRY(const Availability content,
                    availability(std::optional(one), "contentAvailability", tiles));
            subtree.contents.push_back(content);
        }
        return {};
    }

  private:
    Result<void> read_buffers(const TileMembers& members, const SubtreeParts& parts, Subtree& subtree) {
        const std::vector<JsonValue> buffers = members.list("buffers"), views = members.list("bufferViews");
        if (buffers.size() > most_buffers || views.size() > most_views)
            return tileset_fault("has more buffers than are read");
        subtree.buffers.reserve(buffers.size());
        for (const JsonValue& buffer : buffers) {
            const TileMembers of(buffer);
            const auto length = count_of(of.find("byteLength"), std::size_t{1} << 30U);
            if (!length) return tileset_fault("has a buffer without a byteLength");
            if (const auto uri = of.find("uri")) {
                ORO_TRY(std::string bytes, walk_.buffer(uri_, uri->text()));
                subtree.buffers.push_back(std::move(bytes));
            } else if (parts.binary) {
                subtree.buffers.emplace_back(*parts.binary);
            } else {
                return tileset_fault("has a buffer without a uri, and no bytes of its own");
            }
            if (subtree.buffers.back().size() < *length)
                return tileset_fault("has a buffer of " + std::to_string(*length) + " bytes, of which " +
                                     std::to_string(subtree.buffers.back().size()) + " are there");
            subtree.buffers.back().resize(*length);
        }
        for (const JsonValue& view : views) {
            const TileMembers of(view);
            const auto buffer = count_of(of.find("buffer"), buffers.size());
            if (!buffer || *buffer >= buffers.size())
                return tileset_fault("has a buffer view of a buffer that is not there");
            const std::string& bytes = subtree.buffers[*buffer];
            const auto offset = of.find("byteOffset") ? count_of(of.find("byteOffset"), bytes.size())
                                                      : std::optional<std::size_t>(0);
            const auto length = count_of(of.find("byteLength"), bytes.size());
            if (!offset || !length || *length > bytes.size() - *offset)
                return tileset_fault("has a buffer view beyond its buffer");
            views_.push_back(std::string_view(bytes).substr(*offset, *length));
        }
        return {};
    }

    Result<Availability> availability(const std::optional<JsonValue>& value, const char* name,
                                      std::size_t bits) const {
        if (!value) return tileset_fault(std::string("has no ") + name);
        const TileMembers of(*value);
        if (const auto constant = of.find("constant")) {
            const auto all = count_of(constant, 1);
            if (!all) return tileset_fault(std::string("has a ") + name + " whose constant is not 0 or 1");
            return Availability(*all == 1);
        }
        auto view = of.find("bitstream");
        if (!view) view = of.find("bufferView");  // as the extension had it
        const auto number = count_of(view, views_.size());
        if (!number || *number >= views_.size())
            return tileset_fault(std::string("has a ") + name + " without bits");
        const std::string_view bytes = views_[*number];
        if (bytes.size() < (bits + 7) / 8)
            return tileset_fault(std::string("has a ") + name + " of " + std::to_string(bytes.size()) +
                                 " bytes, expected " + std::to_string((bits + 7) / 8));
        return Availability(bytes);
    }

    const ImplicitWalk& walk_;
    std::string uri_;  // of the subtree
    SubtreeShape shape_;
    std::vector<std::string_view> views_;
};

class TileWalker {
  public:
    TileWalker(const ImplicitTiling& tiling, bool replaced, const ImplicitWalk& walk)
        : tiling_(tiling),
          replaced_(replaced),
          walk_(walk),
          shape_{tiling.is_octree ? 8U : 4U, tiling.subtree_levels} {}

    // Subtrees below one are read when its own bytes are gone.
    Result<void> subtree(const ImplicitTile& root) {
        std::vector<ImplicitTile> below;
        ORO_CHECK(tiles_of_subtree(root, below));
        for (const ImplicitTile& one : below) ORO_CHECK(subtree(one));
        return {};
    }

  private:
    [[nodiscard]] Error fault_at(const ImplicitTile& tile, const std::string& why) const {
        return tileset_fault(tile.name(tiling_.is_octree) + " " + why);
    }

    Result<void> tiles_of_subtree(const ImplicitTile& root, std::vector<ImplicitTile>& below) {
        const std::string uri = uri_of(tiling_.subtrees, root);
        Result<std::string> bytes = walk_.subtree(uri);
        if (!bytes.ok()) return fault_at(root, "has its subtree in " + uri + ", which " + bytes.error().what);
        Subtree subtree;
        const Result<void> read = SubtreeReader(tiling_, walk_, uri).read(*bytes, subtree);
        if (!read.ok()) return fault_at(root, "has its subtree in " + uri + ", which " + read.error().what);
        if (subtree.contents.size() > tiling_.contents.size())
            return fault_at(root, "has a subtree with more contents than templates");
        if (!subtree.tiles[0]) return fault_at(root, "has a subtree without it");
        for (std::uint32_t level = 0; level < shape_.levels; ++level)
            for (std::size_t i = 0; i < shape_.count(level); ++i)
                ORO_CHECK(tile(root, subtree, level, i, below));
        for (std::size_t i = 0; i < shape_.count(shape_.levels); ++i)
            if (subtree.subtrees[i] && !subtree.tiles[shape_.first(shape_.levels - 1) + i / shape_.children])
                return fault_at(tile_below(root, shape_.levels, i, tiling_.is_octree),
                                "is there, and the tile above it is not");
        return {};
    }

    // below: subtrees that begin below the tile are put there.
    Result<void> tile(const ImplicitTile& root, const Subtree& subtree, std::uint32_t level,
                      std::size_t number, std::vector<ImplicitTile>& below) {
        const std::size_t bit = shape_.first(level) + number;
        const bool has_content =
            std::ranges::any_of(subtree.contents, [&](const Availability& content) { return content[bit]; });
        if (!subtree.tiles[bit]) {
            if (!has_content) return {};
            return fault_at(tile_below(root, level, number, tiling_.is_octree),
                            "has a content and is not there");
        }
        const ImplicitTile here = tile_below(root, level, number, tiling_.is_octree);
        if (here.level >= tiling_.levels)
            return fault_at(here,
                            "is there, below the last of " + std::to_string(tiling_.levels) + " levels");
        if (level > 0 && !subtree.tiles[shape_.first(level - 1) + number / shape_.children])
            return fault_at(here, "is there, and the tile above it is not");
        ORO_CHECK(walk_.count());
        const bool is_last = level + 1 == shape_.levels;
        bool has_children = false;
        for (std::size_t i = shape_.children * number; i < shape_.children * (number + 1); ++i) {
            const bool is_there = is_last ? subtree.subtrees[i] : subtree.tiles[shape_.first(level + 1) + i];
            has_children = has_children || is_there;
            if (is_last && is_there) below.push_back(tile_below(root, level + 1, i, tiling_.is_octree));
        }
        if (has_children && replaced_) return {};
        for (std::size_t i = 0; i < subtree.contents.size(); ++i)
            if (subtree.contents[i][bit]) ORO_CHECK(walk_.content(here, uri_of(tiling_.contents[i], here)));
        return {};
    }

    const ImplicitTiling& tiling_;
    bool replaced_;
    const ImplicitWalk& walk_;
    SubtreeShape shape_;
};

}  // namespace

std::string ImplicitTile::name(bool is_octree) const {
    std::string name =
        "implicit tile " + std::to_string(level) + "/" + std::to_string(x) + "/" + std::to_string(y);
    return is_octree ? name + "/" + std::to_string(z) : name;
}

Result<std::optional<ImplicitTiling>> implicit_tiling_of(const TileMembers& tile,
                                                         std::vector<std::string> contents) {
    auto stated = tile.find("implicitTiling");
    if (const auto extensions = tile.find("extensions"); !stated && extensions)
        stated = TileMembers(*extensions).find("3DTILES_implicit_tiling");
    if (!stated) return std::optional<ImplicitTiling>();
    const TileMembers of(*stated);
    ImplicitTiling tiling;
    const auto scheme = of.find("subdivisionScheme");
    const std::string word = scheme ? scheme->text() : "";
    if (word != "QUADTREE" && word != "OCTREE")
        return tileset_fault("has implicit tiles by " + (word.empty() ? "no scheme" : shown_word(word)) +
                             ": QUADTREE and OCTREE are read");
    tiling.is_octree = word == "OCTREE";
    // As 3D Tiles 1.1 has it; the extension counts to the last one.
    auto levels = count_of(of.find("availableLevels"), most_levels);
    if (!of.find("availableLevels")) {
        levels = count_of(of.find("maximumLevel"), most_levels - 1);
        if (levels) ++*levels;
    }
    if (!levels || *levels == 0)
        return tileset_fault("has implicit tiles without a number of levels from 1 to 32");
    const std::size_t deepest = tiling.is_octree ? 8 : 12;
    const auto subtree_levels = count_of(of.find("subtreeLevels"), deepest);
    if (!subtree_levels || *subtree_levels == 0)
        return tileset_fault("has implicit tiles whose subtreeLevels is no number from 1 to " +
                             std::to_string(deepest));
    tiling.levels = static_cast<std::uint32_t>(*levels);
    tiling.subtree_levels = static_cast<std::uint32_t>(*subtree_levels);
    tiling.subtrees = template_in(of.find("subtrees"));
    if (tiling.subtrees.empty()) return tileset_fault("has implicit tiles without a template of subtrees");
    tiling.contents = std::move(contents);
    return std::optional(std::move(tiling));
}

std::string uri_of(const std::string& from, const ImplicitTile& tile) {
    const std::array<std::pair<std::string_view, std::uint32_t>, 4> names{
        {{"{level}", tile.level}, {"{x}", tile.x}, {"{y}", tile.y}, {"{z}", tile.z}}};
    std::string uri;
    for (std::size_t at = 0; at < from.size();) {
        const auto name = std::ranges::find_if(
            names, [&](const auto& one) { return std::string_view(from).substr(at).starts_with(one.first); });
        if (name == names.end()) {
            uri += from[at++];
            continue;
        }
        uri += std::to_string(name->second);
        at += name->first.size();
    }
    return uri;
}

Result<void> walk_implicit_tiles(const ImplicitTiling& tiling, bool replaced, const ImplicitWalk& walk) {
    return TileWalker(tiling, replaced, walk).subtree({});
}

}  // namespace oro
