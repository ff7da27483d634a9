#include "geo/sources/undeclared_voids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>

#include "core/terrain/post_grid.h"
#include "geo/sources/row_scans.h"

namespace oro {
namespace {

constexpr std::size_t most_values = 4;   // distinct ones that are kept at either end of the heights
constexpr std::size_t most_counted = 9;  // distinct implausible ones that are counted by value
constexpr double least_cliff_m = 50.0;   // between a value that is no height and all others
constexpr double sea_floor_m = -500.0;   // no land lies so low: other heights below it are depths of the sea,
constexpr double least_sea_cliff_m = 1000.0;  // among which only this is a cliff

// The few lowest, or highest, distinct heights of a file. Heights are kept with the sign that makes them
// lowest.
class Ends {
  public:
    explicit Ends(float sign) : sign_(sign) {}
    void add(float height_m) {
        const float value = sign_ * height_m;
        if (count_ == most_values && value >= last_) return;
        auto* const end = values_.begin() + count_;
        auto* const at = std::lower_bound(values_.begin(), end, value);
        if (at != end && *at == value) return;
        if (count_ < most_values) ++count_;
        std::move_backward(at, values_.begin() + count_ - 1, values_.begin() + count_);
        *at = value;
        last_ = values_[count_ - 1];
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] float at(std::size_t i) const { return sign_ * values_[i]; }

  private:
    float sign_;
    std::size_t count_{0};
    float last_{0.0F};
    std::array<float, most_values> values_{};
};

struct HeightEnds {
    Ends lowest{1.0F};
    Ends highest{-1.0F};
    void add(std::span<const float> heights_m) {
        constexpr std::size_t piece = 1024;
        for (std::size_t first = 0; first < heights_m.size(); first += piece) {
            const auto part = heights_m.subspan(first, std::min(piece, heights_m.size() - first));
            // Nearly everywhere nothing is lower than the lowest few.
            if (lowest.count() == most_values && highest.count() == most_values &&
                !any_beyond(part, lowest.at(most_values - 1), highest.at(most_values - 1)))
                continue;
            for (const float height_m : part) {
                if (is_void(height_m)) continue;
                lowest.add(height_m);
                highest.add(height_m);
            }
        }
    }
};

double stored_of(const Source& source, float height_m) {
    return (static_cast<double>(height_m) - source.offset_m) / source.scale_m;
}

// Where a file holds nothing else: no plain lies at such a height.
bool is_no_plain(double stored) {
    return stored < -9000.0 || stored > 30000.0;
}

// Those values at one end that read like no data, up to the last one that is followed by a cliff.
void add_suspects(const Source& source, const Ends& ends, std::vector<float>& suspects) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < ends.count() && i + 1 < most_values; ++i) {
        const double stored = stored_of(source, ends.at(i));
        if (!reads_like_no_data(stored)) break;
        const bool is_apart = i + 1 == ends.count()
                                  ? is_no_plain(stored)
                                  : std::abs(static_cast<double>(ends.at(i + 1)) -
                                             static_cast<double>(ends.at(i))) >= least_cliff_m;
        if (is_apart) found = i + 1;
    }
    for (std::size_t i = 0; i < found; ++i)
        if (std::ranges::find(suspects, ends.at(i)) == suspects.end()) suspects.push_back(ends.at(i));
}

std::vector<float> suspects_in(const Source& source, const HeightEnds& ends) {
    std::vector<float> suspects;
    add_suspects(source, ends.lowest, suspects);
    add_suspects(source, ends.highest, suspects);
    return suspects;
}

