#include "apps/commands/sight/seen_probability.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "apps/command_line/refusals.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/sight/observer.h"
#include "geo/places/geodesic.h"

namespace oro {
namespace {

// Each takes some 100 bytes.
constexpr std::size_t most_realised_posts = 20000000;
constexpr double usual_correlation_posts = 2.0;

// Source: T. Farr et al., The Shuttle Radar Topography Mission, Reviews of Geophysics 45, 2007, section 5:
// absolute height error at most 16 m (90 %).
constexpr double srtm_le90_m = 16.0;

Result<HeightErrors> errors_of(const RealisationOptions& options, const RegionGrid& grid) {
    double spacing_m = 0.0;
    for (const SourceReport& source : grid.sources) spacing_m = std::max(spacing_m, source.spacing_m);
    const std::optional<double> le90_m = options.le90_m ? options.le90_m : stated_le90_m(grid.sources);
    if (!le90_m)
        return refused(
            "--realisations", std::to_string(*options.count),
            "needs --accuracy METRES: how far off 90 % of the heights are at most. The data do not "
            "say it");
    if (!(spacing_m > 0.0)) spacing_m = 30.0;
    return HeightErrors{*le90_m / le90_of_deviation,
                        options.correlation_m.value_or(usual_correlation_posts * spacing_m)};
}

// The window, within one turn of a grid that goes round the Earth.
GridPart part_of(const ViewshedReport& report, const PostGrid& grid) {
    GridPart part = report.window;
    if (grid.wraps_longitude()) part.columns = std::min(part.columns, grid.columns());
    return part;
}

Geodetic over_ground(Geodetic point, const std::optional<double>& above_m, const TrueSurface& surface) {
    const std::optional<double> ground_h_m = surface.h_m(point.lat_deg, point.lon_deg);
    if (above_m && ground_h_m) point.h_m = *ground_h_m + *above_m;
    return point;
}

// Of the posts of a report's window in realisations.
class Counting {
  public:
    Counting(const ViewshedReport& report, const RealisedHeights& realised, const GridPart& part,
             const std::vector<std::optional<double>>& above_m)
        : report_(report),
          realised_(realised),
          part_(part),
          above_m_(above_m),
          seen_(report.window.count()) {}

    // Looks around in one realisation.
    void add(std::uint32_t seed) {
        const HeightField field = realised_.realisation(seed);
        const TrueSurface surface(field, 1.0, 1);
        std::vector<char> seen(seen_.size());
        const ViewshedQuestion& question = report_.question;
        for (std::size_t i = 0; i < question.eyes.size(); ++i) {
            const Geodetic eye = over_ground(question.eyes[i], above_m_[i], surface);
            take_in(
                viewshed(surface, 0,
                         {eye, question.air, question.target_m, question.radius_km * 1000.0, 1, {}, nullptr}),
                seen);
        }
        const std::lock_guard lock(mutex_);
        for (std::size_t i = 0; i < seen.size(); ++i) seen_[i] += static_cast<unsigned char>(seen[i]);
    }

    [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return seen_; }

  private:
    void take_in(const Viewshed& shed, std::vector<char>& seen) const {
        const GridPart& window = shed.window;
        for (int row = window.first_row; row < window.first_row + window.rows; ++row) {
            for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
                if (shed.clearance_deficit_m[window.number(row, column)] != 0.0F) continue;
                int of_row = row - realised_.first_row(), of_column = column - realised_.first_column();
                if (of_row % realised_.finer() != 0 || of_column % realised_.finer() != 0) continue;
                of_row /= realised_.finer();
                of_column /= realised_.finer();
                if (of_row < 0 || of_row >= part_.rows || of_column < 0 || of_column >= part_.columns)
                    continue;
                seen[static_cast<std::size_t>(of_row) * static_cast<std::size_t>(report_.window.columns) +
                     static_cast<std::size_t>(of_column)] = 1;
            }
        }
    }

