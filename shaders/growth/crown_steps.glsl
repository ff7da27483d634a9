// Steps of distance, by which pieces of crowns are ordered. Needs shared_growth.h.

// The step of distance of what begins so many metres before the eye: 0 up to 2 m, the last from 470 m on.
uint step_at(float begins_m) {
    const uint two_m = 0x40000000u, step_bit = 20u;  // eight steps where distance doubles
    return clamp(floatBitsToUint(begins_m), two_m, two_m + ((crown_step_count - 1u) << step_bit)) - two_m >> step_bit;
}
