// A slow link by hand: cmake --build build/test --target froxel_relay
//
//   froxel_relay --listen 9000 --to 127.0.0.1:8080 --kbit-per-s 2500 --delay-ms 20
//
// and a viewer of ws://127.0.0.1:9000/ws. A number on a line of standard input is a new rate in
// kbit/s; its end ends the relay.
#include "relay/relay.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace froxel::test;

double bytesPerSecond(double kbit_per_s) {
    return kbit_per_s > 0 ? kbit_per_s * 1000 / 8 : TokenBucket::kUnlimited;
}

// "HOST:PORT" or "[ADDRESS]:PORT".
void readTarget(const std::string& text, RelayOptions& options) {
    const size_t colon = text.rfind(':');
    const char* end = text.data() + text.size();
    if (colon == std::string::npos || colon == 0 ||
        std::from_chars(text.data() + colon + 1, end, options.port).ptr != end) {
        throw CLI::ValidationError("--to", "'" + text + "' is not HOST:PORT");
    }
    const bool bracketed = text[0] == '[' && text[colon - 1] == ']';
    options.host = bracketed ? text.substr(1, colon - 2) : text.substr(0, colon);
}

void obeyInput(Relay& relay) {
    for (char line[64]; std::fgets(line, sizeof line, stdin) != nullptr;) {
        const std::string text(line, std::string(line).find_last_not_of("\r\n") + 1);
        double kbit_per_s = -1;
        const char* end = text.data() + text.size();
        if (std::from_chars(text.data(), end, kbit_per_s).ptr != end || kbit_per_s < 0) {
            std::fprintf(stderr, "froxel_relay: '%s' is no rate in kbit/s\n", text.c_str());
            continue;
        }
        relay.setRate(bytesPerSecond(kbit_per_s), bytesPerSecond(kbit_per_s));
    }
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Relays TCP over a slow link", "froxel_relay");
    RelayOptions options;
    std::string target;
    double kbit_per_s = 0;
    int delay_ms = 0;
    size_t buffer_kb = 64;
    app.add_option("--listen", options.listen_port, "Port of 127.0.0.1, 0 for any free one");
    app.add_option("--to", target, "HOST:PORT of the server")->required();
    app.add_option("--kbit-per-s", kbit_per_s, "Rate of each direction, 0 for no limit")
        ->check(CLI::Range(0.0, 1e9));
    app.add_option("--delay-ms", delay_ms, "Delay of each direction")->check(CLI::Range(0, 10'000));
    app.add_option("--buffer-kb", buffer_kb, "Queue of each direction before the rate")
        ->check(CLI::Range(1, 1'000'000));
    try {
        app.parse(argc, argv);
        readTarget(target, options);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    }
    options.up = {bytesPerSecond(kbit_per_s), std::chrono::milliseconds(delay_ms),
                  buffer_kb * 1024};
    options.down = options.up;
    try {
        Relay relay(options);
        std::printf("127.0.0.1:%u\n", static_cast<unsigned>(relay.port()));
        std::fflush(stdout);
        obeyInput(relay);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "froxel_relay: %s\n", error.what());
        return 1;
    }
    return 0;
}
