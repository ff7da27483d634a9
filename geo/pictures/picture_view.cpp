#include "geo/pictures/picture_view.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <span>

#include "geo/pictures/geotags_xmp.h"
#include "geo/pictures/picture.h"

namespace oro {
namespace {

constexpr std::uint64_t largest_xmp = 64 << 20;
// Chunks or segments that are passed on the way to the view: a picture of 65,500 x 65,500 has some 1.6
// million. A file made of nothing but small ones would take hours.
constexpr int most_parts = 4'000'000;

// The walk through one picture to its XMP. Each format's function gives the packet, an empty one when there
// is none.
class PictureWalk {
  public:
    PictureWalk(PictureBytes& bytes, const std::string& path) : bytes_(bytes), path_(path) {}
    Result<XmpPlace> xmp();

  private:
    Result<XmpPlace> png_xmp();
    Result<XmpPlace> jpeg_xmp();
    Result<XmpPlace> tiff_xmp();
    Result<XmpPlace> tiff_packet(std::uint64_t entry, bool big);

    [[nodiscard]] Error damaged(const std::string& what, std::uint64_t at) const {
        return {ErrorKind::failed, path_, "is damaged at byte " + std::to_string(at) + ": " + what};
    }
    // One more chunk, segment or byte between them is passed.
    bool pass() { return ++passed_ <= most_parts; }
    [[nodiscard]] Error endless(std::uint64_t at) const {
        return damaged("more than " + std::to_string(most_parts) + " parts stand before a view", at);
    }
    [[nodiscard]] bool holds(std::uint64_t offset, std::uint64_t count) const {
        return offset <= bytes_.size() && count <= bytes_.size() - offset;
    }
    std::optional<std::string> text(std::uint64_t offset, std::uint64_t count) {
        if (!holds(offset, count) || count > largest_xmp) return std::nullopt;
        std::string read(count, '\0');
        if (!bytes_.read(offset, read.data(), read.size())) return std::nullopt;
        return read;
    }
    // An unsigned number of `count` <= 8 bytes, most significant first unless `little`.
    std::optional<std::uint64_t> number(std::uint64_t offset, std::size_t count, bool little) {
        std::array<unsigned char, 8> raw{};
        if (!holds(offset, count) || !bytes_.read(offset, raw.data(), count)) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < count; ++i) value = value << 8 | raw[little ? count - 1 - i : i];
        return value;
    }

