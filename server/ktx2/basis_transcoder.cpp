#include "ktx2/basis_transcoder.h"

#include "core/assert.h"
#include "core/text.h"

#include <algorithm>
#include <array>
#include <basis.h>
#include <basis_names.h>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <type_traits>

// Where the module ends that does what it must not, or gives up.
extern "C" [[noreturn]] void froxelBasisTrap(wasm_rt_trap_t code);

namespace {

using froxel::Error;
using froxel::ErrorCode;
using froxel::numberText;
using froxel::Result;

struct Trap {
    wasm_rt_trap_t code;
};

// One that emscripten's embind tells of while the module starts.
struct Function {
    u32 invoker = 0; // in the module's table
    u32 context = 0; // its first argument
    std::string signature;
};

// The few JavaScript values that the transcoder handles: an array of bytes in, one out, and views
// of its own memory, which it makes to copy from and to. Any other number is the address of a text,
// of the name of a property.
enum Value : u32 { kFile = 1, kLength, kHeap, kBuffer, kArrayType, kView, kPicture };

constexpr u32 kRgba32 = 13; // transcoder_texture_format
constexpr u32 kNoChannel = 0xffffffffU;
constexpr uint64_t kPageBytes = 65536;
constexpr uint64_t kMaxMemoryBytes = 2ULL << 30U; // as emscripten has it

} // namespace

// The module knows its embedder by this name.
struct BASIS_HOST {
    BASIS_MODULE module{};
    std::span<const std::byte> file;
    std::span<std::byte> picture; // the level that is being transcoded
    u32 view_at = 0;
    u32 view_bytes = 0;
    u32 file_class = 0; // embind's number of KTX2File
    Function constructor;
    std::map<std::string, Function, std::less<>> functions; // of KTX2File, and those of no class

    [[nodiscard]] std::span<std::byte> memory(u32 at, u32 size) {
        const auto* all = EXPORT_wasmMemory(&module);
        if (at > all->size || size > all->size - at) {
            throw Trap{WASM_RT_TRAP_OOB};
        }
        return {reinterpret_cast<std::byte*>(all->data) + at, size};
    }
    [[nodiscard]] u32 word(u32 at) {
        u32 value = 0;
        std::memcpy(&value, memory(at, sizeof value).data(), sizeof value);
        return value;
    }
    [[nodiscard]] std::string_view text(u32 at) {
        const auto size = static_cast<u32>(EXPORT_wasmMemory(&module)->size);
        const auto left = memory(at, size - std::min(at, size));
        const std::string_view rest(reinterpret_cast<const char*>(left.data()), left.size());
        const size_t end = rest.find('\0');
        if (end == std::string_view::npos) {
            throw Trap{WASM_RT_TRAP_OOB};
        }
        return rest.substr(0, end);
    }
};

using Host = BASIS_HOST;

void froxelBasisTrap(wasm_rt_trap_t code) {
    throw Trap{code};
}

// What the module imports. Of embind's registrations those of functions count.
void IMPORT_embind_register_class(
    Host* host, u32 number, u32, u32, u32, u32, u32, u32, u32, u32, u32, u32 name, u32, u32) {
    if (host->text(name) == "KTX2File") {
        host->file_class = number;
    }
}
void IMPORT_embind_register_class_constructor(
    Host* host, u32 of, u32, u32, u32 signature, u32 invoker, u32 context) {
    if (of == host->file_class) {
        host->constructor = {invoker, context, std::string(host->text(signature))};
    }
}
void IMPORT_embind_register_class_function(
    Host* host, u32 of, u32 name, u32, u32, u32 signature, u32 invoker, u32 context, u32, u32) {
    if (of == host->file_class) {
        host->functions[std::string(host->text(name))] = {invoker, context,
                                                          std::string(host->text(signature))};
    }
}
void IMPORT_embind_register_function(
    Host* host, u32 name, u32, u32, u32 signature, u32 invoker, u32 function, u32) {
    host->functions[std::string(host->text(name))] = {invoker, function,
                                                      std::string(host->text(signature))};
}
void IMPORT_embind_register_void(Host*, u32, u32) {}
void IMPORT_embind_register_bool(Host*, u32, u32, u32, u32) {}
void IMPORT_embind_register_integer(Host*, u32, u32, u32, u32, u32) {}
void IMPORT_embind_register_bigint(Host*, u32, u32, u32, u32, u32, u32, u32) {}
void IMPORT_embind_register_float(Host*, u32, u32, u32) {}
void IMPORT_embind_register_std_string(Host*, u32, u32) {}
void IMPORT_embind_register_std_wstring(Host*, u32, u32, u32) {}
void IMPORT_embind_register_emval(Host*, u32) {}
void IMPORT_embind_register_memory_view(Host*, u32, u32, u32) {}
void IMPORT_embind_register_constant(Host*, u32, u32, f64) {}
void IMPORT_embind_register_enum(Host*, u32, u32, u32, u32) {}
void IMPORT_embind_register_enum_value(Host*, u32, u32, u32) {}
void IMPORT_embind_register_value_object(Host*, u32, u32, u32, u32, u32, u32) {}
void IMPORT_embind_register_value_object_field(
    Host*, u32, u32, u32, u32, u32, u32, u32, u32, u32, u32) {}
