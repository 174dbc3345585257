// A new empty folder, removed with all its content at the end. In memory where that can be: a disk
// flushes a file that is written anew, 100 ms each.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace froxel::test {

class TempFolder {
  public:
    explicit TempFolder(const std::string& name) {
        const std::filesystem::path memory = "/dev/shm";
        std::error_code none;
        const std::filesystem::path parent = std::filesystem::is_directory(memory, none)
                                                 ? memory
                                                 : std::filesystem::temp_directory_path();
        std::string pattern = parent / (name + "_XXXXXX");
        if (mkdtemp(pattern.data()) == nullptr) {
            throw std::runtime_error("no folder at " + pattern);
        }
        path_ = pattern;
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace froxel::test
