#include "geo/meshes/meshopt_view.h"

#include <meshoptimizer.h>

namespace oro {
namespace {

Error view_fault(const std::string& why) {
    return {ErrorKind::failed, "", why};
}

// Whether the extension has such a view; its decoders want no others.
bool is_sound(const MeshoptView& view) {
    const bool is_index = view.stride == 2 || view.stride == 4;
    if (view.mode == "TRIANGLES") return is_index && view.count % 3 == 0 && view.filter == "NONE";
    if (view.mode == "INDICES") return is_index && view.filter == "NONE";
    constexpr std::size_t largest_stride = 256;
    if (view.mode != "ATTRIBUTES" || view.stride == 0 || view.stride % 4 != 0 || view.stride > largest_stride)
        return false;
    if (view.filter == "OCTAHEDRAL") return view.stride == 4 || view.stride == 8;
    return view.filter == "NONE" || view.filter == "EXPONENTIAL" ||
           (view.filter == "QUATERNION" && view.stride == 8);
}

void undo_filter(const MeshoptView& view, std::string& bytes) {
    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
}

}  // namespace

Result<std::string> decompressed_view(const MeshoptView& view) {
    if (!is_sound(view))
        return view_fault("is no view of EXT_meshopt_compression: mode " + view.mode + ", filter " +
                          view.filter + ", stride " + std::to_string(view.stride));
    // Of equal vertices a byte may stand for some hundred.
    constexpr std::size_t most_a_byte = 1024, least_bytes = 65536;
    if (view.count > (most_a_byte * view.bytes.size() + least_bytes) / view.stride)
        return view_fault("promises " + std::to_string(view.count) +
                          " elements, more than its bytes can hold");
    std::string bytes(view.count * view.stride, '\0');
    const auto* const from = reinterpret_cast<const unsigned char*>(view.bytes.data());
    const auto failed = [&] {
        if (view.mode == "TRIANGLES")
            return meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride, from, view.bytes.size());
        if (view.mode == "INDICES")
            return meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride, from,
                                               view.bytes.size());
        return meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride, from, view.bytes.size());
    }();
    if (view.count > 0 && failed != 0) return view_fault("is damaged: it cannot be decompressed");
    undo_filter(view, bytes);
    return bytes;
}

}  // namespace oro
