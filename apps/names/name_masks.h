// Names as pixels: text, heights and leader lines.
#pragma once

#include <vector>

#include "apps/names/name_labels.h"
#include "apps/text/inked_rows.h"
#include "apps/text/text_face.h"

namespace oro {

// Names are dark with a light halo: they are read on sky, snow and forest.
inline constexpr InkedText::Colour name_ink{16, 20, 28};
inline constexpr InkedText::Colour name_halo{250, 250, 246};

// What each label puts on a picture, in the labels' order. Errors: those of text.
Result<std::vector<InkedText>> inked_names(const TextFace& face, const std::vector<NameLabel>& labels);

}  // namespace oro
