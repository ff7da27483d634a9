// What `plan` prints for people.
#pragma once

#include <string>

#include "apps/accuracy/accuracy.h"
#include "apps/view/view.h"

namespace oro {

// A table of all effects in three parts, and what they come to in some sentences. Lines of at most 120
// columns with their line ends, but for the sentences, which are as long as they are.
std::string plan_text(const Budget& budget, const View& view, const AccuracyChoice& choice);

}  // namespace oro