// Steps between neighbouring posts by their size, in quarters of an octave from 1 mm.
class Steps {
  public:
    void add(double step_m) {
        const double octave = step_m > 1e-3 ? std::log2(step_m / 1e-3) : 0.0;
        ++steps_[static_cast<std::size_t>(std::min(4.0 * octave, static_cast<double>(steps_.size() - 1)))];
        ++count_;
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    // The step that a share of all is no larger than, to a quarter of an octave; 0 where there is none.
    [[nodiscard]] double at_share(double share) const {
        const double wanted = share * static_cast<double>(count_);
        double seen = 0.0;
        for (std::size_t i = 0; count_ > 0 && i < steps_.size(); ++i) {
            seen += static_cast<double>(steps_[i]);
            if (seen >= wanted && steps_[i] > 0)
                return i == 0 ? 0.0 : 1e-3 * std::exp2(static_cast<double>(i) / 4.0);
        }
        return 0.0;
    }

  private:
    std::array<std::uint64_t, 120> steps_{};
    std::uint64_t count_{0};
};

// What a whole file shows of one suspect: steps at its rim.
struct Cliffs {
    std::vector<Steps> of_suspect;  // between it and heights
    Steps of_others;                // between heights
    float lowest_m{std::numeric_limits<float>::max()};
    float highest_m{std::numeric_limits<float>::lowest()};
};

void add_step(std::span<const float> suspects, float a, float b, Cliffs& cliffs) {
    if (is_void(a) || is_void(b)) return;
    const auto of = [&](float height) { return std::ranges::find(suspects, height) - suspects.begin(); };
    const auto none = static_cast<std::ptrdiff_t>(suspects.size());
    const auto first = of(a), second = of(b);
    const double step_m = std::abs(static_cast<double>(a) - static_cast<double>(b));
    if (first == none && second == none) cliffs.of_others.add(step_m);
    if ((first == none) == (second == none)) return;
    cliffs.of_suspect[static_cast<std::size_t>(first == none ? second : first)].add(step_m);
}

void add_cliffs(std::span<const float> suspects, const PostBlock& block, Cliffs& cliffs) {
    const auto columns = static_cast<std::size_t>(block.window.columns);
    for (std::size_t post = 0; post < block.height_m.size(); ++post) {
        const float height_m = block.height_m[post];
        if (is_void(height_m)) continue;
        if (std::ranges::find(suspects, height_m) == suspects.end()) {
            cliffs.lowest_m = std::min(cliffs.lowest_m, height_m);
            cliffs.highest_m = std::max(cliffs.highest_m, height_m);
        }
        if ((post + 1) % columns != 0) add_step(suspects, height_m, block.height_m[post + 1], cliffs);
        if (post + columns < block.height_m.size())
            add_step(suspects, height_m, block.height_m[post + columns], cliffs);
    }
}

// The verdict, from the whole file.
bool is_no_height(float suspect_m, const Steps& rim, const Cliffs& cliffs) {
    if (cliffs.lowest_m > cliffs.highest_m) return true;  // the file holds nothing else
    const auto value_m = static_cast<double>(suspect_m);
    const double apart_m = std::max(static_cast<double>(cliffs.lowest_m) - value_m,
                                    value_m - static_cast<double>(cliffs.highest_m));
    if (apart_m < least_cliff_m) return false;
    if (rim.count() == 0) return apart_m >= least_sea_cliff_m;  // all around it is void
    const bool has_depths = static_cast<double>(cliffs.lowest_m) < sea_floor_m;
    return rim.at_share(0.05) >=
           std::max(has_depths ? least_sea_cliff_m : least_cliff_m, 2.0 * cliffs.of_others.at_share(0.999));
}

constexpr std::uint64_t least_posts = 9;      // that hold a value for it to be a code of any digits
constexpr double code_spread_m = 8.0;         // by lossy packing values of one code lie so near each other
constexpr double least_zero_cliff_m = 100.0;  // what is filled with 0 lies so far below all heights
constexpr std::uint64_t most_zeros_a_height = 20;  // more of them are the sea around a rock
constexpr std::uint64_t least_terrain_steps = 30;  // between heights that a code leaves

// A pair of neighbours with a larger step lies in a rim, not in terrain: a slope of 63 degrees.
double calm_step_m(const Source& source) {
    return std::clamp(2.0 * source.report.spacing_m, least_cliff_m, least_sea_cliff_m);
}

// True near a number that reads like no data, as lossy packing leaves it.
bool is_near_code(double stored) {
    if (reads_like_no_data(stored)) return true;
    if (std::abs(stored) < 900.0) return false;
    const double whole = std::round(stored);
    for (const double step : {0.0, -1.0, 1.0, -2.0, 2.0})
        if (reads_like_no_data(whole + step)) return true;
    return false;
}

// Some consecutive heights of a file, with nothing near them.
struct Level {
    double first_m{}, end_m{};
    std::uint64_t posts{};
    double code_m{};  // the height that most of them have
};

// A cut of a file's heights: those below it are none.
struct Cut {
    double below_m{};
    double gap_m{};   // between it and the highest value below it that holds many posts
    double code_m{};  // that value
    bool is_blurred{};
    bool is_zero{};
};

// How often each height comes, by whole metres; with a sign of -1 all heights are turned round, so that the
// highest come first. Calm posts have no rim beside them.
class Survey {
  public:
    explicit Survey(double sign)
        : sign_(sign), base_m_(sign > 0.0 ? lowest_plausible_m : -highest_plausible_m) {}
    void add(float height_m, bool is_calm) {
        ++(is_calm ? calm_ : all_)[bin_of(sign_ * static_cast<double>(height_m))];
    }
    // Once all heights are added.
    void end() {
        for (std::size_t bin = 0; bin < bins; ++bin) all_[bin] += calm_[bin];
    }
    void add_plateau(float height_m) {
        constexpr std::size_t most = 1U << 16U;
        const float value = static_cast<float>(sign_) * height_m;
        const auto known = plateaus_.find(value);
        if (known != plateaus_.end())
            ++known->second;
        else if (plateaus_.size() < most)
            plateaus_.emplace(value, 1);
    }
    // Posts that no terrain has, which hold a code.
    void add_beyond(const PostBlock& block) {
        for (const StoredCount& count : block.values.implausible)
            if (sign_ * count.value < 0.0 && reads_like_no_data(count.value)) {
                beyond_ += count.posts;
                beyond_stored_ = count.value;
            }
    }
    [[nodiscard]] std::vector<Cut> cuts(const Source& source) const {
        std::vector<Cut> found = cuts_between(source, levels_of(all_, least_cliff_m), false);
        const double rim_m = calm_step_m(source);
        for (const Cut& cut : cuts_between(source, levels_of(calm_, rim_m), true))
            if (posts_between(cut.code_m + code_spread_m, cut.below_m - rim_m) >= least_posts)
                found.push_back(cut);
        return found;
    }

