#include "apps/text/text_face.h"

#include <ft2build.h>

#include <freetype/freetype.h>
#include <freetype/ftglyph.h>
#include <freetype/ftstroke.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <unordered_map>

#include "apps/text/font_file.h"
#include "apps/text/shaping.h"

namespace oro {

// A letter by itself: what it covers, counted from where it begins on its base line.
struct TextFace::Letter {
    TextMask mask;
};

struct TextFace::Parts {
    FT_Library library{};
    FT_Face face{};
    ShapingFont font;
    std::unordered_map<std::string, ShapedText> texts;                         // that were shaped
    std::map<std::tuple<std::uint32_t, int, double, double>, Letter> letters;  // glyph, quarters, size, halo

    Result<const ShapedText*> shape(const std::string& text);
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

// The part of a mask that has something.
TextMask without_rim(const TextMask& mask) {
    int left = mask.width_px, right = 0, top = mask.height_px, bottom = 0;
    const auto place_of = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width_px) +
               static_cast<std::size_t>(x);
    };
    for (int y = 0; y < mask.height_px; ++y) {
        for (int x = 0; x < mask.width_px; ++x) {
            if (mask.ink[place_of(x, y)] == 0 && mask.halo[place_of(x, y)] == 0) continue;
            left = std::min(left, x), right = std::max(right, x + 1);
            top = std::min(top, y), bottom = std::max(bottom, y + 1);
        }
    }
    TextMask part{
        mask.x_px + left, mask.y_px + top, std::max(0, right - left), std::max(0, bottom - top), {}, {}};
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            part.ink.push_back(mask.ink[place_of(x, y)]);
            part.halo.push_back(mask.halo[place_of(x, y)]);
        }
    }
    return part;
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

// A letter turned, with its beginning at `at`: pixels, counted as pictures are, from where FreeType counts.
Result<Glyph> letter_at(FT_Face face, std::uint32_t glyph, FT_Matrix turn, const glm::dvec2& at) {
    ORO_CHECK(done("a letter cannot be read", FT_Load_Glyph(face, glyph, as_drawn)));
    FT_Glyph loaded{};
    ORO_CHECK(done("a letter cannot be read", FT_Get_Glyph(face->glyph, &loaded)));
    Glyph shape(loaded);
    FT_Vector to{in_64ths(at.x), in_64ths(-at.y)};
    ORO_CHECK(done("a letter cannot be turned", FT_Glyph_Transform(shape.get(), &turn, &to)));
    return shape;
}

}  // namespace

// Kept, as long as there are not too many.
Result<const ShapedText*> TextFace::Parts::shape(const std::string& text) {
    constexpr std::size_t most = 20'000;
    if (const auto known = texts.find(text); known != texts.end()) return &known->second;
    ORO_TRY(ShapedText made, shaped(font.get(), text));
    if (texts.size() >= most) texts.clear();
    return &texts.emplace(text, std::move(made)).first->second;
}

Result<TextFace> TextFace::open() {
    std::unique_ptr<Parts, Ending> parts(new Parts);
    ORO_CHECK(done("FreeType does not start", FT_Init_FreeType(&parts->library)));
    ORO_CHECK(done("the font cannot be read",
                   FT_New_Memory_Face(parts->library, font_file, static_cast<FT_Long>(font_file_bytes), 0,
                                      &parts->face)));
    parts->font = shaping_font(font_file, font_file_bytes);
    return TextFace(std::move(parts));
}

Result<double> TextFace::width_px(const std::string& text, double size_px) const {
    assert(size_px > 0.0);
    ORO_TRY(const ShapedText* const letters, parts_->shape(text));
    return letters->width_em * size_px;
}

Result<bool> TextFace::has_all(const std::string& text) const {
    ORO_TRY(const ShapedText* const letters, parts_->shape(text));
    return letters->is_whole;
}

