// What orograph sun found, as people and as programs read it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/earth/world_model.h"
#include "core/light/sun_position.h"
#include "core/terrain/summit.h"

namespace oro {

struct SunReport {
    struct Crossing {
        std::int64_t time_utc_s{};
        bool rising{};
        double azimuth_deg{};  // of the disc's middle
        // Over terrain: how far the data reach that way. What lies beyond could hide the sun for longer.
        std::optional<double> data_reach_m{};
    };
    struct Light {
        SunDay day{};
        double sunlight_s{};  // of the 24 hours around noon
        std::vector<Crossing> crossings;
    };
    Geodetic place;                        // h is 0 where there is no terrain
    std::optional<double> H_m;             // of the eye, and so are the next two: with terrain
    std::optional<double> above_ground_m;  // nothing where there is no ground below
    std::optional<MovedToSummit> moved;    // of an eye that was asked to stand on a summit
    std::optional<Air> air;
    std::string date;           // "2026-06-21", there
    std::int64_t from_utc_s{};  // the day that was asked for: its midnight
    // Light is looked for in the 24 hours around that day's solar noon: a day with its own evening, whatever
    // the clock says then, and no night inside.
    std::int64_t light_from_utc_s{};
    std::int64_t east_s{};  // of UTC, for times that are told
    std::string zone{"Z"};
    Light plain;
    // Over a plain horizon: from this day's sunset to the next sunrise; nothing where either is not within a
    // day.
    struct Night {
        std::int64_t from_utc_s{};
        std::int64_t to_utc_s{};
    };
    std::optional<Night> night;
    std::optional<Light> terrain;
    std::vector<std::string> notes;  // on the terrain
    std::int64_t noon_utc_s{};
    SunPosition noon;
};

std::string sun_text(const SunReport& report);
nlohmann::ordered_json sun_json(const SunReport& report);

}  // namespace oro
