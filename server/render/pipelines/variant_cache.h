// Compiled variants of one kind of pipeline, by key: a bounded number of them.
#pragma once

#include "gpu/command_context.h"
#include "render/pipelines/variant_maker.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace froxel::render {

// One thread, the timeline's. Whoever asks for a variant records it into the next submission.
template <class Key, class Pipeline = vk::raii::Pipeline, class Timeline = gpu::Timeline>
class VariantCache {
  public:
    // Past `limit` variants the one that was not used for longest goes, unless a frame that is
    // not finished uses it: so a frame that needs more of them has more.
    VariantCache(const Timeline& timeline, VariantMaker& maker, size_t limit)
        : timeline_(timeline), maker_(maker), limit_(limit) {}

    // Throws VariantsMissing where the maker is in the background and has it not yet. `make` runs
    // on one of its threads then, beside others, when what it refers to must still be there.
    template <class Make>
    [[nodiscard]] const Pipeline& findOrMake(const Key& key, const Make& make) {
        if (!prepare(key, make)) {
            throw VariantsMissing();
        }
        Entry& entry = entries_.find(key)->second;
        entry.first_use.note(maker_);
        entry.last_use = timeline_.next();
        return entry.pipeline;
    }

    // Whether findOrMake() has it; asks for it where not. Rethrows what making it threw.
    template <class Make>
    [[nodiscard]] bool prepare(const Key& key, const Make& make) {
        if (entries_.count(key) > 0) {
            return true;
        }
        if (!maker_.inBackground()) {
            makeRoom();
            keep(key, make());
            return true;
        }
        auto asked = asked_.find(key);
        if (asked == asked_.end()) {
            forgetUnwanted();
            asked = asked_.emplace(key, std::make_shared<Making>()).first;
        }
        if (!asked->second->done) { // whoever else asked for it: in this one's turn too
            if (std::exchange(asked->second->asked_in, maker_.recording()) != maker_.recording()) {
                maker_.post([making = asked->second, make] { making->run(make); });
            }
            return false;
        }
        const auto making = std::move(asked->second);
        asked_.erase(asked);
        if (making->error) {
            std::rethrow_exception(making->error);
        }
        makeRoom();
        keep(key, std::move(*making->pipeline));
        return true;
    }

    // It is there, and nothing has used it: see FirstUse.
    [[nodiscard]] bool isNew(const Key& key) const {
        const auto found = entries_.find(key);
        return found != entries_.end() && found->second.first_use.isNew(maker_);
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
        FirstUse first_use;
    };
    // What another thread makes.
    struct Making {
        std::optional<Pipeline> pipeline;
        std::exception_ptr error;
        std::atomic<bool> done = false;
        std::mutex mutex;      // of who makes it
        uint64_t asked_in = 0; // the last recording that asked; of the timeline's thread

        // Of several who asked the first in turn makes it.
        template <class Make>
        void run(const Make& make) {
            const std::lock_guard lock(mutex);
            if (done) {
                return;
            }
            try {
                pipeline.emplace(make());
            } catch (...) {
                error = std::current_exception();
            }
            done = true;
        }
    };

    // Past the limit what was made goes that nobody came for.
    void forgetUnwanted() {
        if (asked_.size() >= limit_) {
            std::erase_if(asked_, [](const auto& entry) { return entry.second->done.load(); });
        }
    }

    // As if it were used by the next submission, for which it is meant.
    void keep(const Key& key, Pipeline pipeline) {
        entries_.emplace(key, Entry{std::move(pipeline), timeline_.next(), {}});
    }

    void makeRoom() {
        if (entries_.size() < limit_) {
            return;
        }
        const uint64_t completed = std::min(timeline_.completed(), maker_.heldSince() - 1);
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
    VariantMaker& maker_;
    size_t limit_;
    std::map<Key, Entry> entries_;
    std::map<Key, std::shared_ptr<Making>> asked_;
};

} // namespace froxel::render