Result<TextMask> TextFace::mask(const std::string& text, const TextPlace& place) const {
    const FT_Face face = parts_->face;
    ORO_TRY(const ShapedText* const letters, parts_->shape(text));
    const double length_px = letters->width_em * place.size_px;
    ORO_CHECK(done("no letters of that size",
                   FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(in_64ths(place.size_px)), 72, 72)));
    ORO_TRY(const Stroker stroker, stroker_of(parts_->library, place.halo_px));
    const double radians = place.angle_deg * std::numbers::pi / 180.0;
    const glm::dvec2 along(std::cos(radians), std::sin(radians)), up(along.y, -along.x);
    const auto fixed = [](double share) { return static_cast<FT_Fixed>(std::lround(share * 65536.0)); };
    const FT_Matrix turn{fixed(along.x), fixed(along.y), fixed(-along.y), fixed(along.x)};

    // FreeType's numbers are small: they count from a pixel near by.
    const glm::dvec2 origin(std::floor(place.middle_px.x), std::floor(place.middle_px.y));
    const glm::dvec2 begin =
        place.middle_px - origin - 0.5 * length_px * along - 0.5 * capital_share * place.size_px * up;
    const auto reach = [&](double share) {
        return static_cast<int>(
                   std::ceil(0.5 * std::abs(share) * length_px + place.size_px + place.halo_px)) +
               1;
    };
    const int across = reach(along.x), down = reach(along.y);
    TextMask mask{-across, -down, 2 * across, 2 * down, {}, {}};
    mask.ink.resize(static_cast<std::size_t>(mask.width_px) * static_cast<std::size_t>(mask.height_px));
    mask.halo.resize(mask.ink.size());
    for (const ShapedLetter& letter : letters->letters) {
        const glm::dvec2 pen = begin + place.size_px * (letter.x_em * along + letter.y_em * up);
        ORO_TRY(Glyph shape, letter_at(face, letter.glyph, turn, pen));
        if (place.halo_px > 0.0) {
            ORO_TRY(Glyph wide, widened(shape, stroker));
            ORO_CHECK(fill(std::move(wide), &TextMask::halo, mask));
        }
        ORO_CHECK(fill(std::move(shape), &TextMask::ink, mask));
    }
    mask.x_px += static_cast<int>(origin.x);
    mask.y_px += static_cast<int>(origin.y);
    return mask;
}

Result<const TextFace::Letter*> TextFace::letter(std::uint32_t glyph, int quarters,
                                                 const TextPlace& place) const {
    const std::tuple key{glyph, quarters, place.size_px, place.halo_px};
    if (const auto known = parts_->letters.find(key); known != parts_->letters.end()) return &known->second;
    const FT_Face face = parts_->face;
    ORO_CHECK(done("no letters of that size",
                   FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(in_64ths(place.size_px)), 72, 72)));
    ORO_TRY(const Stroker stroker, stroker_of(parts_->library, place.halo_px));
    const FT_Matrix level{0x10000, 0, 0, 0x10000};
    ORO_TRY(Glyph shape, letter_at(face, glyph, level, {quarters / 4.0, 0.0}));
    const int reach = static_cast<int>(std::ceil(2.0 * place.size_px + place.halo_px)) + 1;
    Letter made{{-reach, -reach, 2 * reach, 2 * reach, {}, {}}};
    made.mask.ink.resize(static_cast<std::size_t>(made.mask.width_px) *
                         static_cast<std::size_t>(made.mask.height_px));
    made.mask.halo.resize(made.mask.ink.size());
    if (place.halo_px > 0.0) {
        ORO_TRY(Glyph wide, widened(shape, stroker));
        ORO_CHECK(fill(std::move(wide), &TextMask::halo, made.mask));
    }
    ORO_CHECK(fill(std::move(shape), &TextMask::ink, made.mask));
    made.mask = without_rim(made.mask);
    return &parts_->letters.emplace(key, std::move(made)).first->second;
}

Result<void> TextFace::add_level(const std::string& text, const TextPlace& place, TextMask& mask) const {
    ORO_TRY(const ShapedText* const letters, parts_->shape(text));
    const double begin_px = place.middle_px.x - 0.5 * letters->width_em * place.size_px;
    const int base = static_cast<int>(std::lround(place.middle_px.y + 0.5 * capital_share * place.size_px));
    for (const ShapedLetter& one : letters->letters) {
        const auto quarters = static_cast<int>(std::lround(4.0 * (begin_px + place.size_px * one.x_em)));
        const int whole = static_cast<int>(std::floor(quarters / 4.0));
        ORO_TRY(const Letter* const drawn, letter(one.glyph, quarters - 4 * whole, place));
        const int down = base - static_cast<int>(std::lround(place.size_px * one.y_em));
        merge(drawn->mask, whole, down, mask);
    }
    return {};
}

}  // namespace oro