  private:
    static constexpr std::size_t bins = 21002;
    double sign_, base_m_;
    std::vector<std::uint64_t> all_ = std::vector<std::uint64_t>(bins);  // before end(): those not calm
    std::vector<std::uint64_t> calm_ = std::vector<std::uint64_t>(bins);
    std::map<float, std::uint64_t> plateaus_;
    std::uint64_t beyond_{};
    double beyond_stored_{};

    // The whole metre, without a call: above 0 a conversion rounds down.
    [[nodiscard]] std::size_t bin_of(double value_m) const {
        const double bin = value_m - base_m_;
        if (!(bin > 0.0)) return 0;
        return bin < static_cast<double>(bins - 1) ? static_cast<std::size_t>(bin) : bins - 1;
    }
    [[nodiscard]] std::uint64_t posts_between(double from_m, double to_m) const {
        std::uint64_t posts = 0;
        for (std::size_t bin = bin_of(from_m); bin < bin_of(to_m); ++bin) posts += all_[bin];
        return posts;
    }
    [[nodiscard]] std::vector<Level> levels_of(const std::vector<std::uint64_t>& posts, double gap_m) const {
        std::vector<Level> levels;
        std::uint64_t most = 0;
        for (std::size_t bin = 0; bin < bins; ++bin) {
            if (posts[bin] == 0) continue;
            const double at_m = base_m_ + static_cast<double>(bin);
            if (levels.empty() || at_m - levels.back().end_m >= gap_m) {
                levels.push_back({at_m, at_m, 0, at_m});
                most = 0;
            }
            Level& level = levels.back();
            level.end_m = at_m + 1.0;
            level.posts += posts[bin];
            if (posts[bin] <= most) continue;
            most = posts[bin];
            level.code_m = at_m;
        }
        return levels;
    }
    // The value that most squares of 2 x 2 posts of a level hold, and how many.
    [[nodiscard]] std::pair<float, std::uint64_t> plateau_of(const Level& level) const {
        std::pair<float, std::uint64_t> found{static_cast<float>(level.code_m), 0};
        for (auto at = plateaus_.lower_bound(static_cast<float>(level.first_m));
             at != plateaus_.end() && static_cast<double>(at->first) < level.end_m; ++at)
            if (at->second > found.second) found = *at;
        return found;
    }
    // The cut above a level, if all that speaks for a code is there.
    [[nodiscard]] std::optional<Cut> cut_above(const Source& source, const Level& level, const Level& next,
                                               const std::vector<std::uint64_t>& posts,
                                               bool is_blurred) const {
        const auto [plateau, squares] = plateau_of(level);
        const double code = static_cast<double>(plateau);
        std::uint64_t core = 0;
        for (std::size_t bin = bin_of(code - code_spread_m); bin <= bin_of(code + code_spread_m); ++bin)
            core += posts[bin];
        if (core < least_posts || 2 * core < level.posts) return std::nullopt;
        const double stored = stored_of(source, static_cast<float>(sign_ * code));
        const double gap_m = next.first_m - level.end_m;
        const bool is_plateau = squares >= 4 && 5 * squares >= level.posts;
        const Cut cut{next.first_m, next.first_m - code, code, is_blurred, stored == 0.0};
        if (sign_ > 0.0 && next.first_m < sea_floor_m && gap_m < least_sea_cliff_m) return std::nullopt;
        if (cut.is_zero)
            return sign_ > 0.0 && is_plateau && code == 0.0 && cut.gap_m >= least_zero_cliff_m &&
                           level.posts <= most_zeros_a_height * (posts_between(next.first_m, -base_m_) + 1)
                       ? std::optional(cut)
                       : std::nullopt;
        if (sign_ * stored > 0.0) return std::nullopt;
        if (is_near_code(stored)) return cut;
        const bool is_depth = sign_ > 0.0 && stored <= -50.0 && stored == std::floor(stored);
        const double least_m = sign_ < 0.0 ? least_sea_cliff_m : is_depth ? 80.0 : 200.0;
        return is_plateau && gap_m >= least_m ? std::optional(cut) : std::nullopt;
    }
    // One cut above each code, from the lowest on. A few stray posts of blurred rims between a code and the
    // terrain go with it.
    [[nodiscard]] std::vector<Cut> cuts_between(const Source& source, const std::vector<Level>& levels,
                                                bool is_blurred) const {
        std::vector<Cut> found;
        std::uint64_t code_posts = 0;
        if (is_blurred && beyond_ >= least_posts && !levels.empty()) {
            found.push_back(
                {levels[0].first_m, levels[0].first_m - base_m_, sign_ * beyond_stored_, true, false});
            code_posts = beyond_;
        }
        for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
            const Level& level = levels[i];
            const Level& next = levels[i + 1];
            const auto cut = cut_above(source, level, next, is_blurred ? calm_ : all_, is_blurred);
            if (cut && !(cut->is_zero && is_blurred && found.empty())) {
                found.push_back(*cut);
                code_posts = level.posts;
                continue;
            }
            const bool is_stray = is_blurred && !found.empty() && 10 * level.posts <= next.posts &&
                                  level.posts < std::max(least_posts, code_posts / 1000);
            if (!is_stray) break;
            found.back().gap_m += next.first_m - found.back().below_m;
            found.back().below_m = next.first_m;
        }
        return found;
    }
};

