// Text from outside (names of files, words of libraries and of files) as it may be shown on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace oro {

// True for characters that are no part of what a person reads, and change how it looks or where it goes:
// control characters of both sets (C0, DEL, C1), those that turn the direction of text, those without a width
// or a picture of their own, ends of lines and paragraphs, tags, and numbers that stand for no character.
[[nodiscard]] bool is_unseen(char32_t code);

// Zero-width (non-)joiners, U+200C and U+200D, shape the letters of Persian, Hindi and other scripts. Drawn
// text keeps them between two letters beyond Latin, Greek and Cyrillic; a line on a terminal does not.
enum class Joiners { replaced, kept_in_words };

// The text as a part of one line, in valid UTF-8: '?' stands for each unseen character, U+FFFD for each
// sequence of bytes that is no UTF-8, and what is longer than 1,000 bytes is cut between characters.
std::string one_line(std::string_view text, Joiners joiners = Joiners::replaced);

// JSON (or any text that knows its escapes) with each unseen character beyond ASCII as \uXXXX: the same
// value, and a terminal shows what is there. The text must be valid UTF-8.
std::string with_unseen_escaped(std::string_view json);

}  // namespace oro
