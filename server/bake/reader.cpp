#include "bake/reader.h"

#include "bake/channel.h"
#include "bake/flat_scene.h"
#include "bake/isolation.h"
#include "gltf/failure.h"
#include "gltf/file_opener.h"
#include "gltf/gltf_loader.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <limits>
#include <memory>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

namespace froxel::bake {

namespace {

// Whoever started this is gone, or says what it must not.
class ChannelBroken : public std::exception {};

// The output, whose begin holds the pixels of images: they are decoded there, and never copied.
class Output {
  public:
    // most_bytes: of all images together; what does not fit lies elsewhere.
    explicit Output(uint64_t most_bytes) {
        if (ftruncate(kOutputDescriptor, static_cast<off_t>(most_bytes)) == 0) {
            void* const mapped = mmap(nullptr, most_bytes, PROT_READ | PROT_WRITE,
                                      MAP_SHARED | MAP_NORESERVE, kOutputDescriptor, 0);
            if (mapped != MAP_FAILED) {
                pool_ = {static_cast<std::byte*>(mapped), most_bytes};
            }
        }
    }

    // Any thread.
    KeptBytes room(size_t size_bytes) {
        constexpr uint64_t kLine = 64;
        const uint64_t taken = (size_bytes + kLine - 1) / kLine * kLine;
        const uint64_t offset = used_.fetch_add(taken);
        if (offset > pool_.size() || taken > pool_.size() - offset) {
            return KeptBytes(size_bytes);
        }
        // Mapped for as long as the process lives.
        const std::shared_ptr<const void> keeper(pool_.data(), [](const void*) {});
        return {pool_.subspan(offset, size_bytes), keeper};
    }

    // Where it begins, behind the pool.
    uint64_t write(const scene::Scene& scene) {
        const uint64_t begin = std::min<uint64_t>(used_, pool_.size());
        if (ftruncate(kOutputDescriptor, static_cast<off_t>(begin)) != 0) {
            throw std::bad_alloc();
        }
        uint64_t at = begin;
        writeFlat(
            scene,
            [&at](std::span<const std::byte> part) {
                writeAt(at, part);
                at += part.size();
            },
            pool_);
        return begin;
    }

  private:
    static void writeAt(uint64_t offset, std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written =
                pwrite(kOutputDescriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
            if (written < 0 && errno == EINTR) {
                continue;
            }
            if (written <= 0) {
                throw std::bad_alloc();
            }
            bytes = bytes.subspan(static_cast<size_t>(written));
            offset += static_cast<uint64_t>(written);
        }
    }

    std::span<std::byte> pool_;
    std::atomic<uint64_t> used_{0};
};

// Has files opened at the other end of the channel.
class RemoteOpener final : public gltf::FileOpener {
  public:
    RemoteOpener(Channel& channel, Output& output) : channel_(channel), output_(output) {}

    [[nodiscard]] gltf::OpenedFile openScene() override { return ask({.say = Say::kOpenScene}); }
    [[nodiscard]] gltf::OpenedFile open(const std::filesystem::path& relative,
                                        const std::string& user) override {
        return ask({.say = Say::kOpen, .text = relative.string(), .user = user});
    }
    [[nodiscard]] KeptBytes pixelRoom(size_t size_bytes) override {
        return output_.room(size_bytes);
    }

  private:
    gltf::OpenedFile ask(const Message& request) {
        if (!channel_.send(request)) {
            gltf::fail(request.user + " has a path that is too long");
        }
        gltf::OpenedFile file;
        const auto answer = channel_.receive<FileAnswer>(&file.descriptor);
        if (!answer) {
            throw ChannelBroken();
        }
        switch (answer->answer) {
        case Answer::kOpened:
            file.size_bytes = answer->size_bytes;
            file.shown = answer->text;
            return file;
        case Answer::kMissing:
            throw gltf::Unusable(gltf::warning::kMissingFile, answer->text);
        case Answer::kWrongPath:
            throw gltf::Unusable(gltf::warning::kUri, answer->text);
        case Answer::kFailed:
            break;
        }
        throw gltf::Failure(answer->text);
    }

    Channel& channel_;
    Output& output_;
};

// Of addresses alone: memory is taken where pixels are.
constexpr uint64_t kMostPool = 64ULL << 30U;

// Beyond what a file says it needs: code, stacks, and what allocators set aside for each thread.
uint64_t addressBytes(uint64_t memory_bytes) {
    constexpr uint64_t kBeside = 8ULL << 30U;
    return memory_bytes > std::numeric_limits<uint64_t>::max() / 4 ? 0 : 2 * memory_bytes + kBeside;
}

Message read(Channel& channel, const Task& task, Output& output) {
    RemoteOpener opener(channel, output);
    const auto report = [&](const Progress& now) {
        return channel.send(
            Message{.say = Say::kProgress, .text = now.stage, .fraction = now.fraction});
    };
    try {
        const auto scene = gltf::loadFrom(opener, task.file, report, task.memory_bytes);
        if (!scene) {
            return {.say = Say::kError, .text = scene.error().message};
        }
        return {.say = Say::kScene, .pool_bytes = output.write(*scene)};
    } catch (const std::bad_alloc&) {
        return {.say = Say::kError, .text = "out of memory; expected a smaller scene"};
    }
}

} // namespace

int runReader() {
    Channel channel{FileDescriptor(kChannelDescriptor)};
    const auto task = channel.receive<Task>();
    if (!task) {
        return 1;
    }
    const uint64_t most_bytes = addressBytes(task->memory_bytes);
    Output output(std::min(task->memory_bytes, kMostPool));
    const Isolation isolation =
        isolate({.address_bytes = most_bytes, .output_bytes = most_bytes, .cpu_s = task->cpu_s});
    const bool told = channel.send(Message{
        .say = Say::kIsolated, .landlock = isolation.landlock, .seccomp = isolation.seccomp});
    return told && channel.send(read(channel, *task, output)) ? 0 : 1;
}

} // namespace froxel::bake
