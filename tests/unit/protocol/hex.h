// Bytes as lower-case hexadecimal text and back.
#pragma once

#include <boost/algorithm/hex.hpp>

#include <iterator>
#include <string>
#include <string_view>

namespace froxel::protocol {

inline std::string toHex(std::string_view bytes) {
    std::string text;
    boost::algorithm::hex_lower(bytes, std::back_inserter(text));
    return text;
}

// Throws boost::algorithm::hex_decode_error.
inline std::string fromHex(std::string_view text) {
    std::string bytes;
    boost::algorithm::unhex(text, std::back_inserter(bytes));
    return bytes;
}

} // namespace froxel::protocol
