#include "catalogue/catalogue.h"

#include "core/text.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <map>
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

bool isSceneFile(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char letter) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    });
    return ending == ".gltf" || ending == ".glb";
}

// Both are canonical.
bool isInside(const fs::path& file, const fs::path& folder) {
    return std::ranges::mismatch(folder, file).in1 == folder.end();
}

std::vector<Offered> filesIn(const fs::path& folder) {
    std::vector<Offered> found;
    std::error_code failed;
    const fs::path real = fs::canonical(folder, failed);
    auto entry = failed ? fs::recursive_directory_iterator()
                        : fs::recursive_directory_iterator(
                              real, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        const fs::path& file = entry->path();
        const bool hidden = file.filename().string().starts_with('.');
        if (hidden || entry.depth() >= Catalogue::kDeepest) {
            entry.disable_recursion_pending();
        }
        std::error_code unknown;
        if (hidden || !isSceneFile(file) || !entry->is_regular_file(unknown)) {
            continue;
        }
        auto offered = offerFile(file, real);
        if (!offered || offered->path.empty()) { // a link that leads out
            continue;
        }
        if (found.size() == Catalogue::kMostScenes) {
            spdlog::warn("event=scenes_left_out folder={} most={}", logValue(folder.string()),
                         Catalogue::kMostScenes);
            break;
        }
        found.push_back(std::move(*offered));
    }
    if (failed) {
        spdlog::warn("event=scenes_not_read folder={} reason={}", logValue(folder.string()),
                     logValue(failed.message()));
    }
    std::ranges::sort(found, {}, &Offered::path);
    return found;
}

bool equal(const Offered& a, const Offered& b) {
    return a.id == b.id && a.version == b.version;
}

} // namespace

std::optional<Offered> offerFile(const fs::path& file, const fs::path& folder) {
    std::error_code failed;
    const fs::path real = fs::canonical(file, failed);
    const uint64_t bytes = failed ? 0 : fs::file_size(real, failed);
    const auto changed = failed ? fs::file_time_type() : fs::last_write_time(real, failed);
    if (failed) {
        return {};
    }
    std::error_code no_folder;
    const fs::path top = fs::canonical(folder, no_folder);
    const bool inside = !no_folder && isInside(real, top);
    const std::string path = inside ? real.lexically_relative(top).generic_string() : "";
    return Offered{fmt::format("{:016x}", hashOf(inside ? path : real.filename().string())),
                   real.stem().string(),
                   path,
                   real.string(),
                   bytes,
                   std::chrono::duration_cast<std::chrono::seconds>(
                       std::chrono::file_clock::to_sys(changed).time_since_epoch())
                       .count(),
                   hashOf(fmt::format("{} {}", bytes, changed.time_since_epoch().count()))};
}

Listing::Listing(uint64_t generation, std::vector<Offered> scenes)
    : generation_(generation), scenes_(std::move(scenes)) {
    for (size_t i = 0; i < scenes_.size(); ++i) {
        places_.emplace(scenes_[i].id, i);
    }
}

std::optional<size_t> Listing::placeOf(std::string_view id) const {
    const auto found = places_.find(id);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
}

const Offered* Listing::find(std::string_view id) const {
    const auto place = placeOf(id);
    return place ? &scenes_[*place] : nullptr;
}

Catalogue::Catalogue(std::vector<Offered> always, fs::path folder)
    : always_(std::move(always)), folder_(std::move(folder)),
      listing_(std::make_shared<const Listing>(1, always_)) {
    rescan();
}

void Catalogue::rescan() {
    std::vector<Offered> scenes = always_;
    std::map<std::string, size_t> places;
    for (size_t i = 0; i < scenes.size(); ++i) {
        places.emplace(scenes[i].id, i);
    }
    for (Offered& file : filesIn(folder_)) {
        const auto [same, is_new] = places.emplace(file.id, scenes.size());
        if (is_new) {
            scenes.push_back(std::move(file));
        } else if (const Offered& other = scenes[same->second]; other.source != file.source) {
            spdlog::warn("event=scene_left_out scene={} reason=\"its id is that of {}\"",
                         logValue(file.path), logValue(other.path));
        }
    }
    const std::lock_guard lock(mutex_);
    if (!std::ranges::equal(scenes, listing_->scenes(), equal)) {
        spdlog::info("event=scenes_listed folder={} count={}", logValue(folder_.string()),
                     scenes.size());
        listing_ = std::make_shared<const Listing>(listing_->generation() + 1, std::move(scenes));
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
