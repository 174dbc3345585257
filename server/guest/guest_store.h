// Guest scenes that stay for a while: in a folder, within quotas, until nobody has used them for
// long. A scene is announced with its files' sizes, which are reserved; its files come in parts,
// each from where the one before ended; with the last byte of the last file it is ready.
//
//   FOLDER/ID/manifest.json   what was announced; written first, and again when all has come
//   FOLDER/ID/0.part, 1.part  files as they come, by their place in the manifest
//   FOLDER/ID/0, 1            whole ones
//   FOLDER/lock               held by the one server that uses the folder
//
// No name that a client chose is a path. What was acknowledged outlives the process; a scene that
// is ready outlives the machine, too (fsync). Any thread; calls wait for the disk unless said
// otherwise.
#pragma once

#include "core/error.h"
#include "core/file_descriptor.h"
#include "guest/guest_scene.h"

#include <boost/system/result.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace froxel::guest {

struct StoreLimits {
    uint64_t file_bytes = uint64_t{512} << 20U;
    uint64_t all_bytes = uint64_t{5} << 30U;            // of all scenes, as announced
    double account_share = 0.5;                         // of all_bytes: what one account may have
    double free_share = 0.1;                            // of the file system: what stays free
    size_t receiving_of_account = 4;                    // scenes at once
    std::chrono::seconds kept = std::chrono::hours(24); // since a scene was used last
    std::chrono::seconds patience = std::chrono::hours(1); // since the last byte of one that comes
};

inline constexpr size_t kMostGuestFiles = 512;
inline constexpr size_t kLongestGuestName = 255;

struct StoreRefusal {
    enum class Why : uint8_t {
        kMalformed, // what was announced
        kTooLarge,
        kAccount, // it has too much, or too many at once; later there may be room
        kFull,    // likewise the store or the disk
        kUnknown, // there is no such scene or file
        kBusy,    // the file comes on another connection
        kOffset,  // the file has another number of bytes
        kDisk,    // the disk failed
    };
    Why why = Why::kMalformed;
    std::string field{}; // of what was announced, or empty
    std::string message; // one line
};
// value() on a refusal is a bug of the caller.
[[noreturn]] inline void throw_exception_from_error(const StoreRefusal& refusal,
                                                    const boost::source_location& /*where*/) {
    throw StartupError(Error{ErrorCode::kIo, refusal.message});
}
template <class T>
using StoreResult = boost::system::result<T, StoreRefusal>;

class GuestStore : public std::enable_shared_from_this<GuestStore> {
  public:
    using Time = std::chrono::system_clock::time_point;

    struct Announced {
        struct File {
            std::string name; // as the scene refers to it; one is a scene by it
            uint64_t size_bytes = 0;
        };
        std::vector<File> files;
    };
    // All are unguessable.
    struct Begun {
        std::string id;                   // who knows it may see the scene
        std::string owner_key;            // ... may remove it
        std::vector<std::string> uploads; // ... may send the file of the same place
        Time expires{};                   // unless something comes
    };
    struct Standing {
        uint64_t offset = 0; // bytes that are there
        uint64_t size_bytes = 0;
        Time expires{}; // unless more comes
    };
    enum class State : uint8_t { kReceiving, kReady };
    struct Facts {
        State state = State::kReceiving;
        std::string name; // of the scene's file: untrusted
        uint64_t size_bytes = 0;
        uint64_t received_bytes = 0;
        Time expires{};
    };

    // A file that comes, of one connection at a time.
    class Upload {
      public:
        Upload(std::shared_ptr<GuestStore> store, std::string id, size_t place, FileDescriptor file)
            : store_(std::move(store)), id_(std::move(id)), place_(place), file_(std::move(file)) {}
        // What was written stays.
        ~Upload() { store_->release(id_, place_); }
        Upload(const Upload&) = delete;
        Upload& operator=(const Upload&) = delete;

        // No more than are missing.
        [[nodiscard]] StoreResult<void> append(std::span<const std::byte> bytes, Time now);
        // Nothing more comes on this connection. With the scene's last byte it is ready.
        [[nodiscard]] StoreResult<Standing> end(Time now);

      private:
        const std::shared_ptr<GuestStore> store_;
        const std::string id_;
        const size_t place_;
        const FileDescriptor file_;
    };

    // Why scenes went.
    enum class Removal : uint8_t { kDeleted, kExpired, kEvicted, kFailed };
    static constexpr std::array<const char*, 4> kRemovals = {"deleted", "expired", "evicted",
                                                             "failed"};
    struct Counts {
        uint64_t receiving = 0;
        uint64_t ready = 0;
        uint64_t bytes = 0;                                     // announced, of both
        uint64_t completed_total = 0;                           // that became ready
        std::array<uint64_t, kRemovals.size()> removed_total{}; // by Removal
    };

