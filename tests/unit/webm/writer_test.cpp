// Files are read by libwebm, which shares nothing with what writes them.
#include "support/temp_folder.h"
#include "webm/writer.h"

#include <cstdio>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <memory>
#include <string>
#include <vector>
#include <webm/callback.h>
#include <webm/file_reader.h>
#include <webm/webm_parser.h>

namespace froxel::webm {
namespace {

using testing::HasSubstr;

struct Block {
    double at_ms = 0;
    bool key = false;
    std::string bytes;
};

class Read final : public ::webm::Callback {
  public:
    std::string type;
    std::string codec;
    double duration_ms = 0;
    uint64_t width_px = 0;
    uint64_t height_px = 0;
    uint64_t range = 0;
    std::vector<Block> blocks;
    std::map<uint64_t, uint64_t> cues;     // time to the cluster's place
    std::map<uint64_t, uint64_t> clusters; // place in the segment to time
    uint64_t segment_at = 0;
    bool is_whole = false; // the segment's size is known

    ::webm::Status OnElementBegin(const ::webm::ElementMetadata& metadata,
                                  ::webm::Action* action) override {
        *action = ::webm::Action::kRead;
        if (metadata.id == ::webm::Id::kSegment) {
            segment_at = metadata.position + metadata.header_size;
            is_whole = metadata.size != ::webm::kUnknownElementSize;
        }
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status OnEbml(const ::webm::ElementMetadata&, const ::webm::Ebml& ebml) override {
        type = ebml.doc_type.value();
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status OnInfo(const ::webm::ElementMetadata&, const ::webm::Info& info) override {
        duration_ms = info.duration.value();
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status OnTrackEntry(const ::webm::ElementMetadata&,
                                const ::webm::TrackEntry& track) override {
        codec = track.codec_id.value();
        width_px = track.video.value().pixel_width.value();
        height_px = track.video.value().pixel_height.value();
        range = static_cast<uint64_t>(track.video.value().colour.value().range.value());
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status OnClusterBegin(const ::webm::ElementMetadata& metadata,
                                  const ::webm::Cluster& cluster,
                                  ::webm::Action* action) override {
        *action = ::webm::Action::kRead;
        cluster_ms_ = cluster.timecode.value();
        clusters[metadata.position - segment_at] = cluster_ms_;
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status OnSimpleBlockBegin(const ::webm::ElementMetadata&,
                                      const ::webm::SimpleBlock& block,
                                      ::webm::Action* action) override {
        *action = ::webm::Action::kRead;
        blocks.push_back(
            {static_cast<double>(cluster_ms_) + block.timecode, block.is_key_frame, {}});
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status
    OnFrame(const ::webm::FrameMetadata&, ::webm::Reader* reader, uint64_t* left) override {
        std::string& bytes = blocks.back().bytes;
        while (*left > 0) {
            std::vector<uint8_t> part(*left);
            uint64_t count = 0;
            const auto status = reader->Read(part.size(), part.data(), &count);
            bytes.append(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
            *left -= count;
            if (!status.ok()) {
                return status;
            }
        }
        return ::webm::Status(::webm::Status::kOkCompleted);
    }
    ::webm::Status OnCuePoint(const ::webm::ElementMetadata&,
                              const ::webm::CuePoint& cue) override {
        cues[cue.time.value()] = cue.cue_track_positions.front().value().cluster_position.value();
        return ::webm::Status(::webm::Status::kOkCompleted);
    }

  private:
    uint64_t cluster_ms_ = 0;
};

Read readOf(const std::filesystem::path& file) {
    Read read;
    ::webm::FileReader reader(std::fopen(file.c_str(), "rb"));
    ::webm::WebmParser parser;
    const auto status = parser.Feed(&read, &reader);
    EXPECT_TRUE(status.completed_ok()) << status.code;
    return read;
}

std::vector<std::byte> frameOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

TEST(WebmWriter, Frames_AreReadWithTheirTimes) {
    const test::TempFolder folder("froxel_webm");
    const auto file = folder.path() / "film.webm";
    auto writer =
        Writer::create(file, {.width_px = 64, .height_px = 36, .frames_per_s = 30}).value();
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(writer.add(frameOf("frame " + std::to_string(i)), i % 40 == 0));
    }
    ASSERT_TRUE(writer.finish());

    const Read read = readOf(file);
    EXPECT_EQ(read.type, "webm");
    EXPECT_EQ(read.codec, "V_VP9");
    EXPECT_EQ(read.width_px, 64U);
    EXPECT_EQ(read.height_px, 36U);
    EXPECT_EQ(read.range, 2U); // full
    EXPECT_TRUE(read.is_whole);
    EXPECT_NEAR(read.duration_ms, 100 / 0.03, 1e-6);
    ASSERT_EQ(read.blocks.size(), 100U);
    for (size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(read.blocks[i].bytes, "frame " + std::to_string(i));
        EXPECT_EQ(read.blocks[i].key, i % 40 == 0);
        EXPECT_NEAR(read.blocks[i].at_ms, static_cast<double>(i) / 0.03, 0.5);
    }
}

TEST(WebmWriter, Cues_LeadToEachKeyFrame) {
    const test::TempFolder folder("froxel_webm");
    const auto file = folder.path() / "film.webm";
    auto writer = Writer::create(file, {.width_px = 8, .height_px = 8, .frames_per_s = 10}).value();
    for (int i = 0; i < 50; ++i) {
        ASSERT_TRUE(writer.add(frameOf(std::string(1000, 'x')), i % 20 == 0));
    }
    ASSERT_TRUE(writer.finish());
    const Read read = readOf(file);
    ASSERT_EQ(read.cues.size(), 3U);
    for (const auto& [time_ms, place] : read.cues) {
        ASSERT_EQ(read.clusters.count(place), 1U) << time_ms;
        EXPECT_EQ(read.clusters.at(place), time_ms);
    }
    EXPECT_TRUE(read.cues.contains(4000));
}

TEST(WebmWriter, OneFrame_IsAFile) {
    const test::TempFolder folder("froxel_webm");
    const auto file = folder.path() / "film.webm";
    auto writer = Writer::create(file, {.width_px = 8, .height_px = 8, .frames_per_s = 1}).value();
    ASSERT_TRUE(writer.add(frameOf("one"), true));
    ASSERT_TRUE(writer.finish());
    const Read read = readOf(file);
    EXPECT_EQ(read.blocks.size(), 1U);
    EXPECT_EQ(read.duration_ms, 1000);
}

TEST(WebmWriter, FolderThatIsNotThere_IsToldByName) {
    const auto writer =
        Writer::create("/nowhere/film.webm", {.width_px = 8, .height_px = 8, .frames_per_s = 1});
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().code, ErrorCode::kIo);
    EXPECT_THAT(writer.error().message, HasSubstr("/nowhere/film.webm: cannot be written"));
}

TEST(WebmWriter, FullDisk_IsTold) {
    auto writer = Writer::create("/dev/full", {.width_px = 8, .height_px = 8, .frames_per_s = 1});
    if (!writer) {
        EXPECT_EQ(writer.error().code, ErrorCode::kIo);
        return;
    }
    bool ok = true;
    for (int i = 0; i < 100 && ok; ++i) {
        ok = static_cast<bool>(writer->add(frameOf(std::string(10'000, 'x')), true));
    }
    ok = ok && static_cast<bool>(writer->finish());
    EXPECT_FALSE(ok);
}

} // namespace
} // namespace froxel::webm
