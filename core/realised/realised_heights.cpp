#include "core/realised/realised_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "core/base/lowbias32.h"
#include "core/base/wide.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

constexpr int reach = predictor_reach, side = predictor_side;
constexpr int ground_bands = 6;          // cells of 1 to 32 posts: what is longer the guess has from the data
constexpr int block_posts = 16;          // roughness is estimated for squares of so many posts,
constexpr int around_block_posts = 8;    // from these and so many around them
constexpr std::array lags{1, 2, 4};      // posts
constexpr double usual_exponent = 0.9;   // where errors hide the ground's
constexpr double roughness_step = 1.25;  // roughnesses are one where they are nearer than that
constexpr double least_share = 0.01;     // of the errors' deviation: smoother ground counts as that

// Sums of octaves whose deviation grows with the width of cells as its power; that of one post is 1 m. All
// that is narrower than the `narrower`-th octave below, in one sum: posts do not tell it apart.
std::vector<NoiseBand> ground_noise(double cell_m, double exponent, int narrower) {
    const double ratio = std::exp2(-2.0 * exponent);
    std::vector<NoiseBand> bands{
        {std::exp2(-narrower - 1) * cell_m, std::pow(ratio, narrower + 1) / (1.0 - ratio)}};
    for (int i = -narrower; i < ground_bands; ++i)
        bands.push_back({cell_m * std::exp2(i), std::exp2(2.0 * exponent * i)});
    return bands;
}

std::uint32_t seed_of(std::uint32_t seed, std::uint32_t what) {
    return lowbias32(seed * 2U + what + 0x51ed270bU);
}

// Adds the products of weights and values to a run of sums, weight by weight in their order.
ORO_WIDE void add_weighted(const float* weights, const float* ground, float roughness, const float* noise,
                           std::size_t stride, float* sums, std::size_t count) {
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t column = 0; column < side; ++column) {
            const float weight = weights[row * side + column];
            const float* const g = ground + row * stride + column;
            const float* const n = noise + row * stride + column;
            for (std::size_t i = 0; i < count; ++i) sums[i] += weight * (roughness * g[i] + n[i]);
        }
}

// The mean square of second differences with a lag, along rows (across false) or columns, in a square.
double mean_second_difference(const std::vector<float>& H_m, const std::vector<char>& is_void, int stride,
                              const GridPart& square, int lag, bool across) {
    double sum = 0.0;
    std::size_t count = 0;
    const int step = across ? lag * stride : lag;
    for (int row = square.first_row; row < square.first_row + square.rows; ++row) {
        for (int column = square.first_column; column < square.first_column + square.columns; ++column) {
            const auto at = static_cast<std::ptrdiff_t>(row) * stride + column;
            const auto before = static_cast<std::size_t>(at - step), here = static_cast<std::size_t>(at),
                       after = static_cast<std::size_t>(at + step);
            if (is_void[before] != 0 || is_void[here] != 0 || is_void[after] != 0) continue;
            const double second = static_cast<double>(H_m[before]) - 2.0 * static_cast<double>(H_m[here]) +
                                  static_cast<double>(H_m[after]);
            sum += second * second;
            ++count;
        }
    }
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

int wrapped_column(const PostGrid& grid, int column) {
    if (!grid.wraps_longitude()) return std::clamp(column, 0, grid.columns() - 1);
    const int turn = grid.columns() - 1;
    return ((column % turn) + turn) % turn;
}

}  // namespace

ErrorNoise error_noise(const HeightErrors& errors) {
    // Three sums: the first with most of the variance; the last is nearly white at most spacings. Cells are
    // made so wide that the correlation is 1 / e at the length that was asked for.
    constexpr std::array shares{0.75, 0.2, 0.05};
    const auto correlation = [&](double cell_m) {
        double sum = 0.0;
        for (std::size_t i = 0; i < shares.size(); ++i)
            sum += shares[i] * lattice_correlation(errors.correlation_m / (cell_m / std::exp2(i)));
        return sum;
    };
    double low = 0.1 * errors.correlation_m, high = 100.0 * errors.correlation_m;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (correlation(middle) < std::exp(-1.0) ? low : high) = middle;
    }
    // The lattice's cells are powers of two: the places are scaled instead, by 0.5 to 1.
    ErrorNoise noise;
    const double cells = std::log2(high * 192.0);
    noise.scale = std::exp2(std::floor(cells) - cells);
    for (std::size_t i = 0; i < shares.size(); ++i)
        noise.bands.push_back({high / std::exp2(i), shares[i] * errors.deviation_m * errors.deviation_m});
    return noise;
}

