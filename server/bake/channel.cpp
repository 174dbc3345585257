#include "bake/channel.h"

#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>

namespace froxel::bake {

namespace {

constexpr size_t kMostPacketBytes = 32'768; // paths, and messages of a line

union Control {
    char bytes[CMSG_SPACE(sizeof(int))];
    cmsghdr aligned;
};

} // namespace

bool Channel::sendPacket(std::span<const std::byte> packet, int file) {
    if (packet.size() > kMostPacketBytes) {
        return false;
    }
    iovec part{const_cast<std::byte*>(packet.data()), packet.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    Control control{};
    if (file >= 0) {
        message.msg_control = control.bytes;
        message.msg_controllen = sizeof control.bytes;
        cmsghdr* const header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof file);
        std::memcpy(CMSG_DATA(header), &file, sizeof file);
    }
    ssize_t sent = 0;
    do {
        sent = sendmsg(socket_.get(), &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    closed_ = sent < 0;
    return sent == static_cast<ssize_t>(packet.size());
}

std::optional<std::vector<std::byte>> Channel::receivePacket(FileDescriptor* file) {
    std::vector<std::byte> packet(kMostPacketBytes);
    iovec part{packet.data(), packet.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    Control control{};
    if (file != nullptr) { // else descriptors that come are closed by the system
        message.msg_control = control.bytes;
        message.msg_controllen = sizeof control.bytes;
    }
    ssize_t got = 0;
    do {
        got = recvmsg(socket_.get(), &message, MSG_CMSG_CLOEXEC);
    } while (got < 0 && errno == EINTR);
    for (const cmsghdr* header = got < 0 ? nullptr : CMSG_FIRSTHDR(&message); header != nullptr;
         header = CMSG_NXTHDR(&message, const_cast<cmsghdr*>(header))) {
        if (header->cmsg_level == SOL_SOCKET && header->cmsg_type == SCM_RIGHTS) {
            int received = -1;
            std::memcpy(&received, CMSG_DATA(header), sizeof received);
            *file = FileDescriptor(received);
        }
    }
    closed_ = got <= 0;
    if (closed_ || (message.msg_flags & MSG_TRUNC) != 0) {
        return {};
    }
    packet.resize(static_cast<size_t>(got));
    return packet;
}

Channel::Waited Channel::wait(int milliseconds) {
    pollfd waited{socket_.get(), POLLIN, 0};
    return poll(&waited, 1, milliseconds) > 0 ? Waited::kSomething : Waited::kNothing;
}

} // namespace froxel::bake
