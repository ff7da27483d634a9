#include "apps/text/text_face.h"

#include <ft2build.h>
#include <utf8.h>

#include <freetype/freetype.h>
#include <freetype/ftglyph.h>
#include <freetype/ftstroke.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "apps/text/font_file.h"

namespace oro {

struct TextFace::Parts {
    FT_Library library{};
    FT_Face face{};
};

void TextFace::Ending::operator()(Parts* parts) const {
    if (parts->face != nullptr) FT_Done_Face(parts->face);
    if (parts->library != nullptr) FT_Done_FreeType(parts->library);
    delete parts;
}

namespace {

constexpr double capital_share = 0.729;  // height of capitals and figures; source: the font's OS/2 table
constexpr FT_Int32 as_drawn = FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;

Error fault(const char* what, FT_Error code) {
    return {ErrorKind::failed, "text", std::string(what) + ": FreeType's error " + std::to_string(code)};
}

Result<void> done(const char* what, FT_Error code) {
    if (code != 0) return fault(what, code);
    return {};
}

FT_Pos in_64ths(double px) {
    return std::lround(px * 64.0);
}

struct GlyphEnding {
    void operator()(FT_Glyph glyph) const { FT_Done_Glyph(glyph); }
};
using Glyph = std::unique_ptr<FT_GlyphRec_, GlyphEnding>;

struct StrokerEnding {
    void operator()(FT_Stroker stroker) const { FT_Stroker_Done(stroker); }
};
using Stroker = std::unique_ptr<FT_StrokerRec_, StrokerEnding>;

Result<std::u32string> letters_of(const std::string& text) {
    if (!utf8::is_valid(text.begin(), text.end()))
        return Error{ErrorKind::failed, "text", "'" + text + "' is not UTF-8"};
    std::u32string letters;
    for (auto at = text.begin(); at != text.end();) letters += utf8::unchecked::next(at);
    return letters;
}

// What covers a pixel twice covers it as the larger does.
void add(const FT_BitmapGlyph glyph, std::vector<std::uint8_t> TextMask::*which, TextMask& mask) {
    const FT_Bitmap& bitmap = glyph->bitmap;
    const int left = glyph->left - mask.x_px, top = -glyph->top - mask.y_px;
    for (int y = 0; y < static_cast<int>(bitmap.rows); ++y) {
        for (int x = 0; x < static_cast<int>(bitmap.width); ++x) {
            if (x + left < 0 || y + top < 0 || x + left >= mask.width_px || y + top >= mask.height_px)
                continue;
            std::uint8_t& to =
                (mask.*which)[static_cast<std::size_t>(y + top) * static_cast<std::size_t>(mask.width_px) +
                              static_cast<std::size_t>(x + left)];
            to = std::max(to, bitmap.buffer[static_cast<std::ptrdiff_t>(y) * bitmap.pitch + x]);
        }
    }
}

// Makes pixels of a shape that is where it belongs, and adds them.
Result<void> fill(Glyph shape, std::vector<std::uint8_t> TextMask::*which, TextMask& mask) {
    FT_Glyph glyph = shape.release();
    const FT_Error failed = FT_Glyph_To_Bitmap(&glyph, FT_RENDER_MODE_NORMAL, nullptr, 1);
    shape.reset(glyph);
    ORO_CHECK(done("a letter cannot be drawn", failed));
    add(reinterpret_cast<FT_BitmapGlyph>(glyph), which, mask);
    return {};
}

// A shape's outer border, the stroker's radius away from it.
Result<Glyph> widened(const Glyph& shape, const Stroker& stroker) {
    FT_Glyph wide = shape.get();
    const FT_Error failed = FT_Glyph_StrokeBorder(&wide, stroker.get(), 0, 0);
    Glyph kept(failed == 0 ? wide : nullptr);
    ORO_CHECK(done("a letter's halo cannot be drawn", failed));
    return kept;
}

Result<Stroker> stroker_of(FT_Library library, double radius_px) {
    FT_Stroker handle{};
    ORO_CHECK(done("no halo", FT_Stroker_New(library, &handle)));
    Stroker stroker(handle);
    FT_Stroker_Set(handle, in_64ths(radius_px), FT_STROKER_LINECAP_ROUND, FT_STROKER_LINEJOIN_ROUND, 0);
    return stroker;
}

// How far it is from where a letter begins to where the next one does.
Result<double> advance_px(FT_Face face, char32_t letter, double size_px) {
    ORO_CHECK(done("a letter cannot be read",
                   FT_Load_Glyph(face, FT_Get_Char_Index(face, letter), FT_LOAD_NO_SCALE)));
    return static_cast<double>(face->glyph->advance.x) * size_px / face->units_per_EM;
}

// A letter turned, with its beginning at `at`: pixels, counted as pictures are, from where FreeType counts.
Result<Glyph> letter_at(FT_Face face, char32_t letter, FT_Matrix turn, const glm::dvec2& at) {
    ORO_CHECK(
        done("a letter cannot be read", FT_Load_Glyph(face, FT_Get_Char_Index(face, letter), as_drawn)));
    FT_Glyph loaded{};
    ORO_CHECK(done("a letter cannot be read", FT_Get_Glyph(face->glyph, &loaded)));
    Glyph shape(loaded);
    FT_Vector to{in_64ths(at.x), in_64ths(-at.y)};
    ORO_CHECK(done("a letter cannot be turned", FT_Glyph_Transform(shape.get(), &turn, &to)));
    return shape;
}

}  // namespace

Result<TextFace> TextFace::open() {
    std::unique_ptr<Parts, Ending> parts(new Parts);
    ORO_CHECK(done("FreeType does not start", FT_Init_FreeType(&parts->library)));
    ORO_CHECK(done("the font cannot be read",
                   FT_New_Memory_Face(parts->library, font_file, static_cast<FT_Long>(font_file_bytes), 0,
                                      &parts->face)));
    return TextFace(std::move(parts));
}

Result<double> TextFace::width_px(const std::string& text, double size_px) const {
    assert(size_px > 0.0);
    ORO_TRY(const std::u32string letters, letters_of(text));
    double all_px = 0.0;
    for (const char32_t letter : letters) {
        ORO_TRY(const double one_px, advance_px(parts_->face, letter, size_px));
        all_px += one_px;
    }
    return all_px;
}

Result<TextMask> TextFace::mask(const std::string& text, const TextPlace& place) const {
    const FT_Face face = parts_->face;
    ORO_TRY(const std::u32string letters, letters_of(text));
    ORO_TRY(const double length_px, width_px(text, place.size_px));
    ORO_CHECK(done("no letters of that size",
                   FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(in_64ths(place.size_px)), 72, 72)));
    ORO_TRY(const Stroker stroker, stroker_of(parts_->library, place.halo_px));
    const double radians = place.angle_deg * std::numbers::pi / 180.0;
    const glm::dvec2 along(std::cos(radians), std::sin(radians)), up(along.y, -along.x);
    const auto fixed = [](double share) { return static_cast<FT_Fixed>(std::lround(share * 65536.0)); };
    const FT_Matrix turn{fixed(along.x), fixed(along.y), fixed(-along.y), fixed(along.x)};

