#include "core/made/fbm_octaves.h"

#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <immintrin.h>
#define ORO_HAS_LANES
#endif

namespace oro {
namespace {

#ifdef ORO_HAS_LANES

// The compiler's own headers make numbers of nothing where a mask leaves none of them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"

// The two highest bits of a hash, and the fourth, pick an edge: made_corner() of the shaders has edges 0 to
// 15 in the highest four bits. Below 8: the first is 0. Below 4: the first two are. 12 or 14: 11x0.

#pragma GCC push_options
#pragma GCC target("avx2")
namespace eight {

using Ints = std::int32_t __attribute__((vector_size(32)));
using Uints = std::uint32_t __attribute__((vector_size(32)));

inline Ints upper(__m256i of_even, __m256i of_odd) {
    return (Ints)_mm256_blend_epi32(_mm256_srli_epi64(of_even, 32), of_odd, 0xaa);
}
inline Ints made_high(Ints a, Ints b) {
    return upper(_mm256_mul_epi32((__m256i)a, (__m256i)b),
                 _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32)));
}
inline Uints made_high(Uints a, Uints b) {
    return (Uints)upper(
        _mm256_mul_epu32((__m256i)a, (__m256i)b),
        _mm256_mul_epu32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32)));
}
// b where the highest bit of `where` is set, else a.
inline Ints chosen(Ints a, Ints b, Uints where) {
    return (Ints)_mm256_blendv_ps((__m256)a, (__m256)b, (__m256)where);
}
inline Ints made_corner(Uints h, Ints dx, Ints dy, Ints dz) {
    const Ints u = chosen(dx, dy, h);
    const Ints v = chosen(chosen(dy, dz, h | (h << 1U)), dx, h & (h << 1U) & ~(h << 3U));
    return (Ints)_mm256_sign_epi32((__m256i)u, (__m256i)((h << 31U) | 1U)) +
           (Ints)_mm256_sign_epi32((__m256i)v, (__m256i)(((h >> 1U) << 31U) | 1U));
}
#include "core/made/fbm_lanes.h"

}  // namespace eight
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f")
namespace sixteen {

using Ints = std::int32_t __attribute__((vector_size(64)));
using Uints = std::uint32_t __attribute__((vector_size(64)));

inline __m512i upper(__m512i of_even, __m512i of_odd) {
    return _mm512_mask_shuffle_epi32(of_odd, 0x5555, of_even, _MM_PERM_DDBB);
}
inline Ints made_high(Ints a, Ints b) {
    return (Ints)upper(
        _mm512_mul_epi32((__m512i)a, (__m512i)b),
        _mm512_mul_epi32(_mm512_srli_epi64((__m512i)a, 32), _mm512_srli_epi64((__m512i)b, 32)));
}
inline Uints made_high(Uints a, Uints b) {
    return (Uints)upper(
        _mm512_mul_epu32((__m512i)a, (__m512i)b),
        _mm512_mul_epu32(_mm512_srli_epi64((__m512i)a, 32), _mm512_srli_epi64((__m512i)b, 32)));
}
inline __m512i bits(std::uint32_t set) {
    return _mm512_set1_epi32(static_cast<int>(set));
}
inline Ints made_corner(Uints hash, Ints dx, Ints dy, Ints dz) {
    const auto h = (__m512i)hash;
    const __mmask16 from_8 = _mm512_cmplt_epi32_mask(h, _mm512_setzero_si512());
    const __mmask16 from_4 = _mm512_test_epi32_mask(h, bits(0xc0000000U));
    const __mmask16 is_12_or_14 =
        _mm512_cmpeq_epi32_mask(_mm512_and_si512(h, bits(0xd0000000U)), bits(0xc0000000U));
    const __m512i u = _mm512_mask_mov_epi32((__m512i)dx, from_8, (__m512i)dy);
    const __m512i v = _mm512_mask_mov_epi32(_mm512_mask_mov_epi32((__m512i)dy, from_4, (__m512i)dz),
                                            is_12_or_14, (__m512i)dx);
    const __m512i of_u =
        _mm512_mask_sub_epi32(u, _mm512_test_epi32_mask(h, bits(1)), _mm512_setzero_si512(), u);
    return (Ints)_mm512_mask_sub_epi32(_mm512_add_epi32(of_u, v), _mm512_test_epi32_mask(h, bits(2)), of_u,
                                       v);
}
#include "core/made/fbm_lanes.h"

}  // namespace sixteen
#pragma GCC pop_options

#pragma GCC diagnostic pop
#endif

}  // namespace

AddOctave octaves_by_eight() {
#ifdef ORO_HAS_LANES
    if (__builtin_cpu_supports("avx2")) return eight::add_octave;
#endif
    return nullptr;
}

AddOctave octaves_by_sixteen() {
#ifdef ORO_HAS_LANES
    if (__builtin_cpu_supports("avx512f")) return sixteen::add_octave;
#endif
    return nullptr;
}

AddRidgedOctave ridged_octaves_by_eight() {
#ifdef ORO_HAS_LANES
    if (__builtin_cpu_supports("avx2")) return eight::add_ridged_octave;
#endif
    return nullptr;
}

AddRidgedOctave ridged_octaves_by_sixteen() {
#ifdef ORO_HAS_LANES
    if (__builtin_cpu_supports("avx512f")) return sixteen::add_ridged_octave;
#endif
    return nullptr;
}

}  // namespace oro
