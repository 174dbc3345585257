// The scenes that a server offers: some in any case, and the glTF and GLB files of a folder. Any
// thread.
#pragma once

#include "catalogue/folder_walk.h"
#include "core/file_stamp.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace froxel::catalogue {

struct Offered {
    std::string id;               // stays the same while the file is found at the same path
    std::string name;             // of the file, without its ending: untrusted bytes
    std::string path;             // where it was found below the folder, likewise; empty: outside
    std::string source;           // as app::loadScene() takes it: where links lead
    uint64_t bytes = 0;           // of the file alone, not of those that it refers to
    int64_t modified_s = 0;       // since 1970; 0: it is no file
    std::filesystem::path file{}; // as it was found; empty: it is no file
    uint64_t stamp = 0;           // of the file alone
    uint64_t version = 0; // given by a catalogue: another one after the file, or one that reading
                          // it opened, has changed; no two times the same
};

// Never changes.
class Listing {
  public:
    using Paths = std::map<std::string, std::string, std::less<>>; // by id

    // The first `always` of them are offered in any case. `gone`: of scenes that were listed
    // before.
    Listing(uint64_t generation, std::vector<Offered> scenes, size_t always = 0, Paths gone = {});
    Listing(const Listing&) = delete;
    Listing& operator=(const Listing&) = delete;

    [[nodiscard]] uint64_t generation() const { return generation_; } // grows with every change
    // Those in any case, then by path.
    [[nodiscard]] const std::vector<Offered>& scenes() const { return scenes_; }
    // Its place among them.
    [[nodiscard]] std::optional<size_t> placeOf(std::string_view id) const;
    // Where those begin that come after it, were it still there; none: it never was, or too many
    // have gone since.
    [[nodiscard]] std::optional<size_t> placeAfter(std::string_view id) const;
    [[nodiscard]] const Paths& gone() const { return gone_; }
    // Null: it is not offered.
    [[nodiscard]] const Offered* find(std::string_view id) const;

  private:
    uint64_t generation_;
    std::vector<Offered> scenes_;
    std::unordered_map<std::string_view, size_t> places_; // by the scenes' own ids
    size_t always_;
    Paths gone_;
};

class Catalogue {
  public:
    static constexpr size_t kMostScenes = 10'000;
    static constexpr int kDeepest = 8; // folders below the one given

    // `always` is offered whatever the folder holds; an empty path: there is none.
    Catalogue(std::vector<Offered> always, std::filesystem::path folder);

    // Looks at the folder again. Hidden files and links that lead out of it are left out, and what
    // is nobody's to read. Of what could not be looked at, the log says so once, and what was there
    // before stays. Whether all could be.
    bool rescan();

    // A scene was read at that version, and with it these files, its own among them: where one of
    // them has changed since, the scene's version is another one.
    void noteRead(const std::string& id, uint64_t version, std::vector<StampedFile> files);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::shared_ptr<const Listing> listing() const;
    [[nodiscard]] std::optional<Offered> find(const std::string& id) const;

  private:
    // Of a scene that is listed.
    struct Known {
        uint64_t stamp = 0;
        uint64_t version = 0;
        std::shared_ptr<const std::vector<StampedFile>> files; // null: nobody has read it so
    };
    struct Found {
        std::vector<Offered> scenes; // by path
        std::vector<Unread> unread;
    };

    [[nodiscard]] Found look() const;
    // Tells of what is new among what could not be looked at.
    void tell(const std::vector<Unread>& unread);
    // Those in any case as they are now, then those found; one of each id.
    [[nodiscard]] std::vector<Offered> gather(std::vector<Offered> found) const;
    // The ids of scenes whose files are others than those that were read.
    [[nodiscard]] std::set<std::string> changedSinceRead() const;
    // Under the lock.
    void list(std::vector<Offered> scenes, const std::set<std::string>& changed);
    // Of the scenes that were listed and are not among these.
    [[nodiscard]] Listing::Paths goneWithout(const std::vector<Offered>& scenes) const;

    const std::vector<Offered> always_;
    const std::filesystem::path folder_;
    std::mutex rescanning_; // held by one that looks; before mutex_
    bool told_unread_ = false;
    mutable std::mutex mutex_;
    uint64_t last_version_;              // counts on from a number of this run's own
    std::map<std::string, Known> known_; // by id
    std::shared_ptr<const Listing> listing_;
};

// A file, as it is offered below that folder, or by itself where it is not there. Error: it cannot
// be looked at.
[[nodiscard]] std::optional<Offered> offerFile(const std::filesystem::path& file,
                                               const std::filesystem::path& folder,
                                               std::error_code& failed);

} // namespace froxel::catalogue
