#include "apps/window/work.h"

namespace oro {

bool has_work(const Viewer& viewer) {
    return viewer.looking.work || viewer.panorama.work;
}

Result<void> take_finished_work(Viewer& viewer) {
    take_panorama(viewer);
    return take_seen_around(viewer);
}

}  // namespace oro
