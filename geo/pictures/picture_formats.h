// What the three picture formats share: not for use outside picture*.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"
#include "geo/files/whole_file.h"
#include "geo/pictures/geotags_exif.h"
#include "geo/pictures/picture.h"

namespace oro {

struct PictureParts {
    WholeFile file;
    std::string path;
    int width_px{};
    int height_px{};
    ExifFields exif;
    std::string xmp;
    int channels{3};                   // 4: opacity is the last
    std::optional<GeoTiffTags> place;  // of a map, in a TIFF
};

// The order of rows, the first fault and the file, for an encoder that is given one row at a time. After a
// fault the temporary file is gone and every call returns that fault.
class EncodedPicture : public PictureWriter {
  public:
    Result<void> write_row(std::span<const std::uint8_t> rgb) final;
    Result<void> finish() final;
    Result<WholeFile> finished_file() final;

  protected:
    explicit EncodedPicture(PictureParts parts);

    // Each returns false after note()ing why, or after put() failed.
    virtual bool begin() = 0;
    virtual bool encode_row(const std::uint8_t* rgb) = 0;
    virtual bool end() = 0;
    // Frees the encoder; may be called twice, and must be called by the destructor of each format.
    virtual void release() noexcept = 0;

    // Keeps the first fault. The libraries' C frames may be jumped over afterwards: nothing here is left half
    // done.
    void note(const std::string& what);
    [[nodiscard]] bool faulty() const { return fault_.has_value(); }
    // Appends to the file; false after a fault.
    bool put(const void* bytes, std::size_t count);
    [[nodiscard]] std::FILE* stream() { return parts_.file.stream(); }
    [[nodiscard]] const PictureParts& parts() const { return parts_; }

    // begin(), as a factory does it.
    template <class Format>
    static Result<std::unique_ptr<PictureWriter>> started(std::unique_ptr<Format> picture) {
        if (!picture->begin()) return picture->fail();
        return std::unique_ptr<PictureWriter>(std::move(picture));
    }

  private:
    Error fail();

    PictureParts parts_;
    int rows_{0};
    bool finished_{false};
    std::optional<Error> fault_;
};

// Errors: more pixels than the format can hold (usage), tags too large for it, the file's.
Result<std::unique_ptr<PictureWriter>> create_png(PictureParts parts);
Result<std::unique_ptr<PictureWriter>> create_jpeg(PictureParts parts);
Result<std::unique_ptr<PictureWriter>> create_tiff(PictureParts parts);

}  // namespace oro
