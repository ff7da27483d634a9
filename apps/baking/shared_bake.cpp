#include "apps/baking/shared_bake.h"

#include <unistd.h>

#include "apps/baking/cluster_bake.h"
#include "core/cluster_windows/windowed_graph.h"
#include "geo/together/baked_parts.h"

namespace oro {

Result<void> bake_shared(const HeightField& field, const BakeOptions& how, const BakePart& part,
                         bool clusters, const std::function<void(double, const char*)>& on_progress,
                         SharedBakeReport& report) {
    BakeOptions grid = how;
    if (clusters) grid.path = path_of_grid(how.path, 0);
    ORO_TRY(const std::uint64_t rows, measure_part(field, grid, part, [&](double share) {
                on_progress(share, "measuring");
                return true;
            }));
    report.rows += rows;
    report.files.push_back(path_of_measured_part(grid.path, part));
    if (!clusters || field.grid.post_count() <= most_posts_in_one_go) return {};
    WindowedBake windows;
    windows.path = path_of_clusters(how.path);
    windows.fingerprint = how.fingerprint;
    windows.overwrite = true;
    windows.threads = how.threads;
    windows.progress = [&](double share) { on_progress(share, "building clusters"); };
    ORO_TRY(const std::size_t built, bake_windows_of_part(field, windows, part.number, part.count));
    report.windows += built;
    return {};
}

void remove_parts(const MeasuredParts& parts) {
    for (const std::string& file : parts.files()) unlink(file.c_str());
}

}  // namespace oro
