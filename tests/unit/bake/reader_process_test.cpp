#include "bake/reader_process.h"
#include "support/places.h"
#include "support/temp_folder.h"
#include "unit/bake/flat_form.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace froxel::bake {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kTriangle = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"BUFFER"}]})";

class ReaderProcessTest : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* const binary = std::getenv("FROXEL_BINARY");
        ASSERT_NE(binary, nullptr) << "FROXEL_BINARY names the binary that reads";
        process_.binary = binary;
        process_.sandbox = Sandbox::kBest;
        fs::create_directory(inside());
        std::ofstream(inside() / "data.bin") << std::string(36, '\0');
        std::ofstream(folder_.path() / "outside.bin") << std::string(36, '\0');
    }
    [[nodiscard]] fs::path inside() const { return folder_.path() / "scene"; }
    [[nodiscard]] fs::path write(const std::string& uri) const {
        std::string text = kTriangle;
        text.replace(text.find("BUFFER"), 6, uri);
        std::ofstream(inside() / "triangle.gltf") << text;
        return inside() / "triangle.gltf";
    }
    // Another program in place of the reader, in Python: `say(kind, text)` sends a message.
    void replaceReader(const std::string& script) {
        process_.binary = folder_.path() / "reader";
        std::ofstream(process_.binary) << R"(#!/usr/bin/env -S python3 -S
import os, signal, socket, struct, time
channel = socket.socket(fileno=3)
def say(kind, text=b"", isolated=1, pool=0):
    channel.send(struct.pack("<BQ", kind, len(text)) + text + struct.pack("<QdBBQ", 0, 0, isolated, isolated, pool))
def answer():
    data, rights, _, _ = channel.recvmsg(65536, 1024)
    return data, rights
answer()
)" << script;
        fs::permissions(process_.binary, fs::perms::owner_all);
    }
    [[nodiscard]] std::string failure() const {
        const auto result = load(write("data.bin"), process_);
        return result ? "it was read" : result.error().message;
    }

    test::TempFolder folder_{"froxel_reader"};
    ReaderProcess process_;
};

TEST_F(ReaderProcessTest, FilesOfOthers_AreAsThisProcessReadsThem) {
    const auto folder = test::repositoryPath("../shared/scenes");
    if (!fs::exists(folder)) {
        GTEST_SKIP() << "no files of others at " << folder;
    }
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".glb" && extension != ".gltf") {
            continue;
        }
        SCOPED_TRACE(entry.path());
        const auto here = gltf::load(entry.path());
        const auto there = load(entry.path(), process_);
        ASSERT_EQ(here.has_value(), there.has_value())
            << (there ? here.error().message : there.error().message);
        if (!here) {
            EXPECT_EQ(there.error().message, here.error().message);
            continue;
        }
        EXPECT_TRUE(flat(*there) == flat(*here));
        ASSERT_EQ(there->files.size(), here->files.size());
        for (size_t i = 0; i < here->files.size(); ++i) {
            EXPECT_EQ(there->files[i].path, here->files[i].path);
            EXPECT_EQ(there->files[i].stamp, here->files[i].stamp);
        }
        ++count;
    }
    EXPECT_GT(count, 20U);
}

TEST_F(ReaderProcessTest, FilesBeside_AreOpenedForIt) {
    EXPECT_TRUE(load(write("data.bin"), process_));
    EXPECT_THAT(load(write("none.bin"), process_).error().message, HasSubstr("none.bin"));
    fs::create_symlink("../outside.bin", inside() / "link.bin");
    for (const char* uri : {"link.bin", "none.bin", "../outside.bin", "%2e%2e/outside.bin"}) {
        const auto file = write(uri);
        EXPECT_EQ(load(file, process_).error().message, gltf::load(file).error().message);
    }
    EXPECT_THAT(load(inside() / "absent.glb", process_).error().message, HasSubstr("No such file"));
}

