#include "geo/sources/made_truth.h"

#include "core/made/made_heights.h"
#include "geo/sources/made_words.h"

namespace oro {

std::optional<MadeTruth> MadeTruth::of(std::span<const SourceReport> sources) {
    if (sources.size() != 1 || !is_made(sources.front().path)) return std::nullopt;
    const Result<MadeTerrain> made = made_terrain_of(sources.front().path);
    if (!made.ok()) return std::nullopt;
    return MadeTruth(made.value());
}

double MadeTruth::H_m(double lat_deg, double lon_deg) const {
    return made_height_m(made_, rule_, lat_deg, lon_deg);
}

}  // namespace oro
