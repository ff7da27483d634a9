#include "core/seam/mesh_node.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

// A row of a table, each number of which goes into a column.
using VertexRow = std::array<std::int64_t, 4>;     // x, y, z, h
using AttributeRow = std::array<std::int64_t, 4>;  // normal, code of a colour
using LookRow = std::array<std::int64_t, 2>;       // look, tone

struct NodeTriangle {
    std::array<std::uint32_t, 3> vertices, attributes;  // of its half, of the node
    std::uint32_t look;
};

struct NodeHalf {
    std::vector<VertexRow> vertices;
    std::vector<glm::dvec3> places_m;
    std::vector<std::uint32_t> attribute_of;  // of each vertex; several_attributes
    std::vector<NodeTriangle> triangles;
};
constexpr std::uint32_t several_attributes = ~std::uint32_t{0};

Error reaches_far() {
    return {ErrorKind::failed, "meshes", "a part of them reaches more than 1,048 km from its middle"};
}

std::int64_t parts_of_unit(double value) {
    return std::llround(value * static_cast<double>(gpu::seam_unit));
}

VertexRow row_of(const SeamCorner& corner) {
    const LatticePoint place = lattice_point(corner.at.m);
    return {place.steps[0], place.steps[1], place.steps[2], height_steps(corner.h_m)};
}

AttributeRow attributes_of(const SeamPiece& piece, std::size_t corner) {
    const glm::dvec3& normal = piece.corners[corner].normal;
    std::int64_t code = 0;
    if (piece.look == gpu::mesh_look_coloured) {
        const VertexColour& colour = piece.colours[corner];
        code = colour.red | std::int64_t{colour.green} << 8U | std::int64_t{colour.blue} << 16U;
    }
    return {parts_of_unit(normal.x), parts_of_unit(normal.y), parts_of_unit(normal.z), code};
}

// The row that is like it, which is put behind the others where there is none.
template <class Row>
std::uint32_t number_of(const Row& row, std::vector<Row>& rows) {
    // The last ones first: what follows each other hangs together.
    for (std::size_t i = rows.size(); i-- > 0;)
        if (rows[i] == row) return static_cast<std::uint32_t>(i);
    rows.push_back(row);
    return static_cast<std::uint32_t>(rows.size() - 1);
}

// Bits that numbers from 0 to this one need.
std::uint32_t bits_for(std::uint64_t most) {
    return static_cast<std::uint32_t>(std::bit_width(most));
}

// Numbers of any bits, one behind the other.
class BitsOfWords {
  public:
    explicit BitsOfWords(std::vector<std::uint32_t>& words) : words_(words), next_(32 * words.size()) {}
    void put(std::uint64_t value, std::uint32_t count) {
        for (std::uint32_t left = count; left > 0;) {
            const auto at = static_cast<std::uint32_t>(next_ % 32);
            if (at == 0) words_.push_back(0);
            const std::uint32_t now = std::min(left, 32 - at);
            words_.back() |= static_cast<std::uint32_t>((value & ((std::uint64_t{1} << now) - 1)) << at);
            value >>= now;
            next_ += now;
            left -= now;
        }
    }

  private:
    std::vector<std::uint32_t>& words_;
    std::size_t next_;
};

// The least number of each column of a table, and the bits of what is above it.
struct Columns {
    std::vector<std::int64_t> least;
    std::vector<std::uint32_t> bits;
};
template <class Row>
Columns columns_of(const std::vector<Row>& rows) {
    Columns columns;
    for (std::size_t column = 0; column < std::tuple_size_v<Row>; ++column) {
        std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = -least;
        for (const Row& row : rows) least = std::min(least, row[column]), most = std::max(most, row[column]);
        columns.least.push_back(least);
        columns.bits.push_back(bits_for(static_cast<std::uint64_t>(most - least)));
    }
    return columns;
}
template <class Row>
void put_rows(const std::vector<Row>& rows, const Columns& columns, BitsOfWords& to) {
    for (const Row& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            to.put(static_cast<std::uint64_t>(row[i] - columns.least[i]), columns.bits[i]);
}

class NodeBuilder {
  public:
    // False: it is full.
    bool add(const SeamPiece& piece);
    [[nodiscard]] bool empty() const { return halves_[0].triangles.empty(); }
    // The node, whose builder begins anew.
    Result<MeshNode> take();

  private:
    bool add(const SeamPiece& piece, NodeHalf& half);
    // Whether each vertex has one attribute and that takes fewer bits: they then stand in the order of
    // vertices.
    bool order_by_vertex();
    void put_triangles(bool by_vertex, BitsOfWords& to) const;

    std::array<NodeHalf, 2> halves_;
    std::size_t half_{};
    std::vector<AttributeRow> attributes_;
    std::vector<LookRow> looks_;
};

bool NodeBuilder::add(const SeamPiece& piece) {
    for (; half_ < halves_.size(); ++half_)
        if (add(piece, halves_[half_])) return true;
    return false;
}

bool NodeBuilder::add(const SeamPiece& piece, NodeHalf& half) {
    if (half.triangles.size() == gpu::half_triangles) return false;
    const std::size_t vertices = half.vertices.size(), attributes = attributes_.size();
    NodeTriangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
        triangle.vertices[i] = number_of(row_of(piece.corners[i]), half.vertices);
        triangle.attributes[i] = number_of(attributes_of(piece, i), attributes_);
    }
    if (half.vertices.size() > gpu::mesh_half_vertices || attributes_.size() > gpu::mesh_attributes_max) {
        half.vertices.resize(vertices);
        attributes_.resize(attributes);
        return false;
    }
    triangle.look = number_of(LookRow{piece.look, parts_of_unit(static_cast<double>(piece.tone))}, looks_);
    half.places_m.resize(half.vertices.size());
    half.attribute_of.resize(half.vertices.size(), several_attributes - 1);
    for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t& attribute = half.attribute_of[triangle.vertices[i]];
        const bool is_first = attribute == several_attributes - 1;
        if (is_first) half.places_m[triangle.vertices[i]] = piece.corners[i].at.m;
        attribute =
            is_first || attribute == triangle.attributes[i] ? triangle.attributes[i] : several_attributes;
    }
    half.triangles.push_back(triangle);
    return true;
}

