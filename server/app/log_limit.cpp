#include "app/log_limit.h"

#include <utility>

namespace froxel::app {

bool LogLimit::admit(std::string_view kind, TimePoint now) {
    const auto found = kinds_.find(kind);
    Kind& entry = found != kinds_.end() ? found->second : kinds_[std::string(kind)];
    if (entry.said == 0 || now - entry.since >= period_) {
        entry.since = now;
        entry.said = 0;
    }
    if (entry.said >= burst_) {
        ++entry.left_out;
        return false;
    }
    ++entry.said;
    return true;
}

std::vector<LogLimit::LeftOut> LogLimit::takeLeftOut(TimePoint now, bool end) {
    std::vector<LeftOut> all;
    for (auto& [name, kind] : kinds_) {
        if (kind.left_out > 0 && (end || now - kind.since >= period_)) {
            all.push_back({name, std::exchange(kind.left_out, 0)});
        }
    }
    return all;
}

} // namespace froxel::app
