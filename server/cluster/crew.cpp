#include "cluster/crew.h"

#include "core/assert.h"
#include "core/thread_name.h"

namespace froxel::cluster {

Crew::Crew(unsigned members) {
    FROXEL_ASSERT(members > 0, "a crew needs a member");
    threads_.reserve(members - 1);
    for (unsigned member = 1; member < members; ++member) {
        threads_.emplace_back([this, member] {
            nameThread("crew");
            work(member);
        });
    }
}

Crew::~Crew() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    begin_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void Crew::run(unsigned count, const std::function<void(unsigned)>& job) noexcept {
    FROXEL_ASSERT(count > 0 && count <= members(), "a job for members that exist");
    if (count > 1) {
        {
            const std::lock_guard lock(mutex_);
            job_ = &job;
            count_ = count;
            remaining_ = count - 1;
            ++round_;
        }
        begin_.notify_all();
    }
    job(0);
    if (count > 1) {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [this] { return remaining_ == 0; });
    }
}

void Crew::work(unsigned member) {
    uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        begin_.wait(lock, [&] { return stopping_ || round_ != seen; });
        if (stopping_) {
            return;
        }
        seen = round_;
        if (member >= count_) {
            continue;
        }
        const auto& job = *job_;
        lock.unlock();
        job(member);
        lock.lock();
        if (--remaining_ == 0) {
            done_.notify_one();
        }
    }
}

} // namespace froxel::cluster
