#include "session/setting_words.h"

#include "session/settings.h"

#include <nlohmann/json.hpp>

namespace froxel::session {

const std::string& settingWords() {
    static const std::string words = [] {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const SessionSetting& setting : sessionSettings()) {
            const settings::Setting& facts = setting.facts();
            list.push_back({{"name", facts.name},
                            {"label", facts.words.label},
                            {"help", facts.words.help},
                            {"unit", facts.words.unit},
                            {"cost", facts.words.cost}});
        }
        return list.dump();
    }();
    return words;
}

} // namespace froxel::session
