#include "exr/reader.h"

#include "core/text.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/openexr.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

namespace froxel::exr {
namespace {

constexpr std::array<unsigned char, 4> kMagic = {0x76, 0x2F, 0x31, 0x01};
constexpr int kMaxChannels = 64; // of any name; a chunk of all of them is decompressed at once
constexpr size_t kChannels = 3;

Error broken(const std::string& reason) {
    return {ErrorCode::kIo, "is a broken OpenEXR file: " + printable(reason)};
}

// The library reads by callbacks, and says what is wrong by another.
struct Source {
    std::span<const std::byte> file;
    std::string reason; // the first

    static Source& of(exr_const_context_t context) {
        void* user = nullptr;
        exr_get_user_data(context, &user);
        return *static_cast<Source*>(user);
    }
    static int64_t read(exr_const_context_t context,
                        void* user,
                        void* out,
                        uint64_t size,
                        uint64_t offset,
                        exr_stream_error_func_ptr_t fail) {
        const auto& file = static_cast<const Source*>(user)->file;
        if (offset > file.size()) {
            fail(context, EXR_ERR_READ_IO, "it ends too early");
            return -1;
        }
        const size_t given = std::min<uint64_t>(size, file.size() - offset);
        std::memcpy(out, file.data() + offset, given);
        return static_cast<int64_t>(given);
    }
    static int64_t size(exr_const_context_t /*context*/, void* user) {
        return static_cast<int64_t>(static_cast<const Source*>(user)->file.size());
    }
    static void onError(exr_const_context_t context, exr_result_t /*code*/, const char* text) {
        std::string& reason = of(context).reason;
        if (reason.empty()) {
            reason = text;
        }
    }
};

// More than the best of the formats' compressions gives of one grey channel.
constexpr uint64_t kPixelsOfByte = 8192;

// Sizes in the header are allocated before they are held against the file's.
constexpr size_t kMaxHeaderBytes = size_t{1} << 20U;
void* allocate(size_t bytes) {
    return bytes <= kMaxHeaderBytes ? std::malloc(bytes) : nullptr;
}

// The header, by the C library, whose allocations can be bounded: what it has read is of sizes that
// the C++ library may allocate. That one reads the pixels, since 3.1 has DWA there alone.
class Header {
  public:
    explicit Header(std::span<const std::byte> file) : source_{file, {}} {}
    ~Header() { exr_finish(&context_); }
    Header(const Header&) = delete;
    Header& operator=(const Header&) = delete;

    [[nodiscard]] Result<void> open() {
        exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
        how.user_data = &source_;
        how.alloc_fn = allocate;
        how.free_fn = std::free;
        how.read_fn = Source::read;
        how.size_fn = Source::size;
        how.error_handler_fn = Source::onError;
        return told(exr_start_read(&context_, "picture", &how));
    }
    // That it has one flat picture of colours, of a size that is wanted.
    [[nodiscard]] Result<void> check(const SizeCheck& check_size);
    // After check().
    [[nodiscard]] const exr_attr_box2i_t& window() const { return window_; }
    [[nodiscard]] bool grey() const { return grey_; }
    void warnOfPrimaries(std::vector<std::string>& warnings) const;

  private:
    [[nodiscard]] Result<void> told(exr_result_t result) const {
        if (result == EXR_ERR_SUCCESS) {
            return {};
        }
        return broken(source_.reason.empty() ? exr_get_default_error_message(result)
                                             : source_.reason);
    }
    [[nodiscard]] Result<void> checkShape(const SizeCheck& check_size);
    [[nodiscard]] Result<void> checkChannels();

