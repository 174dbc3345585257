#include "bench/join.h"

#include "bench/json.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <set>
#include <string>

namespace froxel::bench {

namespace {

using Json = nlohmann::ordered_json;

Error invalid(std::string text) {
    return {ErrorCode::kInvalidArgument, std::move(text)};
}

// What a joined result states once.
constexpr const char* kShared[] = {"froxel", "device", "host", "build", "scene", "method", "views"};

Result<void> checkSchema(const Json& report) {
    const bool known = report.is_object() && report.value("schema", Json()) == kSchema &&
                       report.value("sweeps", Json()).is_array() &&
                       report.value("complete", Json()).is_boolean() &&
                       report.value("elapsed_s", Json()).is_number();
    if (!known) {
        return invalid(fmt::format("not a result of schema {}", kSchema));
    }
    return {};
}

} // namespace

Result<Json> joinReports(std::span<const Json> reports) {
    Json joined;
    std::set<std::string> names;
    for (size_t i = 0; i < reports.size(); ++i) {
        const Json& report = reports[i];
        if (const auto checked = checkSchema(report); !checked) {
            return invalid(fmt::format("file {}: {}", i + 1, checked.error().message));
        }
        if (i == 0) {
            joined = report;
            joined["complete"] = true;
            joined["elapsed_s"] = 0.0;
            joined["sweeps"] = Json::array();
        }
        for (const char* key : kShared) {
            if (report.value(key, Json()) != joined.value(key, Json())) {
                return invalid(fmt::format("file {}: its {} is not that of file 1", i + 1, key));
            }
        }
        joined["complete"] = joined["complete"].get<bool>() && report["complete"].get<bool>();
        joined["elapsed_s"] = joined["elapsed_s"].get<double>() + report["elapsed_s"].get<double>();
        for (const Json& sweep : report["sweeps"]) {
            const auto name = sweep.value("name", Json());
            if (!name.is_string() || !names.insert(name.get<std::string>()).second) {
                return invalid(fmt::format("file {}: sweep {} is there twice or has no name", i + 1,
                                           name.dump()));
            }
            joined["sweeps"].push_back(sweep);
        }
    }
    // Said outright: anything converts to JSON, an error too.
    return Result<Json>(boost::system::in_place_value, std::move(joined));
}

} // namespace froxel::bench
