#include "geo/pictures/exif_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oro {
namespace {

constexpr int most_exif_parts = 4'000'000;  // chunks and segments before it, as of views (picture_view.cpp)
constexpr std::uint64_t most_exif_values = 1024;

// A part of a picture that is laid out as a TIFF: offsets count from `begin`.
class ExifBlock {
  public:
    ExifBlock(PictureBytes& bytes, std::uint64_t begin, std::uint64_t size)
        : bytes_(bytes), begin_(begin), size_(size) {}

    // The place of the first directory; nothing where the block is none.
    std::optional<std::uint64_t> first_directory() {
        std::array<char, 4> mark{};
        if (size_ < 8 || !bytes_.read(begin_, mark.data(), mark.size())) return std::nullopt;
        little_ = mark[0] == 'I';
        const std::string_view read(mark.data(), mark.size());
        if (read != std::string_view("II*\0", 4) && read != std::string_view("MM\0*", 4)) return std::nullopt;
        return whole(4, 4);
    }
    ExifDirectory directory(std::uint64_t at);

  private:
    // An unsigned number of `count` bytes.
    std::optional<std::uint64_t> whole(std::uint64_t at, std::size_t count) {
        std::array<unsigned char, 8> raw{};
        if (at > size_ || count > size_ - at || !bytes_.read(begin_ + at, raw.data(), count))
            return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < count; ++i) value = value << 8U | raw[little_ ? count - 1 - i : i];
        return value;
    }
    std::optional<double> value(std::uint64_t at, std::uint64_t type);

    PictureBytes& bytes_;
    std::uint64_t begin_, size_;
    bool little_{false};
};

constexpr std::uint64_t ascii_type = 2, fraction_type = 5, signed_long_type = 9, signed_fraction_type = 10;

// TIFF 6.0, section 2: BYTE, ASCII, SHORT, LONG, RATIONAL, SBYTE, UNDEFINED, SSHORT, SLONG, SRATIONAL; then
// FLOAT and DOUBLE, which EXIF has not, and IFD, the place of a directory.
std::size_t bytes_of_type(std::uint64_t type) {
    constexpr std::array<std::size_t, 14> sizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 0, 0, 4};
    return type < sizes.size() ? sizes[type] : 0;
}

std::optional<double> ExifBlock::value(std::uint64_t at, std::uint64_t type) {
    const bool is_fraction = type == fraction_type || type == signed_fraction_type,
               is_signed = type == signed_long_type || type == signed_fraction_type;
    const std::size_t count = is_fraction ? 4 : bytes_of_type(type);
    const auto number = [&](std::uint64_t from) -> std::optional<double> {
        const auto read = whole(from, count);
        if (!read) return std::nullopt;
        const auto size = static_cast<double>(*read);
        return is_signed && *read >= std::uint64_t{1} << 31U ? size - 4294967296.0 : size;
    };
    const auto numerator = number(at);
    if (!is_fraction || !numerator) return numerator;
    const auto denominator = number(at + 4);
    if (!denominator) return std::nullopt;
    return *numerator / *denominator;
}

ExifDirectory ExifBlock::directory(std::uint64_t at) {
    ExifDirectory directory;
    const std::uint64_t entries = whole(at, 2).value_or(0);
    for (std::uint64_t i = 0; i < entries; ++i) {
        const std::uint64_t entry = at + 2 + 12 * i;
        const auto tag = whole(entry, 2), type = whole(entry + 2, 2), count = whole(entry + 4, 4);
        if (!tag || !type || !count) break;
        const std::size_t size = bytes_of_type(*type);
        if (size == 0 || *count == 0 || *count > most_exif_values) continue;
        // What fits into four bytes stands in the entry itself.
        const auto place = *count * size <= 4 ? entry + 8 : whole(entry + 8, 4);
        if (!place) break;
        std::string text;
        std::vector<double> numbers;
        bool is_whole = true;
        for (std::uint64_t j = 0; j < *count && is_whole; ++j) {
            const auto one = value(*place + j * size, *type);
            is_whole = one.has_value();
            if (is_whole && *type == ascii_type) text += static_cast<char>(static_cast<unsigned char>(*one));
            if (is_whole && *type != ascii_type) numbers.push_back(*one);
        }
        const auto key = static_cast<std::uint16_t>(*tag);
        if (is_whole && *type == ascii_type) directory.texts[key] = text.substr(0, text.find('\0'));
        if (is_whole && *type != ascii_type) directory.numbers[key] = std::move(numbers);
    }
    return directory;
}

struct ExifPlace {
    std::uint64_t begin{}, size{};
};

