#include "net/metrics.h"

#include "net/metric_family.h"
#include "net/process_metrics.h"
#include "protocol/limits.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <utility>

namespace froxel::net {
namespace {

using prometheus::Counter;
using prometheus::Gauge;
using prometheus::Histogram;
using session::FrameRecord;

// From a GPU's pass to a slow link, in steps that tell 60 frames a second from 30.
const Histogram::BucketBoundaries kSeconds = {0.0005, 0.001, 0.002, 0.004, 0.008, 0.016, 0.033,
                                              0.066,  0.1,   0.2,   0.5,   1.0,   2.0,   5.0};

// Around what a piece may take on a GPU and on a CPU device.
const Histogram::BucketBoundaries kSteps = {0.001, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2};
const Histogram::BucketBoundaries kQualities = {30, 45, 55, 65, 75, 85, 92, 100};
const Histogram::BucketBoundaries kScales = {0.4, 0.5, 0.6, 0.7, 0.75, 0.85, 1.0};

// In the order of session::RateStep, without kNone.
constexpr std::array kRateReasons = {"congested", "recovered", "undone"};

// The other pictures have waited for nothing that somebody asked for.
bool showsNewCommand(const FrameRecord& record) {
    return record.applied.seq > 0 && record.queue_us > 0;
}

using Micros = std::optional<double>;
struct Stage {
    const char* name;
    Micros (*micros)(const FrameRecord&); // none: not observed
};
constexpr std::array kStages = {
    Stage{"queue",
          [](const FrameRecord& r) { return showsNewCommand(r) ? Micros(r.queue_us) : Micros(); }},
    Stage{"render", [](const FrameRecord& r) { return Micros(r.render_us); }},
    Stage{"host", [](const FrameRecord& r) { return Micros(r.stats.host_us); }},
    Stage{"gpu", [](const FrameRecord& r) { return r.stats.gpu_us; }},
    Stage{"encode_wait", [](const FrameRecord& r) { return Micros(r.encode_wait_us); }},
    Stage{"encode", [](const FrameRecord& r) { return Micros(r.encode_us); }},
    Stage{"send_wait", [](const FrameRecord& r) { return Micros(r.send_wait_us); }},
};

struct ListGauge {
    const char* name;
    const char* help;
    double (*value)(const LightListStats&);
};
constexpr std::array kListGauges = {
    ListGauge{"froxel_lights", "Point and spot lights of the last frame sent.",
              [](const LightListStats& s) { return static_cast<double>(s.light_count); }},
    ListGauge{"froxel_light_list_entries", "Light indices in all lists of the last frame sent.",
              [](const LightListStats& s) { return static_cast<double>(s.entry_count); }},
    ListGauge{"froxel_light_list_mean_entries",
              "Mean length of the non-empty lists of the last frame sent.",
              [](const LightListStats& s) { return s.mean; }},
    ListGauge{"froxel_light_list_p95_entries", "95th percentile of the lengths of these lists.",
              [](const LightListStats& s) { return static_cast<double>(s.p95); }},
    ListGauge{"froxel_light_list_largest_entries", "Length of the longest of these lists.",
              [](const LightListStats& s) { return static_cast<double>(s.largest); }},
    ListGauge{"froxel_light_list_clusters", "Clusters in the grid of the last frame sent.",
              [](const LightListStats& s) { return static_cast<double>(s.cluster_count); }},
    ListGauge{"froxel_light_list_empty_clusters", "Clusters without a light.",
              [](const LightListStats& s) { return static_cast<double>(s.empty_count); }},
    ListGauge{"froxel_light_list_bytes", "Device memory of the lists of the last frame sent.",
              [](const LightListStats& s) { return static_cast<double>(s.bytes); }},
    ListGauge{"froxel_light_list_all_lights",
              "1 if the last frame sent has no lists and loops over all lights.",
              [](const LightListStats& s) { return s.all_lights ? 1.0 : 0.0; }},
};

// Of refused upgrades.
constexpr std::array kUpgradeStatuses = {400U, 403U, 404U, 503U};

constexpr std::array kRequestRefusals = {std::pair(RequestRefusal::kToken, "token"),
                                         std::pair(RequestRefusal::kRate, "rate"),
                                         std::pair(RequestRefusal::kForeign, "foreign")};

// Close codes with rows of their own: RFC 6455's that happen, and the protocol's.
bool isKnown(uint16_t code) {
    return (code >= 1000 && code <= 1011) || (code >= 4001 && code <= 4099);
}

} // namespace

struct Metrics::Impl {
    explicit Impl(std::function<size_t()> count) : session_count(std::move(count)) {}

