#include "geo/together/grid_clip.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "geo/together/face_cut.h"

namespace oro {
namespace {

// Where a post counts as on a rim, and how near the two ends of a wall's edge are to the rim that it is of:
// in posts.
constexpr double on_rim_posts = 1.0e-6;
// How far from a face's rim its other side is asked for.
constexpr double offset_posts = 1.0e-4;

// A piece of a rim over the grid that is cut: x is its column, y its row.
struct RimLine {
    std::uint32_t grid;  // 1 ...
    RimEdge edge;
    PlaneLine at;
};

// Nearest point of a line to one, as a share of the way.
double share_along(const PlaneLine& line, const glm::dvec2& point) {
    const glm::dvec2 along = line[1] - line[0];
    const double squared = glm::dot(along, along);
    return squared > 0.0 ? std::clamp(glm::dot(point - line[0], along) / squared, 0.0, 1.0) : 0.0;
}
double distance_to(const PlaneLine& line, const glm::dvec2& point) {
    return glm::distance(point, line[0] + share_along(line, point) * (line[1] - line[0]));
}

// The three posts of a triangle of a cell: the first and the last are the ends of its diagonal.
struct CellTriangle {
    std::array<GridPost, 3> posts;  // anticlockwise, seen from above
    PlaneTriangle corners;          // from the cell's north-west post
};
CellTriangle cell_triangle(GridPost cell, bool south_west) {
    if (south_west)
        return {{cell, {cell.row + 1, cell.column}, {cell.row + 1, cell.column + 1}},
                {glm::dvec2(0.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(1.0, 1.0)}};
    return {{cell, {cell.row + 1, cell.column + 1}, {cell.row, cell.column + 1}},
            {glm::dvec2(0.0, 0.0), glm::dvec2(1.0, 1.0), glm::dvec2(1.0, 0.0)}};
}

// Shares of the corners in a point of the cell; those nearly 0 are.
std::array<double, 3> shares_at(bool south_west, const glm::dvec2& at) {
    const double down = at.y, right = at.x;
    std::array<double, 3> shares = south_west ? std::array{1.0 - down, down - right, right}
                                              : std::array{1.0 - right, down, right - down};
    double sum = 0.0;
    for (double& share : shares) sum += share = share < 0.5 * seam_slack_posts ? 0.0 : share;
    for (double& share : shares) share /= sum;
    return shares;
}

class Cutting {
  public:
    Cutting(const HeightField& field, std::span<const ClipCover> over)
        : field_(field), over_(over), cutter_(seam_slack_posts) {}
    Result<GridClip> run();

  private:
    [[nodiscard]] std::size_t post(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.grid.columns()) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] glm::dvec2 in_field(const PostPlace& place) const;
    [[nodiscard]] bool is_covered(double row, double column) const;
    [[nodiscard]] bool is_on_rim(int row, int column) const;
    // Numbers of the rim lines that a cell may meet.
    [[nodiscard]] std::span<const std::uint32_t> lines_of(int row, int column) const;
    void find_rims();
    void add_rim(std::uint32_t grid, const ClipRim& rim);
    void leave_covered_out();
    Result<void> mask_covered(int row, int column, bool south_west);
    Result<void> keep_rest(int row, int column, bool south_west);
    Result<void> keep_faces(GridPost cell, bool south_west, bool lost);
    [[nodiscard]] bool is_there(const CellTriangle& triangle) const;
    [[nodiscard]] bool is_lost(const CellTriangle& triangle) const;
    Result<std::vector<PlaneFace>> faces_of(GridPost cell, const CellTriangle& triangle);
    void keep_walls(GridPost cell, bool south_west, const PlaneFace& face);
    template <class Visit>
    Result<void> for_each_triangle(const Visit& visit);

    const HeightField& field_;
    std::span<const ClipCover> over_;
    FaceCutter cutter_;
    std::vector<RimLine> rims_;
    std::unordered_map<std::size_t, std::vector<std::uint32_t>> by_cell_;
    glm::dvec2 rims_low_{1.0e30}, rims_high_{-1.0e30};
    bool is_somewhere_{true};  // these say where what the others cover may lie
    int first_row_{}, last_row_{-1}, first_column_{}, last_column_{-1};  // posts that may be covered
    GridClip out_;
};

glm::dvec2 Cutting::in_field(const PostPlace& place) const {
    const PostNumber at = field_.grid.post_at(place.lat_deg, place.lon_deg);
    return {at.column, at.row};
}

bool Cutting::is_covered(double row, double column) const {
    const PostPlace place = field_.grid.place_at(row, column);
    return std::any_of(over_.begin(), over_.end(),
                       [&](const ClipCover& over) { return over.has_ground(place.lat_deg, place.lon_deg); });
}

std::span<const std::uint32_t> Cutting::lines_of(int row, int column) const {
    const auto found = by_cell_.find(post(row, column));
    if (found == by_cell_.end()) return {};
    return found->second;
}

bool Cutting::is_on_rim(int row, int column) const {
    const glm::dvec2 at(column, row);
    for (int up = 0; up <= 1; ++up) {
        for (int left = 0; left <= 1; ++left) {
            if (row < up || column < left) continue;
            for (const std::uint32_t line : lines_of(row - up, column - left))
                if (distance_to(rims_[line].at, at) < on_rim_posts) return true;
        }
    }
    return false;
}

void Cutting::add_rim(std::uint32_t grid, const ClipRim& rim) {
    RimLine line{grid, rim.edge, {in_field(rim.at[0]), in_field(rim.at[1])}};
    if (!field_.grid.net) {
        // The same turn at both ends.
        const double turn = 360.0 * field_.grid.lon.posts_per_deg;
        line.at[1].x -= turn * std::round((line.at[1].x - line.at[0].x) / turn);
    }
    const glm::dvec2 low = glm::min(line.at[0], line.at[1]) - on_rim_posts,
                     high = glm::max(line.at[0], line.at[1]) + on_rim_posts;
    // What lies between rims is covered wherever they are: beyond this grid, too.
    rims_low_ = glm::min(rims_low_, low);
    rims_high_ = glm::max(rims_high_, high);
    is_somewhere_ = is_somewhere_ && low.x - low.x == 0.0 && low.y - low.y == 0.0 && high.x - high.x == 0.0 &&
                    high.y - high.y == 0.0;
    const double last_row = field_.grid.rows() - 2, last_column = field_.grid.columns() - 2;
    if (!(high.x >= 0.0 && high.y >= 0.0 && low.x <= last_column + 1.0 && low.y <= last_row + 1.0)) return;
    const auto number = static_cast<std::uint32_t>(rims_.size());
    rims_.push_back(line);
    const auto cell = [](double at, double last) {
        return static_cast<int>(std::clamp(std::floor(at), 0.0, last));
    };
    for (int row = cell(low.y, last_row); row <= cell(high.y, last_row); ++row)
        for (int column = cell(low.x, last_column); column <= cell(high.x, last_column); ++column)
            by_cell_[post(row, column)].push_back(number);
}

void Cutting::find_rims() {
    for (std::size_t i = 0; i < over_.size(); ++i) {
        // Rims more than half way round the Earth apart may be taken for those of the other way round.
        is_somewhere_ = is_somewhere_ && over_[i].is_narrow;
        for (const ClipRim& rim : over_[i].rim) add_rim(static_cast<std::uint32_t>(i + 1), rim);
    }
    const glm::dvec2 last(field_.grid.columns() - 1, field_.grid.rows() - 1);
    const glm::dvec2 low =
        is_somewhere_ ? glm::clamp(glm::floor(rims_low_), glm::dvec2(0.0), last) : glm::dvec2(0.0);
    const glm::dvec2 high = is_somewhere_ ? glm::clamp(glm::ceil(rims_high_), glm::dvec2(0.0), last) : last;
    first_row_ = static_cast<int>(low.y);
    last_row_ = static_cast<int>(high.y);
    first_column_ = static_cast<int>(low.x);
    last_column_ = static_cast<int>(high.x);
}

void Cutting::leave_covered_out() {
    for (int row = first_row_; row <= last_row_; ++row) {
        for (int column = first_column_; column <= last_column_; ++column) {
            if (is_covered(row, column) && !is_on_rim(row, column)) out_.masked_posts[post(row, column)] = 1;
        }
    }
}

bool Cutting::is_there(const CellTriangle& triangle) const {
    return std::none_of(triangle.posts.begin(), triangle.posts.end(),
                        [&](GridPost at) { return is_void(field_.H_at_post_m(at.row, at.column)); });
}
bool Cutting::is_lost(const CellTriangle& triangle) const {
    return std::any_of(triangle.posts.begin(), triangle.posts.end(),
                       [&](GridPost at) { return out_.masked_posts[post(at.row, at.column)] != 0; });
}

Result<std::vector<PlaneFace>> Cutting::faces_of(GridPost cell, const CellTriangle& triangle) {
    std::vector<PlaneLine> lines;
    const glm::dvec2 corner(cell.column, cell.row);
    for (const std::uint32_t line : lines_of(cell.row, cell.column))
        lines.push_back({rims_[line].at[0] - corner, rims_[line].at[1] - corner});
    return cutter_.faces(triangle.corners, lines);
}

// A triangle that is covered in part goes, too, if none of its posts went yet: with its first, which both of
// its cell have.
Result<void> Cutting::mask_covered(int row, int column, bool south_west) {
    const GridPost cell{row, column};
    const CellTriangle triangle = cell_triangle(cell, south_west);
    if (lines_of(row, column).empty() || !is_there(triangle) || is_lost(triangle)) return {};
    ORO_TRY(const std::vector<PlaneFace> faces, faces_of(cell, triangle));
    const bool cut = std::any_of(faces.begin(), faces.end(), [&](const PlaneFace& face) {
        return is_covered(row + face.inside.y, column + face.inside.x);
    });
    if (cut) out_.masked_posts[post(row, column)] = 1;
    return {};
}

void Cutting::keep_walls(GridPost cell, bool south_west, const PlaneFace& face) {
    const CellTriangle triangle = cell_triangle(cell, south_west);
    const glm::dvec2 corner(cell.column, cell.row);
    for (const std::vector<glm::dvec2>& ring : face.rings) {
        for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
            const glm::dvec2 ends[2] = {ring[i], ring[i + 1]};
            const glm::dvec2 along = ends[1] - ends[0];
            const glm::dvec2 left = offset_posts / glm::length(along) * glm::dvec2(along.y, -along.x);
            const glm::dvec2 beyond = 0.5 * (ends[0] + ends[1]) + left + corner;
            for (const std::uint32_t number : lines_of(cell.row, cell.column)) {
                const RimLine& rim = rims_[number];
                if (distance_to(rim.at, ends[0] + corner) > on_rim_posts ||
                    distance_to(rim.at, ends[1] + corner) > on_rim_posts)
                    continue;
                const PostPlace place = field_.grid.place_at(beyond.y, beyond.x);
                if (!over_[rim.grid - 1].has_ground(place.lat_deg, place.lon_deg)) continue;
                SeamWall wall;
                for (std::size_t end = 0; end < 2; ++end) {
                    const double share = share_along(rim.at, ends[end] + corner);
                    wall.cut[end] = {0, triangle.posts, shares_at(south_west, ends[end])};
                    wall.over[end] = {
                        rim.grid, {rim.edge.from, rim.edge.to, rim.edge.to}, {1.0 - share, share, 0.0}};
                }
                out_.walls.push_back(wall);
                break;
            }
        }
    }
}

Result<void> Cutting::keep_faces(GridPost cell, bool south_west, bool lost) {
    const CellTriangle triangle = cell_triangle(cell, south_west);
    ORO_TRY(const std::vector<PlaneFace> faces, faces_of(cell, triangle));
    for (const PlaneFace& face : faces) {
        if (is_covered(cell.row + face.inside.y, cell.column + face.inside.x)) continue;
        keep_walls(cell, south_west, face);
        if (!lost) continue;
        ORO_TRY(const std::vector<PlaneTriangle> pieces, cutter_.triangles(face));
        for (const PlaneTriangle& piece : pieces) {
            SeamTriangle kept;
            for (std::size_t i = 0; i < 3; ++i)
                kept.points[i] = {0, triangle.posts, shares_at(south_west, piece[i])};
            out_.ground.push_back(kept);
        }
    }
    return {};
}

Result<void> Cutting::keep_rest(int row, int column, bool south_west) {
    const GridPost cell{row, column};
    const CellTriangle triangle = cell_triangle(cell, south_west);
    if (!is_there(triangle)) return {};
    const bool lost = is_lost(triangle);
    if (!lines_of(row, column).empty()) return keep_faces(cell, south_west, lost);
    const glm::dvec2 middle = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
    if (!lost || is_covered(row + middle.y, column + middle.x)) return {};
    SeamTriangle whole;
    for (std::size_t i = 0; i < 3; ++i)
        whole.points[i] = {0, triangle.posts, shares_at(south_west, triangle.corners[i])};
    out_.ground.push_back(whole);
    return {};
}

template <class Visit>
Result<void> Cutting::for_each_triangle(const Visit& visit) {
    // Two more around: a post that is left out takes the triangles on all its sides.
    for (int row = std::max(0, first_row_ - 2); row <= std::min(last_row_ + 1, field_.grid.rows() - 2);
         ++row) {
        for (int column = std::max(0, first_column_ - 2);
             column <= std::min(last_column_ + 1, field_.grid.columns() - 2); ++column) {
            ORO_CHECK(visit(row, column, true));
            ORO_CHECK(visit(row, column, false));
        }
    }
    return {};
}

Result<GridClip> Cutting::run() {
    out_.masked_posts.resize(field_.grid.post_count());
    find_rims();
    leave_covered_out();
    ORO_CHECK(for_each_triangle(
        [&](int row, int column, bool south_west) { return mask_covered(row, column, south_west); }));
    ORO_CHECK(for_each_triangle(
        [&](int row, int column, bool south_west) { return keep_rest(row, column, south_west); }));
    ORO_CHECK(field_.health());
    return std::move(out_);
}

}  // namespace

Result<GridClip> clip_by_covers(const HeightField& field, std::span<const ClipCover> over) {
    return Cutting(field, over).run();
}

Result<GridClip> clip_by_finer(const HeightField& field, std::span<const HeightField* const> over) {
    std::vector<ClipCover> covers;
    for (const HeightField* const one : over) {
        ClipCover& cover = covers.emplace_back();
        cover.has_ground = [one](double lat_deg, double lon_deg) {
            return one->surface_H_m(lat_deg, lon_deg).has_value();
        };
        const PostGrid& grid = one->grid;
        for (const RimEdge& edge : coverage_rim(*one))
            cover.rim.push_back({edge,
                                 {grid.place_at(edge.from.row, edge.from.column),
                                  grid.place_at(edge.to.row, edge.to.column)}});
        cover.is_narrow = grid.east_deg() - grid.west_deg() < 180.0;
    }
    ORO_TRY(GridClip clip, clip_by_covers(field, covers));
    for (const HeightField* const one : over) ORO_CHECK(one->health());
    return clip;
}

}  // namespace oro
