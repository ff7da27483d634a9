// Several views for one shot: where they stand, and the numbered names of their pictures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/view/view.h"
#include "core/base/result.h"

namespace oro {

// One of several views, and the file that it stands in.
struct ListedView {
    View view;
    std::string file;
};

// The views of several files, or of one .json that holds a list of views, in their order; none where there is
// one file with one view, or no file. Errors: those of read_view(); a list that is empty or holds what is no
// view, with its number from 1.
Result<std::vector<ListedView>> listed_views(const std::vector<std::string>& files);

// The name of picture `number` of `count` by a pattern, in which %d, %4d or %04d stands for the number, once,
// and %% for %. Errors (usage): no pattern, or one of another kind.
Result<std::string> numbered_name(const std::string& pattern, std::size_t count, std::size_t number);

}  // namespace oro
