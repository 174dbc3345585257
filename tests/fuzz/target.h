// What the fuzz targets share. libFuzzer or replay_main.cpp calls LLVMFuzzerTestOneInput, which
// answers with FROXEL_ASSERT where something is not as promised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace froxel::fuzz {

[[nodiscard]] inline std::string_view textOf(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// What every refusal is: a person reads it in a log.
[[nodiscard]] inline bool isOneLine(std::string_view message, size_t max_bytes = 1000) {
    return !message.empty() && message.size() <= max_bytes &&
           message.find_first_of("\r\n") == std::string_view::npos;
}

// Says what was wrong and ends the process.
void expectNoFault(const std::string& fault);

} // namespace froxel::fuzz
