// Values that stand for "no height here" although no tag of their file says so: -9999 and its kin.
#pragma once

#include <limits>
#include <string>

#include "core/base/result.h"
#include "geo/sources/source.h"

namespace oro {

// True for numbers that programs write where they have no height: all nines (-9999, -999, -9999.99), the ends
// of number types (-32768, 65535, -3.4e38) and slips of them (-32678), large powers of ten (1e20). True says
// that it may be one; whether it is, the heights around it say.
[[nodiscard]] bool reads_like_no_data(double stored);

// Stands in ValueFindings::undeclared for all values between a no-data value and the heights of the terrain,
// where a file was resampled with that value in it.
inline constexpr double blurred_value = std::numeric_limits<double>::infinity();

// Makes those posts of a block void whose stored value is no height, and counts them. A value is none where
// it is the lowest or highest of its whole file with nothing near it, has cliffs on its sides that are twice
// as high as the file's other ones, and either reads like no data, or is negative and fills whole squares of
// posts, or lies 1,000 m above all others and does. Where blurred rims lie between such a value and the
// terrain, they are void, too: all below the lowest post that has no such rim beside it. 0 is none where it
// fills whole squares and all else lies 100 m higher, and twice as high as nearly all steps. Depths of
// the sea stay. Reads the whole file once or twice where a block has something of this. Errors: those of
// `read`, which gives a window of posts as they are stored.
Result<void> take_out_undeclared(const Source& source, PostBlock& block,
                                 Result<PostBlock> (*read)(const Source&, const PostWindow&));

// Compares some neighbouring posts of a block, for ValueFindings::steep.
void measure_steepness(const Source& source, PostBlock& block);

// "-9999": a number without needless digits.
[[nodiscard]] std::string value_words(double value);

}  // namespace oro
