#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/files/line_number.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/mesh_words.h"
#include "geo/meshes/polygon_cut.h"

namespace oro {
namespace {

enum class PlyLayout { text, little_endian, big_endian };

// A number's type: its bytes in a binary file.
struct PlyType {
    enum class Kind { whole, unsigned_whole, real };
    std::size_t bytes;
    Kind kind;
};

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count;  // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties{};
};

std::optional<PlyType> ply_type(std::string_view name) {
    using enum PlyType::Kind;
    if (name == "char" || name == "int8") return PlyType{1, whole};
    if (name == "uchar" || name == "uint8") return PlyType{1, unsigned_whole};
    if (name == "short" || name == "int16") return PlyType{2, whole};
    if (name == "ushort" || name == "uint16") return PlyType{2, unsigned_whole};
    if (name == "int" || name == "int32") return PlyType{4, whole};
    if (name == "uint" || name == "uint32") return PlyType{4, unsigned_whole};
    if (name == "float" || name == "float32") return PlyType{4, real};
    if (name == "double" || name == "float64") return PlyType{8, real};
    return std::nullopt;
}

template <class T>
double ply_value(const char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return static_cast<double>(value);
}

// Parts of a colour reach from 0 to this: whole numbers to the largest of their type, real ones to 1.
double ply_most_of_colour(PlyType type) {
    if (type.kind == PlyType::Kind::real) return 1.0;
    return type.bytes == 1 ? 255.0 : type.bytes == 2 ? 65535.0 : 4294967295.0;
}
// 0 to 255, of a property's value; what lies beyond is cut.
std::uint8_t ply_colour_part(double value, PlyType type) {
    return static_cast<std::uint8_t>(std::lround(
        std::isnan(value) ? 0.0 : 255.0 * std::clamp(value / ply_most_of_colour(type), 0.0, 1.0)));
}

// The value of 1 to 8 bytes in this machine's order (little endian).
double ply_number(const char* from, PlyType type) {
    using enum PlyType::Kind;
    if (type.kind == real) return type.bytes == 4 ? ply_value<float>(from) : ply_value<double>(from);
    const bool is_signed = type.kind == whole;
    if (type.bytes == 1) return is_signed ? ply_value<std::int8_t>(from) : ply_value<std::uint8_t>(from);
    if (type.bytes == 2) return is_signed ? ply_value<std::int16_t>(from) : ply_value<std::uint16_t>(from);
    return is_signed ? ply_value<std::int32_t>(from) : ply_value<std::uint32_t>(from);
}

class PlyReader {
  public:
    PlyReader(std::string_view bytes, const ScratchOfMesh& scratch)
        : bytes_(bytes), rest_(bytes), corners_(scratch), counts_(scratch) {
        mesh_.lie_in(scratch);
    }

    Result<SourceMesh> all() {
        mesh_.format = "PLY";
        ORO_CHECK(header());
        for (const PlyElement& element : elements_) ORO_CHECK(body(element));
        ORO_CHECK(nothing_is_left());
        // Faces may stand before the vertices.
        std::vector<std::uint32_t> polygon;
        std::size_t first = 0;
        for (const std::uint32_t count : counts_) {
            polygon.assign(corners_.begin() + static_cast<std::ptrdiff_t>(first),
                           corners_.begin() + static_cast<std::ptrdiff_t>(first + count));
            first += count;
            for (const std::uint32_t corner : polygon) {
                if (corner >= mesh_.vertices.size())
                    return Error{ErrorKind::failed, "",
                                 "the corner " + std::to_string(corner) + " is none of its " +
                                     std::to_string(mesh_.vertices.size()) + " vertices, which begin with 0"};
            }
            if (const char* const fault = add_polygon(polygon, mesh_))
                return Error{ErrorKind::failed, "", fault};
            drop_pages_after(corners_.get_allocator().scratch().get(), mesh_.triangles.size());
        }
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] Error fault(const std::string& why) const {
        return mesh_fault("byte", bytes_.size() - rest_.size(), why);
    }

