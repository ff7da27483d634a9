// All names of a view's picture: what its vector files name, as far as the eye sees it and there is room.
#pragma once

#include <vector>

#include "apps/names/name_labels.h"
#include "apps/text/inked_rows.h"
#include "apps/text/text_face.h"
#include "apps/view/view.h"

namespace oro {

// Names are dark with a light halo: they are read on sky, snow and forest.
inline constexpr InkedText::Colour name_ink{16, 20, 28};
inline constexpr InkedText::Colour name_halo{250, 250, 246};

// What each label puts on a picture, in the labels' order. Errors: those of text.
Result<std::vector<InkedText>> inked_names(const TextFace& face, const std::vector<NameLabel>& labels);

struct NamesInView {
    std::vector<NameLabel> labels;  // the highest rank first
    std::vector<InkedText> inked;   // the same as pixels
    PointCounts counts;
    int without_letters{};  // names that the font has no letters for
    int without_room{};
    double seeing_s{};   // which are seen
    double placing_s{};  // where they stand, and their letters
};

// The named points of the view's files, those of --overlay after those of --names; one point that two files
// name alike at one place is named once.
std::vector<NamedPoint> points_of(const View& view);

// `in_view` is of the view's own camera and model. Errors: no memory for text.
Result<NamesInView> names_in_view(const std::vector<NamedPoint>& points, const PointsInView& in_view,
                                  const Camera& camera, const TextFace& face);

// What was not named and why, one line each. are_asked: a file of names was given (--names), so that none in
// the picture is worth a line.
std::vector<std::string> notes_of(const NamesInView& names, bool are_asked);

}  // namespace oro
