// Metrics whose values are known elsewhere and read when somebody scrapes.
#pragma once

#include <prometheus/metric_family.h>
#include <string>
#include <utility>
#include <vector>

namespace froxel::net {

// One row: the value of a label and the metric's; without a label the name is empty.
using MetricRow = std::pair<std::string, double>;

// A counter or gauge; `label` names what the rows differ in, empty where there is one row.
[[nodiscard]] inline prometheus::MetricFamily metricFamily(prometheus::MetricType type,
                                                           const std::string& name,
                                                           const std::string& help,
                                                           const std::string& label,
                                                           const std::vector<MetricRow>& rows) {
    prometheus::MetricFamily family{name, help, type, {}};
    for (const auto& [label_value, value] : rows) {
        prometheus::ClientMetric metric;
        if (!label.empty()) {
            metric.label = {{label, label_value}};
        }
        metric.counter.value = value;
        metric.gauge.value = value;
        family.metric.push_back(std::move(metric));
    }
    return family;
}

} // namespace froxel::net
