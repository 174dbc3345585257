#include "guest/guest_store.h"

#include "core/replace_file.h"
#include "core/scene_file.h"
#include "core/text.h"
#include "core/unguessable.h"
#include "core/write_all.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <fstream>
#include <set>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <system_error>
#include <unistd.h>

namespace froxel::guest {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Why = StoreRefusal::Why;

namespace {

constexpr size_t kKeyBytes = 16;
constexpr const char* kManifest = "manifest.json";
constexpr const char* kLock = "lock";

StoreRefusal refusal(Why why, std::string field, std::string message) {
    return {why, std::move(field), std::move(message)};
}

StoreRefusal diskFailed(int error) {
    const bool full = error == ENOSPC || error == EDQUOT;
    return refusal(full ? Why::kFull : Why::kDisk, "",
                   "the disk of the uploads: " + std::generic_category().message(error));
}

StoreRefusal unknown() {
    return refusal(Why::kUnknown, "", "there is no such upload; it may have expired");
}

// As scenes refer to files: a path below the scene's own folder.
std::string whatIsWrongWith(const std::string& name) {
    const fs::path path(name);
    if (name.empty() || name.size() > kLongestGuestName) {
        return fmt::format("has {} bytes; expected 1 to {}", name.size(), kLongestGuestName);
    }
    const bool inside = path.is_relative() && path.lexically_normal().generic_string() == name &&
                        !name.starts_with("..") && !name.ends_with('/') && name != ".";
    const bool plain = std::ranges::none_of(
        name, [](unsigned char character) { return character < 0x20 || character == 0x7F; });
    return inside && plain ? ""
                           : fmt::format("is \"{}\"; expected a relative path without .. "
                                         "and control characters",
                                         printable(name, 100));
}

std::optional<StoreRefusal> whyMalformed(const GuestStore::Announced& announced,
                                         uint64_t most_bytes) {
    if (announced.files.empty() || announced.files.size() > kMostGuestFiles) {
        return refusal(Why::kMalformed, "files",
                       fmt::format("files has {} entries; expected 1 to {}", announced.files.size(),
                                   kMostGuestFiles));
    }
    std::set<std::string> names;
    size_t scenes = 0;
    for (size_t i = 0; i < announced.files.size(); ++i) {
        const auto& [name, size_bytes] = announced.files[i];
        const std::string field = fmt::format("files[{}]", i);
        if (const std::string wrong = whatIsWrongWith(name); !wrong.empty()) {
            return refusal(Why::kMalformed, field + ".path", field + ".path " + wrong);
        }
        if (!names.insert(name).second) {
            return refusal(Why::kMalformed, field + ".path",
                           field + ".path is \"" + printable(name, 100) + "\", given twice");
        }
        if (size_bytes == 0 || size_bytes > most_bytes) {
            return refusal(
                size_bytes == 0 ? Why::kMalformed : Why::kTooLarge, field + ".bytes",
                fmt::format("{}.bytes is {}; expected 1 to {}", field, size_bytes, most_bytes));
        }
        scenes += isSceneFile(name) ? 1U : 0U;
    }
    if (scenes != 1) {
        return refusal(Why::kMalformed, "files",
                       fmt::format("files has {} paths that end in {}; expected one", scenes,
                                   kSceneEndingsText));
    }
    return {};
}

int64_t secondsOf(GuestStore::Time time) {
    return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

// When it was changed last; none: it is not there.
std::optional<GuestStore::Time> timeOf(const fs::path& file) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0
               ? std::optional(GuestStore::Time(std::chrono::seconds(status.st_mtim.tv_sec)))
               : std::nullopt;
}

void setTimeOf(const fs::path& file, GuestStore::Time time) {
    const timespec at{secondsOf(time), 0};
    const std::array<timespec, 2> both{at, at};
    (void)::utimensat(AT_FDCWD, file.c_str(), both.data(), 0); // else it goes earlier
}

std::optional<uint64_t> sizeOf(const fs::path& file) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode)
               ? std::optional(static_cast<uint64_t>(status.st_size))
               : std::nullopt;
}

} // namespace

