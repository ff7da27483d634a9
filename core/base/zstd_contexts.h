// What zstd keeps for pressing and unpacking, lent from call to call; not to be had without memory.
#pragma once

#include <zstd.h>

#include <cstddef>
#include <memory>

#include "core/base/pooled_object.h"

namespace oro {

template <class Context, std::size_t (*destroy)(Context*)>
struct DestroyZstd {
    void operator()(Context* context) const { destroy(context); }
};
using ZstdCompressor = std::unique_ptr<ZSTD_CCtx, DestroyZstd<ZSTD_CCtx, ZSTD_freeCCtx>>;
using ZstdDecompressor = std::unique_ptr<ZSTD_DCtx, DestroyZstd<ZSTD_DCtx, ZSTD_freeDCtx>>;
inline ZstdCompressor new_zstd_compressor() {
    return ZstdCompressor(ZSTD_createCCtx());
}
inline ZstdDecompressor new_zstd_decompressor() {
    return ZstdDecompressor(ZSTD_createDCtx());
}
using ZstdPacker = PooledObject<ZstdCompressor, new_zstd_compressor>;
using ZstdUnpacker = PooledObject<ZstdDecompressor, new_zstd_decompressor>;

}  // namespace oro