std::size_t RealisedHeights::wide_number(int row, int column) const {
    return static_cast<std::size_t>(row + reach) * static_cast<std::size_t>(wide_columns_) +
           static_cast<std::size_t>(column + reach);
}

void RealisedHeights::take_in(const HeightField& field, const GridPart& part) {
    const PostGrid& grid = field.grid;
    rows_ = part.rows;
    columns_ = part.columns;
    wide_columns_ = columns_ + 2 * reach;
    frame_.grid = grid;
    frame_.undulation = field.undulation;
    if (grid.net) {
        frame_.N_of_posts_m = field.N_of_posts_m;
        first_row_ = part.first_row;
        first_column_ = part.first_column;
        frame_.H_m.reserve(grid.post_count());
        for (int row = 0; row < grid.rows(); ++row)
            for (int column = 0; column < grid.columns(); ++column)
                frame_.H_m.push_back(field.H_at_post_m(row, column));
    } else {
        frame_.grid.lat.first += static_cast<std::int64_t>(grid.lat.step) * part.first_row;
        frame_.grid.lon.first += static_cast<std::int64_t>(grid.lon.step) * part.first_column;
        for (GridAxis* axis : {&frame_.grid.lat, &frame_.grid.lon}) {
            axis->posts_per_deg *= finer_;
            axis->first *= finer_;
        }
        frame_.grid.lat.count = realised_rows();
        frame_.grid.lon.count = realised_columns();
        // First columns of grids are in one turn.
        const auto turn = static_cast<std::int64_t>(std::llround(360.0 * frame_.grid.lon.posts_per_deg));
        while (frame_.grid.lon.at_deg(0) >= 180.0) frame_.grid.lon.first -= turn;
        while (frame_.grid.lon.at_deg(0) < -180.0) frame_.grid.lon.first += turn;
        frame_.H_m.assign(frame_.grid.post_count(), void_height_m);
    }
    float last_m = 0.0F;
    for (int row = -reach; row < rows_ + reach; ++row) {
        const int of_row = std::clamp(part.first_row + row, 0, grid.rows() - 1);
        for (int column = -reach; column < columns_ + reach; ++column) {
            const float H_m = field.H_at_post_m(of_row, wrapped_column(grid, part.first_column + column));
            void_.push_back(is_void(H_m) ? 1 : 0);
            any_void_ |= is_void(H_m);
            if (!is_void(H_m)) last_m = H_m;
            data_m_.push_back(last_m);
        }
    }
}

void RealisedHeights::place_posts(const HeightField& field, const GridPart& part) {
    const PostGrid& grid = field.grid;
    const std::size_t count = data_m_.size();
    for (NoisePlaces* places : {&places_, &error_places_}) {
        places->x.reserve(count);
        places->y.reserve(count);
        places->z.reserve(count);
    }
    const auto add = [](NoisePlaces& places, const glm::dvec3& m, double scale) {
        places.x.push_back(static_cast<std::int32_t>(std::lround(m.x * 64.0 * scale)));
        places.y.push_back(static_cast<std::int32_t>(std::lround(m.y * 64.0 * scale)));
        places.z.push_back(static_cast<std::int32_t>(std::lround(m.z * 64.0 * scale)));
    };
    for (int row = -reach; row < rows_ + reach; ++row) {
        const int of_row = std::clamp(part.first_row + row, 0, grid.rows() - 1);
        for (int column = -reach; column < columns_ + reach; ++column) {
            const PostPlace place = grid.place_at(of_row, wrapped_column(grid, part.first_column + column));
            const glm::dvec3 m = ecef_from_geodetic({place.lat_deg, place.lon_deg, 0.0}).m;
            add(places_, m, 1.0);
            add(error_places_, m, errors_.scale);
        }
    }
    for (int row = 0; finer_ > 1 && row < realised_rows(); ++row) {
        for (int column = 0; column < realised_columns(); ++column) {
            const PostPlace place = frame_.grid.place_at(row, column);
            add(finer_places_, ecef_from_geodetic({place.lat_deg, place.lon_deg, 0.0}).m, 1.0);
        }
    }
    // Spacing in the middle of the part.
    const int row = std::clamp(rows_ / 2, 0, rows_ - 1), column = std::clamp(columns_ / 2, 0, columns_ - 1);
    const auto between_m = [&](std::size_t one, std::size_t other) {
        return std::max(std::hypot(places_.x[one] - places_.x[other], places_.y[one] - places_.y[other],
                                   places_.z[one] - places_.z[other]) /
                            64.0,
                        0.01);
    };
    const std::size_t here = wide_number(row, column);
    row_spacing_m_ = between_m(here, here + static_cast<std::size_t>(wide_columns_));
    column_spacing_m_ = between_m(here, here + 1);
}

