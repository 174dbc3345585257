#include "scene/looks.h"
#include "session/offered_looks.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

namespace froxel::session {
namespace {

std::map<std::string, std::string> partsOf(const std::string& address) {
    std::map<std::string, std::string> parts;
    std::istringstream text(address);
    for (std::string part; std::getline(text, part, '&');) {
        const size_t at = part.find('=');
        EXPECT_TRUE(parts.emplace(part.substr(0, at), part.substr(at + 1)).second) << part;
    }
    return parts;
}

std::map<std::string, OfferedLook> byName(bool software) {
    std::map<std::string, OfferedLook> looks;
    for (auto& look : offerLooks({}, software)) {
        looks.emplace(look.name, std::move(look));
    }
    return looks;
}

// So that one look leaves nothing of another.
TEST(OfferedLooks, AllSetTheSameSettings) {
    for (const bool software : {true, false}) {
        std::set<std::set<std::string>> names;
        for (const auto& look : offerLooks({}, software)) {
            std::set<std::string> own;
            for (const auto& [name, value] : partsOf(look.address)) {
                own.insert(name);
            }
            names.insert(own);
        }
        ASSERT_EQ(names.size(), 1U);
        EXPECT_EQ(names.begin()->count("light_palette"), 1U);
        EXPECT_EQ(names.begin()->count("animation_speed"), 0U) << "the scene's own";
    }
}

TEST(OfferedLooks, AreTheTables_WithTheirValues) {
    const auto looks = byName(true);
    ASSERT_EQ(looks.size(), scene::looks().size());
    const auto evening = partsOf(looks.at("evening").address);
    EXPECT_EQ(evening.at("light_places"), "surfaces");
    EXPECT_EQ(evening.at("lights"), "1000") << "which the usual settings have, too";
    EXPECT_EQ(evening.at("light_radius"), "2.6");
    EXPECT_EQ(evening.at("renderer"), "clustered_deferred");
    EXPECT_EQ(partsOf(looks.at("toon").address).at("renderer"), "toon_fragment");
    EXPECT_EQ(partsOf(looks.at("clusters").address).at("debug_view"), "listed_lights");
    const auto rainbow = partsOf(looks.at("rainbow").address);
    EXPECT_EQ(rainbow.at("environment"), "off");
    for (const auto& [name, look] : looks) {
        EXPECT_FALSE(look.label.empty() || look.help.empty()) << name;
    }
}

TEST(OfferedLooks, WhatIsDearInSoftware_IsForGpus) {
    EXPECT_EQ(partsOf(byName(false).at("evening").address).at("bloom"), "mip_chain");
    for (const auto& [name, look] : byName(true)) {
        const auto parts = partsOf(look.address);
        const bool glows = parts.count("bloom") != 0 && parts.at("bloom") != "none";
        EXPECT_EQ(glows, name == "glow") << name << ", which is nothing else";
        EXPECT_EQ(parts.count("antialiasing") == 0 || parts.at("antialiasing") == "none", true);
    }
}

} // namespace
} // namespace froxel::session
