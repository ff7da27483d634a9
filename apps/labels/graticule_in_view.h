// The graticule of a view as its picture shows it.
#pragma once

#include <vector>

#include "apps/names/seen_points.h"
#include "apps/text/inked_rows.h"
#include "apps/text/text_face.h"
#include "apps/view/view.h"
#include "core/truth/true_ground.h"

namespace oro {

struct GraticuleInView {
    std::vector<InkedText> lines;   // dark, and over them light; the first are drawn first
    std::vector<InkedText> labels;  // that touch neither each other nor what is in the way
};

// The lines of view.graticule on the ground that is seen, at an interval that fits to it, and their values
// where they come to the picture's border or end. Nothing where no ground is seen. in_the_way: what stands on
// the picture already. Errors: those of text; a CRS that is none (View::graticule_crs).
Result<GraticuleInView> graticule_in_view(const View& view, const TrueGround& ground,
                                          const PointsInView& in_view, const TextFace& face,
                                          const std::vector<InkedText>& in_the_way);

}  // namespace oro
