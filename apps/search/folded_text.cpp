#include "apps/search/folded_text.h"

#include <utf8.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <utility>

namespace oro {
namespace {

// One letter for each code from `first` on; ? for those that become none or several.
struct LetterTable {
    std::uint32_t first;
    std::string_view letters;
};

constexpr std::array<LetterTable, 3> letter_tables{{
    {0xC0,
     "aaaaaa?ceeeeiiiidnooooo?ouuuuy??aaaaaa?ceeeeiiiidnooooo?ouuuuy?y"
     "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiii??jjkkkllllllll"
     "llnnnnnnnnnoooooo??rrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs"},
    {0x1CD,
     "aaiioouuuuuuuuuu?aaaa????ggkkoooo??j???gg??nnaa??ooaaaaeeeeiiiio"
     "ooorrrruuuusstt??hh??????aaeeooooooooyy"},
    {0x1E00,
     "aabbbbbbccddddddddddeeeeeeeeeeffgghhhhhhhhhhiiiikkkkkkllllllllmm"
     "mmmmnnnnnnnnoooooooopppprrrrrrrrssssssssssttttttttuuuuuuuuuuvvvv"
     "wwwwwwwwwwxxxxyyzzzzzzhtwy?s????aaaaaaaaaaaaaaaaaaaaaaaaeeeeeeee"
     "eeeeeeeeiiiioooooooooooooooooooooooouuuuuuuuuuuuuuyyyyyyyy??????"},
}};
static_assert(letter_tables[0].letters.size() == 0x180 - 0xC0 &&
              letter_tables[1].letters.size() == 0x234 - 0x1CD &&
              letter_tables[2].letters.size() == 0x1F00 - 0x1E00);

constexpr std::array<std::pair<std::uint32_t, std::string_view>, 14> several_letters{{
    {0xC6, "ae"},
    {0xDE, "th"},
    {0xDF, "ss"},
    {0xE6, "ae"},
    {0xFE, "th"},
    {0x132, "ij"},
    {0x133, "ij"},
    {0x152, "oe"},
    {0x153, "oe"},
    {0x1E2, "ae"},
    {0x1E3, "ae"},
    {0x1FC, "ae"},
    {0x1FD, "ae"},
    {0x1E9E, "ss"},
}};

// Small letters of Greek and Cyrillic with an accent, and the ones without.
constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 13> bare_letters{{
    {0x3AC, 0x3B1},
    {0x3AD, 0x3B5},
    {0x3AE, 0x3B7},
    {0x3AF, 0x3B9},
    {0x390, 0x3B9},
    {0x3CA, 0x3B9},
    {0x3CC, 0x3BF},
    {0x3CD, 0x3C5},
    {0x3B0, 0x3C5},
    {0x3CB, 0x3C5},
    {0x3CE, 0x3C9},
    {0x439, 0x438},
    {0x451, 0x435},
}};

// Of Greek and Cyrillic.
std::uint32_t small_letter(std::uint32_t code) {
    if (code == 0x386) return 0x3B1;
    if (code >= 0x388 && code <= 0x38A) return code + 37;
    if (code == 0x38C) return 0x3BF;
    if (code == 0x38E || code == 0x38F) return code + 63;
    if (code >= 0x391 && code <= 0x3AB) return code + 32;
    if (code == 0x3C2) return 0x3C3;  // a sigma at the end of a word
    if (code >= 0x400 && code <= 0x40F) return code + 80;
    if (code >= 0x410 && code <= 0x42F) return code + 32;
    return code;
}

bool is_combining_mark(std::uint32_t code) {
    return code >= 0x300 && code <= 0x36F;
}

// What stands between words: of the blocks of punctuation alone.
bool is_between_words(std::uint32_t code) {
    return code < 0xC0 || code == 0xD7 || code == 0xF7 || (code >= 0x2B0 && code <= 0x2FF) ||
           (code >= 0x2000 && code <= 0x206F) || (code >= 0x3000 && code <= 0x3003) || code == 0xFEFF ||
           code == 0xFFFD;
}

void append_letter(std::uint32_t code, std::string& text) {
    for (const LetterTable& table : letter_tables) {
        if (code < table.first || code >= table.first + table.letters.size()) continue;
        if (const char letter = table.letters[code - table.first]; letter != '?') {
            text += letter;
            return;
        }
    }
    for (const auto& [from, letters] : several_letters) {
        if (from != code) continue;
        text += letters;
        return;
    }
    std::uint32_t small = small_letter(code);
    for (const auto& [from, bare] : bare_letters)
        if (from == small) small = bare;
    utf8::unchecked::append(small, std::back_inserter(text));
}

}  // namespace

std::string folded(std::string_view text) {
    std::string valid;
    if (!utf8::is_valid(text.begin(), text.end())) {
        utf8::replace_invalid(text.begin(), text.end(), std::back_inserter(valid), U' ');
        text = valid;
    }
    std::string letters;
    letters.reserve(text.size());
    bool is_apart = false;  // something stands between the last letter and the next
    const auto begin_letter = [&] {
        if (is_apart && !letters.empty()) letters += ' ';
        is_apart = false;
    };
    for (auto at = text.begin(); at != text.end();) {
        const auto byte = static_cast<unsigned char>(*at);
        if (byte < 0x80) {
            ++at;
            const bool is_capital = byte >= 'A' && byte <= 'Z';
            if (is_capital || (byte >= 'a' && byte <= 'z') || (byte >= '0' && byte <= '9')) {
                begin_letter();
                letters += static_cast<char>(is_capital ? byte + 32 : byte);
            } else {
                is_apart = true;
            }
            continue;
        }
        const std::uint32_t code = utf8::unchecked::next(at);
        if (is_combining_mark(code)) continue;
        // The feminine and the masculine ordinal (1a, N°).
        if (is_between_words(code) && code != 0xAA && code != 0xBA) {
            is_apart = true;
            continue;
        }
        begin_letter();
        if (code == 0xAA || code == 0xBA)
            letters += code == 0xAA ? 'a' : 'o';
        else
            append_letter(code, letters);
    }
    return letters;
}

}  // namespace oro
