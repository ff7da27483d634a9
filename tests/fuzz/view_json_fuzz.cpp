// Any bytes as a picture, and as the XMP of one: a view, or one line of error; never a read outside the
// bytes.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "geo/pictures/geotags_xmp.h"
#include "geo/pictures/picture_view.h"

namespace {

class MemoryBytes final : public oro::PictureBytes {
  public:
    MemoryBytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    [[nodiscard]] std::uint64_t size() const override { return size_; }
    bool read(std::uint64_t offset, void* to, std::size_t count) override {
        if (offset > size_ || count > size_ - offset) std::abort();
        if (count != 0) std::memcpy(to, data_ + offset, count);
        return true;
    }

  private:
    const std::uint8_t* data_;
    std::uint64_t size_;
};

void check(const oro::Result<std::string>& view) {
    if (view.ok() ? view->empty() : view.error().line().find('\n') != std::string::npos) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    MemoryBytes bytes(data, size);
    check(oro::find_view_json(bytes, "picture"));
    check(oro::view_in_xmp(std::string(reinterpret_cast<const char*>(data), size), "picture"));
    return 0;
}
