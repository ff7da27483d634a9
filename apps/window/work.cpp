#include "apps/window/work.h"

namespace oro {

bool has_work(const Viewer& viewer) {
    return viewer.looking.work || viewer.panorama.work || viewer.two.work || viewer.comparing.work ||
           viewer.begun.work;
}

Result<void> take_finished_work(Viewer& viewer) {
    take_panorama(viewer);
    take_command(viewer);
    ORO_CHECK(take_seen_around(viewer));
    ORO_CHECK(take_second(viewer));
    return take_difference(viewer);
}

}  // namespace oro
