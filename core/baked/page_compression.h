// The heights and node numbers of a page, pressed into few bytes without loss.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "shaders/shared.h"

namespace oro {

// What a page's block on the GPU is made from, beside its record (core/lod/pyramid.h).
struct PagePayload {
    // H of the posts, row by row from post (-1, -1): 129 x 129 and one more on each side; void_height_m where
    // there is none, else finite.
    std::array<float, gpu::page_heights> H_m;
    // Of the page's nodes, row by row, as in gpu::MeshletBounds; finite.
    std::array<float, gpu::meshlets_per_page> error_m;
    std::array<float, gpu::meshlets_per_page> lod_radius_m;
};

// No payload takes more bytes than this, whatever it holds.
inline constexpr std::size_t largest_payload_bytes = 73'728;

// The payload in bytes, the same for the same numbers. All must be finite. Heights that are whole metres
// within int16 take 2 bytes a post before zstd, others 4; each is kept as its difference from the plane
// through its three neighbours to the north-west, the bytes of one weight together. Safe to call from several
// threads. On SRTM3 of the Alps 0.7 bytes a post. Errors: what zstd says when it fails. Memory that is
// lacking is an exception, as everywhere.
[[nodiscard]] Result<std::vector<std::byte>> encode_payload(const PagePayload& payload);

// The inverse, to the bit. Any bytes may be given: nothing when they are a payload, else what is wrong with
// them, in words that follow "the payload"; `payload` is then of no use.
[[nodiscard]] std::optional<std::string> decode_payload(std::span<const std::byte> bytes,
                                                        PagePayload& payload);

}  // namespace oro
