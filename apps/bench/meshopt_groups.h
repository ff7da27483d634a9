// Groups of a mesh's graph made coarser by meshoptimizer.
#pragma once

#include "core/mesh_graph/custom_simplifier.h"

namespace oro {

enum class MeshoptRims {
    stay,  // meshopt_SimplifyLockBorder: all open edges of the group, those of the mesh's own rims, too
    move,  // only vertices that have to stay do
};
enum class MeshoptLimit {
    none,      // whatever it costs
    own,       // most_m of the group, by what meshoptimizer says
    measured,  // most_m of the group, by the distance of what went in and what came out, both ways, in eight
               // tries: the fewest triangles that are within it
};

// meshopt_simplify over the group alone. It has no list of vertices that stay before version 0.19. A vertex
// stays in any version where more than one open edge leaves it: two triangles that nothing else touches, a
// thousandth as wide as the group, are added at each vertex that has to stay. They are not in what comes out.
[[nodiscard]] CustomSimplifier simplifier_by_meshopt(MeshoptRims rims, MeshoptLimit limit);

}  // namespace oro
