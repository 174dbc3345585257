#include "session/setting_words.h"

#include "session/comparison.h"
#include "session/settings.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace froxel::session {

const std::string& settingWords() {
    static const std::string words = [] {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const SessionSetting& setting : sessionSettings()) {
            const settings::Setting& facts = setting.facts();
            nlohmann::ordered_json row = {
                {"name", facts.name}, {"label", facts.words.label}, {"help", facts.words.help}};
            for (const auto& [key, text] :
                 {std::pair("unit", facts.words.unit), std::pair("cost", facts.words.cost)}) {
                if (!text.empty()) {
                    row[key] = text;
                }
            }
            if (canDiffer(facts)) {
                row["compare"] = true;
            }
            list.push_back(std::move(row));
        }
        return list.dump();
    }();
    return words;
}

} // namespace froxel::session