uint64_t GuestStore::Scene::bytes() const {
    uint64_t sum = 0;
    for (const File& file : files) {
        sum += file.size_bytes;
    }
    return sum;
}

fs::path GuestStore::pathOf(const std::string& id, size_t place) const {
    return folderOf(id) / std::to_string(place);
}

fs::path GuestStore::partOf(const std::string& id, size_t place) const {
    return folderOf(id) / (std::to_string(place) + ".part");
}

GuestStore::GuestStore(fs::path folder, const StoreLimits& limits, Time now)
    : folder_(std::move(folder)), limits_(limits) {
    std::error_code failed;
    if (fs::create_directories(folder_, failed)) {
        fs::permissions(folder_, fs::perms::owner_all, failed);
    }
    lock_ = FileDescriptor(::open((folder_ / kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
    if (lock_ && ::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) {
        throw StartupError({ErrorCode::kIo, "another server keeps its uploads in '" +
                                                folder_.string() +
                                                "'; expected another --upload-folder"});
    }
    Gone broken;
    for (const auto& entry : fs::directory_iterator(folder_, failed)) {
        const std::string id = entry.path().filename().string();
        if (id == kLock) {
            continue;
        }
        if (auto scene = readScene(id)) {
            ids_.emplace(scene->upload_key, id);
            scenes_.emplace(id, std::move(*scene));
        } else {
            broken.push_back(id);
        }
    }
    if (failed || !lock_) {
        throw StartupError(
            {ErrorCode::kIo, "cannot use '" + folder_.string() + "' for uploads: " +
                                 (failed ? failed.message() : "no file can be made in it")});
    }
    if (!broken.empty()) {
        spdlog::warn("event=uploads_dropped count={} reason=\"without a manifest\"", broken.size());
    }
    removeFolders(broken, Removal::kFailed);
    (void)expire(now);
}

// None: it is not as this wrote it.
std::optional<GuestStore::Scene> GuestStore::readScene(const std::string& id) const {
    const fs::path manifest = folderOf(id) / kManifest;
    const auto used = timeOf(manifest);
    const Json json = Json::parse(std::ifstream(manifest), nullptr, false);
    if (!used || json.is_discarded()) {
        return {};
    }
    try {
        Scene scene{.account = json.at("account"),
                    .owner_key = json.at("owner_key"),
                    .upload_key = json.at("upload_key"),
                    .files = {},
                    .state = State::kReady,
                    .used = *used};
        for (const Json& entry : json.at("files")) {
            const size_t place = scene.files.size();
            File file{.name = entry.at("path"), .size_bytes = entry.at("bytes")};
            // A crash may have come between a file's last byte and its name.
            if (sizeOf(partOf(id, place)) == file.size_bytes) {
                fs::rename(partOf(id, place), pathOf(id, place));
            }
            file.whole = sizeOf(pathOf(id, place)) == file.size_bytes;
            file.received_bytes =
                file.whole ? file.size_bytes : sizeOf(partOf(id, place)).value_or(0);
            if (!entry.at("bytes").is_number_unsigned() || file.received_bytes > file.size_bytes) {
                return {};
            }
            if (!file.whole) {
                scene.state = State::kReceiving;
                scene.used = std::max(scene.used, timeOf(partOf(id, place)).value_or(scene.used));
            }
            scene.files.push_back(std::move(file));
        }
        return scene.files.empty() ? std::nullopt : std::optional(std::move(scene));
    } catch (const std::exception&) { // Json's, or the disk's
        return {};
    }
}

StoreResult<void> GuestStore::writeManifest(const std::string& id, const Scene& scene) const {
    Json json{{"account", scene.account},
              {"owner_key", scene.owner_key},
              {"upload_key", scene.upload_key},
              {"files", Json::array()}};
    for (const File& file : scene.files) {
        json["files"].push_back({{"path", file.name}, {"bytes", file.size_bytes}});
    }
    const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace);
    const std::array parts{std::as_bytes(std::span(text))};
    errno = 0;
    const auto written = replaceFile(folderOf(id) / kManifest, parts, Durable::kYes);
    const int error = written ? syncFolder(folder_) : errno != 0 ? errno : EIO;
    return error == 0 ? StoreResult<void>() : diskFailed(error);
}

void GuestStore::removeFolders(const Gone& gone, Removal why) {
    if (gone.empty()) {
        return;
    }
    const auto reason = static_cast<size_t>(why);
    removed_total_[reason] += gone.size();
    spdlog::info("event=uploads_removed count={} reason={}", gone.size(), kRemovals[reason]);
    for (const std::string& id : gone) {
        std::error_code failed;
        fs::remove_all(folderOf(id), failed);
        if (failed) {
            spdlog::warn("event=upload_not_removed reason={}", logValue(failed.message()));
        }
    }
    tell_();
}

GuestStore::Time GuestStore::dueOf(const Scene& scene) const {
    return scene.used + (scene.state == State::kReady ? limits_.kept : limits_.patience);
}

uint64_t GuestStore::bytesOf(const std::string* account) const {
    uint64_t sum = 0;
    for (const auto& [id, scene] : scenes_) {
        sum += account == nullptr || scene.account == *account ? scene.bytes() : 0;
    }
    return sum;
}

GuestStore::Counts GuestStore::counts() const {
    Counts counts;
    counts.completed_total = completed_total_;
    std::ranges::copy(removed_total_, counts.removed_total.begin());
    const std::lock_guard lock(mutex_);
    counts.bytes = bytesOf(nullptr);
    counts.ready = static_cast<uint64_t>(std::ranges::count_if(
        scenes_, [](const auto& entry) { return entry.second.state == State::kReady; }));
    counts.receiving = scenes_.size() - counts.ready;
    return counts;
}

GuestStore::Scenes::iterator GuestStore::oldestOf(const std::string* account) {
    auto oldest = scenes_.end();
    for (auto scene = scenes_.begin(); scene != scenes_.end(); ++scene) {
        const bool counts = scene->second.state == State::kReady &&
                            (account == nullptr || scene->second.account == *account);
        if (counts && (oldest == scenes_.end() || scene->second.used < oldest->second.used)) {
            oldest = scene;
        }
    }
    return oldest;
}

void GuestStore::drop(Scenes::iterator scene, Gone& gone) {
    ids_.erase(scene->second.upload_key);
    gone.push_back(scene->first);
    scenes_.erase(scene);
}

std::optional<StoreRefusal>
GuestStore::makeRoom(const std::string& account, uint64_t bytes, Gone& gone) {
    const auto own_most =
        static_cast<uint64_t>(limits_.account_share * static_cast<double>(limits_.all_bytes));
    if (bytes > own_most) {
        return refusal(
            Why::kTooLarge, "files",
            fmt::format("files have {} bytes together; expected at most {}", bytes, own_most));
    }
    const auto receiving = std::ranges::count_if(scenes_, [&](const auto& entry) {
        return entry.second.state == State::kReceiving && entry.second.account == account;
    });
    if (!account.empty() && static_cast<size_t>(receiving) >= limits_.receiving_of_account) {
        return refusal(Why::kAccount, "",
                       fmt::format("{} scenes of this address or token are on their way, which is "
                                   "the maximum",
                                   receiving));
    }
    const auto shrink = [&](const std::string* whose, uint64_t most) {
        while (bytesOf(whose) + bytes > most) {
            const auto oldest = oldestOf(whose);
            if (oldest == scenes_.end()) {
                return false;
            }
            drop(oldest, gone);
        }
        return true;
    };
    if (!account.empty() && !shrink(&account, own_most)) {
        return refusal(Why::kAccount, "",
                       "scenes of this address or token that are on their way take all its room");
    }
    if (!shrink(nullptr, limits_.all_bytes)) {
        return refusal(Why::kFull, "", "scenes that are on their way take all the room");
    }
    return {};
}

bool GuestStore::diskHolds(uint64_t bytes) const {
    struct statvfs disk {};
    if (::statvfs(folder_.c_str(), &disk) != 0) {
        return true; // writing will tell
    }
    const auto block_bytes = static_cast<double>(disk.f_frsize);
    const double free_bytes = static_cast<double>(disk.f_bavail) * block_bytes;
    const double all_bytes = static_cast<double>(disk.f_blocks) * block_bytes;
    return free_bytes - static_cast<double>(bytes) >= limits_.free_share * all_bytes;
}

StoreResult<GuestStore::Begun>
GuestStore::begin(const Announced& announced, const std::string& account, Time now) {
    if (auto refused = whyMalformed(announced, limits_.file_bytes)) {
        return std::move(*refused);
    }
    Scene scene{.account = account,
                .owner_key = unguessable(kKeyBytes),
                .upload_key = unguessable(kKeyBytes),
                .files = {},
                .used = now};
    for (const auto& [name, size_bytes] : announced.files) {
        scene.files.push_back({.name = name, .size_bytes = size_bytes});
    }
    const std::string id = unguessable(kKeyBytes);
    Gone gone;
    std::optional<StoreRefusal> refused;
    uint64_t missing_bytes = 0;
    {
        const std::lock_guard lock(mutex_);
        refused = makeRoom(account, scene.bytes(), gone);
        if (!refused) {
            ids_.emplace(scene.upload_key, id);
            scenes_.emplace(id, scene);
        }
        for (const auto& [other, coming] : scenes_) {
            for (const File& file : coming.files) {
                missing_bytes += file.size_bytes - file.received_bytes;
            }
        }
    }
    removeFolders(gone, Removal::kEvicted);
    if (refused) {
        return std::move(*refused);
    }
    StoreResult<void> written =
        diskHolds(missing_bytes)
            ? writeManifest(id, scene)
            : refusal(Why::kFull, "", "the disk of the uploads has too little space left");
    if (!written) {
        {
            const std::lock_guard lock(mutex_);
            gone.clear();
            if (const auto found = scenes_.find(id); found != scenes_.end()) {
                drop(found, gone);
            }
        }
        removeFolders(gone, Removal::kFailed);
        return written.error();
    }
    Begun begun{id, scene.owner_key, {}, dueOf(scene)};
    for (size_t place = 0; place < scene.files.size(); ++place) {
        begun.uploads.push_back(scene.upload_key + "-" + std::to_string(place));
    }
    return begun;
}

std::pair<GuestStore::Scenes::const_iterator, size_t>
GuestStore::find(const std::string& upload) const {
    const size_t dash = upload.find('-');
    const auto known = ids_.find(upload.substr(0, dash));
    const std::string_view digits =
        dash == std::string::npos ? std::string_view() : std::string_view(upload).substr(dash + 1);
    size_t place = 0;
    const std::errc error = std::from_chars(digits.data(), digits.data() + digits.size(), place).ec;
    if (known == ids_.end() || error != std::errc() || std::to_string(place) != digits) {
        return {scenes_.end(), 0};
    }
    const auto scene = scenes_.find(known->second);
    return scene != scenes_.end() && place < scene->second.files.size()
               ? std::pair(scene, place)
               : std::pair(scenes_.end(), size_t{0});
}

GuestStore::Standing GuestStore::standingIn(const Scene& scene, const File& file) const {
    return {file.received_bytes, file.size_bytes, dueOf(scene)};
}

StoreResult<GuestStore::Standing> GuestStore::standingOf(const std::string& upload) const {
    const std::lock_guard lock(mutex_);
    const auto [scene, place] = find(upload);
    if (scene == scenes_.end()) {
        return unknown();
    }
    return standingIn(scene->second, scene->second.files[place]);
}

StoreResult<std::unique_ptr<GuestStore::Upload>>
GuestStore::open(const std::string& upload, uint64_t offset, Time now) {
    std::string id;
    size_t place = 0;
    {
        const std::lock_guard lock(mutex_);
        const auto [found, its_place] = find(upload);
        if (found == scenes_.end()) {
            return unknown();
        }
        id = found->first;
        place = its_place;
        File& file = scenes_.at(id).files[place];
        if (file.busy) {
            return refusal(Why::kBusy, "", "the file comes on another connection");
        }
        if (file.whole) {
            return refusal(Why::kOffset, "Upload-Offset", "the file has come to its end");
        }
        if (offset != file.received_bytes) {
            return refusal(
                Why::kOffset, "Upload-Offset",
                fmt::format("Upload-Offset is {}; expected {}", offset, file.received_bytes));
        }
        file.busy = true;
        scenes_.at(id).used = now;
    }
    FileDescriptor file(::open(partOf(id, place).c_str(),
                               O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (!file) {
        const int error = errno;
        release(id, place);
        return error == ENOENT ? unknown() : diskFailed(error);
    }
    return std::make_unique<Upload>(shared_from_this(), std::move(id), place, std::move(file));
}

StoreResult<void> GuestStore::Upload::append(std::span<const std::byte> bytes, Time now) {
    {
        const std::lock_guard lock(store_->mutex_);
        const auto scene = store_->scenes_.find(id_);
        if (scene == store_->scenes_.end()) {
            return unknown();
        }
        const File& file = scene->second.files[place_];
        if (bytes.size() > file.size_bytes - file.received_bytes) {
            return refusal(Why::kTooLarge, "",
                           fmt::format("the file has {} bytes as announced; more of it came",
                                       file.size_bytes));
        }
        scene->second.used = now;
    }
    struct stat status {};
    const bool written = writeAll(file_.get(), bytes);
    const int error = errno;
    // What of it is there, even of a disk that became full.
    const bool known = ::fstat(file_.get(), &status) == 0;
    const std::lock_guard lock(store_->mutex_);
    const auto scene = store_->scenes_.find(id_);
    if (scene != store_->scenes_.end() && known) {
        scene->second.files[place_].received_bytes = static_cast<uint64_t>(status.st_size);
    }
    return written ? StoreResult<void>() : diskFailed(error);
}

StoreResult<GuestStore::Standing> GuestStore::Upload::end(Time now) {
    return store_->endUpload(id_, place_, now);
}

StoreResult<GuestStore::Standing>
GuestStore::endUpload(const std::string& id, size_t place, Time now) {
    bool whole = false;
    {
        const std::lock_guard lock(mutex_);
        const auto found = scenes_.find(id);
        if (found == scenes_.end()) {
            return unknown();
        }
        found->second.used = now;
        const File& file = found->second.files[place];
        whole = file.received_bytes == file.size_bytes;
        if (!whole) {
            return standingIn(found->second, file);
        }
    }
    if (::rename(partOf(id, place).c_str(), pathOf(id, place).c_str()) != 0) {
        return errno == ENOENT ? unknown() : diskFailed(errno);
    }
    size_t to_sync = 0;
    {
        const std::lock_guard lock(mutex_);
        const auto found = scenes_.find(id);
        if (found == scenes_.end()) {
            return unknown();
        }
        found->second.files[place].whole = true;
        if (!std::ranges::all_of(found->second.files, &File::whole)) {
            return standingIn(found->second, found->second.files[place]);
        }
        to_sync = found->second.files.size();
    }
    if (const int error = sync(id, to_sync); error != 0) {
        return error == ENOENT ? unknown() : diskFailed(error);
    }
    std::unique_lock lock(mutex_);
    const auto found = scenes_.find(id);
    if (found == scenes_.end()) {
        return unknown();
    }
    found->second.state = State::kReady;
    const Standing standing = standingIn(found->second, found->second.files[place]);
    const uint64_t bytes = found->second.bytes();
    lock.unlock();
    ++completed_total_;
    spdlog::info("event=upload_ready bytes={} files={}", bytes, to_sync);
    return standing;
}

int GuestStore::sync(const std::string& id, size_t file_count) const {
    for (size_t place = 0; place < file_count; ++place) {
        const FileDescriptor file(::open(pathOf(id, place).c_str(), O_RDONLY | O_CLOEXEC));
        if (!file || ::fsync(file.get()) != 0) {
            return errno;
        }
    }
    return syncFolder(folderOf(id));
}

void GuestStore::release(const std::string& id, size_t place) {
    const std::lock_guard lock(mutex_);
    if (const auto scene = scenes_.find(id); scene != scenes_.end()) {
        scene->second.files[place].busy = false;
    }
}

StoreResult<void> GuestStore::terminate(const std::string& upload) {
    Gone gone;
    {
        const std::lock_guard lock(mutex_);
        const auto [scene, place] = find(upload);
        if (scene == scenes_.end()) {
            return unknown();
        }
        drop(scenes_.find(scene->first), gone);
    }
    removeFolders(gone, Removal::kDeleted);
    return {};
}

bool GuestStore::isReady(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const auto found = scenes_.find(id);
    return found != scenes_.end() && found->second.state == State::kReady;
}

std::optional<GuestStore::Facts> GuestStore::factsOf(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const auto found = scenes_.find(id);
    if (found == scenes_.end()) {
        return {};
    }
    const Scene& scene = found->second;
    Facts facts{scene.state, {}, scene.bytes(), 0, dueOf(scene)};
    for (const File& file : scene.files) {
        facts.received_bytes += file.received_bytes;
        facts.name = isSceneFile(file.name) ? file.name : facts.name;
    }
    return facts;
}

std::shared_ptr<const GuestScene> GuestStore::use(const std::string& id, Time now) {
    std::vector<File> files;
    {
        const std::lock_guard lock(mutex_);
        const auto found = scenes_.find(id);
        if (found == scenes_.end() || found->second.state != State::kReady) {
            return nullptr;
        }
        found->second.used = now;
        files = found->second.files;
    }
    auto scene = std::make_shared<GuestScene>();
    for (size_t place = 0; place < files.size(); ++place) {
        GuestFile file{
            files[place].name,
            FileDescriptor(::open(pathOf(id, place).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW)),
            files[place].size_bytes};
        if (!file.descriptor) {
            return nullptr; // it was removed meanwhile
        }
        const bool first = isSceneFile(file.name);
        scene->files.insert(first ? scene->files.begin() : scene->files.end(), std::move(file));
    }
    setTimeOf(folderOf(id) / kManifest, now);
    return scene;
}

bool GuestStore::remove(const std::string& id, const std::string& owner_key) {
    Gone gone;
    {
        const std::lock_guard lock(mutex_);
        const auto scene = scenes_.find(id);
        if (scene == scenes_.end() || !sameSecret(scene->second.owner_key, owner_key)) {
            return false;
        }
        drop(scene, gone);
    }
    removeFolders(gone, Removal::kDeleted);
    return true;
}

std::optional<GuestStore::Time> GuestStore::expire(Time now) {
    Gone gone;
    std::optional<Time> next;
    {
        const std::lock_guard lock(mutex_);
        for (auto scene = scenes_.begin(); scene != scenes_.end();) {
            const auto here = scene++;
            const bool busy = std::ranges::any_of(here->second.files, &File::busy);
            const Time due = dueOf(here->second);
            if (due <= now && !busy) {
                drop(here, gone);
            } else {
                next = next ? std::min(*next, due) : due;
            }
        }
    }
    removeFolders(gone, Removal::kExpired);
    return next;
}

} // namespace froxel::guest
