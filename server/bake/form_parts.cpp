#include "bake/form_parts.h"

#include "core/scene_file.h"
#include "core/text.h"
#include "gltf/failure.h"

#include <boost/interprocess/streams/bufferstream.hpp>

#include <Poco/Exception.h>
#include <Poco/Net/MessageHeader.h>
#include <Poco/Net/MultipartReader.h>
#include <Poco/Net/NameValueCollection.h>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <sys/mman.h>
#include <utility>

namespace froxel::bake {

namespace {

namespace fs = std::filesystem;

// A file's bytes, unmapped at the end.
class Mapped {
  public:
    explicit Mapped(const gltf::OpenedFile& file) : size_(static_cast<size_t>(file.size_bytes)) {
        bytes_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.descriptor.get(), 0);
        if (size_ == 0 || bytes_ == MAP_FAILED) {
            gltf::fail("the form cannot be mapped");
        }
    }
    ~Mapped() { munmap(bytes_, size_); }
    Mapped(const Mapped&) = delete;
    Mapped& operator=(const Mapped&) = delete;

    [[nodiscard]] std::string_view text() const {
        return {static_cast<const char*>(bytes_), size_};
    }

  private:
    size_t size_;
    void* bytes_ = MAP_FAILED;
};

// "form-data; name=\"files\"; filename=\"a/b.bin\""
std::string filenameOf(const Poco::Net::MessageHeader& header) {
    std::string disposition;
    Poco::Net::NameValueCollection parameters;
    Poco::Net::MessageHeader::splitParameters(header.get("Content-Disposition", ""), disposition,
                                              parameters);
    return parameters.get("filename", "");
}

} // namespace

FormParts::FormParts(gltf::FileOpener& opener, const std::string& boundary) : opener_(opener) {
    try {
        readParts(boundary);
    } catch (const Poco::Exception& error) {
        gltf::fail("is no multipart/form-data: " + printable(error.displayText(), 200));
    }
    const auto isScene = [](const Part& part) { return isSceneFile(part.name); };
    const auto count = std::ranges::count_if(parts_, isScene);
    if (count != 1) {
        gltf::fail("has " + std::to_string(count) + " parts with a filename that ends in " +
                   std::string(kSceneEndingsText) + "; expected one");
    }
    scene_ = static_cast<size_t>(std::ranges::find_if(parts_, isScene) - parts_.begin());
}

void FormParts::readParts(const std::string& boundary) {
    const Mapped form(opener_.openScene());
    const std::string_view text = form.text();
    boost::interprocess::ibufferstream stream(text.data(), text.size(),
                                              std::ios::in | std::ios::binary);
    Poco::Net::MultipartReader reader(stream, boundary);
    while (reader.hasNextPart()) {
        if (parts_.size() >= kMostParts) {
            gltf::fail("has more than " + std::to_string(kMostParts) + " parts");
        }
        Poco::Net::MessageHeader header;
        reader.nextPart(header);
        const auto begin = static_cast<uint64_t>(stream.tellg());
        reader.stream().ignore(std::numeric_limits<std::streamsize>::max());
        const auto size = static_cast<uint64_t>(reader.stream().gcount());
        // The reader takes the end of a form that was cut short for that of its part.
        if (begin > text.size() || size > text.size() - begin ||
            !text.substr(begin + size).starts_with("\r\n--" + boundary)) {
            gltf::fail("ends within part " + std::to_string(parts_.size() + 1));
        }
        parts_.push_back(
            {fs::path(filenameOf(header)).lexically_normal().generic_string(), begin, size});
    }
}

gltf::OpenedFile FormParts::open(const fs::path& relative, const std::string& user) {
    const fs::path wanted = relative.lexically_normal();
    auto found = std::ranges::find(parts_, wanted.generic_string(), &Part::name);
    if (found == parts_.end()) {
        found = std::ranges::find(parts_, wanted.filename().generic_string(), &Part::name);
    }
    if (found == parts_.end() || found->name.empty()) {
        throw gltf::Unusable(gltf::warning::kMissingFile,
                             user + " needs '" + printable(wanted.generic_string(), 300) +
                                 "', which no part of the form has as its filename");
    }
    return open(*found);
}

gltf::OpenedFile FormParts::open(const Part& part) {
    gltf::OpenedFile file = opener_.openScene();
    file.begin = part.begin;
    file.size_bytes = part.size_bytes;
    file.shown = printable(part.name, 300);
    return file;
}

} // namespace froxel::bake
