// Hears of changes below a folder, by inotify(7).
#pragma once

#include "core/clock.h"
#include "core/file_descriptor.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <thread>

namespace froxel::catalogue {

class FolderWatch {
  public:
    // Whatever changes is told once nothing has changed any more for `rest`, so that files are
    // written to their end first; while changes go on without one, after ten times as long. So is
    // that another folder is at this path: it was moved away and made again, or a link on the way
    // leads elsewhere now. `tell` is called on a thread of its own; where it says false (not all
    // could be looked at) again later, every 30 s in the end. Where the system watches no more
    // folders, or none, the log says so once, and changes there are not heard of.
    FolderWatch(std::filesystem::path folder,
                int deepest,
                Seconds rest,
                std::function<bool()> tell);
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    // Tells soon, whether anything was heard or not. Any thread.
    void lookAgain();

  private:
    // What is heard of a folder.
    struct Watched {
        bool all = false;            // that is in it
        std::set<std::string> names; // these alone, on the way to the one that is watched
    };
    using Watches = std::map<int, Watched>; // by inotify's number

    void run();
    void wake() const;
    void watchAll();
    void watchWay(Watches& watches);
    // Null: it is not watched.
    Watched* watch(const std::filesystem::path& folder, uint32_t events, Watches& watches);
    // Whether there was anything of what is watched.
    [[nodiscard]] bool takeEvents() const;

    const std::filesystem::path folder_;
    const int deepest_;
    const Seconds rest_;
    const std::function<bool()> tell_;
    FileDescriptor events_; // inotify's; there may be none
    FileDescriptor wake_;   // an eventfd
    std::atomic<bool> ends_ = false;
    std::atomic<bool> asked_ = false;
    bool complained_ = false;
    Watches watches_;
    std::jthread thread_; // last: ends before what it uses
};

} // namespace froxel::catalogue