    // Takes up what the folder holds, and removes what is broken or too old. Throws StartupError
    // (kIo), also where another server uses it.
    GuestStore(std::filesystem::path folder, const StoreLimits& limits, Time now);

    [[nodiscard]] const StoreLimits& limits() const { return limits_; }

    // `account`: whose quota it is charged to; empty: nobody's. Scenes that were used longest ago
    // go where room is short.
    [[nodiscard]] StoreResult<Begun>
    begin(const Announced& announced, const std::string& account, Time now);
    [[nodiscard]] StoreResult<Standing> standingOf(const std::string& upload) const;
    // For the bytes from `offset` on.
    [[nodiscard]] StoreResult<std::unique_ptr<Upload>>
    open(const std::string& upload, uint64_t offset, Time now);
    // Takes the scene that the file is of away.
    [[nodiscard]] StoreResult<void> terminate(const std::string& upload);

    // Called without a lock, when scenes were removed. Set before the first one is.
    void onRemoved(std::function<void()> tell) { tell_ = std::move(tell); }

    // Neither waits for the disk.
    [[nodiscard]] bool isReady(const std::string& id) const;
    [[nodiscard]] std::optional<Facts> factsOf(const std::string& id) const;
    // Ready to be read; null: there is none of this id. It counts as used now.
    [[nodiscard]] std::shared_ptr<const GuestScene> use(const std::string& id, Time now);
    // False: there is no such scene, or it is another's.
    [[nodiscard]] bool remove(const std::string& id, const std::string& owner_key);
    // Removes what is too old. When that is due next; none: nothing is there.
    std::optional<Time> expire(Time now);
    [[nodiscard]] Counts counts() const;

  private:
    struct File {
        std::string name;
        uint64_t size_bytes = 0;
        uint64_t received_bytes = 0;
        bool whole = false; // it has its own name
        bool busy = false;  // an Upload has it
    };
    struct Scene {
        std::string account;
        std::string owner_key;
        std::string upload_key;
        std::vector<File> files;
        State state = State::kReceiving;
        Time used{}; // or came its last byte

        [[nodiscard]] uint64_t bytes() const;
    };
    using Scenes = std::map<std::string, Scene>; // by id

    [[nodiscard]] std::filesystem::path folderOf(const std::string& id) const {
        return folder_ / id;
    }
    [[nodiscard]] std::filesystem::path pathOf(const std::string& id, size_t place) const;
    [[nodiscard]] std::filesystem::path partOf(const std::string& id, size_t place) const;
    [[nodiscard]] std::optional<Scene> readScene(const std::string& id) const;
    [[nodiscard]] StoreResult<void> writeManifest(const std::string& id, const Scene& scene) const;
    // Whether enough stays free beside so many more.
    [[nodiscard]] bool diskHolds(uint64_t bytes) const;
    // Of scenes that are in the table no more. Counts and tells why.
    void removeFolders(const std::vector<std::string>& gone, Removal why);
    void release(const std::string& id, size_t place);
    [[nodiscard]] Time dueOf(const Scene& scene) const;
    [[nodiscard]] Standing standingIn(const Scene& scene, const File& file) const;
    [[nodiscard]] StoreResult<Standing> endUpload(const std::string& id, size_t place, Time now);
    // Of so many whole files. 0, or errno.
    [[nodiscard]] int sync(const std::string& id, size_t file_count) const;

    // Under the lock, which no call holds while it waits for the disk. `gone`: whose folders are to
    // be removed after it.
    using Gone = std::vector<std::string>;
    [[nodiscard]] std::optional<StoreRefusal>
    makeRoom(const std::string& account, uint64_t bytes, Gone& gone);
    // A scene that is ready; of this account where that is not null.
    [[nodiscard]] Scenes::iterator oldestOf(const std::string* account);
    void drop(Scenes::iterator scene, Gone& gone);
    // End: there is none.
    [[nodiscard]] std::pair<Scenes::const_iterator, size_t> find(const std::string& upload) const;
    [[nodiscard]] uint64_t bytesOf(const std::string* account) const;

    const std::filesystem::path folder_;
    const StoreLimits limits_;
    FileDescriptor lock_;
    std::function<void()> tell_ = [] {};
    mutable std::mutex mutex_;
    std::atomic<uint64_t> completed_total_{0};
    std::array<std::atomic<uint64_t>, kRemovals.size()> removed_total_{};
    Scenes scenes_;
    std::map<std::string, std::string> ids_; // by upload key
};

} // namespace froxel::guest
