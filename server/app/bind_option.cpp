#include "app/bind_option.h"

#include "app/value_parsers.h"
#include "core/text.h"

namespace froxel::app {

Result<net::BindAddress> parseBindAddress(const std::string& text) {
    if (text == "none") {
        return net::BindAddress{};
    }
    const Error refusal{ErrorCode::kInvalidArgument,
                        "'" + printable(text) +
                            "' is not none or ADDRESS:PORT, such as 127.0.0.1:9090 or [::1]:9090"};
    const size_t colon = text.rfind(':');
    if (colon == std::string::npos) {
        return refusal;
    }
    std::string address = text.substr(0, colon);
    const bool bracketed = address.size() > 2 && address.front() == '[' && address.back() == ']';
    if (bracketed) {
        address = address.substr(1, address.size() - 2);
    }
    const auto port = parseNumber(text.substr(colon + 1), kPortRange);
    if (address.empty() || !port || bracketed != (address.find(':') != std::string::npos)) {
        return refusal;
    }
    return net::BindAddress{address, static_cast<uint16_t>(*port)};
}

std::string urlOf(const std::string& address, uint16_t port, const std::string& scheme) {
    const bool v6 = address.find(':') != std::string::npos;
    return scheme + "://" + (v6 ? "[" + address + "]" : address) + ":" + numberText(port) + "/";
}

} // namespace froxel::app
