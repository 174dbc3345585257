// Hears of changes below a folder, by inotify(7).
#pragma once

#include "core/clock.h"

#include <filesystem>
#include <functional>
#include <thread>

namespace froxel::catalogue {

class FolderWatch {
  public:
    // Whatever changes is told once nothing has changed any more for `rest`, so that files are
    // written to their end first; while changes go on without one, after ten times as long. Called
    // on a thread of its own. Where the system watches no more folders, or none, the log says so
    // once, and changes there are not heard of.
    FolderWatch(std::filesystem::path folder,
                int deepest,
                Seconds rest,
                std::function<void()> tell);
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

  private:
    void run();
    void watchAll();
    void watch(const std::filesystem::path& folder);
    // Whether there was anything.
    [[nodiscard]] bool takeEvents() const;

    const std::filesystem::path folder_;
    const int deepest_;
    const Seconds rest_;
    const std::function<void()> tell_;
    int events_ = -1; // inotify's descriptor; -1: there is none
    int stop_ = -1;   // an eventfd
    bool complained_ = false;
    std::jthread thread_; // last: ends before what it uses
};

} // namespace froxel::catalogue