struct Surveys {
    HeightEnds ends;
    Survey low{1.0};
    Survey high{-1.0};
};

// The largest step between a post and its four neighbours.
double step_to_neighbours_m(const PostBlock& block, std::size_t post, std::size_t columns) {
    double largest_m = 0.0;
    const float height_m = block.height_m[post];
    const auto look = [&](std::size_t other) {
        if (!is_void(block.height_m[other]))
            largest_m = std::max(largest_m, std::abs(static_cast<double>(block.height_m[other]) -
                                                     static_cast<double>(height_m)));
    };
    if (post % columns != 0) look(post - 1);
    if ((post + 1) % columns != 0) look(post + 1);
    if (post >= columns) look(post - columns);
    if (post + columns < block.height_m.size()) look(post + columns);
    return largest_m;
}

// Which posts of a row may be so far from a neighbour: all that are, and few others.
void mark_near_steps(const PostBlock& block, std::size_t row, std::size_t columns, double step_m,
                     std::vector<unsigned char>& marks) {
    const std::span all(block.height_m);
    const std::span heights = all.subspan(row * columns, columns);
    const auto least_m = static_cast<float>(step_m);
    const std::span marked(marks);
    std::ranges::fill(marked, static_cast<unsigned char>(0));
    mark_steps(heights.first(columns - 1), heights.last(columns - 1), least_m, marked.first(columns - 1));
    mark_steps(heights.last(columns - 1), heights.first(columns - 1), least_m, marked.last(columns - 1));
    if (row > 0) mark_steps(heights, all.subspan((row - 1) * columns, columns), least_m, marked);
    if ((row + 2) * columns <= all.size())
        mark_steps(heights, all.subspan((row + 1) * columns, columns), least_m, marked);
}