double RealisedHeights::lag_m(std::size_t question) const {
    return lags[question / 2] * (question % 2 == 0 ? row_spacing_m_ : column_spacing_m_);
}

RealisedHeights::SecondDifferences RealisedHeights::ground_differences(int row, int column, int rows,
                                                                       int columns) const {
    constexpr int least = lags.back();
    const int first_row = std::max(row, least - reach), first_column = std::max(column, least - reach);
    const int end_row = std::min(row + rows, rows_ + reach - least),
              end_column = std::min(column + columns, columns_ + reach - least);
    const GridPart square{first_row + reach, std::max(0, end_row - first_row), first_column + reach,
                          std::max(0, end_column - first_column)};
    SecondDifferences found{};
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i] = mean_second_difference(data_m_, void_, wide_columns_, square, lags[i / 2], i % 2 == 0) -
                   second_difference_of(errors_.bands, lag_m(i));
    return found;
}

double RealisedHeights::fitting_exponent(const SecondDifferences& found, double cell_m) const {
    const double variance = covariance_of(errors_.bands, 0.0);
    double least_scatter = std::numeric_limits<double>::infinity(), best = usual_exponent;
    for (int i = 6; i <= 28; ++i) {
        const double exponent = 0.05 * i;
        const std::vector<NoiseBand> bands = ground_noise(cell_m, exponent, 0);
        double weights = 0.0, sum = 0.0, squares = 0.0;
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (!(found[k] > 0.1 * variance)) continue;
            const double weight = found[k] / (found[k] + variance);
            const double says = std::log(found[k] / second_difference_of(bands, lag_m(k)));
            weights += weight;
            sum += weight * says;
            squares += weight * says * says;
        }
        if (weights < 1.0) break;  // hardly more than errors
        const double scatter = squares / weights - (sum / weights) * (sum / weights);
        if (scatter >= least_scatter) continue;
        least_scatter = scatter;
        best = exponent;
    }
    return best;
}

double RealisedHeights::squared_roughness(const SecondDifferences& found) const {
    const double variance = covariance_of(errors_.bands, 0.0);
    double weights = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        // Each lag says a square, which errors of the data scatter in proportion.
        const double expected = second_difference_of(ground_, lag_m(k)),
                     noise = second_difference_of(errors_.bands, lag_m(k));
        const double weight = (expected * expected) / (noise * noise + 1e-12);
        weights += weight;
        sum += weight * found[k] / expected;
    }
    return std::max(sum / weights, least_share * least_share * variance);
}

void RealisedHeights::estimate_roughness() {
    const double cell_m = lattice_cell_near(std::sqrt(row_spacing_m_ * column_spacing_m_));
    roughness_.exponent = fitting_exponent(ground_differences(0, 0, rows_, columns_), cell_m);
    ground_ = ground_noise(cell_m, roughness_.exponent, finer_ > 1 ? 3 : 0);
    const int block_rows = (rows_ + block_posts - 1) / block_posts,
              block_columns = (columns_ + block_posts - 1) / block_posts;
    constexpr int around = around_block_posts, whole = block_posts + 2 * around_block_posts;
    std::vector<double> squares;
    for (int row = 0; row < block_rows; ++row)
        for (int column = 0; column < block_columns; ++column)
            squares.push_back(squared_roughness(
                ground_differences(row * block_posts - around, column * block_posts - around, whole, whole)));
    std::vector<double> sorted = squares;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
    roughness_.deviation_m = std::sqrt(sorted[sorted.size() / 2]);
    spread_roughness(squares, block_rows, block_columns);
}