    const ViewshedReport& report_;
    const RealisedHeights& realised_;
    const GridPart part_;
    const std::vector<std::optional<double>>& above_m_;
    std::vector<std::uint32_t> seen_;
    std::mutex mutex_;
};

void sum_up(const ViewshedReport& report, const std::vector<std::uint32_t>& seen, SeenProbability& found) {
    found.share.assign(seen.size(), Viewshed::unknown);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (report.count[i] == Viewshed::unknown) continue;
        const double share = static_cast<double>(seen[i]) / found.made.realisations;
        found.share[i] = static_cast<float>(share);
        found.expected += share;
        found.uncertain += share >= 0.1 && share <= 0.9;
    }
}

Result<void> check_ground(const RealisationOptions& options, const Region& region, bool has_canopy) {
    const std::string count = std::to_string(*options.count);
    if (has_canopy) return refused("--realisations", count, "takes no canopy");
    if (region.meshes) return refused("--realisations", count, "takes no meshes");
    if (region.grids.size() > 1)
        return refused("--realisations", count,
                       "takes data of one grid, not of several that lie over each other");
    return {};
}

Result<RealisedHeights> realised_part(const RealisationOptions& options, const RegionGrid& grid,
                                      const GridPart& part, Simulations& made) {
    const int finer = options.finer.value_or(1);
    if (finer > 1 && grid.field.grid.net)
        return refused("--finer", std::to_string(finer),
                       "takes data on latitudes and longitudes, not in a CRS of their own");
    const std::size_t posts = part.count() * static_cast<std::size_t>(finer * finer);
    if (posts > most_realised_posts)
        return refused("--realisations", std::to_string(*options.count),
                       "takes at most " + grouped(most_realised_posts) + " posts, not " + grouped(posts) +
                           ": give what is less far");
    ORO_TRY(made.errors, errors_of(options, grid));
    made.realisations = *options.count;
    made.seed = options.seed.value_or(1);
    made.le90_m = made.errors.deviation_m * le90_of_deviation;
    ORO_TRY(RealisedHeights realised, RealisedHeights::create(grid.field, part, made.errors, finer));
    made.roughness = realised.roughness();
    made.finer = finer;
    return realised;
}

// Calls look(seed) once for each realisation, of seeds that follow from the asked one.
template <class Look>
void look_in_each(const Simulations& made, const ViewshedProgress& progress, const Look& look,
                  const std::stop_token& stop = {}) {
    std::atomic<int> done{0};
    std::mutex telling;
    in_parallel(made.realisations, thread_count(), [&](int i) {
        if (stop.stop_requested()) return;
        look(static_cast<std::uint32_t>(made.seed) * 100003U + static_cast<std::uint32_t>(i));
        const int now = ++done;
        const std::lock_guard lock(telling);
        if (progress) progress(static_cast<double>(now) / made.realisations);
    });
}

// The posts around a line, and some beyond.
Result<GridPart> part_around(const RealisationOptions& options, const SightEnds& ends, const PostGrid& grid) {
    constexpr int pieces = 200, beyond = 8;
    const GeodesicPath path =
        geodesic_between(ends.from.lat_deg, ends.from.lon_deg, ends.to.lat_deg, ends.to.lon_deg);
    double first_row = grid.rows(), last_row = -1.0, first_column = 0.0, last_column = 0.0, before = 0.0;
    for (int i = 0; i <= pieces; ++i) {
        const auto there = geodesic_towards(ends.from.lat_deg, ends.from.lon_deg, path.bearing_deg,
                                            path.distance_m * i / pieces);
        PostNumber post = grid.post_at(there.lat_deg, there.lon_deg);
        if (grid.wraps_longitude() && i > 0) {
            const double turn = grid.columns() - 1.0;
            post.column = before + std::remainder(post.column - before, turn);
        }
        before = post.column;
        first_row = std::min(first_row, post.row);
        last_row = std::max(last_row, post.row);
        first_column = i == 0 ? post.column : std::min(first_column, post.column);
        last_column = i == 0 ? post.column : std::max(last_column, post.column);
    }
    GridPart part;
    part.first_row = std::max(0, static_cast<int>(std::floor(first_row)) - beyond);
    part.rows = std::min(grid.rows(), static_cast<int>(std::ceil(last_row)) + beyond) - part.first_row;
    part.first_column = static_cast<int>(std::floor(first_column)) - beyond;
    int end_column = static_cast<int>(std::ceil(last_column)) + beyond;
    if (!grid.wraps_longitude()) {
        part.first_column = std::max(0, part.first_column);
        end_column = std::min(grid.columns(), end_column);
    }
    part.columns = std::min(end_column - part.first_column, grid.columns());
    if (part.rows < 2 || part.columns < 2)
        return refused("--realisations", std::to_string(*options.count), "needs data under the line");
    return part;
}