// True where two neighbours anywhere may be so far apart.
bool has_near_step(const PostBlock& block, double step_m) {
    const auto columns = static_cast<std::size_t>(block.window.columns);
    const std::span all(block.height_m);
    const auto least_m = static_cast<float>(step_m);
    for (std::size_t first = 0; columns > 0 && first + columns <= all.size(); first += columns) {
        const std::span heights = all.subspan(first, columns);
        if (any_step(heights.first(columns - 1), heights.last(columns - 1), least_m)) return true;
        if (first + 2 * columns <= all.size() &&
            any_step(heights, all.subspan(first + columns, columns), least_m))
            return true;
    }
    return false;
}

void add_to_surveys(const PostBlock& block, double rim_m, Surveys& surveys) {
    const auto columns = static_cast<std::size_t>(block.window.columns);
    surveys.ends.add(block.height_m);
    surveys.low.add_beyond(block);
    surveys.high.add_beyond(block);
    std::vector<unsigned char> marks(columns);
    const std::size_t posts = block.height_m.size();
    for (std::size_t first = 0; first < posts; first += columns) {
        mark_near_steps(block, first / columns, columns, rim_m, marks);
        const float* const here_m = block.height_m.data() + first;
        const float* const below_m = first + columns < posts ? here_m + columns : nullptr;
        for (std::size_t i = 0; i < columns; ++i) {
            const float height_m = here_m[i];
            if (is_void(height_m)) continue;
            const bool is_calm = marks[i] == 0 || step_to_neighbours_m(block, first + i, columns) < rim_m;
            surveys.low.add(height_m, is_calm);
            surveys.high.add(height_m, is_calm);
            // A square of four posts that have one height.
            if (below_m != nullptr && i + 1 < columns && here_m[i + 1] == height_m &&
                below_m[i] == height_m && below_m[i + 1] == height_m) {
                surveys.low.add_plateau(height_m);
                surveys.high.add_plateau(height_m);
            }
        }
    }
}

// A cut with the steps between the heights that it leaves.
struct CutSteps {
    double sign{};
    Cut cut;
    Steps steps;
    void add(float a, float b) {
        const double first_m = sign * static_cast<double>(a), second_m = sign * static_cast<double>(b);
        if (!is_void(a) && !is_void(b) && std::min(first_m, second_m) >= cut.below_m)
            steps.add(std::abs(first_m - second_m));
    }
    // True where the step down to the code is far larger than those of terrain.
    [[nodiscard]] bool holds() const {
        const double usual_m = steps.at_share(cut.is_blurred ? 0.99 : cut.is_zero ? 0.9999 : 0.999);
        return steps.count() >= least_terrain_steps && cut.gap_m >= 2.0 * usual_m;
    }
};

void add_cut_steps(const PostBlock& block, std::vector<CutSteps>& cuts) {
    const auto columns = static_cast<std::size_t>(block.window.columns);
    for (std::size_t post = 0; post < block.height_m.size(); ++post)
        for (CutSteps& cut : cuts) {
            if ((post + 1) % columns != 0) cut.add(block.height_m[post], block.height_m[post + 1]);
            if (post + columns < block.height_m.size())
                cut.add(block.height_m[post], block.height_m[post + columns]);
        }
}

using ReadPosts = Result<PostBlock> (*)(const Source&, const PostWindow&);

// All posts of a file, in strips that fit memory.
template <class Use>
Result<void> for_all_posts(const Source& source, const PostBlock& block, ReadPosts read, const Use& use) {
    const int all_rows = source.on_degrees ? source.lat_axis.count : source.report.rows;
    const int columns = source.on_degrees ? source.lon_axis.count : source.report.columns;
    if (block.window.rows == all_rows && block.window.columns == columns) {
        use(block);
        return {};
    }
    constexpr int posts_a_strip = 1 << 25;
    const int strip = std::clamp(posts_a_strip / std::max(1, columns), 2, all_rows);
    for (int row = 0; row < all_rows; row += strip) {
        ORO_TRY(const PostBlock part, read(source, {row, 0, std::min(strip, all_rows - row), columns}));
        use(part);
    }
    return {};
}

std::optional<NoHeights> range_of(const std::vector<NoHeights>& ranges, float height_m) {
    const auto found = std::ranges::find_if(ranges, [&](const NoHeights& range) {
        return height_m >= range.first_m && height_m <= range.last_m;
    });
    return found != ranges.end() ? std::optional(*found) : std::nullopt;
}

