#include "gltf/image_loader.h"

#include "core/text.h"
#include "gltf/image_decode.h"
#include "gltf/limits.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>

namespace froxel::gltf {
namespace {

constexpr size_t kMaxThreads = 16;

struct Job {
    std::string user;
    Bytes owned; // where the image is a file of its own
    std::span<const std::byte> file;
    std::string warning;
    std::optional<Unusable> unusable; // then the rest is nothing
    std::exception_ptr failure;
};

void find(
    Job& job, const ImageSource& source, SceneFolder& folder, BufferViews& views, Budget& pixels) {
    if (source.uri.empty() && source.buffer_view < 0) {
        throw Unusable(warning::kNoSource, job.user + " has neither uri nor bufferView");
    }
    if (!source.uri.empty()) {
        job.owned = folder.read(source.uri, job.user);
        job.file = job.owned;
        job.user += source.uri.starts_with("data:") ? "" : " '" + printable(source.uri) + "'";
    } else {
        job.file = views.bytes(source.buffer_view, job.user);
    }
    pixels.take(imageSize(job.file, job.user).decodedBytes(), job.user);
}

void checkMimeType(const Job& job, const ImageSource& source, size_t number, Warnings& warnings) {
    const std::string_view type = imageType(job.file);
    if (!source.mime_type.empty() && source.mime_type != type) {
        warnings.add(warning::kMimeType, pointerTo("images", number) + "/mimeType",
                     job.user + " has the mimeType '" + printable(source.mime_type) +
                         "'; it is read as what it is, " + std::string(type));
    }
}

void decode(Job& job, scene::Image& image) noexcept {
    try {
        job.warning = decodeImage(job.file, job.user, image);
    } catch (const Unusable& unusable) {
        job.unusable = unusable;
    } catch (...) {
        job.failure = std::current_exception(); // rethrown where the threads are joined
    }
    job.owned = {};
}

void decodeAll(std::vector<Job>& jobs, std::vector<scene::Image>& images) {
    std::atomic<size_t> next{0};
    const auto work = [&] {
        for (size_t i = next++; i < jobs.size(); i = next++) {
            if (!jobs[i].unusable) {
                decode(jobs[i], images[i]);
            }
        }
    };
    const size_t wanted = std::min(
        {jobs.size(), size_t{std::max(1U, std::thread::hardware_concurrency())}, kMaxThreads});
    std::vector<std::jthread> threads;
    for (size_t i = 1; i < wanted; ++i) {
        threads.emplace_back(work);
    }
    work();
}

void leaveOut(const std::vector<Job>& jobs, scene::Scene& scene) {
    for (size_t i = 0; i < jobs.size(); ++i) {
        if (jobs[i].unusable) {
            scene.images[i].width_px = 1;
            scene.images[i].height_px = 1;
            scene.images[i].rgba8.assign(4, std::byte{0xFF});
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
                const std::vector<size_t>& numbers,
                SceneFolder& folder,
                BufferViews& views,
                scene::Scene& scene,
                Warnings& warnings) {
    Budget pixels("bytes of decoded images", kMaxDecodedImageBytes);
    std::vector<Job> jobs(numbers.size());
    for (size_t i = 0; i < jobs.size(); ++i) {
        jobs[i].user = thing("image", numbers[i]);
        const ImageSource& source = document.images[numbers[i]];
        try {
            find(jobs[i], source, folder, views, pixels);
            checkMimeType(jobs[i], source, numbers[i], warnings);
        } catch (const Unusable& unusable) {
            jobs[i].unusable = unusable;
        }
    }
    decodeAll(jobs, scene.images);
    for (size_t i = 0; i < jobs.size(); ++i) {
        const Job& job = jobs[i];
        const std::string pointer = pointerTo("images", numbers[i]);
        if (job.failure) {
            std::rethrow_exception(job.failure);
        }
        if (job.unusable) {
            warnings.add(job.unusable->kind(), pointer,
                         std::string(job.unusable->what()) + "; its textures are left out");
        } else if (!job.warning.empty()) {
            warnings.add(warning::kBrokenImage, pointer, job.warning);
        }
    }
    leaveOut(jobs, scene);
}

} // namespace froxel::gltf
