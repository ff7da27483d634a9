// The paths of a view as its picture tells them: from the picture's own folder, so that they lead there
// wherever the folder that holds both has gone, and tell no more of the machine than that needs.
#pragma once

#include <string>

#include "apps/view/view.h"

namespace oro {

// The view as a picture of that name carries it. Paths that share a folder with the picture start from the
// picture's folder; others, which have only the root in common with it, stay absolute. Without paths where
// the view is not to tell any. Errors: the file system cannot tell where a path leads.
Result<View> view_as_written_in(const View& view, const std::string& picture);

// The other way: the view that was read from `file`, with paths that lead there from the working folder.
// Errors: as above.
Result<void> lead_from_working_folder(View& view, const std::string& file);

}  // namespace oro
