// What all viewers of one server have in common. Immutable but for the service, the lobby, the
// limits and the metrics, which any thread may use.
#pragma once

#include "net/client_address.h"
#include "net/guest_bodies.h"
#include "net/host_names.h"
#include "net/lobby.h"
#include "net/long_work.h"
#include "net/metrics.h"
#include "net/request_limits.h"
#include "net/scene_listing.h"
#include "net/service.h"
#include "net/static_files.h"
#include "net/still_answers.h"
#include "net/token_gate.h"
#include "net/uploads.h"

#include <memory>
#include <string>
#include <vector>

namespace froxel::net {

struct Site {
    StaticFiles files;
    HostNames host_names;
    std::vector<std::string> allowed_origins; // besides the server's own
    bool encrypted = false;                   // by TLS
    std::shared_ptr<const TokenGate> gate;    // null: everybody is let in
    // Whether pages of any site may have stills drawn, to show them: not from a person's own
    // machine, nor where a token is asked for.
    bool shows_elsewhere = false;
    TrustedProxies trusted_proxies;
    uint32_t connections_per_address = 0;
    std::string content_policy; // of the page
    std::shared_ptr<Service> service;
    std::shared_ptr<Lobby> lobby;
    std::shared_ptr<Metrics> metrics;
    std::shared_ptr<RequestLimits> request_limits;
    std::shared_ptr<const SceneListing> scenes;
    std::shared_ptr<still::StillDesk> still_desk;
    std::shared_ptr<StillAnswers> stills;
    std::shared_ptr<GuestBodies> guest_bodies;
    std::shared_ptr<const Uploads> uploads;
    LongWork* long_work = nullptr; // lives until the network's threads have ended
};

} // namespace froxel::net
