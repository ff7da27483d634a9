// ICC profiles that tests write for themselves: a header and one curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oro::test {

using ProfileBytes = std::vector<std::byte>;

inline void put_number(ProfileBytes& bytes, std::uint32_t number, int count) {
    for (int i = count - 1; i >= 0; --i)
        bytes.push_back(static_cast<std::byte>(number >> (8U * static_cast<unsigned>(i))));
}

inline void put_letters(ProfileBytes& bytes, std::string_view letters) {
    for (const char letter : letters) bytes.push_back(static_cast<std::byte>(letter));
}

// 'curv': no entry is a straight line, one an exponent of 1/256ths.
inline ProfileBytes curve_of(const std::vector<std::uint16_t>& entries) {
    ProfileBytes curve;
    put_letters(curve, "curv");
    put_number(curve, 0, 4);
    put_number(curve, static_cast<std::uint32_t>(entries.size()), 4);
    for (const std::uint16_t entry : entries) put_number(curve, entry, 2);
    return curve;
}

// 'para', the formula of an exponent alone, which is counted in 65,536ths.
inline ProfileBytes formula_of(std::uint32_t exponent) {
    ProfileBytes curve;
    put_letters(curve, "para");
    put_number(curve, 0, 8);
    put_number(curve, exponent, 4);
    return curve;
}

// "rTRC": the curve of red; "kTRC": of grey.
inline ProfileBytes profile_with(std::string_view tag, const ProfileBytes& curve) {
    constexpr std::uint32_t first = 128 + 4 + 12;
    ProfileBytes profile;
    put_number(profile, first + static_cast<std::uint32_t>(curve.size()), 4);
    profile.resize(36);
    put_letters(profile, "acsp");
    profile.resize(128);
    put_number(profile, 1, 4);
    put_letters(profile, tag);
    put_number(profile, first, 4);
    put_number(profile, static_cast<std::uint32_t>(curve.size()), 4);
    profile.insert(profile.end(), curve.begin(), curve.end());
    return profile;
}

}  // namespace oro::test
