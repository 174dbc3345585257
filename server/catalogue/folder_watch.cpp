#include "catalogue/folder_watch.h"

#include "core/text.h"
#include "core/thread_name.h"

#include <spdlog/spdlog.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace froxel::catalogue {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kEvents = IN_CREATE | IN_DELETE | IN_DELETE_SELF | IN_MOVED_FROM | IN_MOVED_TO |
                             IN_MOVE_SELF | IN_MODIFY | IN_CLOSE_WRITE | IN_ONLYDIR;
constexpr int kMostRests = 10;

int millisecondsUntil(TimePoint then, TimePoint now) {
    return std::max(0, static_cast<int>(Seconds(then - now).count() * 1e3) + 1);
}

} // namespace

FolderWatch::FolderWatch(fs::path folder, int deepest, Seconds rest, std::function<void()> tell)
    : folder_(std::move(folder)), deepest_(deepest), rest_(rest), tell_(std::move(tell)),
      events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)), stop_(eventfd(0, EFD_CLOEXEC)) {
    watchAll(); // what changes from now on is heard
    thread_ = std::jthread([this] {
        nameThread("folder watch");
        run();
    });
}

FolderWatch::~FolderWatch() {
    const uint64_t one = 1;
    (void)!write(stop_, &one, sizeof one); // an eventfd takes it
    thread_.join();
    close(stop_);
    if (events_ >= 0) {
        close(events_);
    }
}

void FolderWatch::watch(const fs::path& folder) {
    if (events_ >= 0 && inotify_add_watch(events_, folder.c_str(), kEvents) >= 0) {
        return;
    }
    if (events_ >= 0 && (errno == ENOENT || errno == ENOTDIR || errno == EACCES)) {
        return; // it went meanwhile, or is nobody's to read
    }
    if (!std::exchange(complained_, true)) {
        spdlog::warn("event=folder_not_watched folder={} reason={} "
                     "advice=\"SIGHUP has it looked at again\"",
                     logValue(folder.string()), logValue(std::strerror(errno)));
    }
}

// Of one that is watched already the watch stays.
void FolderWatch::watchAll() {
    watch(folder_);
    std::error_code failed;
    auto entry = fs::recursive_directory_iterator(
        folder_, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        std::error_code unknown;
        if (!entry->is_directory(unknown) || entry->is_symlink(unknown)) {
            continue;
        }
        if (entry.depth() >= deepest_ || entry->path().filename().string().starts_with('.')) {
            entry.disable_recursion_pending();
        } else {
            watch(entry->path());
        }
    }
}

bool FolderWatch::takeEvents() const {
    std::array<char, 4096> events; // what they are is no matter
    bool any = false;
    while (read(events_, events.data(), events.size()) > 0) {
        any = true;
    }
    return any;
}

void FolderWatch::run() {
    const auto rest = std::chrono::duration_cast<Clock::duration>(rest_);
    struct Changes {
        TimePoint first;
        TimePoint last;
    };
    std::optional<Changes> untold;
    const auto tellAt = [&] {
        return std::min(untold->last + rest, untold->first + kMostRests * rest);
    };
    for (;;) {
        std::array<pollfd, 2> watched = {pollfd{stop_, POLLIN, 0}, pollfd{events_, POLLIN, 0}};
        const int wait = untold ? millisecondsUntil(tellAt(), Clock::now()) : -1;
        const int ready = poll(watched.data(), watched.size(), wait);
        if (watched[0].revents != 0 || (ready < 0 && errno != EINTR)) {
            return;
        }
        if (const TimePoint now = Clock::now(); takeEvents()) {
            untold = Changes{untold ? untold->first : now, now};
        }
        if (untold && Clock::now() >= tellAt()) {
            untold.reset();
            watchAll(); // new folders, too
            tell_();
        }
    }
}

} // namespace froxel::catalogue
