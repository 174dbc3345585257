// What of a scene's file is not shown as the file says, or was not as glTF has it.
#pragma once

#include <cstdint>
#include <string>

namespace froxel::scene {

// The numbers are those of the Khronos glTF validator's reports. What would be an error there and
// cannot be loaded is no scene.
enum class Severity : uint8_t {
    kWarning = 1,     // the picture lacks something that the file asks for
    kInformation = 2, // the picture is as meant, but others may not read the file so
};

// In the shape of the validator's issues.
struct Warning {
    std::string code; // the validator's own where it has one: "SCENE_NON_ROOT_NODE"
    Severity severity = Severity::kWarning;
    std::string pointer; // JSON pointer to the thing; "": the file as a whole
    std::string message; // printable, one line that names the thing, too

    bool operator==(const Warning&) const = default;
};

} // namespace froxel::scene
