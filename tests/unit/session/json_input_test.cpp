// The text of a message says what its bytes say: against protobuf's own writer and reader.
#include "froxel/v1/client.pb.h"
#include "session/json_input.h"
#include "support/places.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <random>
#include <set>

namespace froxel::session {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

using Random = std::mt19937;

uint32_t below(Random& random, size_t bound) {
    return static_cast<uint32_t>(random() % bound);
}

bool oneIn(Random& random, uint32_t n) {
    return below(random, n) == 0;
}

double anyReal(Random& random) {
    using Limits = std::numeric_limits<double>;
    // Not -0, which the JSON library takes for a whole number.
    const double special[] = {0,
                              0.1,
                              3,
                              -1e9,
                              1e17,
                              -1e-300,
                              Limits::max(),
                              Limits::denorm_min(),
                              Limits::infinity(),
                              Limits::quiet_NaN()};
    return special[below(random, std::size(special))];
}

std::string anyText(Random& random) {
    const char* texts[] = {"",    "a", "sp\xc3\xa4\xc5\xa5 \xe2\x9c\x93", "\"\\/\b\f\n\r\t\x01",
                           "NaN", "17"};
    return texts[below(random, std::size(texts))];
}

void fill(Message& message, Random& random, std::set<std::string>& filled);

// Recurses as deep as the schema.
void fillField(Message& message,
               const FieldDescriptor& field,
               Random& random,
               std::set<std::string>& filled) {
    const Reflection& to = *message.GetReflection();
    filled.insert(field.full_name());
    const auto put = [&](auto set, auto add, auto value) {
        if (field.is_repeated()) {
            (to.*add)(&message, &field, value);
        } else {
            (to.*set)(&message, &field, value);
        }
    };
    switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_UINT32:
        return put(&Reflection::SetUInt32, &Reflection::AddUInt32,
                   oneIn(random, 2) ? below(random, 100) : ~0U);
    case FieldDescriptor::CPPTYPE_UINT64:
        return put(&Reflection::SetUInt64, &Reflection::AddUInt64,
                   oneIn(random, 2) ? uint64_t{random()} << 32U : ~uint64_t{0});
    case FieldDescriptor::CPPTYPE_DOUBLE:
        return put(&Reflection::SetDouble, &Reflection::AddDouble, anyReal(random));
    case FieldDescriptor::CPPTYPE_BOOL:
        return put(&Reflection::SetBool, &Reflection::AddBool, oneIn(random, 2));
    case FieldDescriptor::CPPTYPE_ENUM:
        return put(&Reflection::SetEnumValue, &Reflection::AddEnumValue,
                   static_cast<int>(below(random, 100))); // with values that have no name
    case FieldDescriptor::CPPTYPE_STRING:
        return put(&Reflection::SetString, &Reflection::AddString, anyText(random));
    default:
        ASSERT_EQ(field.cpp_type(), FieldDescriptor::CPPTYPE_MESSAGE) << field.full_name();
        fill(field.is_repeated() ? *to.AddMessage(&message, &field)
                                 : *to.MutableMessage(&message, &field),
             random, filled);
    }
}

// Recurses as deep as the schema.
void fill(Message& message, Random& random, std::set<std::string>& filled) {
    const auto& type = *message.GetDescriptor();
    const int chosen =
        static_cast<int>(below(random, static_cast<size_t>(std::max(type.field_count(), 1))));
    for (int i = 0; i < type.field_count(); ++i) {
        const FieldDescriptor& field = *type.field(i);
        if (field.real_containing_oneof() != nullptr ? i != chosen : oneIn(random, 3)) {
            continue;
        }
        for (uint32_t n = 0; n < (field.is_repeated() ? below(random, 3) : 1); ++n) {
            fillField(message, field, random, filled);
        }
    }
}

// Fields below `type`, by their full names.
// Recurses as deep as the schema.
void fieldsOf(const google::protobuf::Descriptor& type, std::set<std::string>& names) {
    for (int i = 0; i < type.field_count(); ++i) {
        if (names.insert(type.field(i)->full_name()).second &&
            type.field(i)->message_type() != nullptr) {
            fieldsOf(*type.field(i)->message_type(), names);
        }
    }
}

TEST(JsonInput, RandomMessages_AsProtobufWritesThem_AreReadBack) {
    Random random(1);
    std::set<std::string> filled;
    for (int i = 0; i < 3000; ++i) {
        v1::ClientMessage message;
        fill(message, random, filled);
        std::string text;
        ASSERT_TRUE(google::protobuf::util::MessageToJsonString(message, &text).ok());
        v1::ClientMessage read;
        const auto parsed = parseJson(protocol::bytesOf(text), read);
        ASSERT_TRUE(parsed) << parsed.error().message << "\n" << text;
        ASSERT_EQ(message.SerializeAsString(), read.SerializeAsString()) << text;
    }
    std::set<std::string> all;
    fieldsOf(*v1::ClientMessage::descriptor(), all);
    EXPECT_EQ(filled, all);
}

TEST(JsonInput, VectorsOfClients_AreReadAsProtobufReadsThem) {
    std::ifstream file(test::repositoryPath("protocol/vectors") / "vectors.json");
    int count = 0;
    for (const auto& vector : nlohmann::json::parse(file)) {
        if (vector.at("type") != "froxel.v1.ClientMessage") {
            continue;
        }
        const std::string text = vector.at("json").dump();
        v1::ClientMessage wanted;
        ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(text, &wanted).ok());
        v1::ClientMessage read;
        ASSERT_TRUE(parseJson(protocol::bytesOf(text), read)) << text;
        EXPECT_EQ(wanted.SerializeAsString(), read.SerializeAsString()) << text;
        ++count;
    }
    EXPECT_GT(count, 50);
}

} // namespace
} // namespace froxel::session
