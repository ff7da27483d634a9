// Steps of distance, by which pieces of crowns are ordered. Needs shared_growth.h.

// The step of distance of what begins so many metres before the eye: 0 up to a quarter of a metre.
uint step_at(float begins_m) {
    const uint quarter_m = 0x3e800000u;
    return clamp(floatBitsToUint(begins_m), quarter_m, quarter_m + ((crown_step_count - 1u) << 21)) - quarter_m >> 21;
}
