#include "encode/host_form.h"

namespace froxel::encode {

Result<HostForm> hostForm(JpegFormats& formats, const settings::Encoding& encoding) {
    switch (settings::rowOf(encoding.codec).device_form) {
    case PictureForm::kPlanes:
        return HostForm{.plane_sampling = encoding.chroma == settings::Chroma::k420 ? 2U : 1U};
    case PictureForm::kFile: {
        auto format = formats.of(encoding);
        if (!format) {
            return format.error();
        }
        return HostForm{.jpeg = std::move(*format)};
    }
    case PictureForm::kPixels:
        break;
    }
    return HostForm();
}

} // namespace froxel::encode
