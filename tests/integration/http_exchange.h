// Plain HTTP with a server on 127.0.0.1, byte for byte.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace froxel::test {

// Sends `raw` and gives all that comes until the server closes.
inline std::string httpExchange(uint16_t port, const std::string& raw) {
    boost::asio::io_context io;
    boost::asio::ip::tcp::socket socket(io);
    socket.connect({boost::asio::ip::address_v4::loopback(), port});
    boost::system::error_code error;
    boost::asio::write(socket, boost::asio::buffer(raw), error);
    std::string answer;
    boost::asio::read(socket, boost::asio::dynamic_buffer(answer), error);
    return answer;
}

inline std::string
httpGet(uint16_t port, const std::string& target, const std::string& headers = {}) {
    return httpExchange(port, "GET " + target +
                                  " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                                  headers + "\r\n");
}

inline int statusOf(const std::string& answer) {
    return answer.size() > 12 ? std::atoi(answer.substr(9, 3).c_str()) : 0;
}

inline std::string bodyOf(const std::string& answer) {
    const size_t end = answer.find("\r\n\r\n");
    return end == std::string::npos ? "" : answer.substr(end + 4);
}

// Asks until the server does not say any more that it will be there later.
inline std::string httpGetOnceThere(uint16_t port, const std::string& target) {
    std::string answer;
    do {
        answer = httpGet(port, target);
    } while (statusOf(answer) == 503);
    return answer;
}

// The value of a sample, such as `froxel_sessions` or `froxel_x_total{kind="a"}`, in what /metrics
// answered; NaN where it is not there.
inline double sampleOf(const std::string& metrics, const std::string& name) {
    const size_t at = metrics.find("\n" + name + " ");
    return at == std::string::npos ? std::nan("")
                                   : std::strtod(metrics.c_str() + at + name.size() + 2, nullptr);
}

} // namespace froxel::test