std::uint64_t big_endian(PictureBytes& bytes, std::uint64_t at, std::size_t count) {
    std::array<unsigned char, 4> raw{};
    std::uint64_t value = 0;
    if (!bytes.read(at, raw.data(), count)) return 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8U | raw[i];
    return value;
}

std::string text_at(PictureBytes& bytes, std::uint64_t at, std::size_t count) {
    std::string text(count, '\0');
    if (at > bytes.size() || count > bytes.size() - at || !bytes.read(at, text.data(), count)) return "";
    return text;
}

// Nothing at the end of the tags. Errors: a picture that ends before.
Result<std::optional<ExifPlace>> exif_in_jpeg(PictureBytes& bytes, const std::string& path) {
    const std::string name("Exif\0\0", 6);
    std::uint64_t at = 2;
    for (int i = 0; i < most_exif_parts && bytes.size() >= 4 && at <= bytes.size() - 4; ++i) {
        const std::uint64_t mark = big_endian(bytes, at, 2), kind = mark & 0xFFU;
        if (mark >> 8U != 0xFF) break;
        if (kind == 0xFF) {  // a fill byte
            ++at;
            continue;
        }
        if (kind == 0xDA || kind == 0xD9) return std::optional<ExifPlace>();  // the scan, the end
        const std::uint64_t length = big_endian(bytes, at + 2, 2);
        if (length < 2 || length > bytes.size() - at - 2) break;
        if (kind == 0xE1 && length > 2 + name.size() && text_at(bytes, at + 4, name.size()) == name)
            return std::optional(ExifPlace{at + 4 + name.size(), length - 2 - name.size()});
        at += 2 + length;
    }
    return Error{ErrorKind::failed, path,
                 "is damaged at byte " + std::to_string(at) + ": the JPEG ends before its picture"};
}

Result<std::optional<ExifPlace>> exif_in_png(PictureBytes& bytes, const std::string& path) {
    std::uint64_t at = 8;
    for (int i = 0; i < most_exif_parts && bytes.size() >= 12 && at <= bytes.size() - 12; ++i) {
        const std::uint64_t length = big_endian(bytes, at, 4);
        const std::string type = text_at(bytes, at + 4, 4);
        if (type == "IEND") return std::optional<ExifPlace>();
        if (length > bytes.size() - at - 12) break;
        if (type == "eXIf") return std::optional(ExifPlace{at + 8, length});
        at += length + 12;
    }
    return Error{ErrorKind::failed, path,
                 "is damaged at byte " + std::to_string(at) + ": the PNG ends before its end"};
}

}  // namespace

std::optional<double> ExifDirectory::number(std::uint16_t tag) const {
    const auto found = numbers.find(tag);
    if (found == numbers.end() || found->second.empty() || !std::isfinite(found->second.front()))
        return std::nullopt;
    return found->second.front();
}

std::string ExifDirectory::text(std::uint16_t tag) const {
    const auto found = texts.find(tag);
    return found == texts.end() ? "" : found->second;
}

Result<std::optional<ExifDirectories>> find_exif(PictureBytes& bytes, const std::string& path) {
    constexpr std::uint16_t photo_pointer = 0x8769, gps_pointer = 0x8825;
    const std::string start =
        text_at(bytes, 0, static_cast<std::size_t>(std::min<std::uint64_t>(8, bytes.size())));
    std::optional<ExifPlace> place;
    if (start.starts_with("\xFF\xD8\xFF")) {
        ORO_TRY(place, exif_in_jpeg(bytes, path));
    } else if (start == "\x89PNG\r\n\x1a\n") {
        ORO_TRY(place, exif_in_png(bytes, path));
    } else if (start.starts_with(std::string("II*\0", 4)) || start.starts_with(std::string("MM\0*", 4))) {
        place = ExifPlace{0, bytes.size()};
    } else {
        return Error{ErrorKind::failed, path, "is no JPEG, PNG or TIFF picture"};
    }
    if (!place) return std::optional<ExifDirectories>();
    ExifBlock block(bytes, place->begin, place->size);
    const auto first = block.first_directory();
    if (!first) return Error{ErrorKind::failed, path, "its EXIF is damaged: it has no directory"};
    ExifDirectories all;
    all.image = block.directory(*first);
    for (const auto& [pointer, directory] : {std::pair{photo_pointer, &all.photo}, {gps_pointer, &all.gps}})
        if (const auto at = all.image.number(pointer))
            *directory = block.directory(static_cast<std::uint64_t>(*at));
    return std::optional(std::move(all));
}

}  // namespace oro
