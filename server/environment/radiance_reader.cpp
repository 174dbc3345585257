#include "core/text.h"
#include "environment/formats.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stb/stb_image.h>
#include <string_view>

namespace froxel::environment {
namespace {

std::string_view textOf(std::span<const std::byte> file) {
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

// The library takes bytes beyond the end for zeros, and runs of length 0 never fill a row. For
// pixels this source goes on with 0xFF instead, which ends every run, and remembers that it had to.
struct Source {
    std::span<const std::byte> left;
    bool endless = false;
    bool ran_out = false;

    static int read(void* user, char* out, int size) {
        auto& source = *static_cast<Source*>(user);
        const size_t wanted = static_cast<size_t>(size);
        const size_t given = std::min(wanted, source.left.size());
        std::memcpy(out, source.left.data(), given);
        source.left = source.left.subspan(given);
        if (given > 0 || !source.endless) {
            return static_cast<int>(given);
        }
        source.ran_out = true;
        std::memset(out, 0xFF, wanted);
        return size;
    }
    static void skip(void* user, int count) {
        auto& source = *static_cast<Source*>(user);
        const auto bytes = static_cast<size_t>(std::max(count, 0));
        source.left = source.left.subspan(std::min(bytes, source.left.size()));
    }
    static int eof(void* user) { return static_cast<const Source*>(user)->left.empty() ? 1 : 0; }
};

constexpr stbi_io_callbacks kCallbacks{Source::read, Source::skip, Source::eof};

struct FreePixels {
    void operator()(float* pixels) const { stbi_image_free(pixels); }
};

Error broken(const std::string& reason) {
    return {ErrorCode::kIo, "is a broken Radiance file: " + reason};
}

// Lines of the header that change what values mean, and that the library leaves out.
void warnOfHeader(std::string_view header, std::vector<std::string>& warnings) {
    for (const std::string_view name : {"EXPOSURE=", "COLORCORR=", "PRIMARIES="}) {
        const size_t at = header.find("\n" + std::string(name));
        if (at != std::string_view::npos) {
            const std::string_view rest = header.substr(at + 1);
            warnings.push_back("has " + printable(rest.substr(0, rest.find('\n'))) +
                               " in its header, which is not applied");
        }
    }
}

} // namespace

bool isRadiance(std::span<const std::byte> file) {
    const std::string_view text = textOf(file);
    return text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n");
}

Result<Panorama> readRadiance(std::span<const std::byte> file) {
    int width = 0;
    int height = 0;
    int channels = 0;
    Source header{file};
    if (stbi_info_from_callbacks(&kCallbacks, &header, &width, &height, &channels) == 0) {
        return broken("expected FORMAT=32-bit_rle_rgbe, an empty line, then -Y HEIGHT +X WIDTH");
    }
    if (const auto fits = checkSize(width, height); !fits) {
        return fits.error();
    }
    Source source{file, true};
    const std::unique_ptr<float, FreePixels> pixels(
        stbi_loadf_from_callbacks(&kCallbacks, &source, &width, &height, &channels, 3));
    if (source.ran_out) {
        return broken("it ends too early, or has run lengths as before 1991, which are not read");
    }
    if (pixels == nullptr) {
        return broken(stbi_failure_reason());
    }
    Panorama out;
    out.image.width_px = static_cast<uint32_t>(width);
    out.image.height_px = static_cast<uint32_t>(height);
    out.image.rgb.assign(pixels.get(),
                         pixels.get() + size_t{3} * out.image.width_px * out.image.height_px);
    const std::string_view text = textOf(file);
    warnOfHeader(text.substr(0, text.find("\n\n")), out.warnings);
    return out;
}

} // namespace froxel::environment
