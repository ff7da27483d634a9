// Any text as a baked region's description: a region whose own description reads the same, or one line of
// error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geo/region/region_description.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto region =
        oro::region_from_description(std::string(reinterpret_cast<const char*>(data), size), "file");
    if (!region.ok()) {
        if (region.error().line().find('\n') != std::string::npos) std::abort();
        return 0;
    }
    const std::string text = oro::region_description(*region);
    const auto again = oro::region_from_description(text, "file");
    if (!again.ok() || oro::region_description(*again) != text) std::abort();
    return 0;
}
