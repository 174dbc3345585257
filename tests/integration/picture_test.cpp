// What is streamed is what `froxel render` draws: the same picture, the right way up, within what
// the JPEG's quality allows.
#include "integration/http_exchange.h"
#include "integration/server_process.h"
#include "integration/ws_client.h"
#include "support/places.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <unistd.h>

namespace froxel::test {
namespace {

constexpr uint32_t kWidth = 320;
constexpr uint32_t kHeight = 180;
const std::vector<std::string> kSettings = {
    "--look", "rainbow",        "--size", "320x180",    "--lights",
    "100",    "--light-radius", "3",      "--renderer", "forward_plus"};

using Rgb = std::vector<unsigned char>; // [height][width][3]

Rgb decodeJpeg(const Frame& frame) {
    const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), &tjDestroy);
    Rgb rgb(size_t{kWidth} * kHeight * 3);
    const int failed =
        tjDecompress2(decoder.get(), reinterpret_cast<const unsigned char*>(frame.jpeg.data()),
                      frame.jpeg.size(), rgb.data(), kWidth, 0, kHeight, TJPF_RGB, 0);
    EXPECT_EQ(failed, 0) << tjGetErrorStr2(decoder.get());
    return rgb;
}

Rgb decodePng(const std::string& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&image, file.data(), file.size()))
        << image.message;
    image.format = PNG_FORMAT_RGB;
    Rgb rgb(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr)) << image.message;
    return rgb;
}

// What a command writes there.
std::string fileOf(const std::vector<std::string>& command, const std::filesystem::path& file) {
    const auto end = ChildProcess(command).wait();
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

// What `froxel render` writes as this.
std::string renderedFile(const std::string& extension, const std::vector<std::string>& more = {}) {
    const auto file = std::filesystem::path(testing::TempDir()) /
                      ("froxel_picture_" + std::to_string(getpid()) + extension);
    std::vector<std::string> command = {test::binaryPath(), "render", "--device",     "cpu",
                                        "--time",           "1",      "--no-animate", "--out",
                                        file.string()};
    command.insert(command.end(), kSettings.begin(), kSettings.end());
    command.insert(command.end(), more.begin(), more.end());
    const std::string text = fileOf(command, file);
    std::filesystem::remove(file);
    return text;
}

Rgb upsideDown(const Rgb& rgb) {
    Rgb flipped;
    for (size_t row = kHeight; row-- > 0;) {
        const auto line = rgb.begin() + static_cast<ptrdiff_t>(row * kWidth * 3);
        flipped.insert(flipped.end(), line, line + kWidth * 3);
    }
    return flipped;
}

// Peak signal to noise in dB.
double psnr(const Rgb& a, const Rgb& b) {
    double squares = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        squares += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.size()) / squares);
}

TEST(StreamedPicture, AnyQuality_IsTheRenderedOne) {
    const Rgb wanted =
        decodePng(renderedFile(".png")); // before anybody waits for an answer of the client's
    ASSERT_EQ(wanted.size(), size_t{kWidth} * kHeight * 3);
    ServerProcess server(kSettings);
    WsClient client(server.port().value());
    client.join();
    v1::ClientMessage still;
    still.mutable_set_lights()->set_animate(false);
    still.mutable_set_lights()->set_time_s(1);
    client.send(still);
    struct Step {
        uint32_t quality;
        v1::Chroma chroma;
        double least_db;
    };
    for (const Step& step : {Step{95, v1::CHROMA_444, 38}, Step{75, v1::CHROMA_420, 30},
                             Step{30, v1::CHROMA_420, 26}}) {
        v1::ClientMessage encoding;
        encoding.mutable_set_encoding()->set_quality(step.quality);
        encoding.mutable_set_encoding()->set_chroma(step.chroma);
        const uint64_t seq = client.send(encoding);
        const Rgb shown = decodeJpeg(
            client.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; }));
        const double db = psnr(shown, wanted);
        EXPECT_GT(db, step.least_db) << "quality " << step.quality;
        EXPECT_LT(psnr(upsideDown(shown), wanted), 20) << "the test tells pictures apart";
        RecordProperty("psnr_db_" + std::to_string(step.quality), std::to_string(db));
    }
}

