#include "bake/reader.h"

#include "bake/channel.h"
#include "bake/flat_scene.h"
#include "bake/isolation.h"
#include "gltf/failure.h"
#include "gltf/file_opener.h"
#include "gltf/gltf_loader.h"

#include <cerrno>
#include <limits>
#include <unistd.h>
#include <utility>

namespace froxel::bake {

namespace {

// Whoever started this is gone, or says what it must not.
class ChannelBroken : public std::exception {};

// Has files opened at the other end of the channel.
class RemoteOpener final : public gltf::FileOpener {
  public:
    explicit RemoteOpener(Channel& channel) : channel_(channel) {}

    [[nodiscard]] gltf::OpenedFile openScene() override { return ask({.say = Say::kOpenScene}); }
    [[nodiscard]] gltf::OpenedFile open(const std::filesystem::path& relative,
                                        const std::string& user) override {
        return ask({.say = Say::kOpen, .text = relative.string(), .user = user});
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
};

void writeAll(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(kOutputDescriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            throw std::bad_alloc();
        }
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
}

// Beyond what a file says it needs: code, stacks, and what allocators set aside for each thread.
uint64_t addressBytes(uint64_t memory_bytes) {
    constexpr uint64_t kBeside = 8ULL << 30U;
    return memory_bytes > std::numeric_limits<uint64_t>::max() / 4 ? 0 : 2 * memory_bytes + kBeside;
}

Message read(Channel& channel, const Task& task) {
    RemoteOpener opener(channel);
    const auto report = [&](const Progress& now) {
        return channel.send(
            Message{.say = Say::kProgress, .text = now.stage, .fraction = now.fraction});
    };
    try {
        const auto scene = gltf::loadFrom(opener, task.file, report, task.memory_bytes);
        if (!scene) {
            return {.say = Say::kError, .text = scene.error().message};
        }
        writeFlat(*scene, writeAll);
        return {.say = Say::kScene};
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
    const Isolation isolation =
        isolate({.address_bytes = most_bytes, .output_bytes = most_bytes, .cpu_s = task->cpu_s});
    const bool told = channel.send(Message{
        .say = Say::kIsolated, .landlock = isolation.landlock, .seccomp = isolation.seccomp});
    return told && channel.send(read(channel, *task)) ? 0 : 1;
}

} // namespace froxel::bake
