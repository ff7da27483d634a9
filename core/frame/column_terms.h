// What places the columns of a frame's posts on a round Earth, by how far they are from the eye's meridian.
#pragma once

#include <span>

#include "shaders/shared.h"

namespace oro {

// The terms of one column, which lies so many degrees east of the eye, within half a turn: by
// sine_cosine_deg() in double, rounded.
[[nodiscard]] gpu::ColumnTerms column_terms(double east_deg);

// The same of many, to the bit; `terms` has room for all. Up to 45 degrees from the eye sines are found by a
// polynomial, with a bound of its error: where a bound of a term rounds to another float than the other
// bound, the term is found as above.
void column_terms(std::span<const double> east_deg, std::span<gpu::ColumnTerms> terms);

}  // namespace oro
