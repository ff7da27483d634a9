#include "core/unseen/unseen_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "core/base/parallel.h"
#include "core/unseen/azimuth_sights.h"

namespace oro {
namespace {

// Sea level is nowhere higher above the ellipsoid. Source: EGM96, its largest undulation: 85.8 m.
constexpr double highest_sea_m = 86.0;
constexpr int most_columns = 2048, most_rows = 1024;

// A place of the picture by azimuth, in steps from the picture's middle, and the tangent of its elevation.
struct Direction {
    std::int32_t azimuth;
    double tangent;
};

// The picture's places by their directions.
class Directions {
  public:
    Directions(const Camera& camera, int columns, int rows, int threads)
        : columns_(columns), rows_(rows), tangent_(camera.half_fov_tangent()) {
        ecef_from_enu_ = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg);
        enu_from_view_ = glm::transpose(ecef_from_enu_) * glm::transpose(camera.view_from_ecef());
        const glm::dvec3 middle = enu_at(0.5 * columns, 0.5 * rows);
        const double level = std::hypot(middle.x, middle.y);
        if (level > 1.0e-12) ahead_ = {middle.x / level, middle.y / level};
        place_px_rad_ = 2.0 * std::max(tangent_.x / columns, tangent_.y / rows);
        azimuth_step_rad_ = place_px_rad_ / std::max(most_level(), 1.0e-9);
        all_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
        in_parallel(rows, threads, [&](int row) {
            for (int column = 0; column < columns; ++column)
                all_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)] = direction_at(column + 0.5, row + 0.5);
        });
    }

    [[nodiscard]] const std::vector<Direction>& all() const { return all_; }
    [[nodiscard]] double place_rad() const { return place_px_rad_; }
    // ECEF, across the eye's vertical.
    [[nodiscard]] glm::dvec3 ahead(std::int32_t azimuth) const {
        const double angle = azimuth * azimuth_step_rad_;
        const double cosine = std::cos(angle), sine = std::sin(angle);
        return ecef_from_enu_ *
               glm::dvec3(ahead_.x * cosine + ahead_.y * sine, ahead_.y * cosine - ahead_.x * sine, 0.0);
    }

  private:
    [[nodiscard]] glm::dvec3 enu_at(double column, double row) const {
        return enu_from_view_ * glm::dvec3((2.0 * column / columns_ - 1.0) * tangent_.x,
                                           (1.0 - 2.0 * row / rows_) * tangent_.y, -1.0);
    }
    [[nodiscard]] Direction direction_at(double column, double row) const {
        const glm::dvec3 enu = enu_at(column, row);
        const double along = enu.x * ahead_.x + enu.y * ahead_.y;
        const double across = enu.x * ahead_.y - enu.y * ahead_.x;
        const double level = std::sqrt(along * along + across * across);
        const double azimuth = std::atan2(across, along) / azimuth_step_rad_;
        // Straight up or down: as good as infinite.
        return {static_cast<std::int32_t>(azimuth + (azimuth < 0.0 ? -0.5 : 0.5)),
                enu.z / std::max(level, 1.0e-100)};
    }
    // The largest cosine of an elevation along the picture's edges: there a step of azimuth is the longest.
    // 1 where the edges cross the eye's level.
    [[nodiscard]] double most_level() const {
        double most = 0.0;
        bool above = false, below = false;
        const auto take = [&](double column, double row) {
            const glm::dvec3 enu = enu_at(column, row);
            most = std::max(most, std::hypot(enu.x, enu.y) / glm::length(enu));
            (enu.z > 0.0 ? above : below) = true;
        };
        constexpr int parts = 64;
        for (int i = 0; i <= parts; ++i) {
            for (const double end : {0.0, 1.0}) {
                take(static_cast<double>(columns_) * i / parts, end * rows_);
                take(end * columns_, static_cast<double>(rows_) * i / parts);
            }
        }
        return above && below ? 1.0 : most;
    }

    int columns_;
    int rows_;
    glm::dvec2 tangent_;
    glm::dmat3 ecef_from_enu_;
    glm::dmat3 enu_from_view_;
    glm::dvec2 ahead_{0.0, 1.0};  // east and north of the picture's middle
    double place_px_rad_{};
    double azimuth_step_rad_{};
    std::vector<Direction> all_;
};

