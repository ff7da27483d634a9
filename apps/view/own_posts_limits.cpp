#include "apps/view/view.h"

#include <algorithm>
#include <string>

#include "apps/command_line/refusals.h"

namespace oro {

Result<void> check_own_posts(const View& view, const Region& region) {
    const auto on_net = std::ranges::find_if(
        region.grids, [](const RegionGrid& grid) { return grid.field.grid.net != nullptr; });
    if (on_net == region.grids.end()) return {};
    const char* const option = view.model.earth != Earth::ellipsoid          ? "--earth"
                               : view.model.precision != Precision::relative ? "--precision"
                                                                             : nullptr;
    if (option == nullptr) return {};
    return refused(
        option, "",
        std::string("needs posts on latitudes and longitudes, and these lie where their own CRS has "
                    "them: ") +
            (on_net->file ? "bake their files with --resample" : "add --resample"));
}

}  // namespace oro
