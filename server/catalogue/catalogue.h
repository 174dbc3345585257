// The scenes that a server offers: some in any case, and the glTF and GLB files of a folder. Any
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace froxel::catalogue {

struct Offered {
    std::string id;         // stays the same while the file keeps its path
    std::string name;       // of the file, without its ending: untrusted bytes
    std::string path;       // below the folder, likewise; empty: outside of it
    std::string source;     // as app::loadScene() takes it
    uint64_t bytes = 0;     // of the file alone, not of those that it refers to
    int64_t modified_s = 0; // since 1970; 0: it is no file
    uint64_t version = 0;   // another one where size or time of the file are others
};

// Never changes.
class Listing {
  public:
    Listing(uint64_t generation, std::vector<Offered> scenes);
    Listing(const Listing&) = delete;
    Listing& operator=(const Listing&) = delete;

    [[nodiscard]] uint64_t generation() const { return generation_; } // grows with every change
    // Those in any case, then by path.
    [[nodiscard]] const std::vector<Offered>& scenes() const { return scenes_; }
    // Its place among them.
    [[nodiscard]] std::optional<size_t> placeOf(std::string_view id) const;
    // Null: it is not offered.
    [[nodiscard]] const Offered* find(std::string_view id) const;

  private:
    uint64_t generation_;
    std::vector<Offered> scenes_;
    std::unordered_map<std::string_view, size_t> places_; // by the scenes' own ids
};

class Catalogue {
  public:
    static constexpr size_t kMostScenes = 10'000;
    static constexpr int kDeepest = 8; // folders below the one given

    // `always` is offered whatever the folder holds.
    Catalogue(std::vector<Offered> always, std::filesystem::path folder);

    // Looks at the folder again. Hidden files and links that lead out of it are left out, and what
    // cannot be read; the log tells of that.
    void rescan();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::shared_ptr<const Listing> listing() const;
    [[nodiscard]] std::optional<Offered> find(const std::string& id) const;

  private:
    const std::vector<Offered> always_;
    const std::filesystem::path folder_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Listing> listing_;
};

// A file, as it is offered below that folder, or by itself where it is not there. None: there is
// none.
[[nodiscard]] std::optional<Offered> offerFile(const std::filesystem::path& file,
                                               const std::filesystem::path& folder);

} // namespace froxel::catalogue
