// In which form an encoder takes pictures from a device that makes it.
#pragma once

#include "core/error.h"
#include "core/host_form.h"
#include "encode/jpeg_format.h"
#include "settings/settings.h"

namespace froxel::encode {

// By CodecRow::device_form. Errors: as JpegFormats::of().
[[nodiscard]] Result<HostForm> hostForm(JpegFormats& formats, const settings::Encoding& encoding);

} // namespace froxel::encode