std::string simulations_words(const Simulations& made) {
    char text[240], between[80] = "";
    if (made.finer > 1)
        std::snprintf(between, sizeof between, ", with the ground between posts (%d in place of 1 each way)",
                      made.finer);
    std::snprintf(text, sizeof text,
                  "%d realisations of heights with an error of %.4g m (90 %%), correlated over %.4g m%s",
                  made.realisations, made.le90_m, made.errors.correlation_m, between);
    return text;
}

nlohmann::ordered_json simulations_json(const Simulations& made) {
    return json_object("count", made.realisations, "seed", made.seed, "le90_m", made.le90_m, "correlation_m",
                       made.errors.correlation_m, "roughness_m", made.roughness.deviation_m,
                       "roughness_exponent", made.roughness.exponent, "finer", made.finer, "looking_s",
                       made.looking_s);
}

}  // namespace

Result<void> check_realisations(const RealisationOptions& options) {
    if (!options.count) {
        const char* const alone = options.le90_m          ? "--accuracy"
                                  : options.correlation_m ? "--correlation"
                                  : options.seed          ? "--seed"
                                  : options.finer         ? "--finer"
                                                          : nullptr;
        if (alone != nullptr) return refused(alone, "", "needs --realisations");
        return {};
    }
    if (options.le90_m && !(*options.le90_m >= 0.01 && *options.le90_m <= 1000.0))
        return refused("--accuracy", all_digits(*options.le90_m), between_words(0.01, 1000.0));
    if (options.correlation_m && !(*options.correlation_m >= 0.1 && *options.correlation_m <= 100000.0))
        return refused("--correlation", all_digits(*options.correlation_m), between_words(0.1, 100000.0));
    return {};
}

Result<SeenProbability> seen_probability(const RealisationOptions& options, const ViewshedReport& report,
                                         const SightGround& ground, const std::vector<Standing>& eyes,
                                         const ViewshedProgress& progress) {
    ORO_CHECK(check_ground(options, ground.region, ground.canopy != nullptr));
    std::vector<std::optional<double>> above_m;
    for (std::size_t i = 0; i < report.question.eyes.size(); ++i)
        above_m.push_back(keeps_height(eyes[i]) ? std::nullopt : ground.above_m(report.question.eyes[i]));
    return seen_probability(options, report, ground.region, *ground.grids, above_m, progress, {});
}

std::optional<double> stated_le90_m(std::span<const SourceReport> sources) {
    const bool srtm = !sources.empty() && std::ranges::none_of(sources, [](const SourceReport& source) {
        return source.format == SourceFormat::raster;
    });
    return srtm ? std::optional(srtm_le90_m) : std::nullopt;
}

Result<SeenProbability> seen_probability(const RealisationOptions& options, const ViewshedReport& report,
                                         const Region& region, const RegionGround& ground,
                                         const std::vector<std::optional<double>>& above_m,
                                         const ViewshedProgress& progress, const std::stop_token& stop) {
    ORO_CHECK(check_ground(options, region, region.grids.front().canopy.has_value()));
    const RegionGrid& grid = ground.grid(report.grid);
    SeenProbability found;
    const auto looking = Clock::now();
    const GridPart part = part_of(report, grid.field.grid);
    ORO_TRY(const RealisedHeights realised, realised_part(options, grid, part, found.made));
    Counting counting(report, realised, part, above_m);
    look_in_each(
        found.made, progress, [&](std::uint32_t seed) { counting.add(seed); }, stop);
    if (stop.stop_requested())
        return Error{ErrorKind::failed, "realisations", "nobody waits for them any more"};
    sum_up(report, counting.seen(), found);
    found.made.looking_s = seconds_since(looking);
    return found;
}

