// Ground as it may truly be, given data that have errors: realisations of the posterior.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/realised/noise_structure.h"
#include "core/realised/post_predictor.h"
#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"

namespace oro {

// What is known of the errors of data.
struct HeightErrors {
    double deviation_m{};    // standard deviation, above 0; a bound of 90 % (LE90) is 1.6449 of it
    double correlation_m{};  // distance over which the correlation falls to 1 / e, above 0
};
inline constexpr double le90_of_deviation = 1.6449;

// The errors' structure, as sums of noise; its covariance at 0 is the square of the deviation.
struct ErrorNoise {
    std::vector<NoiseBand> bands;
    double scale{1.0};  // of the places that add_noise() is given
};
ErrorNoise error_noise(const HeightErrors& errors);

// How rough the ground is, estimated from the data less their errors.
struct GroundRoughness {
    double exponent{};     // how second differences grow with distance: as its power
    double deviation_m{};  // of the ground's noise with cells of one post; the median of the part
};

// Realisations of the ground in a part of a grid: R = W D + (a U - W (a U + E)), with D the data, W the best
// linear guess (post_predictor.h), U noise with the ground's structure and E noise with the errors'. So R is
// the guess, and around it what the guess leaves open, which is not what errors alone would leave: to add E
// to D would count the errors twice. Roughness a is of each place: from second differences at lags of 1, 2
// and 4 posts, within some 32 posts. Source: A. Journel & C. Huijbregts, Mining Geostatistics, 1978, VII.A.1
// (conditioning by kriging).
class RealisedHeights {
  public:
    // The field may be forgotten afterwards. `part` lies in the grid (of one that goes round the Earth, or a
    // whole turn beside). Errors: the equations of the guess have no solution; posts that cannot be read.
    // finer: 1 to 4; realisations have so many posts in place of one each way, with the ground between posts
    // as it may be; above 1 for grids of latitudes and longitudes alone.
    static Result<RealisedHeights> create(const HeightField& field, const GridPart& part,
                                          const HeightErrors& errors, int finer = 1);

    // Realisation of a seed: a field of the part alone, on a grid of latitudes and longitudes; of a grid on a
    // net the whole field, which differs from the data in the part. Void posts stay void. The same seed gives
    // the same bits for any number of threads. From any thread.
    [[nodiscard]] HeightField realisation(std::uint32_t seed) const;
    // The data with errors added, which is what one would do first: not calibrated, kept for comparison. Of
    // those that are not finer.
    [[nodiscard]] HeightField data_and_noise(std::uint32_t seed) const;
    // How many posts of a realisation there are in place of one.
    [[nodiscard]] int finer() const { return finer_; }
    // Where the part's first post stands in what realisation() gives.
    [[nodiscard]] int first_row() const { return first_row_; }
    [[nodiscard]] int first_column() const { return first_column_; }

    [[nodiscard]] const GroundRoughness& roughness() const { return roughness_; }

  private:
    // A run of posts of one row that have the same weights.
    struct Run {
        int row, column, count;
        int weights;  // number in weights_, of the posts themselves; those between follow
        float roughness;
    };

    void take_in(const HeightField& field, const GridPart& part);
    void place_posts(const HeightField& field, const GridPart& part);
    // Mean squares of second differences of a square of posts, less those of errors: for each lag along
    // columns and along rows.
    using SecondDifferences = std::array<double, 6>;
    [[nodiscard]] double lag_m(std::size_t question) const;
    [[nodiscard]] SecondDifferences ground_differences(int row, int column, int rows, int columns) const;
    // The exponent that leaves the least scatter of what each lag says, weighted by how far it is over
    // errors.
    [[nodiscard]] double fitting_exponent(const SecondDifferences& found, double cell_m) const;
    [[nodiscard]] double squared_roughness(const SecondDifferences& found) const;
    void estimate_roughness();
    // To posts, from the middles of blocks.
    void spread_roughness(const std::vector<double>& squares, int block_rows, int block_columns);
    Result<void> make_weights();
    void guess();
    // Of a run, the places that are `down` and `right` pieces from its posts: calls with the number in a
    // realisation of the first of them, how many there are, and their weights.
    template <class Each>
    void places_of(const Run& run, const Each& each) const;
    [[nodiscard]] int realised_rows() const { return (rows_ - 1) * finer_ + 1; }
    [[nodiscard]] int realised_columns() const { return (columns_ - 1) * finer_ + 1; }
    // Whether the cell of a place between posts has a void one.
    [[nodiscard]] bool is_void_at(int row, int column) const;
    [[nodiscard]] std::size_t wide_number(int row, int column) const;
    [[nodiscard]] float weighted(const std::vector<float>& values, const std::vector<float>& weights, int row,
                                 int column) const;
    [[nodiscard]] HeightField with_heights(const std::vector<float>& H_m) const;

    HeightField frame_;  // what realisations are copies of; of a grid on a net with all data
    int first_row_{}, first_column_{};
    int rows_{}, columns_{};  // of the part
    int wide_columns_{};      // of the part with the reach of weights on each side
    double row_spacing_m_{}, column_spacing_m_{};
    ErrorNoise errors_;
    std::vector<NoiseBand> ground_;  // for a roughness of 1 m
    std::vector<float> data_m_;      // of the part and its reach; voids have the height of a neighbour
    std::vector<char> void_;         // of the part and its reach
    bool any_void_{};
    int finer_{1};
    NoisePlaces places_, error_places_;
    NoisePlaces finer_places_;  // of realisations; none where they are not finer
    GroundRoughness roughness_;
    std::vector<float> local_roughness_;  // of the part
    std::vector<std::vector<float>> weights_;
    std::vector<Run> runs_;
    std::vector<float> guess_m_;  // of the posts of realisations
};

}  // namespace oro