// All heights beyond a cut, on the side where its code lies.
NoHeights beyond(const CutSteps& found) {
    constexpr float farthest_m = 1e30F;
    const float last_m = std::nextafter(static_cast<float>(found.cut.below_m), -farthest_m);
    const auto code_m = static_cast<float>(found.sign * found.cut.code_m);
    return found.sign > 0.0 ? NoHeights{-farthest_m, last_m, code_m} : NoHeights{-last_m, farthest_m, code_m};
}

Result<std::vector<NoHeights>> no_heights_of_file(const Source& source, const PostBlock& block,
                                                  ReadPosts read) {
    Surveys surveys;
    const double rim_m = calm_step_m(source);
    ORO_CHECK(for_all_posts(source, block, read,
                            [&](const PostBlock& part) { add_to_surveys(part, rim_m, surveys); }));
    surveys.low.end();
    surveys.high.end();
    const std::vector<float> suspects = suspects_in(source, surveys.ends);
    std::vector<CutSteps> cuts;
    for (const Cut& cut : surveys.low.cuts(source)) cuts.push_back({1.0, cut, {}});
    for (const Cut& cut : surveys.high.cuts(source)) cuts.push_back({-1.0, cut, {}});
    if (suspects.empty() && cuts.empty()) return std::vector<NoHeights>();
    Cliffs cliffs;
    cliffs.of_suspect.resize(suspects.size());
    ORO_CHECK(for_all_posts(source, block, read, [&](const PostBlock& part) {
        add_cliffs(suspects, part, cliffs);
        add_cut_steps(part, cuts);
    }));
    std::vector<NoHeights> no_heights;
    for (std::size_t i = 0; i < suspects.size(); ++i)
        if (is_no_height(suspects[i], cliffs.of_suspect[i], cliffs))
            no_heights.push_back({suspects[i], suspects[i], suspects[i]});
    for (const CutSteps& cut : cuts)
        if (cut.holds()) no_heights.push_back(beyond(cut));
    return no_heights;
}

// What a post without a height is counted as: its code, or blurred_value.
double counted_value(const Source& source, float height_m, const NoHeights& range) {
    const double stored = stored_of(source, height_m);
    if (reads_like_no_data(stored) && stored == std::floor(stored)) return stored;
    const double off_m = static_cast<double>(height_m) - static_cast<double>(range.code_m);
    return std::abs(off_m) <= code_spread_m ? stored_of(source, range.code_m) : blurred_value;
}

// True where a block may hold a value that is no height in its whole file.
bool is_suspicious(const Source& source, const PostBlock& block) {
    HeightEnds ends;
    ends.add(block.height_m);
    if (!suspects_in(source, ends).empty()) return true;
    const std::size_t count = ends.lowest.count();
    if (count == 0) return false;
    const auto lowest_m = static_cast<double>(ends.lowest.at(0));
    if (is_near_code(stored_of(source, ends.lowest.at(0))) && lowest_m < 0.0) return true;
    constexpr double few_posts = 1 << 24;  // of a small file all are looked at for the sake of a flat part
    if (count == 1 &&
        (lowest_m < 0.0 ||
         (lowest_m == 0.0 && static_cast<double>(source.report.rows) * source.report.columns <= few_posts)))
        return true;
    for (const Ends* const end : {&ends.lowest, &ends.highest})
        for (std::size_t i = 0; i + 1 < end->count(); ++i)
            if (std::abs(static_cast<double>(end->at(i + 1)) - static_cast<double>(end->at(i))) >=
                least_cliff_m)
                return true;
    const auto columns = static_cast<std::size_t>(block.window.columns);
    const double step_m = std::clamp(steep_m_per_m * source.report.spacing_m, 150.0, least_sea_cliff_m);
    if (!has_near_step(block, step_m)) return false;
    for (std::size_t post = 0; post < block.height_m.size(); ++post)
        if (!is_void(block.height_m[post]) && step_to_neighbours_m(block, post, columns) >= step_m)
            return true;
    return false;
}

void add_count(std::vector<StoredCount>& counts, double value, std::uint64_t posts, std::size_t most) {
    const auto known = std::ranges::find(counts, value, &StoredCount::value);
    if (known != counts.end())
        known->posts += posts;
    else if (counts.size() < most)
        counts.push_back({value, posts});
}

}  // namespace

