// The golden vectors of protocol/vectors, shared with every client: each message's bytes and JSON
// say the same. Run with FROXEL_WRITE_VECTORS=1 to compute `hex` anew from each `json`.
#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "protocol/framing.h"
#include "support/places.h"
#include "unit/protocol/hex.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <set>

namespace froxel::protocol {
namespace {

using Json = nlohmann::ordered_json;
using google::protobuf::Message;

std::string pathOf(const char* name) {
    return test::repositoryPath("protocol/vectors") / name;
}

Json load(const char* name) {
    std::ifstream stream(pathOf(name));
    EXPECT_TRUE(stream) << pathOf(name);
    return Json::parse(stream);
}

std::unique_ptr<Message> newMessage(const std::string& type) {
    const auto* descriptor =
        google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(type);
    if (descriptor == nullptr) {
        throw std::runtime_error("no message type " + type);
    }
    auto* factory = google::protobuf::MessageFactory::generated_factory();
    return std::unique_ptr<Message>(factory->GetPrototype(descriptor)->New());
}

std::string serialize(const Message& message) {
    std::string bytes;
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&coded);
    coded.Trim();
    return bytes;
}

Json toJson(const Message& message) {
    std::string text;
    EXPECT_TRUE(google::protobuf::util::MessageToJsonString(message, &text).ok());
    return Json::parse(text);
}

std::unique_ptr<Message> fromJson(const Json& vector) {
    auto message = newMessage(vector.at("type"));
    const auto status =
        google::protobuf::util::JsonStringToMessage(vector.at("json").dump(), message.get());
    EXPECT_TRUE(status.ok()) << vector.at("name") << ": " << status.ToString();
    return message;
}

std::unique_ptr<Message> fromHexText(const std::string& type, const std::string& hex) {
    auto message = newMessage(type);
    EXPECT_TRUE(message->ParseFromString(fromHex(hex))) << type << " " << hex;
    return message;
}

bool rewriting() {
    return std::getenv("FROXEL_WRITE_VECTORS") != nullptr;
}

class Vectors : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!rewriting()) {
            return;
        }
        Json vectors = load("vectors.json");
        for (Json& vector : vectors) {
            const auto message = fromJson(vector);
            vector["hex"] = toHex(serialize(*message));
            vector["json"] = toJson(*message);
        }
        std::ofstream(pathOf("vectors.json")) << vectors.dump(1) << "\n";
    }
};

TEST_F(Vectors, JsonToBytes_IsTheHex) {
    for (const Json& vector : load("vectors.json")) {
        EXPECT_EQ(toHex(serialize(*fromJson(vector))), vector.at("hex").get<std::string>())
            << vector.at("name");
    }
}

TEST_F(Vectors, BytesToJson_IsTheJson) {
    for (const Json& vector : load("vectors.json")) {
        EXPECT_EQ(toJson(*fromHexText(vector.at("type"), vector.at("hex"))), vector.at("json"))
            << vector.at("name");
    }
}

TEST_F(Vectors, Names_AreDistinct) {
    std::set<std::string> names;
    for (const Json& vector : load("vectors.json")) {
        EXPECT_TRUE(names.insert(vector.at("name")).second) << vector.at("name");
    }
}

TEST_F(Vectors, EveryCommandAndServerMessage_HasOne) {
    std::set<std::string> covered;
    for (const Json& vector : load("vectors.json")) {
        for (const auto& [key, value] : vector.at("json").items()) {
            covered.insert(vector.at("type").get<std::string>() + "." + key);
        }
    }
    for (const auto* type : {v1::ClientMessage::descriptor(), v1::ServerMessage::descriptor(),
                             v1::FrameHeader::descriptor(), v1::ViewState::descriptor()}) {
        for (int i = 0; i < type->field_count(); ++i) {
            EXPECT_TRUE(covered.count(type->full_name() + "." + type->field(i)->json_name()))
                << type->full_name() << "." << type->field(i)->json_name();
        }
    }
}

// Whole frames, good and bad: {name, hex, header (JSON), payload (hex)} or {name, hex, error:
// true}.
TEST(FrameVectors, DecodeAsTheySay) {
    for (const Json& vector : load("frames.json")) {
        const std::string message = fromHex(vector.at("hex").get<std::string>());
        v1::FrameHeader header;
        const auto payload = decodeFrame(bytesOf(message), header);
        if (vector.value("error", false)) {
            EXPECT_FALSE(payload) << vector.at("name");
            continue;
        }
        ASSERT_TRUE(payload) << vector.at("name") << ": " << payload.error().message;
        EXPECT_EQ(toJson(header), vector.at("header")) << vector.at("name");
        const std::string bytes(reinterpret_cast<const char*>(payload->data()), payload->size());
        EXPECT_EQ(toHex(bytes), vector.at("payload").get<std::string>()) << vector.at("name");
        EXPECT_EQ(toHex(encodeFramePrefix(header)) + toHex(bytes),
                  vector.at("hex").get<std::string>());
    }
}

} // namespace
} // namespace froxel::protocol