    Source source_;
    exr_context_t context_ = nullptr;
    exr_attr_box2i_t window_{};
    bool grey_ = false;
};

Result<void> Header::check(const SizeCheck& check_size) {
    if (auto shape = checkShape(check_size); !shape) {
        return shape;
    }
    return checkChannels();
}

Result<void> Header::checkShape(const SizeCheck& check_size) {
    int parts = 0;
    if (auto read = told(exr_get_count(context_, &parts)); !read) {
        return read;
    }
    if (parts != 1) {
        return Error{ErrorCode::kUnsupported, "has " + numberText(parts) + " parts; expected one"};
    }
    exr_storage_t storage{};
    exr_attr_box2i_t display{};
    for (const exr_result_t result :
         {exr_get_storage(context_, 0, &storage), exr_get_data_window(context_, 0, &window_),
          exr_get_display_window(context_, 0, &display)}) {
        if (auto read = told(result); !read) {
            return read;
        }
    }
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) {
        return Error{ErrorCode::kUnsupported, "has deep pixels; expected scan lines or tiles"};
    }
    if (std::memcmp(&display, &window_, sizeof display) != 0) {
        return Error{ErrorCode::kUnsupported,
                     "has a data window that is not its display window; expected a whole picture"};
    }
    return check_size(int64_t{window_.max.x} - window_.min.x + 1,
                      int64_t{window_.max.y} - window_.min.y + 1);
}

Result<void> Header::checkChannels() {
    const exr_attr_chlist_t* list = nullptr;
    if (auto read = told(exr_get_channels(context_, 0, &list)); !read) {
        return read;
    }
    if (list->num_channels > kMaxChannels) {
        return Error{ErrorCode::kCapacity, "has " + numberText(list->num_channels) +
                                               " channels; expected up to " +
                                               numberText(kMaxChannels)};
    }
    std::string names;
    int colors = 0;
    for (const auto& channel : std::span(list->entries, static_cast<size_t>(list->num_channels))) {
        const std::string_view name(channel.name.str, static_cast<size_t>(channel.name.length));
        names += (names.empty() ? "" : ", ") + printable(name, 16);
        const bool color = name == "R" || name == "G" || name == "B";
        grey_ = grey_ || name == "Y";
        if (!color && name != "Y") {
            continue;
        }
        colors += color ? 1 : 0;
        if (channel.pixel_type == EXR_PIXEL_UINT || channel.x_sampling != 1 ||
            channel.y_sampling != 1) {
            return Error{
                ErrorCode::kUnsupported,
                "has a channel " + std::string(name) +
                    " of integers or of fewer samples; expected half or float, for every pixel"};
        }
    }
    grey_ = grey_ && list->num_channels == 1;
    if (colors != 3 && !grey_) {
        return Error{ErrorCode::kUnsupported, "has the channels " + printable(names, 200) +
                                                  "; expected R, G and B, or Y alone"};
    }
    return {};
}

void Header::warnOfPrimaries(std::vector<std::string>& warnings) const {
    exr_attr_chromaticities_t is{};
    if (exr_attr_get_chromaticities(context_, 0, "chromaticities", &is) != EXR_ERR_SUCCESS) {
        return; // none are Rec. 709's
    }
    const std::array<float, 8> told = {is.red_x,  is.red_y,  is.green_x, is.green_y,
                                       is.blue_x, is.blue_y, is.white_x, is.white_y};
    constexpr std::array<float, 8> kRec709 = {0.64F, 0.33F, 0.30F,   0.60F,
                                              0.15F, 0.06F, 0.3127F, 0.3290F};
    for (size_t i = 0; i < told.size(); ++i) {
        if (!(std::abs(told[i] - kRec709[i]) < 0.002F)) {
            warnings.push_back("has other primaries than Rec. 709's, which are not applied");
            return;
        }
    }
}

class Stream : public Imf::IStream {
  public:
    explicit Stream(std::span<const std::byte> file) : IStream("picture"), file_(file) {}
    bool read(char out[], int size) override {
        const auto wanted = static_cast<size_t>(size);
        if (at_ > file_.size() || wanted > file_.size() - at_) {
            throw std::runtime_error("it ends too early");
        }
        std::memcpy(out, file_.data() + at_, wanted);
        at_ += wanted;
        return at_ < file_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t at) override { at_ = at; }

  private:
    std::span<const std::byte> file_;
    uint64_t at_ = 0;
};

// Throws what the library does.
void readPixels(std::span<const std::byte> file, const Header& header, LinearImage& image) {
    const auto& [min, max] = header.window();
    const Imath::Box2i window({min.x, min.y}, {max.x, max.y});
    const auto slice = [&](size_t channel) {
        constexpr size_t kStride = kChannels * sizeof(float);
        return Imf::Slice::Make(Imf::FLOAT, &image.rgb[channel], window, kStride,
                                kStride * image.width_px);
    };
    Imf::FrameBuffer to;
    if (header.grey()) {
        to.insert("Y", slice(0));
    } else {
        to.insert("R", slice(0));
        to.insert("G", slice(1));
        to.insert("B", slice(2));
    }
    Stream stream(file);
    Imf::InputFile reader(stream, 0);
    reader.setFrameBuffer(to);
    reader.readPixels(min.y, max.y);
}

} // namespace

bool isExr(std::span<const std::byte> file) {
    return file.size() >= kMagic.size() &&
           std::memcmp(file.data(), kMagic.data(), kMagic.size()) == 0;
}

Result<Picture> read(std::span<const std::byte> file, const SizeCheck& check) {
    Header header(file);
    auto ready = header.open();
    if (ready) {
        ready = header.check(check);
    }
    if (!ready) {
        return ready.error();
    }
    const auto& [min, max] = header.window();
    Picture out;
    out.image.width_px = static_cast<uint32_t>(max.x - min.x + 1);
    out.image.height_px = static_cast<uint32_t>(max.y - min.y + 1);
    const uint64_t pixels = uint64_t{out.image.width_px} * out.image.height_px;
    if (pixels > file.size() * kPixelsOfByte) {
        return broken("its " + numberText(file.size()) + " bytes cannot hold the " +
                      numberText(out.image.width_px) + "x" + numberText(out.image.height_px) +
                      " pixels that its header tells");
    }
    out.image.rgb.resize(size_t{out.image.width_px} * out.image.height_px * kChannels);
    try {
        readPixels(file, header, out.image);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {
        return broken(failure.what());
    }
    if (header.grey()) {
        for (size_t i = 0; i < out.image.rgb.size(); i += kChannels) {
            out.image.rgb[i + 1] = out.image.rgb[i + 2] = out.image.rgb[i];
        }
    }
    header.warnOfPrimaries(out.warnings);
    return out;
}

} // namespace froxel::exr
