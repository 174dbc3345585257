#include "app/diff_command.h"

#include "app/diff_report.h"
#include "app/junit.h"
#include "app/output_file.h"
#include "app/report_page.h"
#include "bench/html.h"
#include "core/clock.h"
#include "core/packed_pixels.h"
#include "core/parallel.h"
#include "core/text.h"
#include "diff/folders.h"
#include "encode/image_file.h"
#include "png/writer.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <new>
#include <openssl/evp.h>
#include <system_error>
#include <utility>

namespace froxel::app {

namespace fs = std::filesystem;

namespace {

// Of a report, which holds three pictures of each.
constexpr size_t kMaxShown = 50;

struct Sides {
    fs::path picture;
    fs::path reference;
};

struct Work {
    std::vector<DiffPair> pairs;
    std::vector<Sides> files; // of each pair that has both
};

std::string nameOf(const fs::path& path) {
    return printable(path.string(), 400);
}

bool isFolder(const fs::path& path) {
    std::error_code failure;
    const bool is = fs::is_directory(path, failure);
    if (!fs::exists(path, failure)) {
        throw StartupError(
            {ErrorCode::kIo, fmt::format("cannot read '{}': it does not exist", nameOf(path))});
    }
    return is;
}

Work findWork(const DiffOptions& options) {
    const bool folder = isFolder(options.picture);
    if (isFolder(options.reference) != folder) {
        throw StartupError(
            {ErrorCode::kInvalidArgument,
             fmt::format("'{}' is a {}, '{}' a {}; expected two files or two folders",
                         nameOf(options.picture), folder ? "folder" : "file",
                         nameOf(options.reference), folder ? "file" : "folder")});
    }
    if (!folder) {
        return {{DiffPair{nameOf(options.picture.filename()), {}, {}}},
                {{options.picture, options.reference}}};
    }
    Work work;
    const auto found = diff::pairsOf(options.picture, options.reference).value();
    for (const fs::path& path : found.both) {
        work.pairs.push_back({nameOf(path), {}, {}});
        work.files.push_back({options.picture / path, options.reference / path});
    }
    for (const auto& [paths, side] : {std::pair(&found.only_picture, &options.reference),
                                      std::pair(&found.only_reference, &options.picture)}) {
        for (const fs::path& path : *paths) {
            work.pairs.push_back(
                {nameOf(path), {}, {fmt::format("'{}' does not have it", nameOf(*side))}});
        }
    }
    return work;
}

struct Read {
    diff::PictureFile picture;
    diff::PictureFile reference;
};

Result<Read> read(const Sides& files) {
    auto picture = diff::read(files.picture);
    if (!picture) {
        return picture.error();
    }
    auto reference = diff::read(files.reference);
    if (!reference) {
        return reference.error();
    }
    return Read{std::move(*picture), std::move(*reference)};
}

std::vector<std::byte> pngOf(const std::vector<std::byte>& rgba8, const PictureSize& size) {
    return png::write(packedView(rgba8, size.width_px, size.height_px),
                      {.compression = png::Compression::kDefault})
        .value();
}

// OUT/NAME.flip.png.
void writeHeatMap(const fs::path& out,
                  const std::string& name,
                  const diff::Difference& difference) {
    const fs::path file = out / (name + ".flip.png");
    std::error_code failure;
    fs::create_directories(file.parent_path(), failure); // writing says what is wrong
    const auto rgba8 = image_metrics::heatMap(difference.flip_errors);
    const auto& size = difference.size;
    encode::writeImage(file, packedView(rgba8, size.width_px, size.height_px), {}).value();
}

// Fills the pair; any thread.
void compare(const DiffOptions& options, const Sides& files, DiffPair& pair) try {
    const auto pictures = read(files);
    if (!pictures) {
        pair.faults = {pictures.error().message};
        return;
    }
    for (const auto* side : {&pictures->picture, &pictures->reference}) {
        for (const std::string& warning : side->warnings) {
            spdlog::warn("{}", warning);
        }
    }
    auto difference = diff::measure(pictures->picture.picture, pictures->reference.picture,
                                    options.limits.tolerance);
    if (!difference) {
        pair.faults = {difference.error().message};
        return;
    }
    pair.faults = diff::broken(*difference, options.limits);
    if (!options.out.empty() && !difference->flip_errors.values.empty()) {
        writeHeatMap(options.out, pair.name, *difference);
    }
    difference->flip_errors = {};
    pair.difference = std::move(*difference);
} catch (const std::bad_alloc&) {
    pair.faults = {"the pictures do not fit into memory"};
}

std::string dataUrl(const std::vector<std::byte>& png) {
    constexpr std::string_view kType = "data:image/png;base64,";
    std::string text(kType.size() + 4 * ((png.size() + 2) / 3) + 1, '\0'); // and EVP's end
    kType.copy(text.data(), kType.size());
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data() + kType.size()),
                    reinterpret_cast<const unsigned char*>(png.data()),
                    static_cast<int>(png.size()));
    text.pop_back();
    return text;
}

// The pictures of the worst pairs, as a page without a network shows them.
void addPictures(const DiffOptions& options, const Work& work, nlohmann::ordered_json& report) {
    for (const size_t i : worstOf(work.pairs, kMaxShown)) {
        const auto pictures = read(work.files[i]).value();
        const diff::Picture& picture = pictures.picture.picture;
        const diff::Picture& reference = pictures.reference.picture;
        const auto difference = diff::measure(picture, reference, options.limits.tolerance).value();
        auto& row = report["pairs"][i];
        row["pictures"] = {
            {"picture", dataUrl(pngOf(diff::shownOf(picture, reference), difference.size))},
            {"reference", dataUrl(pngOf(diff::shownOf(reference, reference), difference.size))}};
        if (!difference.flip_errors.values.empty()) {
            row["pictures"]["flip"] =
                dataUrl(pngOf(image_metrics::heatMap(difference.flip_errors), difference.size));
        }
    }
}

} // namespace

int runDiff(const DiffOptions& options) {
    for (const auto* file : {&options.json, &options.junit, &options.report}) {
        if (!file->empty() && *file != "-") {
            requireFolderOf(*file);
        }
    }
    const std::string page =
        options.report.empty() ? "" : readReportPage(options.web_root, "diff.html");
    const auto begin = Clock::now();
    Work work = findWork(options);
    constexpr size_t kMostThreads = 4; // which need memory for two pictures each
    eachOnThreads(work.files.size(), std::min(threadCount(work.files.size(), 1), kMostThreads),
                  [&](size_t i) { compare(options, work.files[i], work.pairs[i]); });
    auto report = diffReport(options, work.pairs);
    printResults(options.json, diffTable(work.pairs), report);
    if (!options.report.empty()) {
        addPictures(options, work, report);
        writeText(options.report, bench::fillReport(page, report).value());
    }
    if (!options.junit.empty()) {
        writeText(options.junit, junitOf("froxel diff", casesOf(work.pairs),
                                         Seconds(Clock::now() - begin).count()));
    }
    return std::ranges::any_of(work.pairs, &DiffPair::failed) ? 1 : 0;
}

} // namespace froxel::app
