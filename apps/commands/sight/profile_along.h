// The profile along a line, from its options to its figures.
#pragma once

#include "apps/commands/sight/profile_text.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/options/options.h"

namespace oro {

// Errors (usage): a step or a threshold that cannot be.
Result<void> check_steps(const ProfileOptions& options);
// Errors (usage): a line that is too long, or that takes too many steps.
Result<void> check_length(const ProfileOptions& options, const LineAlong& line);
// Gives a profile the points along its line, and what they come to. `progress` is told how far along the line
// it is. Errors: posts that cannot be read.
Result<void> follow_line(const ProfileOptions& options, const SightGround& ground, Profile& profile,
                         const ProfileProgress& progress = {});
// Errors (no_data): none of a profile's points has ground, nor a mesh.
Result<void> check_has_ground(const ProfileOptions& options, const SightGround& ground,
                              const Profile& profile);

}  // namespace oro
