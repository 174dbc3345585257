#include "still/still_store.h"

#include <utility>

namespace froxel::still {

uint64_t StillStore::weightOf(const std::string& tag, const SharedBytes& bytes) {
    constexpr uint64_t kOfAnEntry = 256;
    return bytes->size() + 2 * tag.size() + kOfAnEntry;
}

SharedBytes StillStore::find(const std::string& tag) {
    const auto found = by_tag_.find(tag);
    if (found == by_tag_.end()) {
        return nullptr;
    }
    newest_first_.splice(newest_first_.begin(), newest_first_, found->second);
    return found->second->bytes;
}

void StillStore::keep(const std::string& tag, SharedBytes bytes) {
    const uint64_t weight = weightOf(tag, bytes);
    if (weight > most_bytes_ / 4) {
        return;
    }
    if (const auto before = by_tag_.find(tag); before != by_tag_.end()) {
        drop(before->second);
    }
    bytes_ += weight;
    newest_first_.push_front({tag, std::move(bytes)});
    by_tag_[tag] = newest_first_.begin();
    while (bytes_ > most_bytes_) {
        drop(std::prev(newest_first_.end()));
    }
}

void StillStore::drop(std::list<Kept>::iterator kept) {
    bytes_ -= weightOf(kept->tag, kept->bytes);
    by_tag_.erase(kept->tag);
    newest_first_.erase(kept);
}

} // namespace froxel::still
