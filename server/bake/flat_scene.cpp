#include "bake/flat_scene.h"

#include "bake/delivered_check.h"
#include "bake/scene_fields.h"

#include <cstdint>
#include <string>

namespace froxel::bake {

namespace {

// At both ends, so that a run that is cut off or of another kind is told at once.
constexpr uint64_t kMark = 0x31'74'61'6c'66'78'66'00; // "fxflat1"

} // namespace

void writeFlat(const scene::Scene& scene, const ByteSink& sink, std::span<const std::byte> pool) {
    FlatWriter writer(sink, pool);
    writer.put(kMark);
    writer.put(scene);
    writer.put(kMark);
    writer.finish();
}

Result<scene::Scene> readFlat(std::span<const std::byte> bytes,
                              std::span<const std::byte> pool,
                              std::shared_ptr<const void> keeper) {
    scene::Scene scene;
    try {
        FlatReader reader(bytes, pool, std::move(keeper));
        uint64_t begin = 0;
        uint64_t end = 0;
        reader.get(begin);
        reader.get(scene);
        reader.get(end);
        if (begin != kMark || end != kMark || !reader.atEnd()) {
            throw Broken();
        }
    } catch (const Broken&) {
        return Error{ErrorCode::kScene, "its reader handed back bytes that are no scene"};
    }
    if (const auto fault = findDeliveredFault(scene)) {
        return Error{ErrorCode::kScene, "its reader handed back a scene that is broken: " + *fault};
    }
    return scene;
}

} // namespace froxel::bake
