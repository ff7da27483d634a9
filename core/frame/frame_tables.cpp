#include "core/frame/frame_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/wide.h"
#include "core/earth/culling.h"
#include "core/frame/column_terms.h"
#include "core/frame/ground_noise.h"
#include "core/frame/model_view.h"
#include "core/frame/plan_sources.h"
#include "core/lod/levels.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/page_on_net.h"
#include "shaders/shared_heights.h"
#include "shaders/shared_mesh_pages.h"

namespace oro {
namespace {

constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr int quads = static_cast<int>(gpu::page_quads);

gpu::UndulationTable undulation_table(const PostGrid& grid, const UndulationField& field) {
    gpu::UndulationTable table{};
    if (field.N_m.empty()) return table;
    table.rows = static_cast<gpu::uint>(field.lat.count);
    table.columns = static_cast<gpu::uint>(field.lon.count);
    if (grid.net) {
        // Its nodes are posts of the grid: see drawn_undulation().
        table.per_post = gpu::vec2(1.0F / static_cast<float>(undulation_step(grid)));
        return table;
    }
    const double row = field.lat.index_at(grid.lat.at_deg(0));
    double column = field.lon.index_at(grid.lon.at_deg(0));
    const double turn = 360.0 * field.lon.posts_per_deg;
    // In the whole turn that holds the region.
    const double middle = 0.5 * (field.lon.count - 1);
    const double across = 0.5 * (grid.columns() - 1) * grid.lon.spacing_deg() * field.lon.posts_per_deg;
    column -= turn * std::round((column + across - middle) / turn);
    table.first = gpu::vec2(row, column);
    table.per_post = gpu::vec2(grid.lat.spacing_deg() * field.lat.posts_per_deg,
                               grid.lon.spacing_deg() * field.lon.posts_per_deg);
    return table;
}

gpu::EyePost eye_post(const PostGrid& grid, const Geodetic& eye, Earth earth) {
    gpu::EyePost place{};
    const double middle_deg = 0.5 * (grid.north_deg() + grid.south_deg());
    const SineCosine lat = sine_cosine_deg(eye.lat_deg), middle = sine_cosine_deg(middle_deg);
    const double rad_per_deg = radians_from_deg(1.0).rad;
    if (grid.net) {
        const PostNumber post = grid.net->post_at(eye.lat_deg, eye.lon_deg);
        const LatticeGeoreference::LatticeFrame local_frame =
            grid.net->local_frame_at(0.5 * (grid.rows() - 1), 0.5 * (grid.columns() - 1));
        place.post = gpu::vec2(post.row, post.column);
        place.post_m = gpu::vec2(local_frame.row_m, local_frame.column_m);
        place.latitude = gpu::vec2(lat.cosine, lat.sine);
        place.normal_m = static_cast<float>(prime_vertical_radius_m(eye.lat_deg));
        place.meridian_m = static_cast<float>(meridian_radius_m(eye.lat_deg));
        place.e2 = static_cast<float>(wgs84_e2);
        place.turn = 1.0e9F;
        return place;
    }
    place.post = gpu::vec2(grid.lat.index_at(eye.lat_deg), grid.lon.index_at(eye.lon_deg));
    place.per_rad =
        gpu::vec2(grid.lat.posts_per_deg, grid.lon.posts_per_deg) / static_cast<float>(rad_per_deg);
    place.post_m =
        gpu::vec2(meridian_radius_m(middle_deg) * rad_per_deg / grid.lat.posts_per_deg,
                  prime_vertical_radius_m(middle_deg) * middle.cosine * rad_per_deg / grid.lon.posts_per_deg);
    place.latitude = gpu::vec2(lat.cosine, lat.sine);
    const bool sphere = earth == Earth::sphere;
    place.normal_m = static_cast<float>(sphere ? mean_radius_m : prime_vertical_radius_m(eye.lat_deg));
    place.meridian_m = static_cast<float>(sphere ? mean_radius_m : meridian_radius_m(eye.lat_deg));
    place.e2 = static_cast<float>(sphere ? 0.0 : wgs84_e2);
    place.turn = static_cast<float>(360.0 * grid.lon.posts_per_deg);
    return place;
}

// lon: of the eye.
gpu::NetMap net_map(const LatticeGeoreference& net, const SineCosine& lon) {
    const LatticeGeoreference::Inverse& inverse = net.inverse();
    const auto in_meridian_frame = [&](const glm::dvec3& ecef) {
        return gpu::vec3(lon.cosine * ecef.x + lon.sine * ecef.y, lon.cosine * ecef.y - lon.sine * ecef.x,
                         ecef.z);
    };
    gpu::NetMap map{};
    map.along_u = in_meridian_frame(inverse.along_u);
    map.along_v = in_meridian_frame(inverse.along_v);
    map.middle = gpu::vec2(inverse.middle);
    map.scale = gpu::vec2(inverse.scale);
    map.beyond_u = gpu::vec2(inverse.beyond[0]);
    map.beyond_v = gpu::vec2(inverse.beyond[1]);
    const LatticeGeoreference::LatticeFrame local_frame =
        net.local_frame_at(0.5 * (net.rows() - 1), 0.5 * (net.columns() - 1));
    map.turn = gpu::vec2(std::cos(local_frame.turn_rad), std::sin(local_frame.turn_rad));
    static_assert(std::size(gpu::NetMap{}.coefficients) == LatticeGeoreference::Inverse::terms);
    for (std::size_t i = 0; i < LatticeGeoreference::Inverse::terms; ++i)
        map.coefficients[i] = gpu::vec2(inverse.coefficients[i]);
    return map;
}

gpu::uvec2 address_words(std::uint64_t address) {
    return {static_cast<gpu::uint>(address), static_cast<gpu::uint>(address >> 32U)};
}

double within_half_a_turn_deg(double east_deg) {
    return std::abs(east_deg) < 180.0 ? east_deg : std::remainder(east_deg, 360.0);
}

// Of a column from the eye's meridian, within half a turn.
double east_of_eye_deg(const PostGrid& grid, const Geodetic& eye, std::int64_t column) {
    // Round the Earth the last column is the first.
    const bool twin = column == grid.columns() - 1 && grid.wraps_longitude();
    return within_half_a_turn_deg(grid.lon.at_deg(twin ? 0 : column) - eye.lon_deg);
}

// Of so many numbers, runs of those that are in any of the spans and of those that are not, in order.
template <class Run>
void for_each_run(std::span<const FrameTables::Span> spans, int count, const Run& run) {
    std::vector<std::int32_t> steps(static_cast<std::size_t>(count) + 1, 0);
    for (const FrameTables::Span& span : spans) {
        assert(0 <= span.first && span.first <= span.last && span.last < count);
        ++steps[static_cast<std::size_t>(span.first)];
        --steps[static_cast<std::size_t>(span.last) + 1];
    }
    std::int32_t open = 0;
    for (int first = 0; first < count;) {
        open += steps[static_cast<std::size_t>(first)];
        const bool wanted = open > 0;
        int next = first + 1;
        while (next < count && (open + steps[static_cast<std::size_t>(next)] > 0) == wanted)
            open += steps[static_cast<std::size_t>(next++)];
        run(first, next - first, wanted);
        first = next;
    }
}

// Of an eye over the ellipsoid.
struct EyePlace {
    double reference_m, rho_m, z_m;
};

// The terms of FrameTables::round_row() of many rows of the ellipsoid: the same bits.
ORO_WIDE void ellipsoid_rows(const RowAngles::Rows& rows, std::size_t count, const EyePlace& eye,
                             gpu::RowTerms* terms) {
    constexpr std::size_t at_a_time = 64;
    float R[at_a_time], C[at_a_time], S[at_a_time], P[at_a_time], Z[at_a_time];
    const double reference_m = eye.reference_m, rho_m = eye.rho_m, z_m = eye.z_m;
    for (std::size_t first = 0; first < count; first += at_a_time) {
        const std::size_t some = std::min(at_a_time, count - first);
        const double* const sine = rows.sine + first;
        const double* const cosine = rows.cosine + first;
        const double* const normal_m = rows.normal_m + first;
        const double* const polar_m = rows.polar_m + first;
        for (std::size_t i = 0; i < some; ++i) {
            const double from_axis_m = (normal_m[i] + reference_m) * cosine[i];
            R[i] = static_cast<float>(from_axis_m - rho_m);
            C[i] = static_cast<float>(cosine[i]);
            S[i] = static_cast<float>(sine[i]);
            P[i] = static_cast<float>(from_axis_m);
            Z[i] = static_cast<float>((polar_m[i] + reference_m) * sine[i] - z_m);
        }
        for (std::size_t i = 0; i < some; ++i) terms[first + i] = {R[i], C[i], S[i], P[i], Z[i], C[i], C[i]};
    }
}

}  // namespace

double reference_height_m(const Geodetic& eye) {
    return std::round(std::clamp(eye.h_m, -524000.0, 524000.0));
}

FrameTables::FrameTables(const PostGrid& grid, const Geodetic& eye, Earth earth, KeptAngles* kept)
    : grid_(grid), eye_(eye), earth_(earth), reference_m_(reference_height_m(eye)), kept_(kept) {
    if (kept == nullptr) kept_ = &own_angles_.emplace(grid);
    // A little more than the last frame's: an eye moves by little.
    rows_.reserve(kept_->row_count + 4 * gpu::page_posts);
    columns_.reserve(kept_->column_count + 4 * gpu::page_posts);
    const SineCosine lat = sine_cosine_deg(eye.lat_deg);
    const double normal_m = earth == Earth::sphere ? mean_radius_m : prime_vertical_radius_m(eye.lat_deg);
    const double e2 = earth == Earth::sphere ? 0.0 : wgs84_e2;
    rho_m_ = (normal_m + eye.h_m) * lat.cosine;
    z_m_ = (normal_m * (1.0 - e2) + eye.h_m) * lat.sine;
}

// On the ellipsoid or the sphere.
gpu::RowTerms FrameTables::round_row(const RowAngles::Row& row) const {
    const bool sphere = earth_ == Earth::sphere;
    const double normal_m = sphere ? mean_radius_m : row.normal_m;
    const double P = (normal_m + reference_m_) * row.cosine;
    const double Z = (normal_m * (1.0 - (sphere ? 0.0 : wgs84_e2)) + reference_m_) * row.sine - z_m_;
    const auto cosine = static_cast<float>(row.cosine);
    return {static_cast<float>(P - rho_m_),
            cosine,
            static_cast<float>(row.sine),
            static_cast<float>(P),
            static_cast<float>(Z),
            cosine,
            cosine};
}

// On the plane: its up and north turned into the eye's meridian frame, and with Q = 0 all columns as far
// apart.
gpu::RowTerms FrameTables::flat_row(double lat_deg) const {
    const SineCosine at_eye = sine_cosine_deg(eye_.lat_deg);
    const double north_m = meridian_radius_m(eye_.lat_deg) * radians_from_deg(lat_deg - eye_.lat_deg).rad;
    const double up_m = reference_m_ - eye_.h_m;
    return {static_cast<float>(at_eye.cosine * up_m - at_eye.sine * north_m),
            static_cast<float>(at_eye.cosine),
            static_cast<float>(at_eye.sine),
            static_cast<float>(prime_vertical_radius_m(eye_.lat_deg) * at_eye.cosine),
            static_cast<float>(at_eye.sine * up_m + at_eye.cosine * north_m),
            0.0F,
            static_cast<float>(sine_cosine_deg(lat_deg).cosine)};
}

void FrameTables::add_row(std::int64_t row) {
    if (grid_.net) {
        // Where its posts are is PagePlaces' business; what is coloured by latitude takes that of the row's
        // middle.
        const RowAngles::Row angles = kept_->rows.at(row);
        gpu::RowTerms terms{};
        terms.C = static_cast<float>(angles.cosine);
        terms.S = static_cast<float>(angles.sine);
        terms.cosine = 1.0F;
        rows_.push_back(terms);
        return;
    }
    rows_.push_back(earth_ == Earth::flat ? flat_row(row_lat_deg(grid_, row))
                                          : round_row(kept_->rows.at(row)));
}

void FrameTables::add_rows(const RowAngles::Rows& rows, std::size_t count) {
    const std::size_t first = rows_.size();
    rows_.resize(first + count);
    ellipsoid_rows(rows, count, {reference_m_, rho_m_, z_m_}, &rows_[first]);
}

void FrameTables::add_page_rows(const LevelAxis& level, int page_row) {
    if (is_on_ellipsoid()) {
        add_rows(kept_->rows.of_pages(level, page_row), gpu::page_posts);
        return;
    }
    for (int i = 0; i < posts; ++i) add_row(post_beyond(level, page_row * quads + i));
}

void FrameTables::add_columns(std::span<const double> lon_deg) {
    const std::size_t first = columns_.size();
    columns_.resize(first + lon_deg.size());
    east_deg_.resize(lon_deg.size());
    bool all_within = true;
    for (std::size_t i = 0; i < lon_deg.size(); ++i) {
        east_deg_[i] = lon_deg[i] - eye_.lon_deg;
        all_within &= std::abs(east_deg_[i]) < 180.0;
    }
    if (!all_within)
        for (double& east_deg : east_deg_) east_deg = within_half_a_turn_deg(east_deg);
    if (earth_ != Earth::flat) {
        column_terms(east_deg_, std::span(columns_).subspan(first));
        return;
    }
    for (std::size_t i = 0; i < lon_deg.size(); ++i)
        columns_[first + i] = {0.0F, static_cast<float>(radians_from_deg(east_deg_[i]).rad)};
}

std::uint32_t& FrameTables::first_of(FirstOfPages& all, int level, int number, int count) {
    if (all.size() <= static_cast<std::size_t>(level)) all.resize(static_cast<std::size_t>(level) + 1);
    std::vector<std::uint32_t>& of_level = all[static_cast<std::size_t>(level)];
    if (of_level.empty()) of_level.resize(static_cast<std::size_t>(count), nowhere);
    return of_level[static_cast<std::size_t>(number)];
}

void FrameTables::set_eye(gpu::PlanTerms& terms) const {
    terms.reference_m = reference_m_;
    terms.rho_m = rho_m_;
    terms.z_m = z_m_;
    terms.eye_lon_deg = eye_.lon_deg;
    terms.row_count = static_cast<gpu::uint>(row_sources_.size());
    terms.column_count = static_cast<gpu::uint>(column_sources_.size());
    terms.row_sources = address_words(sources_->row_address());
    terms.column_sources = address_words(sources_->column_address());
    terms.page_sources = address_words(sources_->page_address());
}

void FrameTables::place_for_device(const LevelGrid& level, const PageIndex& index, std::uint32_t& row,
                                   std::uint32_t& column) {
    if (row == nowhere) {
        row = gpu::page_posts * static_cast<std::uint32_t>(row_sources_.size());
        row_sources_.push_back(sources_->rows(level.row, index.row, kept_->rows));
    }
    if (column == nowhere) {
        column = gpu::page_posts * static_cast<std::uint32_t>(column_sources_.size());
        column_sources_.push_back(sources_->columns(level.column, index.column, kept_->columns));
    }
}

void FrameTables::place(const PageIndex& index, gpu::FramePage& page) {
    const LevelGrid level = level_grid(grid_, index.level);
    page.first_row = static_cast<gpu::uint>(std::int64_t{index.row} * quads << index.level);
    page.first_column = static_cast<gpu::uint>(std::int64_t{index.column} * quads << index.level);
    std::uint32_t& row = first_of(first_rows_, index.level, index.row, level.row.pages());
    std::uint32_t& column = first_of(first_columns_, index.level, index.column, level.column.pages());
    if (sources_ != nullptr) place_for_device(level, index, row, column);
    if (row == nowhere) {
        row = static_cast<std::uint32_t>(rows_.size());
        add_page_rows(level.row, index.row);
    }
    if (column == nowhere) {
        column = static_cast<std::uint32_t>(columns_.size());
        if (grid_.net)
            columns_.resize(columns_.size() + gpu::page_posts);
        else
            add_columns(kept_->columns.of_pages(level.column, index.column));
    }
    page.row_terms = row;
    page.column_terms = column;
}

void FrameTables::place_spans(std::span<const Span> rows, std::span<const Span> columns) {
    for_each_run(rows, grid_.rows(), [&](int first, int count, bool wanted) {
        if (!wanted)
            rows_.resize(rows_.size() + static_cast<std::size_t>(count));
        else if (is_on_ellipsoid())
            add_rows(kept_->rows.of(first, count), static_cast<std::size_t>(count));
        else
            for (int row = first; row < first + count; ++row) add_row(row);
    });
    for_each_run(columns, grid_.columns(), [&](int first, int count, bool wanted) {
        if (!wanted || grid_.net)
            columns_.resize(columns_.size() + static_cast<std::size_t>(count));
        else
            add_columns(kept_->columns.of(first, count));
    });
}

namespace {

// Radius of curvature at the eye of the sphere that the bare Earth is drawn as; sight lines that bend make it
// larger.
double seen_earth_radius_m(const WorldModel& model, const Geodetic& eye) {
    if (model.earth == Earth::flat) return 1e12;
    const double radius_m = model.earth == Earth::sphere ? mean_radius_m : gaussian_radius_m(eye.lat_deg);
    return radius_m / (1.0 - Refraction(eye, model.air).curvature_per_m() * radius_m);
}

// What place.glsl needs to place posts by other than the frame's tables alone.
void set_model(const WorldModel& model, const Camera& camera, gpu::FrameConstants& constants) {
    constants.refraction_per_m = static_cast<float>(Refraction(camera.eye, model.air).curvature_per_m());
    constants.placing = static_cast<gpu::uint>(model.precision);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye = model_eye_ecef(model.earth, camera.eye).m;
    const SineCosine lon = sine_cosine_deg(camera.eye.lon_deg);
    constants.view_from_ecef = gpu::mat3(view_from_ecef);
    constants.view_translation = gpu::vec3(-(view_from_ecef * eye));
    constants.eye_high = gpu::vec3(eye);
    constants.eye_low = gpu::vec3(eye - glm::dvec3(constants.eye_high));
    constants.eye_meridian = gpu::vec2(lon.cosine, lon.sine);
}

}  // namespace

gpu::uint cut_column(const PostGrid& grid, const Geodetic& eye, Earth earth) {
    assert(earth == Earth::ellipsoid || !grid.net);
    if (earth != Earth::flat) return gpu::no_column;
    const double turn = 360.0 * grid.lon.posts_per_deg;
    const double opposite = grid.lon.index_at(eye.lon_deg + 180.0);
    const auto nearest = static_cast<std::int64_t>(std::floor(opposite - turn * std::floor(opposite / turn)));
    // Rounded angles may put it a column away; and round the Earth the last column is one turn from the
    // first.
    for (const std::int64_t around : {nearest, nearest - static_cast<std::int64_t>(std::round(turn))})
        for (std::int64_t column = around - 1; column <= around + 1; ++column)
            if (column >= 0 && column + 1 < grid.columns() &&
                east_of_eye_deg(grid, eye, column + 1) < east_of_eye_deg(grid, eye, column))
                return static_cast<gpu::uint>(column);
    return gpu::no_column;
}

gpu::FrameConstants frame_constants(const RegionPages& pages, const Camera& camera, const Tile& tile,
                                    double tau_px, const WorldModel& model,
                                    const HeightQuantization& coding) {
    const RegionFacts& region = pages.facts();
    const Projection projection = projection_of_tile(camera, tile);
    const SeenHorizon horizon = ModelView(camera, model, coding).horizon(region.shape.occluder);
    const LevelView view = level_view(camera, tau_px);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const SineCosine lon = sine_cosine_deg(camera.eye.lon_deg);
    gpu::FrameConstants constants{};
    constants.view_from_eye = gpu::mat3(
        view_from_ecef * glm::dmat3(lon.cosine, lon.sine, 0.0, -lon.sine, lon.cosine, 0.0, 0.0, 0.0, 1.0));
    constants.reference_steps = height_steps(reference_height_m(camera.eye));
    constants.projection_scale = gpu::vec2(projection.scale);
    constants.projection_shift = gpu::vec2(projection.shift);
    constants.near_m = static_cast<float>(projection.near_m);
    constants.horizon_angle_rad = static_cast<float>(horizon.eye.angle_rad);
    constants.horizon_stretch = static_cast<float>(horizon.stretch);
    const glm::dvec3 up = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2];
    constants.up_view = gpu::vec3(view_from_ecef * up);
    if (region.grid.net) {
        const glm::dvec3 eye_ecef = camera.eye_ecef().m;
        const LatticePoint lattice = lattice_point(eye_ecef);
        constants.has_net = 1;
        for (int axis = 0; axis < 3; ++axis)
            constants.eye_remainder[axis] = static_cast<float>(
                eye_ecef[axis] -
                static_cast<double>(lattice.steps[static_cast<std::size_t>(axis)]) * height_step_m);
    }
    constants.eye_h_m = static_cast<float>(camera.eye.h_m);
    constants.earth_radius_m = static_cast<float>(seen_earth_radius_m(model, camera.eye));
    set_model(model, camera, constants);
    constants.height_bits = coding.sixteen ? 16U : coding.packed ? gpu::height_bits_packed : 32U;
    constants.height_shift = static_cast<gpu::uint>(coding.shift);
    constants.height_offset = coding.offset_steps;
    constants.width_px = static_cast<gpu::uint>(tile.width_px);
    constants.height_px = static_cast<gpu::uint>(tile.height_px);
    constants.first_x_px = static_cast<gpu::uint>(tile.x_px);
    constants.first_y_px = static_cast<gpu::uint>(tile.y_px);
    constants.pixels_per_tangent = view.pixels_per_tangent;
    constants.corner_tangent = view.corner_tangent;
    constants.tau_px = view.tau_px;
    constants.exaggeration = static_cast<float>(region.shape.exaggeration);
    constants.last_row = static_cast<gpu::uint>(region.grid.rows() - 1);
    constants.last_column = static_cast<gpu::uint>(region.grid.columns() - 1);
    constants.cut_column = cut_column(region.grid, camera.eye, model.earth);
    constants.sample_count = 1;
    constants.undulation = undulation_table(region.grid, region.undulation);
    constants.eye_post = eye_post(region.grid, camera.eye, model.earth);
    if (region.grid.net) constants.net = net_map(*region.grid.net, lon);
    constants.contents = static_cast<gpu::uint>(pages.contents());
    set_ground_noise(model_eye_ecef(model.earth, camera.eye), constants);
    return constants;
}

}  // namespace oro
