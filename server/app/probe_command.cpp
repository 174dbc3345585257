#include "app/probe_command.h"

#include "core/clock.h"
#include "core/text.h"
#include "load/http_probe.h"

#include <cstdio>

namespace froxel::app {

int runProbe(const ProbeOptions& options) {
    const auto timeout =
        std::chrono::duration_cast<std::chrono::milliseconds>(Seconds(options.timeout_s));
    const load::Target target = load::parseTarget(options.url).value();
    if (target.tls) {
        throw StartupError(
            {ErrorCode::kInvalidArgument,
             "'" + printable(options.url, 200) +
                 "' uses https; a probe supports only http, because the admin address has no TLS"});
    }
    const load::ProbeAnswer answer = load::probe(target, timeout).value();
    std::printf("%u %s\n", answer.status, answer.line.c_str());
    return answer.status >= 200 && answer.status < 300 ? 0 : 1;
}

} // namespace froxel::app