// What each azimuth of a picture has beyond the data, and how high and low the picture looks there.
struct Azimuths {
    struct Tangents {
        double low;
        double high;
    };
    struct Beyond {
        Tangents lines;
        UnseenPlace place;
    };
    std::int32_t first{};
    std::vector<Tangents> wanted;
    std::vector<std::vector<Beyond>> beyond;
    std::vector<double> ground_below;

    explicit Azimuths(const std::vector<Direction>& directions) {
        constexpr double never = std::numeric_limits<double>::infinity();
        std::int32_t last = std::numeric_limits<std::int32_t>::min();
        first = std::numeric_limits<std::int32_t>::max();
        for (const Direction& direction : directions) {
            first = std::min(first, direction.azimuth);
            last = std::max(last, direction.azimuth);
        }
        wanted.assign(static_cast<std::size_t>(last - first) + 1, {never, -never});
        for (const Direction& direction : directions) {
            Tangents& here = wanted[static_cast<std::size_t>(direction.azimuth - first)];
            here.low = std::min(here.low, direction.tangent);
            here.high = std::max(here.high, direction.tangent);
        }
        beyond.resize(wanted.size());
        ground_below.resize(wanted.size());
    }

    void look(const AzimuthSights& sights, const Directions& directions, int threads) {
        constexpr int chunk = 32;  // neighbours guess well
        const auto count = static_cast<int>(wanted.size());
        in_parallel((count + chunk - 1) / chunk, threads, [&](int part) {
            std::optional<double> guess_rad;
            for (int i = part * chunk; i < std::min((part + 1) * chunk, count); ++i) {
                const auto number = static_cast<std::size_t>(i);
                const Tangents& here = wanted[number];
                if (here.low > here.high) continue;
                const ElevationInterval elevations{std::atan(here.low), std::atan(here.high)};
                const AzimuthSights::Look look = sights.look(directions.ahead(first + i), elevations,
                                                             0.5 * directions.place_rad(), guess_rad);
                ground_below[number] = tangent_of(look.ground_below_rad);
                for (const BeyondData& some : look.beyond)
                    beyond[number].push_back(
                        {{tangent_of(some.lines.low_rad), tangent_of(some.lines.high_rad)}, some.place});
            }
        });
    }
    // Infinite from straight up and straight down on.
    [[nodiscard]] static double tangent_of(double elevation_rad) {
        constexpr double upright = 0.5 * std::numbers::pi, never = std::numeric_limits<double>::infinity();
        return elevation_rad >= upright    ? never
               : elevation_rad <= -upright ? -never
                                           : std::tan(elevation_rad);
    }
};

}  // namespace

UnseenPicture unseen_picture(const TrueSurface& surface, const KnownGround& known, const Sight& sight,
                             const Camera& camera, double ceiling_m, int threads) {
    UnseenPicture picture;
    picture.columns = std::min(camera.width_px, most_columns);
    picture.rows = std::min(camera.height_px, most_rows);
    const Directions directions(camera, picture.columns, picture.rows, threads);
    const Oracle oracle(surface, sight);
    const AzimuthSights sights(oracle, surface, known, camera.eye, sight,
                               ceiling_m * surface.exaggeration() + highest_sea_m);
    Azimuths azimuths(directions.all());
    azimuths.look(sights, directions, threads);

    std::map<UnseenPlace, std::int32_t> numbers;
    picture.kind.reserve(directions.all().size());
    for (const Direction& direction : directions.all()) {
        const auto azimuth = static_cast<std::size_t>(direction.azimuth - azimuths.first);
        std::int32_t kind =
            direction.tangent < azimuths.ground_below[azimuth] ? UnseenPicture::data : UnseenPicture::sky;
        for (const Azimuths::Beyond& some : azimuths.beyond[azimuth]) {
            if (direction.tangent > some.lines.high) continue;
            kind = UnseenPicture::data;
            if (direction.tangent <= some.lines.low) continue;
            const auto next = static_cast<std::int32_t>(numbers.size());
            const auto [number, fresh] = numbers.try_emplace(some.place, next);
            if (fresh) picture.cells.push_back(some.place);
            kind = number->second;
            break;
        }
        picture.kind.push_back(kind);
    }
    return picture;
}