    prometheus::Registry registry;

    Counter& counter(const char* name, const char* help) {
        return prometheus::BuildCounter().Name(name).Help(help).Register(registry).Add({});
    }
    Gauge& gauge(const char* name, const char* help) {
        return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
    }
    prometheus::Family<Counter>& family(const char* name, const char* help) {
        return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
    }
    [[nodiscard]] std::vector<prometheus::MetricFamily> frameFamilies() const;
    Histogram&
    histogram(const char* name, const char* help, const Histogram::BucketBoundaries& bounds) {
        return prometheus::BuildHistogram().Name(name).Help(help).Register(registry).Add({},
                                                                                         bounds);
    }
    void noteDelivery(const FrameRecord& record);
    [[nodiscard]] prometheus::MetricFamily sessionFamily() const;
    [[nodiscard]] prometheus::MetricFamily memoryFamily() const;
    [[nodiscard]] prometheus::MetricFamily loadFamily() const;
    [[nodiscard]] std::vector<prometheus::MetricFamily> sceneFamilies() const;
    [[nodiscard]] std::vector<prometheus::MetricFamily> uploadFamilies() const;
    [[nodiscard]] std::vector<prometheus::MetricFamily> stillFamilies() const;
    [[nodiscard]] prometheus::MetricFamily logFamily() const;

