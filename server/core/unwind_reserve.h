// Memory for destructors that allocate while they unwind: nlohmann::json's does, so that a
// std::bad_alloc that passes it would end the process.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

namespace froxel {

// While one lives, the first allocation of its thread that fails frees it and throws
// std::bad_alloc; what unwinds after that has these bytes. They are reserved, not touched: they
// take address space, no memory. At most one a thread.
class UnwindReserve {
  public:
    // Throws std::bad_alloc.
    explicit UnwindReserve(size_t bytes) {
        std::set_new_handler(onFailedNew);
        held() = std::malloc(bytes);
        if (held() == nullptr) {
            throw std::bad_alloc();
        }
    }
    ~UnwindReserve() { std::free(std::exchange(held(), nullptr)); }
    UnwindReserve(const UnwindReserve&) = delete;
    UnwindReserve& operator=(const UnwindReserve&) = delete;

  private:
    static void*& held() {
        static thread_local void* bytes = nullptr;
        return bytes;
    }
    // Of all threads; those without a reserve throw as if there were no handler.
    [[noreturn]] static void onFailedNew() {
        std::free(std::exchange(held(), nullptr));
        throw std::bad_alloc();
    }
};

} // namespace froxel
