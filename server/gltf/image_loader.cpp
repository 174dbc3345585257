#include "gltf/image_loader.h"

#include "core/text.h"
#include "gltf/image_decode.h"
#include "gltf/limits.h"
#include "gltf/uri.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace froxel::gltf {
namespace {

constexpr size_t kMaxThreads = 16;

struct Job {
    std::span<const size_t> sources; // the file's images that are still to be tried
    scene::Image* image = nullptr;
    std::string user;
    Bytes owned; // where the image is a file of its own
    std::span<const std::byte> file;
    std::string warning;
    std::optional<Unusable> unusable; // then the rest is nothing
    std::exception_ptr failure;
};

// What is wrong with its bytes costs the image, not the scene.
std::span<const std::byte> viewBytes(int view, BufferViews& views, const std::string& user) {
    try {
        return views.bytes(view, user);
    } catch (const Failure& failure) {
        throw Unusable(warning::kBrokenImage, user + " cannot be read: " + failure.what());
    }
}

void find(
    Job& job, const ImageSource& source, SceneFiles& files, BufferViews& views, Budget& pixels) {
    if (source.uri.empty() && source.buffer_view < 0) {
        throw Unusable(warning::kNoSource, job.user + " has neither uri nor bufferView");
    }
    if (!source.uri.empty()) {
        job.owned = files.read(source.uri, job.user);
        job.file = job.owned;
        job.user += isDataUri(source.uri) ? "" : " '" + printable(source.uri) + "'";
    } else {
        job.file = viewBytes(source.buffer_view, views, job.user);
    }
    pixels.take(imageSize(job.file, job.user).decodedBytes(), job.user);
}

void checkMimeType(const Job& job, const ImageSource& source, size_t number, Warnings& warnings) {
    const std::string_view type = imageType(job.file);
    if (!source.mime_type.empty() && source.mime_type != type) {
        warnings.add(warning::kMimeType, pointerTo("images", number) + "/mimeType",
                     job.user + " has the mimeType '" + printable(source.mime_type) +
                         "'; it is read by its content, " + std::string(type));
    }
}

void begin(Job& job,
           const Document& document,
           SceneFiles& files,
           BufferViews& views,
           Budget& pixels,
           Warnings& warnings) {
    const size_t number = job.sources.front();
    job.user = thing("image", number);
    try {
        find(job, document.images[number], files, views, pixels);
        checkMimeType(job, document.images[number], number, warnings);
    } catch (const Unusable& unusable) {
        job.unusable = unusable;
    }
}

void decode(Job& job, const PixelRoom& room) noexcept {
    try {
        job.warning = decodeImage(job.file, job.user, *job.image, room);
    } catch (const Unusable& unusable) {
        job.unusable = unusable;
    } catch (...) {
        job.failure = std::current_exception(); // rethrown where the threads are joined
    }
    job.owned = {};
}

// Where it is called off what others have begun is done first.
void decodeAll(const std::vector<Job*>& jobs, const PixelRoom& room, LoadProgress& progress) {
    std::atomic<size_t> next{0};
    std::atomic<size_t> done{0};
    const auto decodeNext = [&] {
        const size_t i = next++;
        if (i >= jobs.size()) {
            return false;
        }
        if (!jobs[i]->unusable) {
            decode(*jobs[i], room);
        }
        ++done;
        return true;
    };
    const size_t wanted = std::min(
        {jobs.size(), size_t{std::max(1U, std::thread::hardware_concurrency())}, kMaxThreads});
    std::vector<std::jthread> threads;
    for (size_t i = 1; i < wanted; ++i) {
        threads.emplace_back([&] {
            while (decodeNext()) {
            }
        });
    }
    try {
        do {
            progress.decoding(static_cast<double>(done) / static_cast<double>(jobs.size()));
        } while (decodeNext());
    } catch (const CalledOff&) {
        next = jobs.size();
        throw;
    }
}

// Says what is wrong. Whether another of its sources is to be tried.
bool goesOn(Job& job, Warnings& warnings) {
    if (job.failure) {
        std::rethrow_exception(job.failure);
    }
    const std::string pointer = pointerTo("images", job.sources.front());
    if (!job.unusable) {
        if (!job.warning.empty()) {
            warnings.add(warning::kBrokenImage, pointer, job.warning);
        }
        return false;
    }
    const bool goes_on = job.sources.size() > 1;
    warnings.add(job.unusable->kind(), pointer,
                 std::string(job.unusable->what()) +
                     (goes_on ? "; " + thing("image", job.sources[1]) + " takes its place"
                              : "; its textures are left out"));
    if (goes_on) {
        job.sources = job.sources.subspan(1);
        job.unusable.reset();
    }
    return goes_on;
}

void leaveOut(const std::vector<Job>& jobs, scene::Scene& scene) {
    for (size_t i = 0; i < jobs.size(); ++i) {
        if (jobs[i].unusable) {
            scene.images[i].width_px = 1;
            scene.images[i].height_px = 1;
            scene.images[i].rgba8.assign(4, std::byte{0xFF});
            scene.images[i].mips.clear();
        }
    }
    for (scene::Material& material : scene.materials) {
        for (scene::TextureSlot* slot : textureSlots(material)) {
            if (slot->texture != scene::kNone &&
                jobs[scene.textures[slot->texture].image].unusable) {
                clearTexture(material, *slot);
            }
        }
    }
}

} // namespace

void loadImages(const Document& document,
                const std::vector<std::vector<size_t>>& sources,
                SceneFiles& files,
                BufferViews& views,
                LoadProgress& progress,
                ReadMemory& memory,
                scene::Scene& scene,
                Warnings& warnings) {
    Budget pixels("bytes of decoded images", kMaxDecodedImageBytes, 1, memory);
    std::vector<Job> jobs(sources.size());
    std::vector<Job*> due;
    for (size_t i = 0; i < jobs.size(); ++i) {
        jobs[i].sources = sources[i];
        jobs[i].image = &scene.images[i];
        due.push_back(&jobs[i]);
    }
    while (!due.empty()) {
        for (Job* job : due) {
            begin(*job, document, files, views, pixels, warnings);
        }
        decodeAll(
            due, [&files](size_t bytes) { return files.pixelRoom(bytes); }, progress);
        std::vector<Job*> again;
        std::copy_if(due.begin(), due.end(), std::back_inserter(again),
                     [&](Job* job) { return goesOn(*job, warnings); });
        due = std::move(again);
    }
    leaveOut(jobs, scene);
}

} // namespace froxel::gltf
