#include "bake/reader.h"

#include "bake/channel.h"
#include "bake/flat_scene.h"
#include "bake/form_parts.h"
#include "bake/isolation.h"
#include "core/write_all.h"
#include "formats/scene_loader.h"
#include "gltf/file_opener.h"
#include "gltf/load_result.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <string>
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
        const auto end = static_cast<off_t>(begin);
        if (ftruncate(kOutputDescriptor, end) != 0 ||
            lseek(kOutputDescriptor, end, SEEK_SET) != end) {
            throw std::bad_alloc();
        }
        const auto sink = [](std::span<const std::byte> part) {
            if (!writeAll(kOutputDescriptor, part)) {
                throw std::bad_alloc();
            }
        };
        writeFlat(scene, sink, pool_);
        return begin;
    }

  private:
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

// What is written to, beside the output: libraries make room for what a file says before they see
// that it lies.
uint64_t dataBytes(uint64_t memory_bytes) {
    constexpr uint64_t kBeside = 1ULL << 30U;
    return memory_bytes > std::numeric_limits<uint64_t>::max() / 4 ? 0
                                                                   : memory_bytes / 2 * 3 + kBeside;
}

Message read(Channel& channel, const Task& task, Output& output) {
    RemoteOpener remote(channel, output);
    const auto report = [&](const Progress& now) {
        return channel.send(
            Message{.say = Say::kProgress, .text = now.stage, .fraction = now.fraction});
    };
    uint64_t pool_bytes = 0;
    const auto scene = gltf::resultOf(task.file, [&] {
        std::optional<FormParts> form;
        if (!task.form_boundary.empty()) {
            form.emplace(remote, task.form_boundary);
        }
        gltf::FileOpener& opener = form ? static_cast<gltf::FileOpener&>(*form) : remote;
        const std::string& name = form ? form->sceneName() : task.file;
        auto loaded = formats::loadFrom(opener, name, report, task.memory_bytes);
        if (loaded) {
            pool_bytes = output.write(*loaded);
        }
        return loaded;
    });
    return scene ? Message{.say = Say::kScene, .pool_bytes = pool_bytes}
                 : Message{.say = Say::kError, .text = scene.error().message};
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
    const Isolation isolation = isolate({.address_bytes = most_bytes,
                                         .data_bytes = dataBytes(task->memory_bytes),
                                         .output_bytes = most_bytes,
                                         .cpu_s = task->cpu_s});
    const bool told = channel.send(Message{.say = Say::kIsolated, .isolation = isolation});
    return told && channel.send(read(channel, *task, output)) ? 0 : 1;
}

} // namespace froxel::bake
