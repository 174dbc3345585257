#include "gltf/image_loader.h"

#include "gltf/image_decode.h"
#include "gltf/limits.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <span>
#include <string>
#include <thread>

namespace froxel::gltf {
namespace {

constexpr size_t kMaxThreads = 16;

struct Job {
    std::string user;
    Bytes owned; // where the image is a file of its own
    std::span<const std::byte> file;
    std::string warning;
    std::exception_ptr failure;
};

Job prepare(const ImageSource& source, size_t number, SceneFolder& folder, BufferViews& views) {
    Job job;
    job.user = thing("image", number);
    if (source.uri.empty() && source.buffer_view < 0) {
        fail(job.user + " has neither uri nor bufferView");
    }
    if (!source.uri.empty()) {
        job.owned = folder.read(source.uri, job.user);
        job.file = job.owned;
        job.user += source.uri.starts_with("data:") ? "" : " '" + source.uri + "'";
    } else {
        job.file = views.bytes(source.buffer_view, job.user);
    }
    return job;
}

void decode(Job& job, scene::Image& image) noexcept {
    try {
        job.warning = decodeImage(job.file, job.user, image);
    } catch (...) {
        job.failure = std::current_exception(); // rethrown where the threads are joined
    }
    job.owned = {};
}

} // namespace

void loadImages(const Document& document,
                const std::vector<size_t>& numbers,
                SceneFolder& folder,
                BufferViews& views,
                scene::Scene& scene,
                Warnings& warnings) {
    Budget pixels("bytes of decoded images", kMaxDecodedImageBytes);
    std::vector<Job> jobs;
    jobs.reserve(numbers.size());
    for (const size_t number : numbers) {
        jobs.push_back(prepare(document.images[number], number, folder, views));
        pixels.take(imageSize(jobs.back().file, jobs.back().user).decodedBytes(), jobs.back().user);
    }
    {
        std::atomic<size_t> next{0};
        const auto work = [&] {
            for (size_t i = next++; i < jobs.size(); i = next++) {
                decode(jobs[i], scene.images[i]);
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
    for (const Job& job : jobs) {
        if (job.failure) {
            std::rethrow_exception(job.failure);
        }
        if (!job.warning.empty()) {
            warnings.add(job.warning);
        }
    }
}

} // namespace froxel::gltf