bool keeps_height(const Standing& standing) {
    if (standing.altitude_m) return true;
    const auto place = place_at(standing.place_option, standing.place);
    return place.ok() && place.value().height_m.has_value();
}

Result<SightProbability> sight_probability(const RealisationOptions& options, const SightEnds& ends,
                                           const Air& air, const SightGround& ground,
                                           const ViewshedProgress& progress) {
    ORO_CHECK(check_ground(options, ground.region, ground.canopy != nullptr));
    const RegionGrid& grid = ground.grids->grid(0);
    SightProbability found;
    const auto looking = Clock::now();
    ORO_TRY(const GridPart part, part_around(options, ends, grid.field.grid));
    ORO_TRY(const RealisedHeights realised, realised_part(options, grid, part, found.made));
    const std::optional<double> from_m = ends.from_keeps_height ? std::nullopt : ground.above_m(ends.from),
                                to_m = ends.to_keeps_height ? std::nullopt : ground.above_m(ends.to);
    std::atomic<int> seen{0};
    look_in_each(found.made, progress, [&](std::uint32_t seed) {
        const HeightField field = realised.realisation(seed);
        const TrueSurface surface(field, 1.0, 1);
        const Observer observer(surface, over_ground(ends.from, from_m, surface), air);
        if (observer.sees(over_ground(ends.to, to_m, surface))) ++seen;
    });
    const double count = found.made.realisations, likely = (seen + 1.0) / (count + 2.0);
    found.share = seen / count;
    found.standard_error = std::sqrt(likely * (1.0 - likely) / count);
    found.made.looking_s = seconds_since(looking);
    return found;
}

std::string probable_words(const SeenProbability& probability, std::size_t cells) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "Probable: %s posts expected to be seen, %.2f %%; %s of them uncertain (0.1 to 0.9). ",
                  grouped(static_cast<std::uint64_t>(probability.expected + 0.5)).c_str(),
                  100.0 * probability.expected / static_cast<double>(std::max<std::size_t>(1, cells)),
                  grouped(probability.uncertain).c_str());
    return text + simulations_words(probability.made);
}

std::string probable_words(const SightProbability& probability) {
    char text[120];
    std::snprintf(text, sizeof text, "Probability of being seen: %.3g, standard error %.2g. ",
                  probability.share, probability.standard_error);
    return text + simulations_words(probability.made);
}

nlohmann::ordered_json probability_json(const SeenProbability& probability) {
    nlohmann::ordered_json json = simulations_json(probability.made);
    json["expected_seen"] = probability.expected;
    json["uncertain"] = probability.uncertain;
    return json;
}

nlohmann::ordered_json probability_json(const SightProbability& probability) {
    nlohmann::ordered_json json = simulations_json(probability.made);
    json["probability"] = probability.share;
    json["standard_error"] = probability.standard_error;
    return json;
}

void add_probability(const SeenProbability& probability, PostRaster& raster) {
    raster.bands.push_back(
        {"probability of being seen, of " + std::to_string(probability.made.realisations) + " realisations",
         probability.share});
    raster.tags.emplace_back("REALISATIONS", std::to_string(probability.made.realisations));
    raster.tags.emplace_back("REALISATIONS_SEED", std::to_string(probability.made.seed));
    raster.tags.emplace_back("REALISATIONS_FINER", std::to_string(probability.made.finer));
    raster.tags.emplace_back("HEIGHT_ERROR_LE90_M", all_digits(probability.made.le90_m));
    raster.tags.emplace_back("HEIGHT_ERROR_CORRELATION_M", all_digits(probability.made.errors.correlation_m));
}

}  // namespace oro