void IMPORT_embind_finalize_value_object(Host*, u32) {}

// Values live as long as the host does.
void IMPORT_emval_incref(Host*, u32) {}
void IMPORT_emval_decref(Host*, u32) {}
void IMPORT_emval_run_destructors(Host*, u32) {}
u32 IMPORT_emval_new_cstring(Host*, u32 text) {
    return text;
}
u32 IMPORT_emval_get_module_property(Host* host, u32 name) {
    if (host->text(name) != "HEAP8") {
        throw Trap{WASM_RT_TRAP_UNREACHABLE};
    }
    return kHeap;
}
u32 IMPORT_emval_get_property(Host* host, u32 /*of*/, u32 name) {
    const std::string_view text = host->text(name);
    if (text == "byteLength" || text == "length") {
        return kLength;
    }
    if (text == "buffer") {
        return kBuffer;
    }
    if (text == "constructor") {
        return kArrayType;
    }
    throw Trap{WASM_RT_TRAP_UNREACHABLE};
}
u32 IMPORT_emval_get_global(Host* host, u32 name) {
    if (host->text(name) != "Uint8Array") {
        throw Trap{WASM_RT_TRAP_UNREACHABLE};
    }
    return kArrayType;
}
f64 IMPORT_emval_as(Host* host, u32 value, u32 /*type*/, u32 /*destructors*/) {
    if (value != kLength) {
        throw Trap{WASM_RT_TRAP_UNREACHABLE};
    }
    return static_cast<f64>(host->file.size());
}
u32 IMPORT_emval_get_method_caller(Host*, u32, u32, u32) {
    return 0;
}
// new kArrayType(kBuffer, address, size); an argument takes eight bytes.
f64 IMPORT_emval_call(Host* host, u32, u32 callee, u32 /*destructors*/, u32 arguments) {
    if (callee != kArrayType || host->word(arguments) != kBuffer) {
        throw Trap{WASM_RT_TRAP_UNREACHABLE};
    }
    host->view_at = host->word(arguments + 8);
    host->view_bytes = host->word(arguments + 16);
    return kView;
}
// to.set(from)
f64 IMPORT_emval_call_method(
    Host* host, u32, u32 to, u32 name, u32 /*destructors*/, u32 arguments) {
    const u32 from = host->word(arguments);
    const std::span<std::byte> view = host->memory(host->view_at, host->view_bytes);
    if (host->text(name) == "set" && to == kView && from == kFile &&
        view.size() == host->file.size()) {
        std::copy(host->file.begin(), host->file.end(), view.begin());
    } else if (host->text(name) == "set" && to == kPicture && from == kView &&
               view.size() == host->picture.size()) {
        std::copy(view.begin(), view.end(), host->picture.begin());
    } else {
        throw Trap{WASM_RT_TRAP_UNREACHABLE};
    }
    return 0;
}

