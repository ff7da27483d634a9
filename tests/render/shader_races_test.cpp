// What several invocations write is only touched by atomics: of the compiled shaders, word by word
// (SPIR-V 1.6, 3.49: opcodes; 2.3: layout).
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <span>

#include "spirv/lod_test_comp.h"
#include "spirv/raster_clip_comp.h"
#include "spirv/raster_comp.h"
#include "spirv/raster_large_comp.h"

namespace {

using Words = std::span<const std::uint32_t>;
constexpr std::uint32_t op_type_int = 21, op_type_pointer = 32, op_variable = 59, op_load = 61, op_store = 62,
                        op_access_chain = 65, op_atomic_load = 227, op_atomic_umax = 239;
constexpr std::uint32_t workgroup = 4, physical_storage_buffer = 5349;

// Calls visit(opcode, the instruction's words) for each instruction of a module.
template <class Visit>
void for_each_instruction(Words module, const Visit& visit) {
    constexpr std::size_t header = 5;
    for (std::size_t at = header; at < module.size();) {
        const std::uint32_t count = module[at] >> 16U;
        ASSERT_GT(count, 0U);
        visit(module[at] & 0xffffU, module.subspan(at, count));
        at += count;
    }
}

// How the words of 64 bits in buffers, which are those of the visibility buffer alone, are touched.
struct Touches {
    int plain{};
    int atomic_loads{};
    int atomic_maxima{};
};
Touches touches_of_visibility(Words module) {
    std::set<std::uint32_t> integers, pointers, places;
    Touches touches;
    for_each_instruction(module, [&](std::uint32_t opcode, Words words) {
        if (opcode == op_type_int && words[2] == 64 && words[3] == 0) integers.insert(words[1]);
        if (opcode == op_type_pointer && words[2] == physical_storage_buffer && integers.contains(words[3]))
            pointers.insert(words[1]);
        if (opcode == op_access_chain && pointers.contains(words[1])) places.insert(words[2]);
        if (opcode == op_load && places.contains(words[3])) ++touches.plain;
        if (opcode == op_store && places.contains(words[1])) ++touches.plain;
        if (opcode == op_atomic_load && places.contains(words[3])) ++touches.atomic_loads;
        if (opcode == op_atomic_umax && places.contains(words[3])) ++touches.atomic_maxima;
    });
    return touches;
}

TEST(ShaderRaces, TheVisibilityBufferIsAtomic) {
    for (const Words module :
         {Words(raster_comp_spirv), Words(raster_clip_comp_spirv), Words(raster_large_comp_spirv)}) {
        const Touches touches = touches_of_visibility(module);
        EXPECT_EQ(touches.plain, 0);
        EXPECT_GT(touches.atomic_loads, 0);
        EXPECT_GT(touches.atomic_maxima, 0);
    }
}

// `live` of lod_test.comp: stored once, by one invocation before the barrier; raised by atomics.
TEST(ShaderRaces, SharedFlagsAreRaisedByAtomics) {
    std::set<std::uint32_t> integers, pointers, flags;
    int stores = 0;
    for_each_instruction(Words(lod_test_comp_spirv), [&](std::uint32_t opcode, Words words) {
        if (opcode == op_type_int && words[2] == 32) integers.insert(words[1]);
        if (opcode == op_type_pointer && words[2] == workgroup && integers.contains(words[3]))
            pointers.insert(words[1]);
        if (opcode == op_variable && pointers.contains(words[1])) flags.insert(words[2]);
        if (opcode == op_store && flags.contains(words[1])) ++stores;
    });
    EXPECT_EQ(flags.size(), 1U);
    EXPECT_EQ(stores, 1);
}

}  // namespace
