#include "bake/reader_process.h"

#include "bake/channel.h"
#include "bake/flat_scene.h"
#include "bake/reader.h"
#include "bake/seal.h"
#include "core/text.h"
#include "formats/scene_loader.h"
#include "gltf/load_result.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace froxel::bake {

namespace {

namespace fs = std::filesystem;

constexpr int kAskEvery_ms = 100;
constexpr size_t kMostFiles = 100'000; // that a reader may ask for

// How a process ended, for a person.
std::string wordsOfEnd(int status) {
    if (!WIFSIGNALED(status)) {
        return "its reader ended with exit code " + std::to_string(WEXITSTATUS(status));
    }
    switch (const int signal = WTERMSIG(status)) {
    case SIGSYS:
        return "its reader was ended, because it made a system call that it may not make";
    case SIGXCPU:
        return "its reader was ended, because it took too much processor time";
    case SIGKILL:
        return "its reader was killed";
    default: {
        const char* const words = sigdescr_np(signal);
        return "its reader ended by signal " + std::to_string(signal) +
               (words == nullptr ? "" : " (" + std::string(words) + ")");
    }
    }
}

// What the reader's libraries look at; nothing else of this process is its business.
std::vector<std::string> environmentOfReader() {
    std::vector<std::string> kept;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        if (text.starts_with("LD_LIBRARY_PATH=") || text.starts_with("ASAN_OPTIONS=") ||
            text.starts_with("TSAN_OPTIONS=") || text.starts_with("UBSAN_OPTIONS=")) {
            kept.emplace_back(text);
        }
    }
    return kept;
}

// The actions and arguments of one posix_spawn().
class Spawn {
  public:
    Spawn() {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
    }
    ~Spawn() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    Spawn(const Spawn&) = delete;
    Spawn& operator=(const Spawn&) = delete;

    // 0, or an error of the system.
    int start(const fs::path& binary, int channel, int output, pid_t& process) {
        for (const int standard : {0, 1, 2}) {
            posix_spawn_file_actions_addopen(&actions_, standard, "/dev/null", O_RDWR, 0);
        }
        posix_spawn_file_actions_adddup2(&actions_, channel, kChannelDescriptor);
        posix_spawn_file_actions_adddup2(&actions_, output, kOutputDescriptor);
        posix_spawn_file_actions_addclosefrom_np(&actions_, kOutputDescriptor + 1);
        // This process may hold some signals back.
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
        std::vector<std::string> environment = environmentOfReader();
        std::vector<char*> entries;
        for (std::string& entry : environment) {
            entries.push_back(entry.data());
        }
        entries.push_back(nullptr);
        std::string name = "froxel";
        std::string command = "bake";
        std::string reads = "--reader";
        const std::array arguments = {name.data(), command.data(), reads.data(),
                                      static_cast<char*>(nullptr)};
        return posix_spawn(&process, binary.c_str(), &actions_, &attributes_, arguments.data(),
                           entries.data());
    }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

// Ended and waited for at the latest when this is.
class Child {
  public:
    explicit Child(pid_t process) : process_(process) {}
    ~Child() { end(); }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    // Its status, once: killed, or how it had ended before.
    int end() {
        int status = 0;
        if (process_ > 0) {
            kill(process_, SIGKILL);
            while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
            }
            process_ = 0;
        }
        return status;
    }

  private:
    pid_t process_;
};

// Of descriptors above those that the reader has.
FileDescriptor aboveReaders(int descriptor) {
    const FileDescriptor low(descriptor);
    return FileDescriptor(fcntl(low.get(), F_DUPFD_CLOEXEC, kOutputDescriptor + 1));
}

Error systemError(const std::string& what) {
    return {ErrorCode::kIo, what + ": " + std::generic_category().message(errno)};
}

// Memory that nobody writes any more.
Result<scene::Scene> readOutput(const FileDescriptor& output, uint64_t pool_bytes) {
    struct stat status {};
    if (!seal(output.get()) || fstat(output.get(), &status) != 0) {
        return systemError("cannot seal what the reader wrote");
    }
    const auto size = static_cast<size_t>(status.st_size);
    if (size == 0 || pool_bytes > size) {
        return readFlat({});
    }
    void* const mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, output.get(), 0);
    if (mapped == MAP_FAILED) {
        return systemError("cannot map what the reader wrote");
    }
    const std::shared_ptr<const void> keeper(mapped,
                                             [mapped, size](const void*) { munmap(mapped, size); });
    const std::span all(static_cast<const std::byte*>(mapped), size);
    return readFlat(all.subspan(pool_bytes), all.first(pool_bytes), keeper);
}

// One reader and what it asks for.
class Reading {
  public:
    Reading(const fs::path& file,
            const ReaderProcess& process,
            const ProgressReport& report,
            gltf::FileOpener& opener,
            FileDescriptor channel,
            pid_t child)
        : file_(file), process_(process), report_(report), opener_(opener),
          channel_(std::move(channel)), child_(child) {}

