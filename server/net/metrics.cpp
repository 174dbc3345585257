#include "net/metrics.h"

#include <array>
#include <map>
#include <mutex>
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

struct Stage {
    const char* name;
    double (*micros)(const FrameRecord&);
};
constexpr std::array kStages = {
    Stage{"queue", [](const FrameRecord& r) { return r.queue_us; }},
    Stage{"render", [](const FrameRecord& r) { return r.render_us; }},
    Stage{"host", [](const FrameRecord& r) { return r.stats.host_us; }},
    Stage{"gpu", [](const FrameRecord& r) { return r.stats.gpu_us; }},
    Stage{"encode_wait", [](const FrameRecord& r) { return r.encode_wait_us; }},
    Stage{"encode", [](const FrameRecord& r) { return r.encode_us; }},
    Stage{"send_wait", [](const FrameRecord& r) { return r.send_wait_us; }},
};

struct ListGauge {
    const char* name;
    const char* help;
    double (*value)(const LightListStats&);
};
constexpr std::array kListGauges = {
    ListGauge{"froxel_lights", "Point and spot lights of the frame sent last.",
              [](const LightListStats& s) { return static_cast<double>(s.light_count); }},
    ListGauge{"froxel_light_list_entries", "Light indices over all of its lists.",
              [](const LightListStats& s) { return static_cast<double>(s.entry_count); }},
    ListGauge{"froxel_light_list_mean_entries", "Mean of its lists that are not empty.",
              [](const LightListStats& s) { return s.mean; }},
    ListGauge{"froxel_light_list_p95_entries", "95th percentile of those.",
              [](const LightListStats& s) { return static_cast<double>(s.p95); }},
    ListGauge{"froxel_light_list_largest_entries", "The longest of them.",
              [](const LightListStats& s) { return static_cast<double>(s.largest); }},
    ListGauge{"froxel_light_list_clusters", "Clusters of its grid.",
              [](const LightListStats& s) { return static_cast<double>(s.cluster_count); }},
    ListGauge{"froxel_light_list_empty_clusters", "Those without a light.",
              [](const LightListStats& s) { return static_cast<double>(s.empty_count); }},
    ListGauge{"froxel_light_list_bytes", "Its lists and light indices in device memory.",
              [](const LightListStats& s) { return static_cast<double>(s.bytes); }},
    ListGauge{"froxel_light_list_all_lights", "1 where it has no lists and loops over all lights.",
              [](const LightListStats& s) { return s.all_lights ? 1.0 : 0.0; }},
};

} // namespace

struct Metrics::Impl {
    prometheus::Registry registry;

    Counter& counter(const char* name, const char* help) {
        return prometheus::BuildCounter().Name(name).Help(help).Register(registry).Add({});
    }
    Gauge& gauge(const char* name, const char* help) {
        return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
    }
    void setMemory(const std::shared_ptr<const FrameDetails>& details);

    Gauge& sessions = gauge("froxel_sessions", "Viewers now.");
    Counter& opened = counter("froxel_sessions_opened_total", "Viewers since the start.");
    Counter& sent = counter("froxel_frames_sent_total", "Pictures sent.");
    Counter& dropped =
        counter("froxel_frames_dropped_total", "Pictures that a newer one replaced unsent.");
    Counter& bytes = counter("froxel_sent_bytes_total", "Bytes of pictures and messages sent.");
    Counter& redraws = counter("froxel_light_list_redraws_total",
                               "Times that a picture was drawn again since its lists had to grow.");
    std::array<Histogram*, kStages.size()> stages{};
    std::array<Gauge*, kListGauges.size()> lists{};
    prometheus::Family<Counter>& pairs =
        prometheus::BuildCounter()
            .Name("froxel_light_pairs_total")
            .Help("(light, pixel) pairs of the pictures sent that counted them.")
            .Register(registry);
    Counter& evaluated = pairs.Add({{"kind", "evaluated"}});
    Counter& contributing = pairs.Add({{"kind", "contributing"}});
    prometheus::Family<Gauge>& memory = prometheus::BuildGauge()
                                            .Name("froxel_device_memory_bytes")
                                            .Help("Device memory by purpose, as last told.")
                                            .Register(registry);

    std::mutex memory_mutex;
    std::shared_ptr<const FrameDetails> told;
    std::map<std::string, Gauge*> purposes;
};

Metrics::Metrics() : impl_(std::make_unique<Impl>()) {
    auto& stages = prometheus::BuildHistogram()
                       .Name("froxel_stage_duration_seconds")
                       .Help("What a picture spends in each stage from command to socket.")
                       .Register(impl_->registry);
    for (size_t i = 0; i < kStages.size(); ++i) {
        impl_->stages[i] = &stages.Add({{"stage", kStages[i].name}}, kSeconds);
    }
    for (size_t i = 0; i < kListGauges.size(); ++i) {
        impl_->lists[i] = &impl_->gauge(kListGauges[i].name, kListGauges[i].help);
    }
}

Metrics::~Metrics() = default;

void Metrics::sessionOpened() {
    impl_->sessions.Increment();
    impl_->opened.Increment();
}

void Metrics::sessionClosed() {
    impl_->sessions.Decrement();
}

void Metrics::frameSent(const FrameRecord& record) {
    impl_->sent.Increment();
    impl_->redraws.Increment(static_cast<double>(record.stats.lists.redraw_count));
    for (size_t i = 0; i < kStages.size(); ++i) {
        impl_->stages[i]->Observe(kStages[i].micros(record) / 1e6);
    }
    for (size_t i = 0; i < kListGauges.size(); ++i) {
        impl_->lists[i]->Set(kListGauges[i].value(record.stats.lists));
    }
    if (const PairStats& pairs = record.stats.pairs; pairs.counted) {
        impl_->evaluated.Increment(static_cast<double>(pairs.evaluated));
        impl_->contributing.Increment(static_cast<double>(pairs.contributing));
    }
    impl_->setMemory(record.stats.details);
}

// Other than the rest seldom news: a purpose that is gone leaves no row behind.
void Metrics::Impl::setMemory(const std::shared_ptr<const FrameDetails>& details) {
    const std::lock_guard lock(memory_mutex);
    if (!details || details == told) {
        return;
    }
    told = details;
    std::map<std::string, Gauge*> rows;
    for (const MemoryUse& use : details->memory) {
        Gauge*& row = rows[use.purpose];
        row = &memory.Add({{"purpose", use.purpose}}); // the one that is there, if any
        row->Set(static_cast<double>(use.bytes));
    }
    for (const auto& [purpose, row] : purposes) {
        if (rows.count(purpose) == 0) {
            memory.Remove(row);
        }
    }
    purposes = std::move(rows);
}

void Metrics::frameDropped() {
    impl_->dropped.Increment();
}

void Metrics::bytesSent(size_t count) {
    impl_->bytes.Increment(static_cast<double>(count));
}

std::string Metrics::text() const {
    return prometheus::TextSerializer().Serialize(impl_->registry.Collect());
}

} // namespace froxel::net
