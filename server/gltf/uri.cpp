#include "gltf/uri.h"

#include "core/text.h"
#include "gltf/failure.h"

#include <boost/algorithm/string/predicate.hpp>
#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cstring>

namespace froxel::gltf {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kData = "data:";

bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool isLetterOrDigit(char c) {
    return isLetter(c) || (c >= '0' && c <= '9');
}

// What begins no escape stands for itself, as in "wood 50%.png".
void appendPercentDecoded(std::string_view uri, std::string& text) {
    text.reserve(text.size() + uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        const char* first = uri.data() + i + 1;
        const char* last = uri.data() + std::min(i + 3, uri.size());
        if (uri[i] == '%' && last - first == 2 &&
            std::from_chars(first, last, value, 16).ptr == last) {
            text += static_cast<char>(value);
            i += 2;
        } else {
            text += uri[i];
        }
    }
}

// RFC 3986, 3.1: a letter first, so that a time of day is none.
bool hasScheme(const std::string& uri) {
    const size_t colon = uri.find(':');
    return colon != std::string::npos && isLetter(uri.front()) &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
               return isLetterOrDigit(c) || c == '+' || c == '-' || c == '.';
           });
}

// Whether a type ends in ";base64", which is taken off with the spaces around it.
bool isBase64(std::string_view type) {
    const auto dropSpaces = [&type] { type = type.substr(0, type.find_last_not_of(' ') + 1); };
    constexpr std::string_view kBase64 = "base64";
    dropSpaces();
    if (!boost::algorithm::iends_with(type, kBase64)) {
        return false;
    }
    type.remove_suffix(kBase64.size());
    dropSpaces();
    return type.ends_with(';');
}

// "Forgiving-base64 decode" (WHATWG Infra): spaces and lines count for nothing, the end needs no
// padding. Whether the text is right; then it is such as any decoder takes.
bool tidyBase64(std::string& text, size_t begin) {
    const auto at = [&](size_t i) { return text.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto isSpace = [](char c) {
        return std::string_view(" \t\n\f\r").find(c) != std::string_view::npos;
    };
    text.erase(std::remove_if(at(begin), text.end(), isSpace), text.end());
    for (int i = 0; i < 2 && text.size() > begin && text.back() == '='; ++i) {
        text.pop_back();
    }
    return (text.size() - begin) % 4 != 1 && std::all_of(at(begin), text.end(), [](char c) {
               return isLetterOrDigit(c) || c == '+' || c == '/';
           });
}

std::vector<unsigned char> decodedData(std::string_view type, std::string_view body) {
    // Whatever type it tells: what counts are the bytes, and tinygltf knows few types.
    const std::string plain_type = "data:application/octet-stream;base64,";
    std::string text = isBase64(type) ? plain_type : std::string();
    const size_t begin = text.size();
    appendPercentDecoded(body, text);
    std::vector<unsigned char> decoded;
    std::string mime_type;
    if (begin == 0) {
        decoded.assign(text.begin(), text.end());
    } else if (tidyBase64(text, begin)) {
        tinygltf::DecodeDataURI(&decoded, mime_type, text, 0, false);
    }
    return decoded;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return boost::algorithm::istarts_with(uri, kData);
}

Bytes bytesOfDataUri(std::string_view uri, const std::string& user) {
    const std::string_view whole = uri.substr(0, uri.find('#')); // RFC 3986, 3.5
    const size_t comma = whole.find(',');
    std::vector<unsigned char> decoded;
    if (comma != std::string_view::npos) {
        decoded =
            decodedData(whole.substr(kData.size(), comma - kData.size()), whole.substr(comma + 1));
    }
    if (decoded.empty()) {
        throw Unusable(
            warning::kBrokenImage,
            user + " has the URI '" + printable(std::string(uri.substr(0, 40)), 40) +
                "', which cannot be decoded; expected data:TYPE;base64, with at least one byte");
    }
    Bytes bytes(decoded.size());
    std::memcpy(bytes.data(), decoded.data(), decoded.size());
    return bytes;
}

fs::path relativePathFromUri(const std::string& uri, const std::string& user) {
    const auto refuse = [&](const char* why, const char* more = "") {
        throw Unusable(warning::kUri, user + " has the URI '" + printable(uri) + "', which " + why +
                                          "; expected a path inside the scene's folder" + more);
    };
    if (hasScheme(uri)) {
        refuse("has a scheme", ", or data:");
    }
    // Neither a query nor a fragment is part of a file's name (RFC 3986, 3.4 and 3.5).
    std::string text;
    appendPercentDecoded(std::string_view(uri).substr(0, uri.find_first_of("?#")), text);
    // Some tools that write such files have it separate folders.
    std::replace(text.begin(), text.end(), '\\', '/');
    if (text.empty()) {
        refuse("is empty");
    }
    if (text.find('\0') != std::string::npos) {
        refuse("contains a NUL");
    }
    const fs::path path = fs::path(text).lexically_normal(); // RFC 3986, 5.2.4
    if (path.is_absolute()) {
        refuse("is absolute");
    }
    if (*path.begin() == "..") {
        refuse("leaves the scene's folder by '..'");
    }
    return path;
}

} // namespace froxel::gltf
