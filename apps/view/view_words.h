// The words of a command line that ask for what a view has: its data and its looks, without its eye.
#pragma once

#include <string>
#include <vector>

#include "apps/view/view.h"

namespace oro {

// The options of the looks, the models and the size of a view, where they differ from what a command takes by
// itself. view_without_eye() makes that view of them again; of its accuracy each part is one option.
ViewOptions look_options_of(const View& view);
// Paths and options of its elevation data.
RegionOptions region_options_of(const View& view);

// The words that give these options: {"--style", "plain", "--tau", "0.5"}; paths come first.
std::vector<std::string> words_of(const ViewOptions& options);
std::vector<std::string> words_of(const RegionOptions& options);
// The same of a view.
std::vector<std::string> look_words(const View& view);
std::vector<std::string> region_words(const View& view);
// A box as --bbox takes it, to the last digit.
std::string box_words(const BoundingBox& box);
// Words as a line for a shell: what it would change stands in single quotes.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace oro
