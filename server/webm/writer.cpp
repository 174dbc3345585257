#include "webm/writer.h"

#include "core/assert.h"

#include <cmath>
#include <ebml/EbmlHead.h>
#include <ebml/EbmlSubHead.h>
#include <ebml/EbmlVoid.h>
#include <ebml/StdIOCallback.h>
#include <matroska/KaxBlock.h>
#include <matroska/KaxCluster.h>
#include <matroska/KaxCues.h>
#include <matroska/KaxCuesData.h>
#include <matroska/KaxInfo.h>
#include <matroska/KaxInfoData.h>
#include <matroska/KaxSeekHead.h>
#include <matroska/KaxSegment.h>
#include <matroska/KaxTrackEntryData.h>
#include <matroska/KaxTrackVideo.h>
#include <matroska/KaxTracks.h>
#include <string>
#include <utility>
#include <vector>

namespace froxel::webm {
namespace {

namespace ebml = libebml;
namespace kax = libmatroska;

constexpr uint64_t kScale_ns = 1'000'000; // a tick of the file's clock
constexpr int kSizeBytes = 8;             // of the segment's size, which is known at the end
constexpr uint64_t kSeekHeadBytes = 128;  // kept free for where the parts are
constexpr uint64_t kTrack = 1;
constexpr uint64_t kVideoTrack = 1; // TrackType
// ITU-T H.273: what the encoder makes of sRGB (encode/vp9_encoder.cpp).
constexpr uint64_t kMatrixBt601 = 6;
constexpr uint64_t kPrimariesBt709 = 1;
constexpr uint64_t kTransferSrgb = 13;
constexpr uint64_t kRangeFull = 2;

template <class Element>
void set(ebml::EbmlMaster& parent, uint64_t value) {
    static_cast<ebml::EbmlUInteger&>(ebml::GetChild<Element>(parent)).SetValue(value);
}

template <class Element>
void set(ebml::EbmlMaster& parent, const char* text) {
    static_cast<ebml::EbmlString&>(ebml::GetChild<Element>(parent)).SetValue(text);
}

void writeHead(ebml::IOCallback& out) {
    ebml::EbmlHead head;
    set<ebml::EDocType>(head, "webm");
    set<ebml::EDocTypeVersion>(head, 4);
    set<ebml::EDocTypeReadVersion>(head, 2);
    head.Render(out, true);
}

void describe(kax::KaxTrackEntry& track, const Video& video) {
    track.SetGlobalTimecodeScale(kScale_ns);
    set<kax::KaxTrackNumber>(track, kTrack);
    set<kax::KaxTrackUID>(track, kTrack);
    set<kax::KaxTrackType>(track, kVideoTrack);
    set<kax::KaxTrackFlagLacing>(track, uint64_t{0});
    set<kax::KaxTrackDefaultDuration>(
        track, static_cast<uint64_t>(std::llround(1e9 / video.frames_per_s)));
    set<kax::KaxCodecID>(track, "V_VP9");
    auto& picture = ebml::GetChild<kax::KaxTrackVideo>(track);
    set<kax::KaxVideoPixelWidth>(picture, uint64_t{video.width_px});
    set<kax::KaxVideoPixelHeight>(picture, uint64_t{video.height_px});
    auto& colour = ebml::GetChild<kax::KaxVideoColour>(picture);
    set<kax::KaxVideoColourMatrix>(colour, kMatrixBt601);
    set<kax::KaxVideoColourRange>(colour, kRangeFull);
    set<kax::KaxVideoColourTransferCharacter>(colour, kTransferSrgb);
    set<kax::KaxVideoColourPrimaries>(colour, kPrimariesBt709);
}

} // namespace

struct Writer::File {
    File(std::filesystem::path name, const Video& of)
        : path(std::move(name)), video(of), out(path.c_str(), MODE_CREATE) {}

    void begin() {
        writeHead(out);
        segment.WriteHead(out, kSizeBytes);
        places_kept.SetSize(kSeekHeadBytes);
        places_kept.Render(out);
        auto& info = ebml::GetChild<kax::KaxInfo>(segment);
        set<kax::KaxTimecodeScale>(info, kScale_ns);
        auto& duration = static_cast<ebml::EbmlFloat&>(ebml::GetChild<kax::KaxDuration>(info));
        duration.SetPrecision(ebml::EbmlFloat::FLOAT_64);
        duration.SetValue(0);
        const ebml::UTFstring app(L"froxel");
        static_cast<ebml::EbmlUnicodeString&>(ebml::GetChild<kax::KaxMuxingApp>(info))
            .SetValue(app);
        static_cast<ebml::EbmlUnicodeString&>(ebml::GetChild<kax::KaxWritingApp>(info))
            .SetValue(app);
        info.Render(out, true);
        places.IndexThis(info, segment);
        auto& tracks = ebml::GetChild<kax::KaxTracks>(segment);
        track = &ebml::GetChild<kax::KaxTrackEntry>(tracks);
        describe(*track, video);
        tracks.Render(out, false);
        places.IndexThis(tracks, segment);
        cues.SetGlobalTimecodeScale(kScale_ns);
    }