bool NodeBuilder::order_by_vertex() {
    std::vector<AttributeRow> by_vertex;
    for (const NodeHalf& half : halves_)
        for (const std::uint32_t attribute : half.attribute_of) {
            if (attribute == several_attributes) return false;
            by_vertex.push_back(attributes_[attribute]);
        }
    std::uint64_t bits = 0;
    for (const std::uint32_t width : columns_of(attributes_).bits) bits += width;
    const std::uint64_t numbers = 3 * (halves_[0].triangles.size() + halves_[1].triangles.size());
    if (by_vertex.size() * bits > attributes_.size() * bits + numbers * bits_for(attributes_.size() - 1))
        return false;
    attributes_ = std::move(by_vertex);
    return true;
}

void NodeBuilder::put_triangles(bool by_vertex, BitsOfWords& to) const {
    const std::uint32_t attribute_bits = by_vertex ? 0 : bits_for(attributes_.size() - 1);
    const std::uint32_t look_bits = bits_for(looks_.size() - 1);
    for (const NodeHalf& half : halves_)
        for (const NodeTriangle& triangle : half.triangles) {
            for (const std::uint32_t vertex : triangle.vertices) to.put(vertex, gpu::mesh_vertex_bits);
            for (const std::uint32_t attribute : triangle.attributes) to.put(attribute, attribute_bits);
            to.put(triangle.look, look_bits);
        }
}

Result<MeshNode> NodeBuilder::take() {
    MeshNode node;
    std::vector<VertexRow> vertices = halves_[0].vertices;
    vertices.insert(vertices.end(), halves_[1].vertices.begin(), halves_[1].vertices.end());
    for (const NodeHalf& half : halves_) {
        node.places_m.insert(node.places_m.end(), half.places_m.begin(), half.places_m.end());
        node.triangles += static_cast<std::uint32_t>(half.triangles.size());
    }
    node.has_last_half = !halves_[1].triangles.empty();
    const bool by_vertex = order_by_vertex();
    const std::uint32_t look_bits = bits_for(looks_.size() - 1);
    looks_.resize(std::size_t{1} << look_bits, looks_.back());
    const Columns of_vertices = columns_of(vertices), of_attributes = columns_of(attributes_),
                  of_looks = columns_of(looks_);
    const auto count = [](const auto& items) { return static_cast<std::uint32_t>(items.size()); };
    node.words = {count(halves_[0].vertices) | count(halves_[1].vertices) << 6U |
                      count(halves_[0].triangles) << 12U | count(halves_[1].triangles) << 19U |
                      (by_vertex ? 1U : 0U) << gpu::mesh_by_vertex_bit,
                  0, 0, 0};
    std::uint32_t number = 0;
    for (const Columns& columns : {of_vertices, of_attributes, of_looks})
        for (std::size_t i = 0; i < columns.bits.size(); ++i, ++number) {
            if (columns.bits[i] > 32) return reaches_far();
            node.words[1 + number / 4] |= columns.bits[i] << number % 4 * 6;
            // Places are counted from an origin later.
            node.words.push_back(number < 3 ? 0U : static_cast<std::uint32_t>(columns.least[i]));
        }
    node.words[3] |= (by_vertex ? 0U : bits_for(attributes_.size() - 1)) << 12U | look_bits << 18U;
    for (std::size_t i = 0; i < 3; ++i) node.first_steps[i] = of_vertices.least[i];
    BitsOfWords to(node.words);
    put_rows(vertices, of_vertices, to);
    put_triangles(by_vertex, to);
    put_rows(looks_, of_looks, to);
    put_rows(attributes_, of_attributes, to);
    node.words.push_back(0);  // a number is read from two words
    node.lowest_h_m = static_cast<double>(of_vertices.least[3]) * height_step_m;
    node.highest_h_m = node.lowest_h_m;
    for (const VertexRow& row : vertices)
        node.highest_h_m = std::max(node.highest_h_m, static_cast<double>(row[3]) * height_step_m);
    *this = {};
    return node;
}

}  // namespace

Result<std::vector<MeshNode>> mesh_nodes(std::span<const SeamPiece> pieces) {
    std::vector<MeshNode> nodes;
    NodeBuilder builder;
    for (const SeamPiece& piece : pieces) {
        if (builder.add(piece)) continue;
        ORO_TRY(MeshNode node, builder.take());
        nodes.push_back(std::move(node));
        builder.add(piece);
    }
    if (!builder.empty()) {
        ORO_TRY(MeshNode node, builder.take());
        nodes.push_back(std::move(node));
    }
    return nodes;
}

Result<void> from_origin(const std::array<std::int64_t, 3>& origin_steps, MeshNode& node) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t from = node.first_steps[axis] - origin_steps[axis];
        const std::uint64_t bits = node.words[1] >> axis * 6 & 63U;
        const std::int64_t most = from + static_cast<std::int64_t>((std::uint64_t{1} << bits) - 1);
        constexpr std::int64_t reach = std::int64_t{1} << 31U;
        if (from < -reach || most >= reach) return reaches_far();
        node.words[1 + gpu::mesh_widths + axis] = static_cast<std::uint32_t>(from);
    }
    return {};
}

}  // namespace oro