    Result<void> header() {
        if (take_line(rest_) != "ply") return Error{ErrorKind::failed, "", "is no PLY: it begins otherwise"};
        bool has_format = false;
        while (!rest_.empty()) {
            std::string_view line = take_line(rest_);
            const std::string_view key = take_word(line);
            if (key == "end_header") {
                if (!has_format) return fault("the header names no format");
                return {};
            }
            if (key == "format") {
                const std::string_view name = take_word(line);
                has_format = true;
                if (name == "binary_little_endian")
                    layout_ = PlyLayout::little_endian;
                else if (name == "binary_big_endian")
                    layout_ = PlyLayout::big_endian;
                else if (name != "ascii")
                    return fault("an unknown format: " + shown_word(name));
            } else if (key == "element") {
                const std::string_view name = take_word(line);
                long long count = -1;
                if (!whole_number_in(take_word(line), count) || count < 0)
                    return fault("an element without a count");
                elements_.push_back({std::string(name), static_cast<std::uint64_t>(count)});
            } else if (key == "property") {
                ORO_CHECK(property(line));
            }
        }
        return fault("the header has no end");
    }

    // A header that names too few of something would leave the rest out without a word.
    [[nodiscard]] Result<void> nothing_is_left() {
        constexpr std::string_view blanks(" \t\r\n\v\f\0", 7);
        const std::size_t begin = rest_.find_first_not_of(blanks);
        if (begin == std::string_view::npos) return {};
        rest_.remove_prefix(begin);
        std::string counts;
        for (const PlyElement& element : elements_)
            counts += (counts.empty() ? "" : ", ") + std::to_string(element.count) + " of " +
                      shown_word(element.name);
        const std::string why =
            "the file goes on behind all that its header names (" + counts + "): is a count in it too small?";
        if (layout_ != PlyLayout::text) return fault(why);
        const std::size_t at = bytes_.size() - rest_.size();
        return mesh_fault("line", line_number(bytes_, at), why);
    }

    Result<void> property(std::string_view line) {
        if (elements_.empty()) return fault("a property before the first element");
        std::string_view word = take_word(line);
        std::optional<PlyType> count;
        if (word == "list") {
            count = ply_type(take_word(line));
            if (!count || count->kind == PlyType::Kind::real)
                return fault("a list without a type of its count");
            word = take_word(line);
        }
        const auto type = ply_type(word);
        if (!type) return fault("an unknown type: " + shown_word(word));
        elements_.back().properties.push_back({std::string(take_word(line)), *type, count});
        return {};
    }

    // The fewest bytes that one of an element takes: what a header promises is held against the file's
    // length.
    [[nodiscard]] std::uint64_t fewest_bytes(const PlyElement& element) const {
        std::uint64_t sum = 0;
        for (const PlyProperty& property : element.properties)
            sum += layout_ == PlyLayout::text ? 2
                   : property.count           ? property.count->bytes
                                              : property.type.bytes;
        return std::max<std::uint64_t>(sum, 1);
    }

    Result<double> number(PlyType type) {
        if (layout_ == PlyLayout::text) {
            const std::string_view word = take_word(rest_);
            double value = 0.0;
            if (word.empty()) return fault("the file ends too early");
            if (!mesh_number(word, value)) return fault(shown_word(word) + " is no number");
            return value;
        }
        if (rest_.size() < type.bytes) return fault("the file ends too early");
        char copy[8];
        std::memcpy(copy, rest_.data(), type.bytes);
        rest_.remove_prefix(type.bytes);
        if (layout_ == PlyLayout::big_endian) std::reverse(copy, copy + type.bytes);
        return ply_number(copy, type);
    }

    Result<void> list(const PlyProperty& property, std::vector<double>& values) {
        ORO_TRY(const double count, number(*property.count));
        const auto most =
            static_cast<double>(rest_.size() / (layout_ == PlyLayout::text ? 1 : property.type.bytes));
        if (!(count >= 0.0 && count <= most)) return fault("a list is longer than the file");
        values.resize(static_cast<std::size_t>(count));
        for (double& value : values) {
            ORO_TRY(value, number(property.type));
        }
        return {};
    }

