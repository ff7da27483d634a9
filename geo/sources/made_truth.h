// What lies between the posts of made terrain: its rule, asked anywhere.
#pragma once

#include <optional>
#include <span>

#include "core/made/made_rule.h"
#include "geo/sources/source_report.h"

namespace oro {

// The truth of data that one made: source stands for. Safe to ask from several threads.
class MadeTruth {
  public:
    // Nothing where the data are not of made terrain alone, or of several: each has its own rule.
    static std::optional<MadeTruth> of(std::span<const SourceReport> sources);

    // H by the rule at a place, as made_height_m(): metres, latitude -90 to 90. At a post that is the post's
    // height to 2^-11 m.
    [[nodiscard]] double H_m(double lat_deg, double lon_deg) const;

  private:
    explicit MadeTruth(const MadeTerrain& made) : made_(made), rule_(made_rule(made)) {}

    MadeTerrain made_;
    gpu::MadeRule rule_;
};

}  // namespace oro