    // Until the reader says that the scene is there: how many bytes of images lie before it.
    Result<uint64_t> run(uint64_t memory_bytes) {
        if (!channel_.send(Task{file_.filename().string(), memory_bytes, process_.cpu_s,
                                process_.form_boundary})) {
            return ended();
        }
        while (true) {
            const bool came = channel_.wait(kAskEvery_ms) == Channel::Waited::kSomething;
            const auto message = came ? channel_.receive<Message>() : std::nullopt;
            if (came && !message) {
                return ended();
            }
            if (message && isolated_ &&
                (message->say == Say::kScene || message->say == Say::kError)) {
                child_.end(); // nothing more is expected of it
                return message->say == Say::kScene ? Result<uint64_t>(message->pool_bytes)
                                                   : fault(message->text);
            }
            if (auto answered = message ? answer(*message) : Result<void>(); !answered) {
                return answered.error();
            }
            if (!report_(now_)) {
                throw gltf::CalledOff();
            }
        }
    }

  private:
    // Its own line, which names the file, or what is left of it.
    Error fault(const std::string& text) const {
        const std::string line = printable(text, 900);
        return line.starts_with(gltf::begunWith(file_)) ? Error{ErrorCode::kScene, line}
                                                        : gltf::sceneError(file_, line);
    }
    Error ended() {
        const int status = child_.end();
        const std::string how =
            channel_.closed() ? wordsOfEnd(status) : "its reader said what it must not say";
        return gltf::sceneError(file_, how + stageWords());
    }
    std::string stageWords() const {
        return now_.stage.empty() ? " before it began" : " while " + now_.stage;
    }

    Result<void> answer(const Message& message) {
        if (isolated_ == (message.say == Say::kIsolated)) {
            return ended(); // that comes first, and once
        }
        switch (message.say) {
        case Say::kIsolated: {
            isolated_ = true;
            if (process_.sandbox == Sandbox::kRequire && !message.isolation.full()) {
                return Error{ErrorCode::kUnsupported,
                             "--sandbox require: this system isolates a reader by " +
                                 wordsOf(message.isolation) + "; expected landlock and seccomp"};
            }
            return {};
        }
        case Say::kOpenScene:
            return open([this] { return opener_.openScene(); });
        case Say::kOpen:
            return open([&] { return opener_.open(message.text, printable(message.user, 300)); });
        case Say::kProgress:
            now_ = {printable(message.text, 100), std::clamp(message.fraction, 0.0, 1.0)};
            return {};
        case Say::kScene:
        case Say::kError:
            break;
        }
        return {};
    }

    template <class Open>
    Result<void> open(Open open) {
        if (++asked_count_ > kMostFiles) {
            return gltf::sceneError(file_,
                                    "it names more than " + std::to_string(kMostFiles) + " files");
        }
        FileAnswer answer;
        gltf::OpenedFile file;
        try {
            file = open();
            answer = {Answer::kOpened, file.shown, file.size_bytes};
        } catch (const gltf::Unusable& unusable) {
            const bool path = std::string_view(unusable.kind().code) == gltf::warning::kUri.code;
            answer = {path ? Answer::kWrongPath : Answer::kMissing, unusable.what(), 0};
        } catch (const gltf::Failure& failure) {
            answer = {Answer::kFailed, failure.what(), 0};
        }
        if (!channel_.send(answer, file.descriptor.get())) {
            return ended();
        }
        return {};
    }

    const fs::path& file_;
    const ReaderProcess& process_;
    const ProgressReport& report_;
    gltf::FileOpener& opener_;
    Channel channel_;
    Child child_;
    bool isolated_ = false;
    size_t asked_count_ = 0;
    Progress now_;
};

Result<scene::Scene> loadApart(gltf::FileOpener& opener,
                               const fs::path& file,
                               const ReaderProcess& process,
                               const ProgressReport& report,
                               uint64_t memory_bytes) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0) {
        return systemError("cannot make a channel to a reader");
    }
    FileDescriptor ours(pair[0]);
    FileDescriptor theirs = aboveReaders(pair[1]);
    const FileDescriptor output =
        aboveReaders(memfd_create("froxel scene", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    pid_t child = 0;
    if (const int error = Spawn().start(process.binary, theirs.get(), output.get(), child);
        error != 0) {
        errno = error;
        return systemError("cannot start a reader");
    }
    theirs = FileDescriptor();
    Reading reading(file, process, report, opener, std::move(ours), child);
    const auto pool_bytes = reading.run(memory_bytes);
    if (!pool_bytes) {
        return pool_bytes.error();
    }
    auto scene = readOutput(output, *pool_bytes);
    return scene ? std::move(scene)
                 : Error{scene.error().code, gltf::begunWith(file) + scene.error().message};
}

} // namespace

Result<scene::Scene> load(const fs::path& file,
                          const ReaderProcess& process,
                          const ProgressReport& report,
                          const gltf::LoadLimits& limits) {
    if (process.sandbox == Sandbox::kOff) {
        return formats::load(file, report, limits);
    }
    return gltf::loadOfFolder(file, limits.no_link, [&](gltf::FileOpener& folder) {
        return loadApart(folder, file, process, report, limits.memory_bytes);
    });
}

Result<scene::Scene> loadFrom(gltf::FileOpener& opener,
                              const fs::path& file,
                              const ReaderProcess& process,
                              const ProgressReport& report,
                              uint64_t memory_bytes) {
    if (process.sandbox == Sandbox::kOff) {
        return Error{ErrorCode::kUnsupported,
                     gltf::begunWith(file) + "--sandbox off reads no scene that a client brings; "
                                             "expected --sandbox best or require"};
    }
    return gltf::resultOf(file,
                          [&] { return loadApart(opener, file, process, report, memory_bytes); });
}

} // namespace froxel::bake
