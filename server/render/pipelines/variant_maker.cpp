#include "render/pipelines/variant_maker.h"

#include "core/thread_name.h"

#include <algorithm>
#include <unistd.h>
#include <utility>

namespace froxel::render {

VariantUses::VariantUses(VariantMaker& maker, uint64_t since, std::vector<bool*> first_uses)
    : maker_(&maker), since_(since), first_uses_(std::move(first_uses)) {
    maker.held_.insert(since);
}

VariantUses& VariantUses::operator=(VariantUses&& other) noexcept {
    if (this != &other) {
        end();
        maker_ = std::exchange(other.maker_, nullptr);
        since_ = other.since_;
        first_uses_ = std::exchange(other.first_uses_, {});
    }
    return *this;
}

void VariantUses::end() {
    for (bool* used : std::exchange(first_uses_, {})) {
        *used = true;
    }
    if (maker_ != nullptr) {
        maker_->held_.erase(maker_->held_.find(since_));
        maker_ = nullptr;
    }
}

void VariantMaker::start(int niceness, unsigned thread_count) {
    while (threads_.size() < thread_count) {
        threads_.emplace_back([this, niceness](const std::stop_token& stop) {
            nameThread("variants");
            (void)nice(niceness); // of this thread alone, on Linux
            run(stop);
        });
    }
}

void VariantMaker::stop() {
    for (std::jthread& thread : threads_) {
        thread.request_stop();
    }
    threads_.clear(); // waits for each
}

bool VariantMaker::busyFor(const void* asker) const {
    const std::lock_guard lock(mutex_);
    return queues_.count(asker) > 0;
}

void VariantMaker::post(std::function<void()> make) {
    {
        const std::lock_guard lock(mutex_);
        queues_[asker_].push_back(std::move(make));
        ++waiting_;
    }
    wake_.notify_one();
}

void VariantMaker::forget(const void* asker) {
    std::deque<std::function<void()>> dropped; // ends without the lock
    const std::lock_guard lock(mutex_);
    if (const auto queue = queues_.find(asker); queue != queues_.end()) {
        dropped.swap(queue->second);
        waiting_ -= dropped.size();
        if (!under_way_.contains(asker)) {
            queues_.erase(queue);
        }
    }
}

// One of each asker's after the other, so that who needs few does not wait for who needs many.
VariantMaker::Queues::iterator VariantMaker::nextInTurn() {
    auto next = queues_.upper_bound(last_);
    for (;; ++next) {
        if (next == queues_.end()) {
            next = queues_.begin();
        }
        if (!next->second.empty()) {
            return next;
        }
    }
}

void VariantMaker::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, stop, [&] { return waiting_ > 0; })) {
        const auto next = nextInTurn();
        const void* asker = next->first;
        auto make = std::move(next->second.front());
        next->second.pop_front();
        --waiting_;
        last_ = asker;
        under_way_.insert(asker);
        lock.unlock();
        make();
        lock.lock();
        under_way_.erase(under_way_.find(asker));
        const auto queue = queues_.find(asker);
        if (queue->second.empty() && !under_way_.contains(asker)) {
            queues_.erase(queue);
        }
        if (stop.stop_requested()) {
            return;
        }
    }
}

} // namespace froxel::render
