#include "net/long_work.h"

#include "core/thread_name.h"
#include "net/guard.h"

#include <sys/resource.h>

namespace froxel::net {
namespace {

// setpriority(2): on Linux a thread's own. A tenth of the weight of a thread that has none.
constexpr int kNiceness = 10;

} // namespace

LongWork::LongWork(uint32_t thread_count)
    : io_(static_cast<int>(thread_count)), open_(io_.get_executor()) {
    for (uint32_t i = 0; i < thread_count; ++i) {
        threads_.emplace_back([this] {
            nameThread("messages");
            setpriority(PRIO_PROCESS, 0, kNiceness); // refused: it goes on as it is
            runGuarded("long message", io_);
        });
    }
}

LongWork::~LongWork() {
    io_.stop();
}

} // namespace froxel::net
