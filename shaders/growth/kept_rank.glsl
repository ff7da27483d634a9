// Which trees are left out far away. Needs growth.glsl.

// Trees up to this rank are kept so far away.
float kept_rank(SitePlace place) { return trees_at(length(place.view), GROWTH.reach_m) * (stocked_sites + trees_grow_in); }
