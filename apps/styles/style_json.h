// Styles as JSON: data/README.md lists the fields.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/options/view_limits.h"
#include "apps/styles/style.h"
#include "core/base/result.h"
#include "shaders/shared.h"

namespace oro {

// A style, with its own sun. Throws a JsonFault (apps/report/json_fields.h): a field that is missing, unknown
// or bad.
Style style_of_json(const nlohmann::json& json);
// The style of a file's text. Errors: as style_of_json(), or no JSON at all; they name `path`.
Result<Style> style_of_text(const std::string& text, const std::string& path);

// The air of a style's "air". Throws a JsonFault: a field that is missing, unknown or bad.
gpu::AirModel air_of(const nlohmann::json& object);

// Dust, so that black can be told from the horizon's sky from so far away at sea level; within
// view_limits::visibility_km.
void set_visibility(double visibility_km, gpu::AirModel& air);

// What covers the ground, of a style's "cover"; its colour as the tints are: sRGB codes, or linear light.
// Throws a JsonFault.
gpu::GroundCover cover_of(const nlohmann::json& object, bool as_codes);

// What the ground is made of, of a style's "materials". Throws a JsonFault.
gpu::MaterialTable materials_of(const nlohmann::json& object);

// What grows on the ground, of a style's "growth": gpu::materials_with_trees and gpu::materials_with_grass.
// Throws a JsonFault.
gpu::uint growth_of(const nlohmann::json& object);

}  // namespace oro
