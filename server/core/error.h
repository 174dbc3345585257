// Errors from outside (files, network, options, device): values, never exceptions across threads.
#pragma once

#include <boost/system/result.hpp>

#include <stdexcept>
#include <string>
#include <utility>

namespace froxel {

enum class ErrorCode {
    kInvalidArgument, // an option or command field is out of its range
    kScene,           // a scene file cannot be loaded
    kDevice,          // no usable Vulkan device, or it was lost
    kAddressInUse,    // the listening address is taken
    kIo,              // a file or socket operation failed
    kUnsupported,     // known but not available here
    kCapacity,        // a stated limit is reached
    kTooLong,         // likewise the limit on a picture's time; a smaller picture may keep it
    kCancelled,       // whoever wanted it does not any more
};

// One line for a person: names the thing, the value and what would be right.
struct Error {
    ErrorCode code = ErrorCode::kInvalidArgument;
    std::string message;
    // How many times larger the picture's area is than one that would do; 0: none would.
    double too_large_by = 0;
};

// The exception form of an Error, for start-up code only; caught once, in main.
class StartupError : public std::runtime_error {
  public:
    explicit StartupError(Error error) : std::runtime_error(error.message), code_(error.code) {}
    [[nodiscard]] ErrorCode code() const { return code_; }

  private:
    ErrorCode code_;
};

[[noreturn]] inline void throw_exception_from_error(const Error& error,
                                                    const boost::source_location& /*where*/) {
    throw StartupError(error);
}

template <class T>
using Result = boost::system::result<T, Error>;

} // namespace froxel