    const std::function<size_t()> session_count;
    Gauge& viewers = gauge("froxel_viewers", "Connected viewers.");
    Gauge& capacity = gauge("froxel_session_capacity", "Maximum number of sessions.");
    Counter& device_losses =
        counter("froxel_device_losses_total", "Device losses in earlier runs.");
    Counter& joined =
        counter("froxel_viewers_joined_total", "Viewers that joined since the start.");
    Counter& sent = counter("froxel_frames_sent_total", "Frames sent.");
    std::atomic<uint64_t> replaced{0};
    const std::shared_ptr<FrameFates> fates = std::make_shared<FrameFates>();
    Counter& bytes = counter("froxel_sent_bytes_total", "Bytes of sent frames and messages.");
    Counter& depth_bytes =
        counter("froxel_depth_bytes_total", "Bytes of depth sent with frames, part of all bytes.");
    Counter& redraws = counter("froxel_light_list_redraws_total",
                               "Frames drawn again because their lists outgrew their memory.");
    Counter& kept = counter("froxel_frames_kept_total",
                            "Frames sent that reused the surfaces of the previous frame.");
    Counter& peel_overflow =
        counter("froxel_peel_overflow_pixels_total",
                "Pixels of sent frames with more blended layers than were peeled.");
    Histogram& quality =
        histogram("froxel_frame_quality", "JPEG quality of sent frames.", kQualities);
    Histogram& scale = histogram("froxel_frame_scale",
                                 "Side length of sent frames, as a share of the requested one.",
                                 kScales);
    Histogram& queue_delay =
        histogram("froxel_queue_delay_seconds", "Delay of sent frames on the link.", kSeconds);
    std::array<Counter*, kRateReasons.size()> rate_steps{};
    std::array<Counter*, session::kRefinementNames.size()> refinements{};
    std::array<Histogram*, kStages.size()> stages{};
    std::array<Gauge*, kListGauges.size()> lists{};
    prometheus::Family<Histogram>& steps =
        prometheus::BuildHistogram()
            .Name("froxel_frame_step_seconds")
            .Help("Duration of one step of a frame: to begin it, or to draw a piece of it. Other "
                  "viewers are served between steps.")
            .Register(registry);
    Histogram& begun = steps.Add({{"step", "begin"}}, kSteps);
    Histogram& pieces = steps.Add({{"step", "piece"}}, kSteps);
    Counter& refused_connections =
        counter("froxel_connections_refused_total", "Connections over the limit.");
    prometheus::Family<Counter>& rejects =
        family("froxel_command_rejects_total", "Messages of viewers answered with an error.");
    prometheus::Family<Counter>& closes =
        family("froxel_websocket_closes_total", "Closed WebSockets, by close code.");
    prometheus::Family<Counter>& upgrades =
        family("froxel_upgrades_refused_total", "Refused WebSocket upgrades.");
    prometheus::Family<Counter>& requests =
        family("froxel_requests_refused_total", "Refused HTTP requests.");
    std::map<RequestRefusal, Counter*> refused_requests{}; // fixed once it is made
    prometheus::Family<Counter>& pairs = family(
        "froxel_light_pairs_total", "(light, pixel) pairs of sent frames with counting turned on.");
    Counter& evaluated = pairs.Add({{"kind", "evaluated"}});
    Counter& contributing = pairs.Add({{"kind", "contributing"}});
    mutable std::mutex watch_mutex;
    std::function<std::vector<MemoryUse>()> memory;
    std::function<double()> load;
    std::function<uint64_t()> log_lost;
    std::function<still::StillCounts()> stills;   // likewise
    std::function<session::SceneCounts()> scenes; // none: nothing is told of them
    std::function<guest::GuestStore::Counts()> uploads;
};

Metrics::Metrics(const std::string& version, std::function<size_t()> session_count)
    : impl_(std::make_unique<Impl>(std::move(session_count))) {
    prometheus::BuildGauge()
        .Name("froxel_build_info")
        .Help("1; the labels describe this server.")
        .Register(impl_->registry)
        .Add({{"version", version},
              {"protocol",
               std::to_string(protocol::kMajor) + "." + std::to_string(protocol::kMinor)}})
        .Set(1);
    // There from the start, so that their first one shows as a rise.
    for (const auto code : protocol::kCloseCodes) {
        impl_->closes.Add({{"code", std::to_string(static_cast<unsigned>(code))}});
    }
    for (const auto code : session::kRejectCodes) {
        impl_->rejects.Add({{"reason", session::nameOf(code)}});
    }
    for (const unsigned status : kUpgradeStatuses) {
        impl_->upgrades.Add({{"status", std::to_string(status)}});
    }
    for (const auto& [why, reason] : kRequestRefusals) {
        impl_->refused_requests[why] = &impl_->requests.Add({{"reason", reason}});
    }
    auto& stages = prometheus::BuildHistogram()
                       .Name("froxel_stage_duration_seconds")
                       .Help("Duration of each stage from command to socket, for sent frames, once "
                             "for each viewer. queue: only frames that show a new command. gpu: "
                             "only if the driver reports it.")
                       .Register(impl_->registry);
    for (size_t i = 0; i < kStages.size(); ++i) {
        impl_->stages[i] = &stages.Add({{"stage", kStages[i].name}}, kSeconds);
    }
    auto& steps = prometheus::BuildCounter()
                      .Name("froxel_rate_steps_total")
                      .Help("Adaptation steps down and up, by reason.")
                      .Register(impl_->registry);
    for (size_t i = 0; i < kRateReasons.size(); ++i) {
        impl_->rate_steps[i] = &steps.Add({{"reason", kRateReasons[i]}});
    }
    auto& refinements = prometheus::BuildCounter()
                            .Name("froxel_refinement_frames_total")
                            .Help("Frames sent, by their refinement stage.")
                            .Register(impl_->registry);
    for (size_t i = 0; i < session::kRefinementNames.size(); ++i) {
        impl_->refinements[i] =
            &refinements.Add({{"refinement", std::string(session::kRefinementNames[i])}});
    }
    for (size_t i = 0; i < kListGauges.size(); ++i) {
        impl_->lists[i] = &impl_->gauge(kListGauges[i].name, kListGauges[i].help);
    }
}

Metrics::~Metrics() = default;

void Metrics::setSessionCapacity(uint32_t sessions_max) {
    impl_->capacity.Set(sessions_max);
}

void Metrics::setDeviceLosses(uint64_t count) {
    impl_->device_losses.Increment(static_cast<double>(count));
}

void Metrics::sessionOpened() {
    impl_->viewers.Increment();
    impl_->joined.Increment();
}

void Metrics::sessionClosed() {
    impl_->viewers.Decrement();
}

void Metrics::depthSent(size_t bytes) {
    impl_->depth_bytes.Increment(static_cast<double>(bytes));
}

void Metrics::frameSent(const FrameRecord& record) {
    impl_->sent.Increment();
    impl_->kept.Increment(record.stats.surfaces_reused ? 1 : 0);
    impl_->redraws.Increment(static_cast<double>(record.stats.lists.redraw_count));
    impl_->peel_overflow.Increment(record.stats.steps.find("peel", "overflow_pixels").value_or(0));
    for (size_t i = 0; i < kStages.size(); ++i) {
        if (const Micros micros = kStages[i].micros(record)) {
            impl_->stages[i]->Observe(*micros / 1e6);
        }
    }
    for (size_t i = 0; i < kListGauges.size(); ++i) {
        impl_->lists[i]->Set(kListGauges[i].value(record.stats.lists));
    }
    impl_->evaluated.Increment(record.stats.steps.find("pairs", "evaluated").value_or(0));
    impl_->contributing.Increment(record.stats.steps.find("pairs", "contributing").value_or(0));
    impl_->noteDelivery(record);
}

void Metrics::Impl::noteDelivery(const FrameRecord& record) {
    const session::Delivered& with = record.delivered;
    if (with.refinement != session::Refinement::kLossless) {
        quality.Observe(with.encoding.quality);
    }
    scale.Observe(with.scale);
    queue_delay.Observe(record.queue_delay_us / 1e6);
    refinements.at(static_cast<size_t>(with.refinement))->Increment();
}

void Metrics::rateStepped(session::RateStep step) {
    if (step != session::RateStep::kNone) {
        impl_->rate_steps.at(static_cast<size_t>(step) - 1)->Increment();
    }
}

void Metrics::frameDropped() {
    ++impl_->replaced;
}

void Metrics::commandRejected(session::RejectCode code) {
    impl_->rejects.Add({{"reason", session::nameOf(code)}}).Increment();
}

void Metrics::socketClosed(uint16_t code) {
    impl_->closes.Add({{"code", isKnown(code) ? std::to_string(code) : "other"}}).Increment();
}

void Metrics::upgradeRefused(unsigned http_status) {
    impl_->upgrades.Add({{"status", std::to_string(http_status)}}).Increment();
}

void Metrics::requestRefused(RequestRefusal why) {
    impl_->refused_requests.at(why)->Increment();
}

void Metrics::connectionRefused() {
    impl_->refused_connections.Increment();
}

void Metrics::frameBegun(Seconds took) {
    impl_->begun.Observe(took.count());
}

void Metrics::pieceDrawn(Seconds took) {
    impl_->pieces.Observe(took.count());
}

std::shared_ptr<FrameFates> Metrics::fates() const {
    return impl_->fates;
}

void Metrics::watchMemory(std::function<std::vector<MemoryUse>()> memory) {
    const std::lock_guard lock(impl_->watch_mutex);
    impl_->memory = std::move(memory);
}

void Metrics::watchLoad(std::function<double()> load) {
    const std::lock_guard lock(impl_->watch_mutex);
    impl_->load = std::move(load);
}

prometheus::MetricFamily Metrics::Impl::loadFamily() const {
    const std::lock_guard lock(watch_mutex);
    return metricFamily(prometheus::MetricType::Gauge, "froxel_device_load",
                        "Used fraction of the device time that the server admits, 0 to 1.", "",
                        {{"", load ? load() : 0.0}});
}

void Metrics::watchScenes(std::function<session::SceneCounts()> scenes) {
    const std::lock_guard lock(impl_->watch_mutex);
    impl_->scenes = std::move(scenes);
}

std::vector<prometheus::MetricFamily> Metrics::Impl::sceneFamilies() const {
    const std::lock_guard lock(watch_mutex);
    if (!scenes) {
        return {};
    }
    const session::SceneCounts counts = scenes();
    const auto number = [](uint64_t value) { return static_cast<double>(value); };
    using prometheus::MetricType;
    return {
        metricFamily(MetricType::Gauge, "froxel_scenes", "Scenes by state.", "state",
                     {{"resident", number(counts.resident)}, {"loading", number(counts.loading)}}),
        metricFamily(MetricType::Gauge, "froxel_scene_memory_bytes",
                     "Device memory of all scenes except the first.", "",
                     {{"", number(counts.bytes)}}),
        metricFamily(MetricType::Counter, "froxel_scene_loads_total", "Loads of scenes, by result.",
                     "result",
                     {{"loaded", number(counts.loaded_total)},
                      {"failed", number(counts.failed_total)},
                      {"refused", number(counts.refused_total)}}),
        metricFamily(MetricType::Counter, "froxel_scenes_evicted_total",
                     "Scenes that left the device to make room for others.", "",
                     {{"", number(counts.evicted_total)}})};
}

void Metrics::watchUploads(std::function<guest::GuestStore::Counts()> uploads) {
    const std::lock_guard lock(impl_->watch_mutex);
    impl_->uploads = std::move(uploads);
}

std::vector<prometheus::MetricFamily> Metrics::Impl::uploadFamilies() const {
    const std::lock_guard lock(watch_mutex);
    if (!uploads) {
        return {};
    }
    const guest::GuestStore::Counts counts = uploads();
    const auto number = [](uint64_t value) { return static_cast<double>(value); };
    using guest::GuestStore;
    using prometheus::MetricType;
    std::vector<std::pair<std::string, double>> removed;
    for (size_t reason = 0; reason < GuestStore::kRemovals.size(); ++reason) {
        removed.emplace_back(GuestStore::kRemovals[reason], number(counts.removed_total[reason]));
    }
    return {
        metricFamily(MetricType::Gauge, "froxel_uploads", "Uploaded scenes by state.", "state",
                     {{"receiving", number(counts.receiving)}, {"ready", number(counts.ready)}}),
        metricFamily(MetricType::Gauge, "froxel_upload_bytes",
                     "Bytes of uploaded scenes, with those that are still to come.", "",
                     {{"", number(counts.bytes)}}),
        metricFamily(MetricType::Counter, "froxel_uploads_completed_total",
                     "Uploads that arrived whole.", "", {{"", number(counts.completed_total)}}),
        metricFamily(MetricType::Counter, "froxel_uploads_removed_total",
                     "Uploads that were removed, by reason.", "reason", removed)};
}

void Metrics::watchStills(std::function<still::StillCounts()> stills) {
    const std::lock_guard lock(impl_->watch_mutex);
    impl_->stills = std::move(stills);
}

std::vector<prometheus::MetricFamily> Metrics::Impl::stillFamilies() const {
    const std::lock_guard lock(watch_mutex);
    if (!stills) {
        return {};
    }
    const still::StillCounts counts = stills();
    const auto number = [](uint64_t value) { return static_cast<double>(value); };
    return {metricFamily(prometheus::MetricType::Counter, "froxel_stills_total",
                         "Stills and thumbnails, by result.", "result",
                         {{"drawn", number(counts.drawn_total)},
                          {"kept", number(counts.kept_total)},
                          {"refused", number(counts.refused_total)},
                          {"put_off", number(counts.put_off_total)}})};
}

void Metrics::watchLog(std::function<uint64_t()> lost) {
    const std::lock_guard lock(impl_->watch_mutex);
    impl_->log_lost = std::move(lost);
}

prometheus::MetricFamily Metrics::Impl::logFamily() const {
    const std::lock_guard lock(watch_mutex);
    return metricFamily(prometheus::MetricType::Counter, "froxel_log_lines_lost_total",
                        "Log lines that the log's reader did not take.", "",
                        {{"", log_lost ? static_cast<double>(log_lost()) : 0.0}});
}

prometheus::MetricFamily Metrics::Impl::sessionFamily() const {
    return metricFamily(prometheus::MetricType::Gauge, "froxel_sessions",
                        "Sessions with a viewer, or waiting for a lost one; a room is one session.",
                        "", {{"", static_cast<double>(session_count())}});
}

prometheus::MetricFamily Metrics::Impl::memoryFamily() const {
    std::vector<MetricRow> rows;
    const std::lock_guard lock(watch_mutex);
    for (const MemoryUse& use : memory ? memory() : std::vector<MemoryUse>{}) {
        rows.emplace_back(use.purpose, static_cast<double>(use.bytes));
    }
    return metricFamily(prometheus::MetricType::Gauge, "froxel_device_memory_bytes",
                        "Device memory by purpose.", "purpose", rows);
}

std::vector<prometheus::MetricFamily> Metrics::Impl::frameFamilies() const {
    const auto count = [](const std::atomic<uint64_t>& value) {
        return static_cast<double>(value.load());
    };
    using prometheus::MetricType;
    return {metricFamily(MetricType::Counter, "froxel_frames_rendered_total",
                         "Frames that left the device.", "", {{"", count(fates->rendered)}}),
            metricFamily(MetricType::Counter, "froxel_frames_encoded_total",
                         "Frames that left an encoder.", "", {{"", count(fates->encoded)}}),
            metricFamily(MetricType::Counter, "froxel_frames_sampled_total",
                         "Frames of static views drawn as samples of a later mean.", "",
                         {{"", count(fates->samples)}}),
            metricFamily(MetricType::Counter, "froxel_frames_dropped_total",
                         "Frames begun and not sent.", "reason",
                         {{"replaced", count(replaced)},
                          {"not_encoded", count(fates->not_encoded)},
                          {"viewer_gone", count(fates->viewer_gone)},
                          {"given_up", count(fates->given_up)}})};
}

void Metrics::bytesSent(size_t count) {
    impl_->bytes.Increment(static_cast<double>(count));
}

std::string Metrics::text() const {
    auto families = impl_->registry.Collect();
    for (auto more : {impl_->frameFamilies(), impl_->sceneFamilies(), impl_->uploadFamilies(),
                      impl_->stillFamilies(), processMetrics()}) {
        std::move(more.begin(), more.end(), std::back_inserter(families));
    }
    families.push_back(impl_->sessionFamily());
    families.push_back(impl_->memoryFamily());
    families.push_back(impl_->loadFamily());
    families.push_back(impl_->logFamily());
    return prometheus::TextSerializer().Serialize(families);
}

} // namespace froxel::net
