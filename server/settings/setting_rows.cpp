// Holds the table against the structs: a member without a row does not compile.
#include "settings/setting_rows.h"

#include "settings/setting_cover.h"

namespace froxel::settings {
namespace {

// The camera, the size, two ramps, the material variant, and the structs below.
static_assert(covers<ViewSettings>(kSettingRows, 5 + 12));
static_assert(covers<GbufferLayout>(kSettingRows, 0));
static_assert(covers<Grid>(kSettingRows, 2));   // whether it is automatic, and its size
static_assert(covers<Debug>(kSettingRows, 1));  // whose grid
static_assert(covers<Lights>(kSettingRows, 2)); // their box, and placed ones
static_assert(covers<Shadows>(kSettingRows, 0));
static_assert(covers<Environment>(kSettingRows, 0));
static_assert(covers<Background>(kSettingRows, 0));
static_assert(covers<Animation>(kSettingRows, 1)); // which
static_assert(covers<Toon>(kSettingRows, 0));
static_assert(covers<ToonOutline>(kSettingRows, 0));
static_assert(covers<Bloom>(kSettingRows, 0));
static_assert(covers<Fog>(kSettingRows, 0));
static_assert(covers<Encoding>(kEncodingRows, 0));

} // namespace
} // namespace froxel::settings
