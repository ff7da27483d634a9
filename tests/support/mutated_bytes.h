// A file's bytes, changed as disks, transfers and people change them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/support/asked_count.h"

namespace oro::test {

struct Mutation {
    std::string bytes;
    std::string what;  // "bit 3 of byte 4711 flipped"
};

// How many mutations a test tries: OROGRAPH_TEST_MUTATIONS, or what the test takes by itself.
inline int mutation_count(int otherwise) {
    return asked_count("OROGRAPH_TEST_MUTATIONS", otherwise);
}

// A copy of `whole` that differs from it. `parts`: where the file's parts begin, in order, the first at 0;
// each part is hit as often as any other, however small it is.
inline Mutation mutated(const std::string& whole, const std::vector<std::size_t>& parts,
                        std::mt19937_64& random) {
    const std::size_t part = random() % parts.size();
    const std::size_t end = part + 1 < parts.size() ? parts[part + 1] : whole.size();
    const std::size_t at = parts[part] + random() % (end - parts[part]);
    const std::size_t some = std::min<std::size_t>(1 + random() % 600, whole.size() - at);
    const std::size_t from = random() % (whole.size() - some + 1);
    const std::string place = std::to_string(at), run = std::to_string(some) + " bytes from byte " + place;
    for (;;) {
        Mutation changed{whole, ""};
        switch (random() % 8) {
            case 0:
            case 1:
                changed.bytes[at] = static_cast<char>(whole[at] ^ (1 << random() % 8));
                changed.what = "a bit of byte " + place + " flipped";
                break;
            case 2:
                changed.bytes[at] = static_cast<char>(random());
                changed.what = "byte " + place + " overwritten";
                break;
            case 3:
                changed.bytes.replace(at, some, some, '\0');
                changed.what = run + " zeroed";
                break;
            case 4:
                for (std::size_t i = 0; i < some; ++i) changed.bytes[at + i] = static_cast<char>(random());
                changed.what = run + " overwritten";
                break;
            case 5:
                changed.bytes.replace(at, some, whole, from, some);
                changed.what = run + " overwritten with those from byte " + std::to_string(from);
                break;
            case 6:
                changed.bytes.erase(at, random() % 2 == 0 ? some : std::string::npos);
                changed.what =
                    "cut at byte " + place + " to " + std::to_string(changed.bytes.size()) + " bytes";
                break;
            default:
                changed.bytes.insert(at, whole, from, some);
                changed.what = std::to_string(some) + " bytes inserted at byte " + place;
        }
        if (changed.bytes != whole) return changed;
    }
}

}  // namespace oro::test