void IMPORT_emscripten_memcpy_js(Host* host, u32 to, u32 from, u32 size) {
    std::memmove(host->memory(to, size).data(), host->memory(from, size).data(), size);
}
u32 IMPORT_emscripten_resize_heap(Host* host, u32 size) {
    auto* memory = EXPORT_wasmMemory(&host->module);
    const uint64_t pages = (uint64_t{size} + kPageBytes - 1) / kPageBytes;
    if (pages > memory->pages && pages <= kMaxMemoryBytes / kPageBytes) {
        (void)wasm_rt_grow_memory(memory, static_cast<u32>(pages - memory->pages));
    }
    return pages <= memory->pages ? 1 : 0;
}
// It writes nowhere: what it would print is its own debugging.
u32 IMPORT_fd_close(Host*, u32) {
    return 1;
}
u32 IMPORT_fd_seek(Host*, u32, u32, u32, u32, u32) {
    return 1;
}
u32 IMPORT_fd_write(Host*, u32, u32, u32, u32) {
    return 1;
}
void IMPORT_cxa_throw(Host*, u32, u32, u32) {
    throw Trap{WASM_RT_TRAP_UNCAUGHT_EXCEPTION};
}
void IMPORT_abort_js(Host*) {
    throw Trap{WASM_RT_TRAP_UNREACHABLE};
}

namespace froxel::ktx2 {
namespace {

// The module, started, with a KTX2File of the file. Throws Trap.
class Transcoder {
  public:
    explicit Transcoder(std::span<const std::byte> file) {
        static std::once_flag once;
        std::call_once(once, [] {
            wasm_rt_init();
            BASIS_INIT();
        });
        host_.file = file;
        BASIS_INSTANTIATE(&host_.module, &host_);
        try {
            EXPORT_wasm_call_ctors(&host_.module);
            call<void>(function("initializeBasis", "vp"));
            FROXEL_ASSERT(host_.constructor.signature == "ppp", "the transcoder is as expected");
            object_ = call<u32>(host_.constructor, kFile);
        } catch (...) {
            BASIS_FREE(&host_.module);
            throw;
        }
    }
    ~Transcoder() { BASIS_FREE(&host_.module); }
    Transcoder(const Transcoder&) = delete;
    Transcoder& operator=(const Transcoder&) = delete;

    [[nodiscard]] bool start() {
        return call<u32>(function("isValid", "ipp"), object_) != 0 &&
               call<u32>(function("startTranscoding", "ipp"), object_) != 0;
    }
    // After start().
    [[nodiscard]] bool level(u32 number, std::span<std::byte> rgba8) {
        constexpr u32 kLayer = 0;
        constexpr u32 kFace = 0;
        constexpr u32 kAlphaOfOpaque = 0;
        host_.picture = rgba8;
        return call<u32>(function("transcodeImage", "ipppiiiiiii"), object_, kPicture, number,
                         kLayer, kFace, kRgba32, kAlphaOfOpaque, kNoChannel, kNoChannel) != 0;
    }

  private:
    [[nodiscard]] const Function& function(std::string_view name, std::string_view signature) {
        const auto found = host_.functions.find(name);
        FROXEL_ASSERT(found != host_.functions.end() && found->second.signature == signature,
                      "the transcoder is as expected");
        return found->second;
    }
    template <class Returned, class... Arguments>
    Returned call(const Function& function, Arguments... arguments) {
        const auto* table = EXPORT_wasmTable(&host_.module);
        FROXEL_ASSERT(function.invoker < table->size, "embind tells of functions in the table");
        const auto& entry = table->data[function.invoker];
        using Invoker = Returned (*)(void*, u32, std::conditional_t<true, u32, Arguments>...);
        return reinterpret_cast<Invoker>(entry.func)(entry.module_instance, function.context,
                                                     arguments...);
    }

    Host host_;
    u32 object_ = 0;
};

} // namespace

Result<void> transcodeBasis(std::span<const std::byte> file,
                            std::span<const std::span<std::byte>> levels) {
    try {
        Transcoder transcoder(file);
        if (!transcoder.start()) {
            return Error{ErrorCode::kIo, "its tables or level index are broken"};
        }
        for (size_t i = 0; i < levels.size(); ++i) {
            if (!transcoder.level(static_cast<u32>(i), levels[i])) {
                return Error{ErrorCode::kIo, "level " + numberText(i) + " cannot be transcoded"};
            }
        }
        return {};
    } catch (const Trap& trap) {
        return Error{ErrorCode::kIo,
                     std::string("transcoding it fails: ") + wasm_rt_strerror(trap.code)};
    }
}

} // namespace froxel::ktx2
