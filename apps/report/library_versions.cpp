#include "apps/report/library_versions.h"

#include <erfaextra.h>
#include <freetype/freetype.h>
#include <ft2build.h>
#include <hb.h>
#include <vulkan/vulkan_core.h>
#include <xxhash.h>
#include <zstd.h>

#include <utility>

namespace oro {
namespace {

template <class... Numbers>
std::string dotted(Numbers... numbers) {
    std::string text;
    ((text += (text.empty() ? "" : ".") + std::to_string(numbers)), ...);
    return text;
}

std::string vulkan_headers() {
    constexpr std::uint32_t version = VK_HEADER_VERSION_COMPLETE;
    return dotted(VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                  VK_API_VERSION_PATCH(version));
}

}  // namespace

std::vector<LibraryVersion> library_versions() {
    std::vector<LibraryVersion> all = {
        {"zstd", "zstd", ZSTD_versionString()},
        {"xxhash", "xxHash", dotted(XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE)},
        {"erfa", "ERFA", eraVersion()},
        {"freetype", "FreeType", dotted(FREETYPE_MAJOR, FREETYPE_MINOR, FREETYPE_PATCH)},
        {"harfbuzz", "HarfBuzz", hb_version_string()},
        {"vulkan_headers", "Vulkan headers", vulkan_headers()}};
    for (LibraryVersion& library : package_versions()) all.push_back(std::move(library));
    return all;
}

}  // namespace oro
