// Compiled variants of one kind of pipeline, by key: a bounded number of them.
#pragma once

#include "gpu/command_context.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

namespace froxel::render {

// One thread, the timeline's. Whoever asks for a variant records it into the next submission.
template <class Key, class Pipeline = vk::raii::Pipeline, class Timeline = gpu::Timeline>
class VariantCache {
  public:
    // Past `limit` variants the one that was not used for longest goes, unless a frame that is
    // not finished uses it: so a frame that needs more of them has more.
    VariantCache(const Timeline& timeline, size_t limit) : timeline_(timeline), limit_(limit) {}

    template <class Make>
    [[nodiscard]] const Pipeline& findOrMake(const Key& key, Make make) {
        auto found = entries_.find(key);
        if (found == entries_.end()) {
            makeRoom();
            found = entries_.emplace(key, Entry{make(), 0}).first;
        }
        found->second.last_use = timeline_.next();
        return found->second.pipeline;
    }

    template <class Visit>
    void forEachKey(Visit visit) const {
        for (const auto& [key, entry] : entries_) {
            visit(key);
        }
    }

  private:
    struct Entry {
        Pipeline pipeline;
        uint64_t last_use; // the timeline's value once its frame is finished
    };

    void makeRoom() {
        if (entries_.size() < limit_) {
            return;
        }
        const uint64_t completed = timeline_.completed();
        while (entries_.size() >= limit_) {
            const auto oldest = std::min_element(
                entries_.begin(), entries_.end(),
                [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; });
            if (oldest == entries_.end() || oldest->second.last_use > completed) {
                return;
            }
            entries_.erase(oldest);
        }
    }

    const Timeline& timeline_;
    size_t limit_;
    std::map<Key, Entry> entries_;
};

} // namespace froxel::render
