#include "stream/frame_pipeline.h"

#include "core/assert.h"
#include "core/text.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace froxel::stream {
namespace {

settings::Codec codecOf(const DrawnFrame& frame) {
    return frame.record.delivered.encoding.codec;
}

// What a mesh may take: about a twentieth of a JPEG, and of video, which is small itself, a fifth.
struct MeshQuality {
    uint32_t cell_px = 0;
    uint32_t bits = 0;
};
MeshQuality meshQualityOf(settings::Codec codec) {
    return settings::rowOf(codec).frames_depend ? MeshQuality{2 * kDepthCell_px, 8}
                                                : MeshQuality{kDepthCell_px, 9};
}

} // namespace

FramePipeline::FramePipeline(encode::EncodePool& pool,
                             session::SessionId session,
                             std::weak_ptr<session::FrameSink> sink,
                             std::shared_ptr<FrameFates> fates,
                             std::function<void()> on_progress)
    : pool_(pool), session_(session), sink_(std::move(sink)), fates_(std::move(fates)),
      on_progress_(std::move(on_progress)) {}

uint32_t FramePipeline::size() const {
    const std::lock_guard lock(mutex_);
    return static_cast<uint32_t>(encoding_.has_value()) +
           static_cast<uint32_t>(waiting_.has_value());
}

FramePipeline::Losses FramePipeline::takeLosses() {
    const std::lock_guard lock(mutex_);
    return std::exchange(losses_, {});
}

Seconds FramePipeline::takeWork() {
    const std::lock_guard lock(mutex_);
    return std::exchange(work_, Seconds(0));
}

void FramePipeline::push(DrawnFrame frame) {
    const bool lossless = settings::rowOf(codecOf(frame)).lossless;
    bool waits = false;
    {
        const std::lock_guard lock(mutex_);
        FROXEL_ASSERT(!waiting_, "more pictures pushed than the pipeline holds");
        waits = encoding_.has_value();
        (waits ? waiting_ : encoding_) = std::move(frame);
    }
    if (!waits) {
        startEncoding();
    } else if (!lossless && pool_.withdrawLossless(this)) {
        finish({1, false}); // the view moves on: nobody wants that picture any more
    }
}

void FramePipeline::keepDepth() {
    const PixelView& pixels = encoding_->pixels.view();
    inverse_distances_.clear();
    const float* const vertices = pixels.output(Output::kDepthMesh);
    if (vertices == nullptr) {
        return;
    }
    const DepthMeshSize drawn(pixels.width_px, pixels.height_px);
    const uint32_t cells = meshQualityOf(codecOf(*encoding_)).cell_px / kDepthCell_px;
    const DepthMeshSize kept(pixels.width_px, pixels.height_px, cells * kDepthCell_px);
    inverse_distances_.reserve(kept.vertexCount());
    for (uint32_t y = 0; y < kept.rows; ++y) {
        const size_t row = size_t{std::min(cells * y, drawn.rows - 1)} * drawn.columns;
        for (uint32_t x = 0; x < kept.columns; ++x) {
            inverse_distances_.push_back(vertices[row + std::min(cells * x, drawn.columns - 1)]);
        }
    }
}

// What rests looks the same from a camera that rests: the mesh before is still right, and so it is
// for a refined picture, which comes without.
void FramePipeline::codeDepth() {
    session::FrameRecord& record = encoding_->record;
    if (!inverse_distances_.empty()) {
        const MeshQuality quality = meshQualityOf(codecOf(*encoding_));
        auto coded = protocol::encodeDepthMesh(
            inverse_distances_, DepthMeshSize(record.width_px, record.height_px, quality.cell_px),
            quality.bits);
        coded.cell_px = quality.cell_px;
        if (!depth_ || *depth_ != coded) {
            depth_ = std::make_shared<const protocol::CodedDepthMesh>(std::move(coded));
            ++depth_number_;
        }
        depth_version_ = encoding_->version;
        record.depth_mesh = depth_number_;
    } else if (record.delivered.refinement != session::Refinement::kInteractive &&
               depth_version_ == encoding_->version) {
        record.depth_mesh = depth_number_;
    }
}

void FramePipeline::startEncoding() {
    keepDepth();
    // After a refined still the video goes on where it was.
    if (!settings::rowOf(codecOf(*encoding_)).frames_depend &&
        encoding_->record.delivered.refinement < session::Refinement::kHigh) {
        video_.reset();
    }
    encoding_->record.encode_wait_us = Microseconds(Clock::now() - encoding_->drawn_at).count();
    bool taken = false;
    {
        const session::Delivered& with = encoding_->record.delivered;
        encode::EncodeJob job{std::move(encoding_->pixels),
                              with.encoding,
                              [self = shared_from_this()](Result<EncodedFrame> result) {
                                  self->onEncoded(std::move(result));
                              },
                              videoJob(*encoding_),
                              this,
                              composition()};
        taken = pool_.submit(std::move(job));
    } // a lease that was not taken ends here
    if (!taken) {
        finish({1, true});
    }
}

std::function<PixelLease(PixelLease)> FramePipeline::composition() {
    if (!encoding_->compared) {
        return nullptr;
    }
    return [self = shared_from_this()](PixelLease right) {
        DrawnFrame& frame = *self->encoding_;
        return compose(*frame.compared, std::move(right), *frame.record.compared);
    };
}

// A request is served when its key frame is there: until then the pool may refuse the job.
std::optional<encode::VideoJob> FramePipeline::videoJob(const DrawnFrame& frame) {
    const settings::Codec codec = codecOf(frame);
    if (!settings::rowOf(codec).frames_depend) {
        return {};
    }
    if (!video_ || video_codec_ != codec) {
        video_ = encode::makeEncoder(codec, pool_.threadCount());
        video_codec_ = codec;
    }
    return encode::VideoJob{video_, frame.key_requests != key_requests_, frame.drawn_at};
}

void FramePipeline::onEncoded(Result<EncodedFrame> result) {
    if (!result) {
        const Error& error = result.error();
        spdlog::error("event=frame_not_encoded session={} frame={} reason={}", session_,
                      encoding_->record.frame_id, logValue(error.message));
        // A full or closing encoder may take it the next time; anything else would fail again.
        const bool retry = error.code == ErrorCode::kCapacity;
        if (const auto sink = retry ? nullptr : sink_.lock()) {
            sink->notEncoded(error);
        }
        finish({1, retry});
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        work_ += Microseconds(result->busy_us);
    }
    session::FrameRecord& record = encoding_->record;
    record.encoded_bytes = result->bytes->size();
    record.encode_wait_us += result->wait_us;
    record.encode_us = result->encode_us;
    record.key = result->key;
    if (result->key) {
        key_requests_ = encoding_->key_requests;
    }
    codeDepth();
    auto depth = record.depth_mesh > 0 ? depth_ : nullptr;
    const Seconds cost = std::max(encoding_->cost, Seconds(Microseconds(result->encode_us)));
    ++fates_->encoded;
    if (const auto sink = sink_.lock()) {
        sink->deliver(
            {std::move(record), std::move(result->bytes), std::move(depth), cost, Clock::now()});
    }
    finish({});
}

void FramePipeline::finish(Losses losses) {
    fates_->not_encoded += losses.count;
    bool more = false;
    {
        const std::lock_guard lock(mutex_);
        losses_.count += losses.count;
        losses_.retry = losses_.retry || losses.retry;
        encoding_ = std::exchange(waiting_, std::nullopt);
        more = encoding_.has_value();
    }
    if (more) {
        startEncoding();
    }
    on_progress_();
}

} // namespace froxel::stream