// The floats of a PFM, from the top.
std::vector<float> radianceOf(const std::string& pfm) {
    constexpr size_t kRow = size_t{kWidth} * 3;
    std::vector<float> rgb(kRow * kHeight);
    const char* floats = pfm.data() + pfm.size() - rgb.size() * sizeof(float);
    for (size_t y = 0; y < kHeight; ++y) {
        std::memcpy(&rgb[(kHeight - 1 - y) * kRow], floats + y * kRow * sizeof(float),
                    kRow * sizeof(float));
    }
    return rgb;
}

std::vector<float> decodeExr(const std::string& file) {
    Imf::StdISStream from;
    from.str(file);
    Imf::InputFile exr(from);
    const auto& window = exr.header().dataWindow();
    EXPECT_EQ(window.max.x, static_cast<int>(kWidth) - 1);
    EXPECT_EQ(window.max.y, static_cast<int>(kHeight) - 1);
    std::vector<float> rgb(size_t{kWidth} * kHeight * 3);
    Imf::FrameBuffer to;
    for (size_t channel = 0; channel < 3; ++channel) {
        to.insert(std::string(1, "RGB"[channel]),
                  Imf::Slice::Make(Imf::FLOAT, &rgb[channel], window, 3 * sizeof(float),
                                   3 * sizeof(float) * kWidth));
    }
    exr.setFrameBuffer(to);
    exr.readPixels(window.min.y, window.max.y);
    return rgb;
}

// Also while somebody else's lights move, and of whatever size the server's pictures are.
TEST(Still, IsTheRenderedPicture_ToTheBit) {
    const Rgb wanted = decodePng(renderedFile(".png"));
    const std::vector<float> radiance = radianceOf(renderedFile(".pfm"));
    ServerProcess server({"--size", "64x64", "--lights", "5"});
    const uint16_t port = server.port().value();
    const std::string view = "&look=rainbow&size=320x180&lights=100&light_radius=3&"
                             "renderer=forward_plus&light_time=1&animate=1";
    const std::string linear = httpGetOnceThere(port, "/render?format=exr" + view);
    ASSERT_EQ(statusOf(linear), 200) << linear.substr(0, 1000);
    EXPECT_EQ(decodeExr(bodyOf(linear)), radiance);
    EXPECT_NE(httpGet(port, "/render?format=exr&size=64x48&debug_view=depth")
                  .find("depth has no linear picture"),
              std::string::npos);
    WsClient client(port);
    client.join();
    const std::string answer = httpGet(port, "/render?format=png" + view);
    ASSERT_EQ(statusOf(answer), 200) << answer.substr(0, 1000);
    EXPECT_EQ(decodePng(bodyOf(answer)), wanted);
}

// Both sides of one frame, with a divider; what the server measures is what the command does.
TEST(Still, OfAComparison_IsTheRenderedOne_ToTheBit) {
    const Rgb wanted = decodePng(
        renderedFile(".png", {"--compare", "as-set", "light_cutoff:0.05", "--split", "0.25"}));
    ServerProcess server({"--size", "64x64", "--lights", "5"});
    const uint16_t port = server.port().value();
    const std::string view =
        "/render?look=rainbow&size=320x180&lights=100&light_radius=3&renderer=forward_plus&"
        "light_time=1&compare_split=0.25&compare=light_cutoff:0.05&format=";
    const std::string answer = httpGetOnceThere(port, view + "png");
    ASSERT_EQ(statusOf(answer), 200) << answer.substr(0, 1000);
    EXPECT_EQ(decodePng(bodyOf(answer)), wanted);
    EXPECT_NE(answer.find("Froxel-Compared: {\"pixels\":57600,\"differing\":"), std::string::npos)
        << answer.substr(0, 1000);
    for (const char* format : {"exr", "json"}) {
        const std::string refused = httpGet(port, view + format);
        EXPECT_EQ(statusOf(refused), 400);
        EXPECT_NE(refused.find("compare fits one picture of the formats jpg and png"),
                  std::string::npos);
    }
}

