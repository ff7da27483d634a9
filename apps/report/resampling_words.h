// What resampling did to a region, in words for people.
#pragma once

#include <string>

#include "geo/region/region.h"

namespace oro {

// "27.1 m off at 46.537110 8.126330 (own 2411.0 m, shown 2438.1 m), 1.77 m RMS, of all 407,537 posts": of one
// source, the worst, the root of the mean square, and how many posts that is known of.
std::string resampling_words(const Resampling& found);
// "4107.9 m at 46.537110 8.126330, shown as 4087.1 m"
std::string post_words(const PostShown& post);
// The whole region in a sentence, without its end; "" where no source was resampled or interpolated.
std::string resampling_sentence(const RegionGrid& grid);
// "Resampled: ..." with its line end, for what is measured against the region; "" likewise.
std::string resampling_line(const RegionGrid& grid);

}  // namespace oro
