#include "catalogue/catalogue.h"

#include "core/is_inside.h"
#include "core/scene_file.h"
#include "core/text.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <sys/stat.h>
#include <system_error>
#include <utility>

namespace froxel::catalogue {
namespace {

namespace fs = std::filesystem;

// FNV-1a, 64 bits: its constants are the function's own.
uint64_t hashOf(std::string_view text, uint64_t hash = 14'695'981'039'346'656'037U) {
    for (const char letter : text) {
        hash = (hash ^ static_cast<uint8_t>(letter)) * 1'099'511'628'211U;
    }
    return hash;
}

uint64_t randomNumber() {
    std::random_device device;
    return std::uniform_int_distribution<uint64_t>()(device);
}

bool equal(const Offered& a, const Offered& b) {
    return a.id == b.id && a.version == b.version;
}

} // namespace

std::optional<Offered>
offerFile(const fs::path& file, const fs::path& folder, std::error_code& failed) {
    const fs::path place = fs::canonical(file.has_parent_path() ? file.parent_path() : ".", failed);
    const fs::path real = failed ? fs::path() : fs::canonical(file, failed);
    struct stat status {};
    if (!failed && ::stat(real.c_str(), &status) != 0) {
        failed = std::error_code(errno, std::generic_category());
    }
    if (failed) {
        return {};
    }
    std::error_code no_folder;
    const fs::path top = fs::canonical(folder, no_folder);
    const fs::path found = place / file.filename();
    const bool inside = !no_folder && isInside(found, top) && isInside(real, top);
    const std::string path = inside ? found.lexically_relative(top).generic_string() : "";
    return Offered{fmt::format("{:016x}", hashOf(inside ? path : found.filename().string())),
                   found.stem().string(),
                   path,
                   real.string(),
                   static_cast<uint64_t>(status.st_size),
                   status.st_mtim.tv_sec,
                   file,
                   stampOf(status)};
}

Listing::Listing(uint64_t generation, std::vector<Offered> scenes, size_t always, Paths gone)
    : generation_(generation), scenes_(std::move(scenes)), always_(always), gone_(std::move(gone)) {
    for (size_t i = 0; i < scenes_.size(); ++i) {
        places_.emplace(scenes_[i].id, i);
    }
}

std::optional<size_t> Listing::placeOf(std::string_view id) const {
    const auto found = places_.find(id);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<size_t> Listing::placeAfter(std::string_view id) const {
    if (const auto place = placeOf(id)) {
        return *place + 1;
    }
    const auto gone = gone_.find(id);
    if (gone == gone_.end()) {
        return {};
    }
    const auto by_path = scenes_.begin() + static_cast<ptrdiff_t>(always_);
    const auto later = std::upper_bound(
        by_path, scenes_.end(), gone->second,
        [](const std::string& path, const Offered& scene) { return path < scene.path; });
    return static_cast<size_t>(later - scenes_.begin());
}

const Offered* Listing::find(std::string_view id) const {
    const auto place = placeOf(id);
    return place ? &scenes_[*place] : nullptr;
}

Catalogue::Catalogue(std::vector<Offered> always, fs::path folder)
    : always_(std::move(always)), folder_(std::move(folder)), last_version_(randomNumber()),
      listing_(std::make_shared<const Listing>(0, std::vector<Offered>())) {
    rescan();
}

bool Catalogue::rescan() {
    const std::lock_guard one_at_a_time(rescanning_);
    Found found = look();
    tell(found.unread);
    std::vector<Offered> scenes = gather(std::move(found.scenes));
    const std::set<std::string> changed = changedSinceRead();
    const std::lock_guard lock(mutex_);
    list(std::move(scenes), changed);
    return found.unread.empty();
}

Catalogue::Found Catalogue::look() const {
    Found found;
    if (folder_.empty()) {
        return found;
    }
    bool too_many = false;
    const auto visit = [&](const fs::directory_entry& entry) -> std::error_code {
        std::error_code failed;
        if (too_many || !isSceneFile(entry.path()) || !entry.is_regular_file(failed)) {
            return failed;
        }
        auto offered = offerFile(entry.path(), folder_, failed);
        if (!offered || offered->path.empty()) { // a link that leads out
            return failed;
        }
        too_many = found.scenes.size() == kMostScenes;
        if (!too_many) {
            found.scenes.push_back(std::move(*offered));
        }
        return {};
    };
    found.unread = walkFolder(folder_, kDeepest, {.on_file = visit});
    if (too_many) {
        spdlog::warn("event=scenes_left_out folder={} most={}", logValue(folder_.string()),
                     kMostScenes);
    }
    const auto was_there = [&](const Offered& scene) {
        return !scene.path.empty() && std::ranges::any_of(found.unread, [&](const Unread& unread) {
            return isInside(scene.file, unread.path);
        });
    };
    std::set<std::string> ids;
    std::ranges::transform(found.scenes, std::inserter(ids, ids.end()), &Offered::id);
    const auto before = listing();
    std::ranges::copy_if(
        before->scenes(), std::back_inserter(found.scenes),
        [&](const Offered& scene) { return was_there(scene) && !ids.contains(scene.id); });
    std::ranges::sort(found.scenes, {}, &Offered::path);
    return found;
}

void Catalogue::tell(const std::vector<Unread>& unread) {
    const bool told = std::exchange(told_unread_, !unread.empty());
    if (!unread.empty() && !told) {
        spdlog::warn("event=scenes_not_read path={} reason={} more={} "
                     "advice=\"what was there stays; it is tried again\"",
                     logValue(unread.front().path.string()), logValue(unread.front().why.message()),
                     unread.size() - 1);
    } else if (unread.empty() && told) {
        spdlog::info("event=scenes_read_again folder={}", logValue(folder_.string()));
    }
}

std::vector<Offered> Catalogue::gather(std::vector<Offered> found) const {
    std::vector<Offered> scenes;
    std::map<std::string, size_t> places;
    for (const Offered& scene : always_) {
        std::error_code gone; // then it stays as it was
        auto now = scene.file.empty() ? std::nullopt : offerFile(scene.file, folder_, gone);
        places.emplace(scene.id, scenes.size());
        scenes.push_back(now && now->id == scene.id ? std::move(*now) : scene);
    }
    for (Offered& file : found) {
        const auto [same, is_new] = places.emplace(file.id, scenes.size());
        if (is_new) {
            scenes.push_back(std::move(file));
        } else if (const Offered& other = scenes[same->second]; other.path != file.path) {
            spdlog::warn("event=scene_left_out scene={} reason=\"its id is that of {}\"",
                         logValue(file.path), logValue(other.path));
        }
    }
    return scenes;
}

// Without the lock: a file system may take its time.
std::set<std::string> Catalogue::changedSinceRead() const {
    std::map<std::string, Known> known;
    {
        const std::lock_guard lock(mutex_);
        known = known_;
    }
    std::set<std::string> changed;
    for (const auto& [id, scene] : known) {
        if (scene.files && std::ranges::any_of(*scene.files, &StampedFile::hasChanged)) {
            changed.insert(id);
        }
    }
    return changed;
}

void Catalogue::list(std::vector<Offered> scenes, const std::set<std::string>& changed) {
    std::map<std::string, Known> now;
    for (Offered& scene : scenes) {
        const auto known = known_.find(scene.id);
        const bool same = known != known_.end() && known->second.stamp == scene.stamp &&
                          !changed.contains(scene.id);
        Known& kept = now[scene.id];
        kept = same ? known->second : Known{scene.stamp, ++last_version_, nullptr};
        scene.version = kept.version;
    }
    known_ = std::move(now);
    if (!std::ranges::equal(scenes, listing_->scenes(), equal)) {
        spdlog::info("event=scenes_listed folder={} count={}", logValue(folder_.string()),
                     scenes.size());
        Listing::Paths gone = goneWithout(scenes);
        listing_ = std::make_shared<const Listing>(listing_->generation() + 1, std::move(scenes),
                                                   always_.size(), std::move(gone));
    }
}

Listing::Paths Catalogue::goneWithout(const std::vector<Offered>& scenes) const {
    Listing::Paths gone = listing_->gone();
    for (const Offered& scene : listing_->scenes()) {
        gone.emplace(scene.id, scene.path);
    }
    for (const Offered& scene : scenes) {
        gone.erase(scene.id);
    }
    if (gone.size() > kMostScenes) {
        gone.clear();
    }
    return gone;
}

void Catalogue::noteRead(const std::string& id, uint64_t version, std::vector<StampedFile> files) {
    const bool changed = std::ranges::any_of(files, &StampedFile::hasChanged);
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(id);
    if (known == known_.end() || known->second.version != version) {
        return; // it has changed meanwhile, and is read again
    }
    known->second.files = std::make_shared<const std::vector<StampedFile>>(std::move(files));
    if (changed) {
        list(listing_->scenes(), {id});
    }
}

std::shared_ptr<const Listing> Catalogue::listing() const {
    const std::lock_guard lock(mutex_);
    return listing_;
}

std::optional<Offered> Catalogue::find(const std::string& id) const {
    const auto listed = listing();
    const Offered* found = listed->find(id);
    return found == nullptr ? std::nullopt : std::optional(*found);
}

} // namespace froxel::catalogue
