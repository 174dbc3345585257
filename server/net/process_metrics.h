// What Linux says of this process, under the names that Prometheus' own clients use.
#pragma once

#include <prometheus/metric_family.h>
#include <vector>

namespace froxel::net {

// process_resident_memory_bytes, process_open_fds, process_max_fds, process_threads and
// process_cpu_seconds_total, from /proc/self; what cannot be read is left out. Any thread.
[[nodiscard]] std::vector<prometheus::MetricFamily> processMetrics();

} // namespace froxel::net