TEST_F(ReaderProcessTest, AReaderThatEnds_IsTold) {
    replaceReader("os._exit(7)\n");
    EXPECT_EQ(failure(), "triangle.gltf: its reader ended with exit code 7 before it began");
    replaceReader("say(0)\nsay(3, b'decoding images')\nos.kill(os.getpid(), signal.SIGSEGV)\n");
    EXPECT_EQ(failure(), "triangle.gltf: its reader ended by signal 11 (Segmentation fault) while "
                         "decoding images");
    replaceReader("os.kill(os.getpid(), signal.SIGKILL)\n");
    EXPECT_THAT(failure(), HasSubstr("its reader was killed"));
    process_.binary = folder_.path() / "absent";
    EXPECT_THAT(failure(), HasSubstr("cannot start a reader: No such file"));
}

TEST_F(ReaderProcessTest, AReaderThatLies_IsNotBelieved) {
    const char* const said = "its reader said what it must not say";
    replaceReader("channel.send(b'x' * 100)\ntime.sleep(1000)\n");
    EXPECT_THAT(failure(), HasSubstr(said));
    replaceReader("say(99)\ntime.sleep(1000)\n");
    EXPECT_THAT(failure(), HasSubstr(said));
    replaceReader("say(1)\ntime.sleep(1000)\n"); // before it has given up its rights
    EXPECT_THAT(failure(), HasSubstr(said));
    replaceReader("say(0)\nsay(4)\ntime.sleep(1000)\n");
    EXPECT_THAT(failure(), HasSubstr("bytes that are no scene"));
    replaceReader("say(0)\nos.write(4, bytes(999))\nsay(4, pool=1000)\ntime.sleep(1000)\n");
    EXPECT_THAT(failure(), HasSubstr("bytes that are no scene"));
    replaceReader("say(0)\nos.write(4, os.urandom(100000))\nsay(4)\ntime.sleep(1000)\n");
    EXPECT_THAT(failure(), HasSubstr("bytes that are no scene"));
    replaceReader("say(0)\nsay(5, b'two\\nlines ' + b'x' * 5000)\ntime.sleep(1000)\n");
    EXPECT_EQ(failure().find('\n'), std::string::npos);
    EXPECT_LT(failure().size(), 1000U);
}

TEST_F(ReaderProcessTest, FilesOutside_AreNotOpenedForIt) {
    replaceReader(R"(
say(0)
for path in b"../outside.bin", b"/etc/passwd", b"../scene/../outside.bin", b".", b"", b"data.bin\0":
    say(2, path)
    _, rights = answer()
    if rights and path != b"data.bin\0":
        say(5, b"opened " + path)
say(5, b"none was opened")
time.sleep(1000)
)");
    EXPECT_EQ(failure(), "triangle.gltf: none was opened");
}

TEST_F(ReaderProcessTest, IsolationThatIsRequired_MustBeThere) {
    process_.sandbox = Sandbox::kRequire;
    replaceReader("say(0, isolated=0)\ntime.sleep(1000)\n");
    const auto result = load(write("data.bin"), process_);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUnsupported);
    EXPECT_THAT(result.error().message, HasSubstr("--sandbox require"));
}

TEST_F(ReaderProcessTest, FilesWithoutEnd_AreNotOpenedForIt) {
    replaceReader("say(0)\nwhile True:\n    say(2, b'data.bin')\n    answer()\n");
    EXPECT_EQ(failure(), "triangle.gltf: it names more than 100000 files");
}

TEST_F(ReaderProcessTest, SelfTest_EscapesNowhere) {
    const std::string command = process_.binary.string() + " bake --self-test";
    FILE* const pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    char line[256] = "";
    (void)fgets(line, sizeof line, pipe);
    const int status = pclose(pipe);
    if (std::string(line).starts_with("not isolated: it has")) {
        GTEST_SKIP() << line; // this kernel, or a build with a sanitizer
    }
    EXPECT_EQ(std::string(line), "isolated by landlock and seccomp: opening a file, connecting and "
                                 "executing all failed\n");
    EXPECT_EQ(status, 0);
}

TEST_F(ReaderProcessTest, NobodyWaits_EndsIt) {
    replaceReader("say(0)\ntime.sleep(1000)\n");
    int asked = 0;
    const auto result =
        load(write("data.bin"), process_, [&](const Progress&) { return ++asked < 3; });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

} // namespace
} // namespace froxel::bake