void RealisedHeights::spread_roughness(const std::vector<double>& squares, int block_rows,
                                       int block_columns) {
    const auto log_at = [&](int row, int column) {
        return std::log(squares[static_cast<std::size_t>(std::min(row, block_rows - 1) * block_columns +
                                                         std::min(column, block_columns - 1))]);
    };
    const auto between_blocks = [](int post, int blocks) {
        return std::clamp((post + 0.5) / block_posts - 0.5, 0.0, blocks - 1.0);
    };
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const double y = between_blocks(row, block_rows), x = between_blocks(column, block_columns);
            const int top = static_cast<int>(y), left = static_cast<int>(x);
            const double dy = y - top, dx = x - left;
            const double between =
                (1.0 - dy) * ((1.0 - dx) * log_at(top, left) + dx * log_at(top, left + 1)) +
                dy * ((1.0 - dx) * log_at(top + 1, left) + dx * log_at(top + 1, left + 1));
            const double class_of = std::round(0.5 * between / std::log(roughness_step));
            local_roughness_.push_back(static_cast<float>(std::pow(roughness_step, class_of)));
        }
    }
}

Result<void> RealisedHeights::make_weights() {
    std::map<float, int> numbers;
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const float roughness =
                local_roughness_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                 static_cast<std::size_t>(column)];
            auto [known, is_new] = numbers.try_emplace(roughness, static_cast<int>(weights_.size()));
            if (is_new) {
                std::vector<NoiseBand> ground = ground_;
                for (NoiseBand& band : ground)
                    band.variance *= static_cast<double>(roughness) * static_cast<double>(roughness);
                std::vector<std::vector<float>> weights =
                    predictor_weights(ground, errors_.bands, row_spacing_m_, column_spacing_m_, finer_);
                if (weights.empty())
                    return Error{ErrorKind::failed, "realisations",
                                 "the equations of the ground's guess have no solution: give another "
                                 "--accuracy or --correlation"};
                std::ranges::move(weights, std::back_inserter(weights_));
            }
            if (column > 0 && runs_.back().weights == known->second)
                ++runs_.back().count;
            else
                runs_.push_back({row, column, 1, known->second, roughness});
        }
    }
    return {};
}

float RealisedHeights::weighted(const std::vector<float>& values, const std::vector<float>& weights, int row,
                                int column) const {
    const float here = values[wide_number(row, column)];
    float sum = 0.0F;
    for (int r = 0; r < side; ++r)
        for (int c = 0; c < side; ++c) {
            const std::size_t at = wide_number(row + r - reach, column + c - reach);
            sum += weights[static_cast<std::size_t>(r * side + c)] * (void_[at] != 0 ? here : values[at]);
        }
    return sum;
}

template <class Each>
void RealisedHeights::places_of(const Run& run, const Each& each) const {
    const int stride = realised_columns();
    for (int down = 0; down < (run.row + 1 < rows_ ? finer_ : 1); ++down) {
        for (int right = 0; right < finer_; ++right) {
            // Nothing is east of the last column.
            const int count = run.count - (right > 0 && run.column + run.count == columns_ ? 1 : 0);
            each(static_cast<std::size_t>(run.row * finer_ + down) * static_cast<std::size_t>(stride) +
                     static_cast<std::size_t>(run.column * finer_ + right),
                 count, weights_[static_cast<std::size_t>(run.weights + down * finer_ + right)]);
        }
    }
}

