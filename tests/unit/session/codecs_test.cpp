// The table of codecs against the schema.
#include "session/delivery.h"
#include "session/proto_enums.h"
#include "session/session_state.h"
#include "session/settings.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace froxel::session {
namespace {

TEST(Codecs, EveryValueOfTheSchema_HasARow) {
    const auto& schema = *google::protobuf::GetEnumDescriptor<v1::Codec>();
    for (int i = 0; i < schema.value_count(); ++i) {
        const auto* value = schema.value(i);
        const auto codec = fromProto<settings::Codec>(settings::kCodecNames,
                                                      static_cast<v1::Codec>(value->number()));
        EXPECT_EQ(codec.has_value(), value->number() != v1::CODEC_UNSPECIFIED) << value->name();
    }
}

TEST(Codecs, EveryStreamedRow_HasAValueOfTheSchemaByItsName) {
    std::set<std::string_view> names;
    for (const settings::CodecRow& row : settings::kCodecRows) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        if (!row.streamed) {
            continue;
        }
        const auto proto = toProto<v1::Codec>(settings::kCodecNames, row.codec);
        EXPECT_EQ(fromProto<settings::Codec>(settings::kCodecNames, proto), row.codec) << row.name;
    }
}

TEST(Codecs, WhatViewersNeedNotChoose_EveryClientDecodes) {
    for (const settings::CodecRow& row : settings::kCodecRows) {
        EXPECT_EQ(settings::contains(settings::commonCodecs(), row.codec),
                  row.streamed && !row.announced)
            << row.name;
        EXPECT_TRUE(row.chosen || !row.announced) << row.name;
    }
}

TEST(Codecs, RefinedPictures_StandAlone) {
    for (const settings::CodecRow& row : settings::kCodecRows) {
        for (const auto stage : {Refinement::kHigh, Refinement::kLossless}) {
            const Delivered with = delivered({.codec = row.codec}, {}, stage);
            const settings::CodecRow& refined = settings::rowOf(with.encoding.codec);
            EXPECT_FALSE(refined.frames_depend || refined.announced) << row.name;
            EXPECT_EQ(refined.lossless, stage == Refinement::kLossless) << row.name;
        }
    }
}

// As the server's log has them of a picture that took long.
TEST(Codecs, UnusualSettings_NameACodecOfStillsToo) {
    for (const settings::CodecRow& row : settings::kCodecRows) {
        const SessionState state{{}, {.codec = row.codec}, {}, {{}, 1, false}, {}};
        const std::string words = unusualSettings(state);
        const bool usual = row.codec == settings::Encoding{}.codec;
        EXPECT_EQ(words.find("codec=" + std::string(row.name)) == std::string::npos, usual)
            << words;
    }
}

} // namespace
} // namespace froxel::session