// By a process without rights, of a file that no folder has.
TEST(Still, OfAPostedScene_IsTheRenderedPicture_ToTheBit) {
    const auto file = std::filesystem::path(testing::TempDir()) /
                      ("froxel_posted_" + std::to_string(getpid()) + ".glb");
    const std::string body =
        fileOf({test::binaryPath(), "scene", "--out", file.string(), "--spheres", "1000"}, file);
    const Rgb wanted = decodePng(renderedFile(".png", {"--scene", file.string()}));
    std::filesystem::remove(file);

    ServerProcess server({"--size", "64x64", "--lights", "5"});
    const uint16_t port = server.port().value();
    const auto post = [&](const std::string& query, const std::string& scene,
                          const std::string& fields = "") {
        return httpExchange(port, "POST /render?" + query +
                                      " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                                      fields + "Content-Length: " + std::to_string(scene.size()) +
                                      "\r\n\r\n" + scene);
    };
    const std::string view = "format=png&look=rainbow&size=320x180&lights=100&light_radius=3&"
                             "renderer=forward_plus&light_time=1";
    const std::string answer = post(view, body);
    ASSERT_EQ(statusOf(answer), 200) << answer.substr(0, 1000);
    EXPECT_EQ(decodePng(bodyOf(answer)), wanted);
    EXPECT_EQ(answer.find("ETag"), std::string::npos);
    const std::string form = "--x\r\nContent-Disposition: form-data; name=\"scene\"; "
                             "filename=\"a.glb\"\r\n\r\n" +
                             body + "\r\n--x--\r\n";
    const std::string of_form =
        post(view, form, "Content-Type: multipart/form-data; boundary=x\r\n");
    ASSERT_EQ(statusOf(of_form), 200) << of_form.substr(0, 1000);
    EXPECT_EQ(bodyOf(of_form), bodyOf(answer));

    const std::string broken = post("size=64x64", body.substr(0, body.size() / 2));
    EXPECT_EQ(statusOf(broken), 400);
    EXPECT_NE(broken.find(R"("code":"malformed","field":"scene","message":"scene.glb: )"),
              std::string::npos)
        << broken;
    EXPECT_EQ(statusOf(post("scene=builtin", body)), 400);
    // Nothing of them is left.
    std::string metrics;
    do {
        metrics = httpGet(server.adminPort().value(), "/metrics");
    } while (sampleOf(metrics, "froxel_scene_memory_bytes") > 0);
    EXPECT_EQ(sampleOf(metrics, R"(froxel_scenes{state="resident"})"), 1);
}

// By the device's time; what is said to fit does.
TEST(Still, ThatTakesTooLong_IsToldWhichSizeFits) {
    ServerProcess server({"--size", "64x64", "--lights", "5", "--frame-limit", "0.3"});
    const uint16_t port = server.port().value();
    const std::string heavy = "/render?lights=2000&size=";
    std::string size = "4096x4096";
    std::string answer;
    for (int tries = 0; tries < 6; ++tries) { // not all of a frame goes by its area
        answer = httpGetOnceThere(port, heavy + size);
        const size_t fits = answer.find(R"("fits":")");
        if (tries == 0) {
            EXPECT_EQ(statusOf(answer), 400);
            ASSERT_NE(fits, std::string::npos) << answer;
        }
        if (fits == std::string::npos) {
            break;
        }
        size = answer.substr(fits + 8, answer.find('"', fits + 8) - fits - 8);
    }
    EXPECT_EQ(statusOf(answer), 200) << size << ": " << answer.substr(0, 1000);
}

} // namespace
} // namespace froxel::test
