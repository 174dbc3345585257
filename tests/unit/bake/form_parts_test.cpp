#include "bake/form_parts.h"
#include "bake/guest_files.h"
#include "gltf/failure.h"
#include "guest/memory_file.h"

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

namespace froxel::bake {
namespace {

using Files = std::vector<std::pair<std::string, std::string>>; // filename, content

std::string formOf(const Files& files, const std::string& boundary = "xyz") {
    std::string form;
    for (const auto& [name, content] : files) {
        form += "--" + boundary + "\r\nContent-Disposition: form-data; name=\"f\"; filename=\"" +
                name + "\"\r\nContent-Type: application/octet-stream\r\n\r\n" + content + "\r\n";
    }
    return form + "--" + boundary + "--\r\n";
}

class Form {
  public:
    explicit Form(std::string_view text, const std::string& boundary = "xyz")
        : files_(sceneOf(text)), parts_(files_, boundary) {}

    FormParts& parts() { return parts_; }
    static std::string textOf(const gltf::OpenedFile& file) {
        std::string text(file.size_bytes, '\0');
        const ssize_t size = ::pread(file.descriptor.get(), text.data(), text.size(),
                                     static_cast<off_t>(file.begin));
        EXPECT_EQ(size, static_cast<ssize_t>(text.size()));
        return text;
    }
    std::string open(const std::string& name) { return textOf(parts_.open(name, "buffer 0")); }

  private:
    static std::shared_ptr<const guest::GuestScene> sceneOf(std::string_view text) {
        auto file = guest::MemoryFile::make().value();
        file.append(std::as_bytes(std::span(text))).value();
        guest::GuestScene scene;
        scene.files.push_back(std::move(file).complete("form").value());
        return std::make_shared<const guest::GuestScene>(std::move(scene));
    }

    GuestFiles files_;
    FormParts parts_;
};

// Why it is none; empty: it is one.
std::string faultOf(std::string_view text, const std::string& boundary = "xyz") {
    try {
        const Form form(text, boundary);
        return {};
    } catch (const gltf::Failure& failure) {
        return failure.what();
    }
}

TEST(FormParts, EachPart_HasItsBytesAsTheyCame) {
    // What looks like an end, and like the next part, but is neither.
    const std::string binary("\0\r\n--xy\r\n\r\n--\r\n\r\r\n-\n--xyz is within a line\xFF\r\n", 50);
    Form form(formOf({{"a.gltf", "{\"scene\": 0}"},
                      {"b.bin", binary},
                      {"empty.bin", ""},
                      {"textures/c.png", "\r\n"},
                      {"last.bin", std::string(5000, '-')}}));
    EXPECT_EQ(form.parts().sceneName(), "a.gltf");
    EXPECT_EQ(Form::textOf(form.parts().openScene()), "{\"scene\": 0}");
    EXPECT_EQ(form.open("b.bin"), binary);
    EXPECT_EQ(form.open("empty.bin"), "");
    EXPECT_EQ(form.open("textures/c.png"), "\r\n");
    EXPECT_EQ(form.open("last.bin"), std::string(5000, '-'));
}

// curl sends a path's last component alone.
TEST(FormParts, PartIsFound_ByItsName_OrByTheLastOfIt) {
    Form form(formOf({{"a.glb", "glTF"}, {"b.png", "alone"}, {"t/c.png", "t"}, {"c.png", "top"}}));
    EXPECT_EQ(form.open("textures/b.png"), "alone");
    EXPECT_EQ(form.open("./textures/../b.png"), "alone");
    EXPECT_EQ(form.open("t/c.png"), "t");
    EXPECT_EQ(form.open("c.png"), "top");
    for (const char* absent : {"d.png", "/etc/passwd", "..", "", "textures/"}) {
        EXPECT_THROW(static_cast<void>(form.parts().open(absent, "image 0")), gltf::Unusable)
            << absent;
    }
}

TEST(FormParts, ScenesOtherThanOne_AreNamed) {
    EXPECT_EQ(faultOf(formOf({{"a.gltf", "{}"}})), "");
    EXPECT_NE(faultOf(formOf({{"a.bin", "b"}})).find("has 0 parts"), std::string::npos);
    EXPECT_NE(faultOf(formOf({{"a.glb", "g"}, {"b.gltf", "{}"}})).find("has 2 parts"),
              std::string::npos);
    Files many(FormParts::kMostParts + 1, {"a.bin", ""});
    EXPECT_NE(faultOf(formOf(many)).find("more than 512 parts"), std::string::npos);
}

// Each begin of a form is none, or one of fewer parts, and no part lies outside.
TEST(FormParts, FormThatEndsAnywhere_IsReadWithoutHarm) {
    const std::string whole = formOf({{"a.gltf", "{\"a\":1}"}, {"b.bin", "\r\n--xy"}});
    size_t faults = 0;
    for (size_t size = 0; size < whole.size(); ++size) {
        const std::string_view begun = std::string_view(whole).substr(0, size);
        try {
            Form form(begun);
            const auto file = form.parts().openScene();
            EXPECT_LE(file.begin + file.size_bytes, size);
        } catch (const gltf::Failure&) {
            ++faults;
        }
    }
    EXPECT_GT(faults, 50U);
    EXPECT_NE(faultOf(whole, "other"), "");
    EXPECT_NE(faultOf(std::string(100'000, '\n')), "");
    EXPECT_NE(faultOf("--xyz\r\n" + std::string(100'000, 'h') + ": x\r\n\r\n"), "");
}

} // namespace
} // namespace froxel::bake