bool reads_like_no_data(double stored) {
    const double size = std::abs(stored);
    // Of positive numbers only those that are higher than any terrain in metres.
    if (stored > 0.0 && stored < 9990.0) return false;
    const auto near = [&](double value) { return std::abs(size - value) <= 1e-6 * value; };
    for (double power = 1e3; power <= 1e12; power *= 10.0)
        if (size >= power - 1.0 - 1e-6 * power && size < power * (1.0 - 1e-9)) return true;
    constexpr std::array known{99.0,    99.9,    99.99,        998.0,        9998.0,
                               9997.0,  32768.0, 32767.0,      32766.0,      32678.0,
                               65535.0, 65534.0, 2147483648.0, 2147483647.0, 4294967295.0};
    if (std::ranges::any_of(known, near)) return true;
    for (double power = 1e5; power <= 1e300; power *= 10.0)
        if (near(power)) return true;
    return size >= 3.4e38;
}

void ValueFindings::add(const ValueFindings& part) {
    for (const StoredCount& count : part.undeclared)
        add_count(undeclared, count.value, count.posts, 2 * most_values);
    for (const StoredCount& count : part.implausible)
        add_count(implausible, count.value, count.posts, most_counted);
    implausible_posts += part.implausible_posts;
    read += part.read;
    unwritten += part.unwritten;
    pairs += part.pairs;
    steep += part.steep;
    lowest_stored_m = std::min(lowest_stored_m, part.lowest_stored_m);
    highest_stored_m = std::max(highest_stored_m, part.highest_stored_m);
}

void count_implausible(PostBlock& block, double stored) {
    ++block.implausible;
    ++block.values.implausible_posts;
    add_count(block.values.implausible, stored, 1, most_counted);
}

Result<void> take_out_undeclared(const Source& source, PostBlock& block, ReadPosts read) {
    if (!is_suspicious(source, block)) return {};
    std::vector<NoHeights> no_heights;
    {
        UndeclaredVoids& found = *source.undeclared;
        const std::scoped_lock lock(found.mutex);
        if (!found.ranges) {
            ORO_TRY(found.ranges, no_heights_of_file(source, block, read));
        }
        no_heights = *found.ranges;
    }
    if (no_heights.empty()) return {};
    HeightEnds left;
    for (float& height_m : block.height_m) {
        if (is_void(height_m)) continue;
        const auto range = range_of(no_heights, height_m);
        if (!range) continue;
        add_count(block.values.undeclared, counted_value(source, height_m, *range), 1, 2 * most_values);
        height_m = void_height_m;
        ++block.voids;
    }
    // What stands for no height is no stored height, unless no terrain has it, either.
    left.add(block.height_m);
    if (block.values.implausible_posts > 0) return {};
    block.lowest_stored_m = std::numeric_limits<double>::infinity();
    block.highest_stored_m = -block.lowest_stored_m;
    if (left.lowest.count() == 0) return {};
    block.lowest_stored_m = static_cast<double>(left.lowest.at(0));
    block.highest_stored_m = static_cast<double>(left.highest.at(0));
    return {};
}

void measure_steepness(const Source& source, PostBlock& block) {
    constexpr std::size_t most_pairs = 4096;
    const auto columns = static_cast<std::size_t>(block.window.columns);
    if (block.window.rows < 2 || source.report.spacing_m <= 0.0) return;
    const std::size_t pairs = block.height_m.size() - columns;
    const std::size_t stride = std::max<std::size_t>(1, pairs / most_pairs);
    const double limit_m = steep_m_per_m * source.report.spacing_m;
    for (std::size_t post = 0; post < pairs; post += stride) {
        const float here_m = block.height_m[post], below_m = block.height_m[post + columns];
        if (is_void(here_m) || is_void(below_m)) continue;
        ++block.values.pairs;
        if (std::abs(static_cast<double>(here_m) - static_cast<double>(below_m)) > limit_m)
            ++block.values.steep;
    }
}

std::string value_words(double value) {
    char text[40];
    if (value == std::floor(value) && std::abs(value) < 1e10) {
        std::snprintf(text, sizeof text, "%.0f", value);
        return text;
    }
    // Without a float's digits beyond those that were meant: -9999.99023.
    std::snprintf(text, sizeof text, "%.6g", value);
    double meant = 0.0;
    std::sscanf(text, "%lf", &meant);
    if (static_cast<float>(meant) != static_cast<float>(value))
        std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace oro