    Result<void> face(const std::vector<double>& corners) {
        if (corners.size() < 3) return fault("a face has fewer than three corners");
        if (corners.size() > most_polygon_corners) return fault("a face has more than 10,000 corners");
        constexpr double most = 4294967295.0;
        for (const double corner : corners) {
            if (!(corner >= 0.0 && corner < most && corner == std::floor(corner)))
                return fault("a corner of a face is no number of a vertex");
            corners_.push_back(static_cast<std::uint32_t>(corner));
        }
        counts_.push_back(static_cast<std::uint32_t>(corners.size()));
        return {};
    }

    Result<void> body(const PlyElement& element) {
        if (element.count > rest_.size() / fewest_bytes(element))
            return fault("the header promises " + std::to_string(element.count) + " of " +
                         shown_word(element.name) + ", more than the file can hold");
        const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
        if (is_vertex) {
            for (const char* axis : {"x", "y", "z"}) {
                if (std::ranges::none_of(element.properties, [&](const PlyProperty& property) {
                        return property.name == axis && !property.count;
                    }))
                    return fault(std::string("vertices have no ") + axis);
            }
            mesh_.vertices.reserve(element.count);
        }
        const bool is_coloured = is_vertex && has_colours(element);
        std::vector<double> values;
        std::uint64_t cut = 0;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            glm::dvec3 place{};
            VertexColour colour{0, 0, 0, 1};
            bool is_cut = false;
            for (const PlyProperty& property : element.properties) {
                if (property.count) {
                    ORO_CHECK(list(property, values));
                    if (is_face && (property.name == "vertex_indices" || property.name == "vertex_index"))
                        ORO_CHECK(face(values));
                    continue;
                }
                ORO_TRY(const double value, number(property.type));
                if (property.name == "x") place.x = value;
                if (property.name == "y") place.y = value;
                if (property.name == "z") place.z = value;
                if (!is_coloured) continue;
                const auto part = [&] {
                    is_cut |= !(value >= 0.0 && value <= ply_most_of_colour(property.type));
                    return ply_colour_part(value, property.type);
                };
                if (is_part(property.name, "red")) colour.red = part();
                if (is_part(property.name, "green")) colour.green = part();
                if (is_part(property.name, "blue")) colour.blue = part();
            }
            if (is_vertex) mesh_.vertices.push_back(place);
            if (is_coloured) mesh_.colours.push_back(colour);
            drop_pages_after(corners_.get_allocator().scratch().get(), i + 1);
            cut += is_cut ? 1 : 0;
        }
        if (cut > 0)
            mesh_.notes.push_back("colours of " + std::to_string(cut) + " of its " +
                                  std::to_string(element.count) +
                                  " vertices are beyond what their type may hold, and are cut");
        return {};
    }

    // "red", and "diffuse_red" as old programs write it.
    static bool is_part(std::string_view name, std::string_view part) {
        if (name.starts_with("diffuse_")) name.remove_prefix(std::string_view("diffuse_").size());
        return name == part;
    }
    static bool has_colours(const PlyElement& element) {
        const std::array<std::string_view, 3> parts{"red", "green", "blue"};
        return std::ranges::all_of(parts, [&](std::string_view part) {
            return std::ranges::any_of(element.properties, [&](const PlyProperty& property) {
                return is_part(property.name, part) && !property.count;
            });
        });
    }

    std::string_view bytes_, rest_;
    PlyLayout layout_{PlyLayout::text};
    std::vector<PlyElement> elements_;
    ScratchVector<std::uint32_t> corners_, counts_;  // of the faces, and how many of each
    SourceMesh mesh_;
};

}  // namespace

static_assert(std::endian::native == std::endian::little);

Result<SourceMesh> read_ply(std::string_view bytes, const ScratchOfMesh& scratch) {
    return PlyReader(bytes, scratch).all();
}

}  // namespace oro
