// The eye of a view that asks for no place: one that sees the whole region.
#pragma once

#include "apps/view/view.h"

namespace oro {

// Share of the picture's width that stays free on the left and on the right of the whole region, and of its
// height above and below.
inline constexpr double overview_margin = 0.05;
// Angle of view of a picture of the whole region, unless --fov says otherwise: narrower than that of a place,
// so that the far side of the region is not seen through much more air than the near one.
inline constexpr double overview_fov_deg = 30.0;

// The pitch of an overview of ground within radius_m of its middle: it looks down as a guide does from a
// summit, and the steeper the more the Earth is curved, which would hide the far side and put it behind more
// air.
double overview_pitch_deg(double radius_m);

// Puts the eye of a view so that all of the region's surface (its heights exaggerated as the view has it) is
// in the picture, with overview_margin around it, touched on two opposite sides: obliquely from the south,
// the steeper the larger the region; --heading, --pitch and --roll are of the line of sight in the region's
// middle. A rim of more than 2,048 posts is looked at every few posts, ground inside at 64 x 64 posts.
// Errors: every post is void (no_data); an eye beyond view_limits (usage).
Result<void> see_whole_region(View& view, const ViewOptions& options, const Region& region);

// True when a view on a plane shows all of the region's rim: a picture in which the data are seen to end.
// Places are taken without the air's bending.
[[nodiscard]] bool is_whole_in_view(const View& view, const Region& region);

}  // namespace oro