    PictureBytes& bytes_;
    const std::string& path_;
    bool little_{false};  // TIFF's byte order
    int passed_{0};
};

Result<XmpPlace> PictureWalk::xmp() {
    constexpr std::size_t magic_bytes = 8;
    const std::string start = text(0, std::min<std::uint64_t>(magic_bytes, bytes_.size())).value_or("");
    if (start == "\x89PNG\r\n\x1a\n") return png_xmp();
    if (start.starts_with("\xFF\xD8\xFF")) return jpeg_xmp();
    little_ = start.starts_with("II");
    if (start.starts_with(std::string("II*\0", 4)) || start.starts_with(std::string("MM\0*", 4)) ||
        start.starts_with(std::string("II+\0", 4)) || start.starts_with(std::string("MM\0+", 4)))
        return tiff_xmp();
    return Error{ErrorKind::failed, path_, "is no PNG, JPEG or TIFF picture"};
}

// PNG specification (third edition), 5.3 and 11.3.3.4: length, type, data, CRC; iTXt is keyword 0 flag method
// language 0 translated 0 text.
Result<XmpPlace> PictureWalk::png_xmp() {
    const std::string keyword("XML:com.adobe.xmp\0", 18);
    for (std::uint64_t at = 8; at < bytes_.size();) {
        if (!pass()) return endless(at);
        const auto length = number(at, 4, false);
        const auto type = text(at + 4, 4);
        if (!length || !type || !holds(at + 8, *length + 4)) return damaged("a PNG chunk is cut off", at);
        if (*type == "IEND") break;
        // Only letters; zeros, as where a file has a hole, would be a chunk every 12 bytes.
        if (!std::all_of(type->begin(), type->end(), [](unsigned char c) { return std::isalpha(c) != 0; }))
            return damaged("a PNG chunk has no type", at);
        if (*type == "iTXt" && *length >= keyword.size() && *length <= largest_xmp) {
            const auto chunk = text(at + 4, *length + 4);
            const auto sum = number(at + 8 + *length, 4, false);
            if (!chunk || !sum) return damaged("a PNG chunk cannot be read", at);
            if (chunk->compare(4, keyword.size(), keyword) == 0) {
                if (crc32(0, reinterpret_cast<const Bytef*>(chunk->data()),
                          static_cast<uInt>(chunk->size())) != *sum)
                    return damaged("the sum of the PNG chunk with the view is wrong", at);
                const std::size_t flags = 4 + keyword.size();
                const std::size_t translated = chunk->find('\0', flags + 2);
                const std::size_t value =
                    translated == std::string::npos ? translated : chunk->find('\0', translated + 1);
                if (value == std::string::npos) return damaged("a PNG text has no end", at);
                if ((*chunk)[flags] != 0)
                    return damaged("its XMP is compressed, which Orograph does not read", at);
                return XmpPlace{at + 4 + value + 1, chunk->substr(value + 1), at + 4, *length + 4};
            }
        }
        at += *length + 12;
    }
    return XmpPlace{};
}

// ITU-T T.81, B.1.1: FF, marker, length of two bytes that counts itself; the tags stand before the first
// scan.
Result<XmpPlace> PictureWalk::jpeg_xmp() {
    const std::string name("http://ns.adobe.com/xap/1.0/\0", 29);
    for (std::uint64_t at = 2; at < bytes_.size();) {
        if (!pass()) return endless(at);
        const auto mark = number(at, 2, false);
        if (!mark || *mark >> 8 != 0xFF) return damaged("a JPEG marker is missing", at);
        const std::uint64_t kind = *mark & 0xFF;
        if (kind == 0xFF) {  // a fill byte
            ++at;
            continue;
        }
        if (kind == 0xDA || kind == 0xD9) return XmpPlace{};  // the scan, the end
        const auto length = number(at + 2, 2, false);
        if (!length || *length < 2 || !holds(at + 2, *length))
            return damaged("a JPEG segment is cut off", at);
        if (kind == 0xE1 && *length >= 2 + name.size()) {
            const auto segment = text(at + 4, *length - 2);
            if (!segment) return damaged("a JPEG segment cannot be read", at);
            if (segment->starts_with(name))
                return XmpPlace{at + 4 + name.size(), segment->substr(name.size())};
        }
        at += 2 + *length;
    }
    return damaged("the JPEG ends before its picture", bytes_.size());
}

// TIFF 6.0, section 2, and BigTIFF: the first directory's entry 700.
Result<XmpPlace> PictureWalk::tiff_xmp() {
    const bool big = number(2, 2, little_) == 43;
    const std::size_t width = big ? 8 : 4;
    const auto directory = number(big ? 8 : 4, width, little_);
    if (!directory || !holds(*directory, big ? 8 : 2))
        return damaged("the TIFF has no directory", big ? 8 : 4);
    const auto entries = number(*directory, big ? 8 : 2, little_);
    const std::uint64_t entry_bytes = 4 + 2 * width;
    const std::uint64_t first = *directory + (big ? 8 : 2);
    if (!entries || *entries > 65535 || !holds(first, *entries * entry_bytes))
        return damaged("the TIFF's directory is cut off", *directory);
    for (std::uint64_t i = 0; i < *entries; ++i) {
        constexpr std::uint64_t xmp_tag = 700;
        const std::uint64_t entry = first + i * entry_bytes;
        if (number(entry, 2, little_) == xmp_tag) return tiff_packet(entry, big);
    }
    return XmpPlace{};
}

Result<XmpPlace> PictureWalk::tiff_packet(std::uint64_t entry, bool big) {
    const std::size_t width = big ? 8 : 4;
    const auto count = number(entry + 4, width, little_);
    const auto place = number(entry + 4 + width, width, little_);
    if (!count || !place || *count <= width) return damaged("the TIFF's XMP has no place", entry);
    auto packet = text(*place, *count);
    if (!packet) return damaged("the TIFF's XMP lies outside the file", entry);
    return XmpPlace{*place, std::move(*packet)};
}

// A file that is being written, and can be read already.
class StreamBytes final : public PictureBytes {
  public:
    explicit StreamBytes(std::FILE* stream) : stream_(stream) {}
    [[nodiscard]] std::uint64_t size() const override {
        if (fseeko(stream_, 0, SEEK_END) != 0) return 0;
        return static_cast<std::uint64_t>(ftello(stream_));
    }
    bool read(std::uint64_t offset, void* to, std::size_t count) override {
        return fseeko(stream_, static_cast<off_t>(offset), SEEK_SET) == 0 &&
               std::fread(to, 1, count, stream_) == count;
    }
    bool write(std::uint64_t offset, const void* from, std::size_t count) {
        return fseeko(stream_, static_cast<off_t>(offset), SEEK_SET) == 0 &&
               std::fwrite(from, 1, count, stream_) == count && std::fflush(stream_) == 0;
    }

  private:
    std::FILE* stream_;
};

}  // namespace

Result<std::string> find_view_json(PictureBytes& bytes, const std::string& path) {
    ORO_TRY(const XmpPlace xmp, find_xmp(bytes, path));
    return view_in_xmp(xmp.packet, path);
}

Result<XmpPlace> find_xmp(PictureBytes& bytes, const std::string& path) {
    return PictureWalk(bytes, path).xmp();
}

Result<std::string> read_view_json(const std::string& path) {
    ORO_TRY(const OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    FileBytes bytes(file, size);
    return find_view_json(bytes, path);
}

Result<void> replace_in_view(WholeFile& picture, const std::string& path, const std::string& was,
                             const std::string& now) {
    assert(was.size() == now.size());
    StreamBytes bytes(picture.stream());
    const auto fault = [&] {
        return Error{ErrorKind::failed, path, "cannot be written: " + system_reason(errno)};
    };
    if (std::fflush(picture.stream()) != 0) return fault();
    ORO_TRY(XmpPlace xmp, find_xmp(bytes, path));
    const std::size_t at = xmp.packet.find(was);
    assert(at != std::string::npos);
    if (!bytes.write(xmp.at + at, now.data(), now.size())) return fault();
    if (xmp.chunk_bytes == 0) return {};
    std::string chunk(xmp.chunk_bytes, '\0');
    if (!bytes.read(xmp.chunk_at, chunk.data(), chunk.size())) return fault();
    const auto sum = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size())));
    const std::array<unsigned char, 4> stored{
        static_cast<unsigned char>(sum >> 24), static_cast<unsigned char>(sum >> 16),
        static_cast<unsigned char>(sum >> 8), static_cast<unsigned char>(sum)};
    return bytes.write(xmp.chunk_at + xmp.chunk_bytes, stored.data(), stored.size()) ? Result<void>()
                                                                                     : fault();
}

}  // namespace oro