namespace {

// Of one column: the length of its longest run, in places, and the cells in it.
int longest_run(const UnseenPicture& picture, int column, std::vector<std::int32_t>& cells) {
    int longest = 0, begin = -1, of_ground = 0;
    for (int row = 0; row < picture.rows; ++row) {
        const std::int32_t kind = picture.at(column, row);
        // One place of ground may be none: edges are right to a place.
        of_ground = kind == UnseenPicture::data ? of_ground + 1 : 0;
        if (of_ground > 1) begin = -1;
        if (kind < 0) continue;
        if (begin < 0) begin = row;
        // Its ends lie within the places above and below.
        longest = std::max(longest, std::min(row - begin + 2, picture.rows));
        if (cells.empty() || (cells.back() != kind && std::ranges::find(cells, kind) == cells.end()))
            cells.push_back(kind);
    }
    return longest;
}

}  // namespace

UnseenGround unseen_ground(const UnseenPicture& picture, const Camera& camera, double ceiling_m) {
    UnseenGround unseen;
    unseen.ceiling_m = ceiling_m;
    unseen.columns = camera.width_px;
    unseen.column_px.resize(static_cast<std::size_t>(picture.columns));
    std::vector<UnseenCell> looked_into;
    for (const UnseenPlace& place : picture.cells) looked_into.push_back({place.cell, 0.0, 0});
    const double row_px = static_cast<double>(camera.height_px) / picture.rows;
    std::int64_t beyond = 0, beyond_part = 0;
    std::vector<std::int32_t> cells;
    for (int column = 0; column < picture.columns; ++column) {
        cells.clear();
        const double bound_px = row_px * longest_run(picture, column, cells);
        unseen.column_px[static_cast<std::size_t>(column)] = static_cast<float>(bound_px);
        bool into_missing = false, into_rest = false;
        for (const std::int32_t number : cells) {
            const auto cell = static_cast<std::size_t>(number);
            (picture.cells[cell].is_beyond_part ? into_rest : into_missing) = true;
            looked_into[cell].bound_px = std::max(looked_into[cell].bound_px, bound_px);
            ++looked_into[cell].columns;
        }
        if (into_missing) unseen.bound_px = std::max(unseen.bound_px, bound_px);
        if (into_rest) unseen.part_bound_px = std::max(unseen.part_bound_px, bound_px);
        beyond += into_missing ? 1 : 0;
        beyond_part += into_rest ? 1 : 0;
    }
    // Rounded up: one column of those looked at stands for as many as there are to each.
    const auto of_all = [&](std::int64_t columns) {
        return static_cast<int>((columns * camera.width_px + picture.columns - 1) / picture.columns);
    };
    unseen.columns_beyond = of_all(beyond);
    unseen.columns_beyond_part = of_all(beyond_part);
    for (std::size_t i = 0; i < looked_into.size(); ++i)
        (picture.cells[i].is_beyond_part ? unseen.beyond_part : unseen.missing).push_back(looked_into[i]);
    for (std::vector<UnseenCell>* const some : {&unseen.missing, &unseen.beyond_part})
        std::ranges::sort(*some, [](const UnseenCell& a, const UnseenCell& b) {
            if (a.bound_px != b.bound_px) return a.bound_px > b.bound_px;
            return a.columns != b.columns ? a.columns > b.columns : a.cell < b.cell;
        });
    return unseen;
}

}  // namespace oro
