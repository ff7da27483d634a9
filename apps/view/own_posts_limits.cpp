#include "apps/view/own_posts_limits.h"

#include <string>

#include "apps/command_line/refusals.h"

namespace oro {

Result<void> check_own_posts(const View& view, const Region& region) {
    for (const Region& other : region.beside) ORO_CHECK(check_own_posts(view, other));
    if (!region.field.grid.net) return {};
    const char* const option = view.model.earth != Earth::ellipsoid          ? "--earth"
                               : view.model.precision != Precision::relative ? "--precision"
                                                                             : nullptr;
    if (option == nullptr) return {};
    return refused(
        option, "",
        std::string("needs posts on latitudes and longitudes, and these lie where their own CRS has "
                    "them: ") +
            (region.file ? "bake their files with --resample" : "add --resample"));
}

}  // namespace oro