    // FreeType's numbers are small: they count from a pixel near by.
    const glm::dvec2 origin(std::floor(place.middle_px.x), std::floor(place.middle_px.y));
    glm::dvec2 pen =
        place.middle_px - origin - 0.5 * length_px * along - 0.5 * capital_share * place.size_px * up;
    const int reach = static_cast<int>(std::ceil(0.5 * length_px + place.size_px + place.halo_px)) + 1;
    TextMask mask{-reach, -reach, 2 * reach, 2 * reach, {}, {}};
    mask.ink.resize(static_cast<std::size_t>(mask.width_px) * static_cast<std::size_t>(mask.height_px));
    mask.halo.resize(mask.ink.size());
    for (const char32_t letter : letters) {
        ORO_TRY(const double one_px, advance_px(face, letter, place.size_px));
        ORO_TRY(Glyph shape, letter_at(face, letter, turn, pen));
        if (place.halo_px > 0.0) {
            ORO_TRY(Glyph wide, widened(shape, stroker));
            ORO_CHECK(fill(std::move(wide), &TextMask::halo, mask));
        }
        ORO_CHECK(fill(std::move(shape), &TextMask::ink, mask));
        pen += one_px * along;
    }
    mask.x_px += static_cast<int>(origin.x);
    mask.y_px += static_cast<int>(origin.y);
    return mask;
}

}  // namespace oro
