// The words of --pipeline: the one table that options, views and devices read them by.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace oro {

enum class RasterRequest { automatic, mesh, compute };

inline constexpr std::array<std::pair<const char*, RasterRequest>, 3> raster_requests{
    {{"auto", RasterRequest::automatic}, {"mesh", RasterRequest::mesh}, {"compute", RasterRequest::compute}}};

// What a word stands for; nothing for all others.
inline std::optional<RasterRequest> raster_request_named(std::string_view word) {
    const auto found = std::find_if(raster_requests.begin(), raster_requests.end(),
                                    [&](const auto& request) { return word == request.first; });
    if (found == raster_requests.end()) return std::nullopt;
    return found->second;
}

}  // namespace oro
