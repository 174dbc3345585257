// Messages between a process that reads a scene and the one that started it, with open files.
#pragma once

#include "bake/flat_bytes.h"
#include "bake/isolation.h"
#include "core/error.h"
#include "core/file_descriptor.h"

#include <cstdint>
#include <optional>
#include <string>

namespace froxel::bake {

// To the reader: first what to read, then an answer to each request for a file.
struct Task {
    std::string file; // names the scene in messages
    uint64_t memory_bytes = 0;
    uint32_t cpu_s = 0;
    std::string form_boundary{}; // the scene's file is a form, see FormParts; empty: it is none
};
enum class Answer : uint8_t { kOpened, kMissing, kWrongPath, kFailed };
struct FileAnswer {
    Answer answer = Answer::kFailed;
    std::string text; // why it was not opened, or the file's name
    uint64_t size_bytes = 0;
};

// From the reader.
enum class Say : uint8_t { kIsolated, kOpenScene, kOpen, kProgress, kScene, kError };
struct Message {
    Say say = Say::kError;
    std::string text{};      // a path, a stage, why it failed
    std::string user{};      // of a path
    double fraction = 0;     // of a stage
    Isolation isolation{};   // of kIsolated
    uint64_t pool_bytes = 0; // of kScene: where the output has the scene, behind its images
};

template <>
struct Values<Answer> : ValuesFrom<Answer, Answer::kOpened, Answer::kFailed> {};
template <>
struct Values<Say> : ValuesFrom<Say, Say::kIsolated, Say::kError> {};
FROXEL_FIELDS(Isolation, 0, v.landlock, v.seccomp)
FROXEL_FIELDS(Task, 0, v.file, v.memory_bytes, v.cpu_s, v.form_boundary)
FROXEL_FIELDS(FileAnswer, 0, v.answer, v.text, v.size_bytes)
FROXEL_FIELDS(Message, 0, v.say, v.text, v.user, v.fraction, v.isolation, v.pool_bytes)

// One end of a pair of sockets that keep packets apart. Of one thread.
class Channel {
  public:
    explicit Channel(FileDescriptor socket) : socket_(std::move(socket)) {}

    // `file`: goes along; none: below 0. False: the other end is gone, or it is too long.
    template <class T>
    [[nodiscard]] bool send(const T& message, int file = -1) {
        std::vector<std::byte> packet;
        const ByteSink sink = [&](std::span<const std::byte> part) {
            packet.insert(packet.end(), part.begin(), part.end());
        };
        FlatWriter writer(sink);
        writer.put(message);
        writer.finish();
        return sendPacket(packet, file);
    }

    // Waits for a packet; none: the other end is gone, or what came is no T.
    template <class T>
    [[nodiscard]] std::optional<T> receive(FileDescriptor* file = nullptr) {
        const auto packet = receivePacket(file);
        if (!packet) {
            return {};
        }
        try {
            T message;
            FlatReader reader(*packet);
            reader.get(message);
            return reader.atEnd() ? std::optional(std::move(message)) : std::nullopt;
        } catch (const Broken&) {
            return {};
        }
    }

    // That the other end is gone, rather than that it sent something else.
    [[nodiscard]] bool closed() const { return closed_; }

    enum class Waited : uint8_t { kSomething, kNothing };
    // For a packet or the other end's end.
    [[nodiscard]] Waited wait(int milliseconds);

  private:
    [[nodiscard]] bool sendPacket(std::span<const std::byte> packet, int file);
    [[nodiscard]] std::optional<std::vector<std::byte>> receivePacket(FileDescriptor* file);

    FileDescriptor socket_;
    bool closed_ = false;
};

} // namespace froxel::bake