    [[nodiscard]] uint64_t timeOf(uint64_t frame) const { // in whole ticks
        return static_cast<uint64_t>(
                   std::llround(1000 * static_cast<double>(frame) / video.frames_per_s)) *
               kScale_ns;
    }

    // Of the frames since the last key frame.
    void writeCluster() {
        if (frames.empty()) {
            return;
        }
        kax::KaxCluster cluster;
        cluster.SetParent(segment);
        cluster.InitTimecode(timeOf(first) / kScale_ns, static_cast<int64_t>(kScale_ns));
        for (size_t i = 0; i < frames.size(); ++i) {
            auto& block = ebml::AddNewChild<kax::KaxSimpleBlock>(cluster);
            block.SetParent(cluster);
            auto* bytes = reinterpret_cast<unsigned char*>(frames[i].data());
            auto buffer = // the block's, but for its bytes
                std::make_unique<kax::DataBuffer>(bytes, static_cast<uint32_t>(frames[i].size()));
            block.AddFrame(*track, timeOf(first + i), *buffer.release(), kax::LACING_NONE);
            block.SetKeyframe(i == 0);
            block.SetDiscardable(false);
        }
        cluster.Render(out, cues);
        auto& point = ebml::AddNewChild<kax::KaxCuePoint>(cues);
        set<kax::KaxCueTime>(point, timeOf(first) / kScale_ns);
        auto& place = ebml::GetChild<kax::KaxCueTrackPositions>(point);
        set<kax::KaxCueTrack>(place, kTrack);
        set<kax::KaxCueClusterPosition>(place, segment.GetRelativePosition(cluster));
        first += frames.size();
        frames.clear();
    }

    void end() {
        writeCluster();
        cues.Render(out);
        places.IndexThis(cues, segment);
        places_kept.ReplaceWith(places, out, true);
        auto& duration = ebml::GetChild<kax::KaxDuration>(ebml::GetChild<kax::KaxInfo>(segment));
        static_cast<ebml::EbmlFloat&>(duration).SetValue(1000 * static_cast<double>(first) /
                                                         video.frames_per_s);
        duration.OverwriteData(out);
        const uint64_t bytes =
            out.getFilePointer() - segment.GetElementPosition() - segment.HeadSize();
        if (segment.ForceSize(bytes)) {
            segment.OverwriteHead(out);
        }
        out.close();
    }

    std::filesystem::path path;
    Video video;
    ebml::StdIOCallback out;
    kax::KaxSegment segment;
    ebml::EbmlVoid places_kept;
    kax::KaxSeekHead places;
    kax::KaxCues cues;
    kax::KaxTrackEntry* track = nullptr;        // of the segment
    std::vector<std::vector<std::byte>> frames; // of the cluster that is not written yet
    uint64_t first = 0;                         // of them, since the beginning
};

namespace {

// libebml tells of files by exceptions.
template <class Step>
Result<void> told(const std::filesystem::path& file, const Step& step) {
    try {
        step();
        return {};
    } catch (const std::exception& error) {
        return Error{ErrorCode::kIo, file.string() + ": cannot be written: " + error.what()};
    }
}

} // namespace

Result<Writer> Writer::create(const std::filesystem::path& file, const Video& video) {
    std::unique_ptr<File> made;
    const auto begun = told(file, [&] {
        made = std::make_unique<File>(file, video);
        made->begin();
    });
    if (!begun) {
        return begun.error();
    }
    return Writer(std::move(made));
}

Writer::Writer(std::unique_ptr<File> file) : file_(std::move(file)) {}
Writer::~Writer() = default;
Writer::Writer(Writer&& other) noexcept = default;
Writer& Writer::operator=(Writer&& other) noexcept = default;

Result<void> Writer::add(std::span<const std::byte> frame, bool key) {
    FROXEL_ASSERT(key || !file_->frames.empty(), "a video begins with a key frame");
    return told(file_->path, [&] {
        if (key) {
            file_->writeCluster();
        }
        file_->frames.emplace_back(frame.begin(), frame.end());
    });
}

Result<void> Writer::finish() {
    return told(file_->path, [&] { file_->end(); });
}

} // namespace froxel::webm
