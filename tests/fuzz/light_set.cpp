// A file of placed lights, as --light-set reads it.
#include "core/assert.h"
#include "fuzz/target.h"
#include "session/placed_lights.h"

#include <google/protobuf/util/json_util.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const auto lights = session::parseLightSet(fuzz::textOf(data, size));
    if (!lights) {
        FROXEL_ASSERT(fuzz::isOneLine(lights.error().message), "a refusal is one line");
        return 0;
    }
    std::string json;
    const auto status =
        google::protobuf::util::MessageToJsonString(session::changeOf({}, *lights), &json);
    FROXEL_ASSERT(status.ok(), "a set that was read can be written");
    const auto again = session::parseLightSet(json);
    // Nothing is read as an empty set: a set has lights.
    FROXEL_ASSERT(again && *again == *lights, "a set that was written reads back the same");
    return 0;
}
