#include "catalogue/folder_watch.h"

#include "catalogue/folder_walk.h"
#include "core/text.h"
#include "core/thread_name.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
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

constexpr uint32_t kNames = IN_CREATE | IN_DELETE | IN_DELETE_SELF | IN_MOVED_FROM | IN_MOVED_TO |
                            IN_MOVE_SELF | IN_ONLYDIR;
constexpr uint32_t kAll = kNames | IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB;
constexpr int kMostRests = 10;
constexpr Seconds kFirstRetry{1};
constexpr Seconds kLongestRetry{30};
constexpr int kMostLinks = 40; // on a path, as the system has it

int millisecondsUntil(TimePoint then, TimePoint now) {
    return std::max(0, static_cast<int>(Seconds(then - now).count() * 1e3) + 1);
}

TimePoint after(Seconds time, TimePoint now) {
    return now + std::chrono::duration_cast<Clock::duration>(time);
}

} // namespace

FolderWatch::FolderWatch(fs::path folder, int deepest, Seconds rest, std::function<bool()> tell)
    : folder_(std::move(folder)), deepest_(deepest), rest_(rest), tell_(std::move(tell)),
      events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    watchAll(); // what changes from now on is heard
    thread_ = std::jthread([this] {
        nameThread("folder watch");
        run();
    });
}

FolderWatch::~FolderWatch() {
    ends_ = true;
    wake();
    thread_.join();
}

void FolderWatch::lookAgain() {
    asked_ = true;
    wake();
}

void FolderWatch::wake() const {
    const uint64_t one = 1;
    (void)!write(wake_.get(), &one, sizeof one); // an eventfd takes it
}

FolderWatch::Watched*
FolderWatch::watch(const fs::path& folder, uint32_t events, Watches& watches) {
    const int number = events_ ? inotify_add_watch(events_.get(), folder.c_str(), events) : -1;
    if (number >= 0) {
        return &watches[number];
    }
    if (events_ && (errno == ENOENT || errno == ENOTDIR || errno == EACCES)) {
        return nullptr; // it went meanwhile, or is nobody's to read
    }
    if (!std::exchange(complained_, true)) {
        spdlog::warn("event=folder_not_watched folder={} reason={} "
                     "advice=\"SIGHUP has it looked at again\"",
                     logValue(folder.string()), logValue(std::strerror(errno)));
    }
    return nullptr;
}

// In each folder on the way, links followed, the name that leads on.
void FolderWatch::watchWay(Watches& watches) {
    std::error_code failed;
    const fs::path whole = fs::absolute(folder_, failed);
    std::deque<fs::path> names(whole.begin(), whole.end());
    fs::path at = "/";
    for (int links = 0; !failed && !names.empty() && links <= kMostLinks;) {
        const fs::path name = names.front();
        names.pop_front();
        if (name == "/") {
            at = name;
        } else if (name == "..") {
            at = at.parent_path();
        } else if (!name.empty() && name != ".") {
            if (Watched* watched = watch(at, kNames, watches)) {
                watched->names.insert(name.string());
            }
            if (const fs::path target = fs::read_symlink(at / name, failed); failed) {
                failed.clear(); // no link
                at /= name;
            } else {
                names.insert(names.begin(), target.begin(), target.end());
                ++links;
            }
        }
    }
}

// Of one that is watched already the watch stays; one that is not there any more is let go, where
// all could be looked at.
void FolderWatch::watchAll() {
    Watches now;
    watchWay(now);
    const auto enter = [&](const fs::path& folder) {
        if (Watched* watched = watch(folder, kAll, now)) {
            watched->all = true;
        }
    };
    const bool complete = walkFolder(folder_, deepest_, {.on_folder = enter}).empty();
    for (auto& [number, watched] : watches_) {
        if (now.contains(number)) {
            continue;
        }
        if (complete) {
            inotify_rm_watch(events_.get(), number);
        } else {
            now.emplace(number, std::move(watched));
        }
    }
    watches_ = std::move(now);
}

bool FolderWatch::takeEvents() const {
    alignas(inotify_event) std::array<char, 4096> bytes;
    bool any = false;
    for (ssize_t size = 0; (size = read(events_.get(), bytes.data(), bytes.size())) > 0;) {
        for (ssize_t at = 0; at < size;) {
            const auto* event = reinterpret_cast<const inotify_event*>(bytes.data() + at);
            const auto found = watches_.find(event->wd);
            const bool lost = (event->mask & IN_Q_OVERFLOW) != 0;
            any = any || lost ||
                  (found != watches_.end() &&
                   (found->second.all || event->len == 0 ||
                    found->second.names.contains(static_cast<const char*>(event->name))));
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
        }
    }
    return any;
}

void FolderWatch::run() {
    struct Changes {
        TimePoint first;
        TimePoint last;
    };
    std::optional<Changes> untold;
    std::optional<TimePoint> retry_at;
    Seconds retry = kFirstRetry;
    const auto tellAt = [&] {
        std::optional<TimePoint> at = retry_at;
        if (untold) {
            const TimePoint rested =
                std::min(after(rest_, untold->last), after(kMostRests * rest_, untold->first));
            at = at ? std::min(*at, rested) : rested;
        }
        return at;
    };
    while (!ends_) {
        std::array<pollfd, 2> watched = {pollfd{wake_.get(), POLLIN, 0},
                                         pollfd{events_.get(), POLLIN, 0}};
        const auto at = tellAt();
        const int wait = at ? millisecondsUntil(*at, Clock::now()) : -1;
        if (poll(watched.data(), watched.size(), wait) < 0 && errno != EINTR) {
            return;
        }
        uint64_t count = 0;
        (void)!read(wake_.get(), &count, sizeof count);
        if (const TimePoint now = Clock::now(); takeEvents()) {
            untold = Changes{untold ? untold->first : now, now};
        }
        const auto due = tellAt();
        if (!asked_.exchange(false) && (!due || Clock::now() < *due)) {
            continue;
        }
        untold.reset();
        retry_at.reset();
        watchAll(); // new folders, too
        if (tell_()) {
            retry = kFirstRetry;
        } else {
            retry_at = after(retry, Clock::now());
            retry = std::min(2 * retry, kLongestRetry);
        }
    }
}

} // namespace froxel::catalogue
