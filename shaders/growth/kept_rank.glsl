// Which trees are left out far away. Needs growth.glsl.

const float grows_in = 0.12;  // ranks over which a tree goes from nothing to its height

// Trees up to this rank are kept so far away.
float kept_rank(SitePlace place) { return trees_at(length(place.view), GROWTH.reach_m) * (stocked_sites + grows_in); }