void RealisedHeights::guess() {
    guess_m_.assign(frame_.grid.net ? static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)
                                    : frame_.grid.post_count(),
                    0.0F);
    for (const Run& run : runs_) {
        // From a height near by, so that float sums keep millimetres.
        const float base = data_m_[wide_number(run.row, run.column)];
        places_of(run, [&](std::size_t first, int count, const std::vector<float>& weights) {
            for (int i = 0; i < count; ++i) {
                float sum = 0.0F;
                const float here = data_m_[wide_number(run.row, run.column + i)] - base;
                for (int r = 0; r < side; ++r)
                    for (int c = 0; c < side; ++c) {
                        const std::size_t at = wide_number(run.row + r - reach, run.column + i + c - reach);
                        sum += weights[static_cast<std::size_t>(r * side + c)] *
                               (void_[at] != 0 ? here : data_m_[at] - base);
                    }
                guess_m_[first + static_cast<std::size_t>(i) * static_cast<std::size_t>(finer_)] = base + sum;
            }
        });
    }
}

Result<RealisedHeights> RealisedHeights::create(const HeightField& field, const GridPart& part,
                                                const HeightErrors& errors, int finer) {
    RealisedHeights made;
    made.finer_ = finer;
    made.errors_ = error_noise(errors);
    made.take_in(field, part);
    ORO_CHECK(field.health());
    made.place_posts(field, part);
    made.estimate_roughness();
    ORO_CHECK(made.make_weights());
    made.guess();
    return made;
}

bool RealisedHeights::is_void_at(int row, int column) const {
    const int top = row / finer_, left = column / finer_, bottom = (row + finer_ - 1) / finer_,
              right = (column + finer_ - 1) / finer_;
    return (void_[wide_number(top, left)] | void_[wide_number(top, right)] |
            void_[wide_number(bottom, left)] | void_[wide_number(bottom, right)]) != 0;
}

HeightField RealisedHeights::with_heights(const std::vector<float>& H_m) const {
    HeightField field = frame_;
    const auto stride = static_cast<std::size_t>(field.grid.columns());
    for (int row = 0; row < realised_rows(); ++row) {
        for (int column = 0; column < realised_columns(); ++column) {
            if (any_void_ && is_void_at(row, column)) continue;
            const int to_column = first_column_ + column;
            field.H_m[static_cast<std::size_t>(first_row_ + row) * stride +
                      static_cast<std::size_t>(to_column)] =
                H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(realised_columns()) +
                    static_cast<std::size_t>(column)];
        }
    }
    return field;
}

HeightField RealisedHeights::realisation(std::uint32_t seed) const {
    std::vector<float> ground(data_m_.size(), 0.0F), noise(data_m_.size(), 0.0F), between;
    add_noise(ground_, 1.0, seed_of(seed, 0), places_, ground);
    add_noise(errors_.bands, errors_.scale, seed_of(seed, 1), error_places_, noise);
    if (finer_ > 1) {
        between.assign(guess_m_.size(), 0.0F);
        add_noise(ground_, 1.0, seed_of(seed, 0), finer_places_, between);
    }
    std::vector<float> H_m(guess_m_.size()), sums;
    for (const Run& run : runs_) {
        const std::size_t wide = wide_number(run.row - reach, run.column - reach);
        places_of(run, [&](std::size_t first, int places, const std::vector<float>& weights) {
            const auto count = static_cast<std::size_t>(places);
            sums.assign(count, 0.0F);
            if (any_void_) {
                for (int i = 0; i < places; ++i)
                    sums[static_cast<std::size_t>(i)] =
                        run.roughness * weighted(ground, weights, run.row, run.column + i) +
                        weighted(noise, weights, run.row, run.column + i);
            } else {
                add_weighted(weights.data(), ground.data() + wide, run.roughness, noise.data() + wide,
                             static_cast<std::size_t>(wide_columns_), sums.data(), count);
            }
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t at = first + i * static_cast<std::size_t>(finer_);
                const float here =
                    finer_ > 1 ? between[at] : ground[wide_number(run.row, run.column + static_cast<int>(i))];
                H_m[at] = guess_m_[at] + (run.roughness * here - sums[i]);
            }
        });
    }
    return with_heights(H_m);
}

HeightField RealisedHeights::data_and_noise(std::uint32_t seed) const {
    std::vector<float> noise(data_m_.size(), 0.0F);
    add_noise(errors_.bands, errors_.scale, seed_of(seed, 1), error_places_, noise);
    std::vector<float> H_m;
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column) {
            const std::size_t at = wide_number(row, column);
            H_m.push_back(data_m_[at] + noise[at]);
        }
    return with_heights(H_m);
}

}  // namespace oro
