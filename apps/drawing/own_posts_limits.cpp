#include "apps/drawing/own_posts_limits.h"

#include <string>

#include "apps/command_line/refusals.h"

namespace oro {

Result<void> check_own_posts(const View& view, const Region& region) {
    for (const Region& other : region.beside) ORO_CHECK(check_own_posts(view, other));
    if (!region.field.grid.net) return {};
    if (view.model.earth != Earth::ellipsoid)
        return refused("--earth", "", "not together with --own-posts: they lie on the ellipsoid alone");
    if (view.model.precision != Precision::relative)
        return refused("--precision", "", "not together with --own-posts");
    if (!view.drape.empty()) return refused("--drape", "", "not together with --own-posts yet");
    return {};
}

Result<void> refuse_own_posts(bool asked, const char* command) {
    if (!asked) return {};
    return refused("--own-posts", "", std::string("not with orograph ") + command + " yet");
}

}  // namespace oro
