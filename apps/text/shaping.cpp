#include "apps/text/shaping.h"

#include <hb-ot.h>
#include <utf8.h>

#include <algorithm>
#include <cstddef>

namespace oro {
namespace {

// Letters that are shaped together.
struct Run {
    std::size_t first{};
    std::size_t count{};
    hb_script_t script{HB_SCRIPT_COMMON};
    bool figures{};

    [[nodiscard]] bool leftwards() const {
        return !figures && hb_script_get_horizontal_direction(script) == HB_DIRECTION_RTL;
    }
};

Result<std::u32string> letters_of(const std::string& text) {
    if (!utf8::is_valid(text.begin(), text.end()))
        return Error{ErrorKind::failed, "text", "'" + text + "' is not UTF-8"};
    std::u32string letters;
    for (auto at = text.begin(); at != text.end();) letters += utf8::unchecked::next(at);
    return letters;
}

bool is_real(hb_script_t script) {
    return script != HB_SCRIPT_COMMON && script != HB_SCRIPT_INHERITED && script != HB_SCRIPT_UNKNOWN;
}

bool is_figure(hb_unicode_funcs_t* facts, char32_t letter) {
    return hb_unicode_general_category(facts, letter) == HB_UNICODE_GENERAL_CATEGORY_DECIMAL_NUMBER;
}

// What has no script of its own (spaces, points, accents) goes with what is before it, at the beginning with
// what follows; figures amid letters that run leftwards are a run of their own.
std::vector<Run> runs_of(const std::u32string& letters) {
    hb_unicode_funcs_t* const facts = hb_unicode_funcs_get_default();
    std::vector<Run> runs;
    for (std::size_t i = 0; i < letters.size(); ++i) {
        const hb_script_t script = hb_unicode_script(facts, letters[i]);
        if (runs.empty()) {
            runs.push_back({i, 1, script, false});
            continue;
        }
        Run& last = runs.back();
        if (is_figure(facts, letters[i])) {
            if (last.leftwards())
                runs.push_back({i, 1, HB_SCRIPT_COMMON, true});
            else
                ++last.count;
        } else if (last.figures) {
            // Back to the script before the figures.
            runs.push_back({i, 1, is_real(script) ? script : runs[runs.size() - 2].script, false});
        } else if (!is_real(script) || script == last.script) {
            ++last.count;
        } else if (!is_real(last.script)) {
            last.script = script;
            ++last.count;
        } else {
            runs.push_back({i, 1, script, false});
        }
    }
    return runs;
}

struct BufferEnding {
    void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};

void add_run(hb_font_t* font, const std::u32string& letters, const Run& run, ShapedText& text) {
    const std::unique_ptr<hb_buffer_t, BufferEnding> buffer(hb_buffer_create());
    static_assert(sizeof(char32_t) == sizeof(std::uint32_t));
    hb_buffer_add_utf32(buffer.get(), reinterpret_cast<const std::uint32_t*>(letters.data()),
                        static_cast<int>(letters.size()), static_cast<unsigned>(run.first),
                        static_cast<int>(run.count));
    hb_buffer_set_script(buffer.get(), is_real(run.script) ? run.script : HB_SCRIPT_LATIN);
    hb_buffer_set_direction(buffer.get(), run.leftwards() ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));
    hb_shape(font, buffer.get(), nullptr, 0);
    unsigned count = 0;
    const hb_glyph_info_t* const glyphs = hb_buffer_get_glyph_infos(buffer.get(), &count);
    const hb_glyph_position_t* const places = hb_buffer_get_glyph_positions(buffer.get(), &count);
    const double em = hb_face_get_upem(hb_font_get_face(font));
    for (unsigned i = 0; i < count; ++i) {
        text.letters.push_back(
            {glyphs[i].codepoint, text.width_em + places[i].x_offset / em, places[i].y_offset / em});
        text.width_em += places[i].x_advance / em;
        if (glyphs[i].codepoint == 0) text.is_whole = false;
    }
}

}  // namespace

ShapingFont shaping_font(const unsigned char* file, unsigned long bytes) {
    hb_blob_t* const blob = hb_blob_create(reinterpret_cast<const char*>(file), static_cast<unsigned>(bytes),
                                           HB_MEMORY_MODE_READONLY, nullptr, nullptr);
    hb_face_t* const face = hb_face_create(blob, 0);
    hb_blob_destroy(blob);
    hb_font_t* const font = hb_font_create(face);
    hb_face_destroy(face);
    hb_ot_font_set_funcs(font);
    return ShapingFont(font);
}

Result<ShapedText> shaped(hb_font_t* font, const std::string& text) {
    ORO_TRY(const std::u32string letters, letters_of(text));
    std::vector<Run> runs = runs_of(letters);
    const auto first = std::ranges::find_if(runs, [](const Run& run) { return is_real(run.script); });
    if (first != runs.end() && first->leftwards()) std::ranges::reverse(runs);
    ShapedText all;
    for (const Run& run : runs) add_run(font, letters, run, all);
    return all;
}

}  // namespace oro
