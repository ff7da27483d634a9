#include "geo/sources/undeclared_voids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

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
        for (const float height_m : heights_m) {
            if (is_void(height_m)) continue;
            lowest.add(height_m);
            highest.add(height_m);
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

Result<std::vector<float>> no_heights_of_file(const Source& source, const PostBlock& block, ReadPosts read) {
    HeightEnds ends;
    ORO_CHECK(for_all_posts(source, block, read, [&](const PostBlock& part) { ends.add(part.height_m); }));
    const std::vector<float> suspects = suspects_in(source, ends);
    if (suspects.empty()) return std::vector<float>();
    Cliffs cliffs;
    cliffs.of_suspect.resize(suspects.size());
    ORO_CHECK(for_all_posts(source, block, read,
                            [&](const PostBlock& part) { add_cliffs(suspects, part, cliffs); }));
    std::vector<float> no_heights;
    for (std::size_t i = 0; i < suspects.size(); ++i)
        if (is_no_height(suspects[i], cliffs.of_suspect[i], cliffs)) no_heights.push_back(suspects[i]);
    return no_heights;
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
    HeightEnds ends;
    ends.add(block.height_m);
    if (suspects_in(source, ends).empty()) return {};
    std::vector<float> no_heights;
    {
        UndeclaredVoids& found = *source.undeclared;
        const std::scoped_lock lock(found.mutex);
        if (!found.height_m) {
            ORO_TRY(found.height_m, no_heights_of_file(source, block, read));
        }
        no_heights = *found.height_m;
    }
    if (no_heights.empty()) return {};
    std::vector<std::uint64_t> posts(no_heights.size());
    HeightEnds left;
    for (float& height_m : block.height_m) {
        const auto which = std::ranges::find(no_heights, height_m);
        if (is_void(height_m) || which == no_heights.end()) continue;
        ++posts[static_cast<std::size_t>(which - no_heights.begin())];
        height_m = void_height_m;
        ++block.voids;
    }
    for (std::size_t i = 0; i < no_heights.size(); ++i)
        if (posts[i] > 0)
            add_count(block.values.undeclared, stored_of(source, no_heights[i]), posts[i], 2 * most_values);
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
