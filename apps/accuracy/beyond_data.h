// What a view's picture cannot know: ground that is not loaded. What shot, shot --verify, compare and plan
// tell of it, in the same words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/view/view.h"
#include "core/unseen/unseen_ground.h"

namespace oro {
class TrueScene;

// The --unseen-ceiling, or the usual one. Usage errors: out of range.
Result<double> unseen_ceiling(const std::optional<double>& option_m);

// From the truth's eye through the truth's air, over what the region holds: of several grids the one that
// reaches farthest around the eye. truth: the view's true scene, where it has been made: of one grid its
// surface is taken. Else posts of a baked region stay in their file, and are read where they are asked for.
// Errors: a baked region that cannot be read.
Result<UnseenGround> unseen_in(const View& view, const Region& region, double ceiling_m,
                               const TrueScene* truth = nullptr);

// "the view reaches past the data in 640 of 640 columns (missing: N46E010): terrain there, if it is up to
// 9,000 m high, could rise up to 312 px above what is drawn"; "" where it does in none, and where the picture
// shows all of the data: then it shows where they end. At most 12 cells are named. Nothing is said of ground
// beyond a part that was chosen.
std::string unseen_sentence(const UnseenGround& unseen);
// The same for who draws, with what helps: "the view reaches past the data in 640 of 640 columns (missing:
// N46E010): ground up to 9,000 m high there could rise up to 312 px above what is drawn; give these tiles,
// too, or --fetch skadi gets them".
std::string unseen_note(const UnseenGround& unseen);
// "In 640 of 640 columns ground beyond the data could be up to 312 px higher (missing: N46E010)."; ""
// likewise.
std::string unseen_ending(const UnseenGround& unseen);
// "The part of the data that you chose ends here: in 640 of 640 columns ground beyond it could be up to 312
// px higher."; "" likewise. For plan alone.
std::string beyond_part_ending(const UnseenGround& unseen);
nlohmann::ordered_json unseen_json(const UnseenGround& unseen);

}  // namespace oro
