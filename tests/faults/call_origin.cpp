// Whose code calls: by the frames on the stack and the modules that they lie in. Allocates nothing.
#include <dlfcn.h>
#include <link.h>
#include <unwind.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <initializer_list>

#include "tests/faults/injection.h"

namespace oro::faults {
namespace {

const char* file_name(const link_map* module) {
    const char* const slash = std::strrchr(module->l_name, '/');
    return slash ? slash + 1 : module->l_name;
}

bool begins(const char* name, const char* with) {
    return std::strncmp(name, with, std::strlen(with)) == 0;
}

Origin origin_of_module(const link_map* module) {
    const char* const name = file_name(module);
    if (*name == '\0') return Origin::program;
    for (const char* neutral : {"libc.so", "libstdc++", "libgcc_s", "libm.so", "libpthread", "libdl.so",
                                "ld-linux", "libfault_injection"})
        if (begins(name, neutral)) return Origin::neutral;
    for (const char* driver :
         {"libvulkan_", "libLLVM", "libgallium", "libVkLayer", "libdrm", "libnvidia", "libGLX"})
        if (begins(name, driver)) return Origin::driver;
    return Origin::library;
}

const link_map* module_of(const void* address) {
    dl_find_object found{};
    if (_dl_find_object(const_cast<void*>(address), &found) != 0) return nullptr;
    return found.dlfo_link_map;
}

Origin origin_of(const void* address) {
    const link_map* const module = module_of(address);
    return module ? origin_of_module(module) : Origin::neutral;
}

struct Innermost {
    Origin origin{Origin::neutral};
};
_Unwind_Reason_Code take_innermost(_Unwind_Context* context, void* into) {
    auto& innermost = *static_cast<Innermost*>(into);
    innermost.origin = origin_of(reinterpret_cast<const void*>(_Unwind_GetIP(context)));
    return innermost.origin == Origin::neutral ? _URC_NO_REASON : _URC_END_OF_STACK;
}

_Unwind_Reason_Code find_driver(_Unwind_Context* context, void* into) {
    if (origin_of(reinterpret_cast<const void*>(_Unwind_GetIP(context))) != Origin::driver)
        return _URC_NO_REASON;
    *static_cast<bool*>(into) = true;
    return _URC_END_OF_STACK;
}

struct Description {
    char* text;
    std::size_t size;
    std::size_t used;
    int frames;
};
_Unwind_Reason_Code describe_frame(_Unwind_Context* context, void* into) {
    auto& description = *static_cast<Description*>(into);
    const std::uintptr_t address = _Unwind_GetIP(context);
    const link_map* const module = module_of(reinterpret_cast<const void*>(address));
    if (!module || begins(file_name(module), "libfault_injection")) return _URC_NO_REASON;
    const char* const name = *file_name(module) ? file_name(module) : "program";
    const int wrote = std::snprintf(description.text + description.used, description.size - description.used,
                                    "%s%s+0x%lx", description.used > 0 ? " " : "", name,
                                    static_cast<unsigned long>(address - module->l_addr));
    if (wrote > 0) description.used += static_cast<std::size_t>(wrote);
    const bool goes_on = ++description.frames < 24 && description.used + 80 < description.size;
    return goes_on ? _URC_NO_REASON : _URC_END_OF_STACK;
}

}  // namespace

Origin origin_of_call(const void* caller) {
    if (caller) {
        const Origin direct = origin_of(caller);
        if (direct != Origin::neutral) return direct;
    }
    Innermost innermost;
    _Unwind_Backtrace(&take_innermost, &innermost);
    return innermost.origin;
}

bool is_in(const char* library, const void* address) {
    const link_map* const module = module_of(address);
    return module && begins(file_name(module), library);
}

bool driver_on_stack() {
    bool found = false;
    _Unwind_Backtrace(&find_driver, &found);
    return found;
}

void describe_stack(char* text, unsigned long size) {
    text[0] = '\0';
    Description description{text, size, 0, 0};
    _Unwind_Backtrace(&describe_frame, &description);
}

}  // namespace oro::faults
