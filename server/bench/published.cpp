#include "bench/published.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <string>
#include <vector>

namespace froxel::bench {

namespace {

using Json = nlohmann::ordered_json;

// Frames a second, as printed there.
struct Rate {
    double value;
    double fps;
};
// Milliseconds, as printed there.
struct Duration {
    double value;
    double ms;
};

// Only compared with another, as printed there.
struct Ratio {
    double value;
    const char* published;
};

// Whose figures, on what.
struct Origin {
    const char* source;
    const char* hardware;
    const char* sweep;
    const char* variable;
    const char* note;
};

Json rowOf(const Rate& rate) {
    return {{"value", rate.value},
            {"ms", 1000 / rate.fps},
            {"published", fmt::format("{} FPS", rate.fps)}};
}

Json rowOf(const Duration& duration) {
    return {{"value", duration.value},
            {"ms", duration.ms},
            {"published", fmt::format("{} ms", duration.ms)}};
}

Json rowOf(const Ratio& ratio) {
    return {{"value", ratio.value}, {"ms", nullptr}, {"published", ratio.published}};
}

template <class Figure>
Json line(const Origin& origin, const char* series, const std::vector<Figure>& figures) {
    Json rows = Json::array();
    for (const auto& figure : figures) {
        rows.push_back(rowOf(figure));
    }
    return {{"source", origin.source},
            {"hardware", origin.hardware},
            {"sweep", origin.sweep},
            {"series", series},
            {"variable", origin.variable},
            {"note", origin.note},
            {"rows", rows}};
}

constexpr const char* kConswang = "conswang (WebGL)";
constexpr const char* kSeabiscuit = "seabiscuit-iv (WebGPU)";
constexpr const char* kLaptop3070 = "RTX 3070 Laptop";
constexpr const char* kLaptop4060 = "RTX 4060 Laptop";
constexpr const char* kCharts =
    "Frame rates in charts; the same case differs by up to 28 % between "
    "them; lights are placed anew in each run; 15x15x15 clusters, radius 5 m but where it varies.";
constexpr const char* kReadOff = "Read off a chart, +-2 frames a second.";

constexpr Origin kCounts1{kConswang, kLaptop3070, "light_count", "lights", kCharts};
constexpr Origin kRadii1{kConswang, kLaptop3070, "light_radius", "radius", kCharts};
constexpr Origin kTwoTargets{kConswang, kLaptop3070, "gbuffer", "lights", kCharts};
constexpr Origin kCounts2{kSeabiscuit, kLaptop4060, "light_count", "lights", kReadOff};
constexpr Origin kSizes2{kSeabiscuit, kLaptop4060, "resolution", "pixels",
                         "1,000 lights. Read off a chart."};
constexpr Origin kGrids2{kSeabiscuit, kLaptop4060, "grid", "clusters",
                         "3840x1440, mean frame rate. Equal numbers of clusters are, in order, "
                         "32x16x32 and 32x32x16."};
constexpr Origin kNormals3{"haco77 (WebGL)", "GT 755M", "gbuffer", "normal components",
                           "400 lights; further packing gained nothing."};
constexpr Origin kAlan{"alan7996 (WebGPU)", "RTX 3070 Ti", "light_count", "lights",
                       "16x16x24 clusters of at most 1,000 lights; times of 3 x 100 frames, around "
                       "the queue's submission."};
constexpr Origin kBloom1{kConswang, kLaptop3070, "bloom", "taps",
                         "100 lights of 5 m; 121 taps in one pass: 11.3 ms more."};

} // namespace

nlohmann::ordered_json publishedFigures() {
    using Rates = std::vector<Rate>;
    using Durations = std::vector<Duration>;
    using Ratios = std::vector<Ratio>;
    return Json::array({
        line(kCounts1, "naive", Rates{{50, 29}, {100, 15}, {200, 9}, {400, 4}, {800, 1}}),
        line(kCounts1, "forward_plus",
             Rates{{50, 80}, {100, 58}, {200, 26}, {400, 16}, {800, 7}, {1600, 4}}),
        line(kCounts1, "clustered_deferred",
             Rates{{50, 71}, {100, 68}, {200, 38}, {400, 30}, {800, 15}, {1600, 8}}),
        line(kRadii1, "naive", Rates{{1, 15}, {2, 15}, {5, 14}, {10, 15}, {20, 15}, {50, 14}}),
        line(kRadii1, "forward_plus",
             Rates{{1, 140}, {2, 109}, {5, 42}, {10, 26}, {20, 16}, {50, 13}}),
        line(kRadii1, "clustered_deferred",
             Rates{{1, 85}, {2, 79}, {5, 66}, {10, 38}, {20, 27}, {50, 23}}),
        line(kTwoTargets, "three targets",
             Rates{{100, 60}, {200, 43}, {300, 30}, {400, 28}, {800, 14}}),
        line(kTwoTargets, "two targets",
             Rates{{100, 64}, {200, 53}, {300, 39}, {400, 29}, {800, 16}}),
        line(kCounts2, "naive", Rates{{50, 78}, {500, 10}, {1000, 7}, {2500, 3}, {5000, 1}}),
        line(kCounts2, "forward_plus",
             Rates{{50, 165}, {500, 125}, {1000, 65}, {2500, 30}, {5000, 15}}),
        line(kCounts2, "clustered_deferred",
             Rates{{50, 200}, {500, 185}, {1000, 148}, {2500, 88}, {5000, 45}}),
        line(kSizes2, "naive", Rates{{2073600, 8}, {3686400, 4}, {8294400, 2}}),
        line(kSizes2, "forward_plus", Rates{{2073600, 103}, {3686400, 70}, {8294400, 30}}),
        line(kSizes2, "clustered_deferred", Rates{{2073600, 254}, {3686400, 150}, {8294400, 70}}),
        line(kGrids2, "clustered_deferred",
             Rates{{8 * 8 * 16, 79.4},
                   {16 * 16 * 8, 71.2},
                   {16 * 16 * 16, 80.6},
                   {32 * 16 * 16, 83.2},
                   {32 * 16 * 32, 93.8},
                   {32 * 32 * 16, 84.4},
                   {32 * 16 * 64, 95.2},
                   {32 * 32 * 32, 92.6},
                   {32 * 32 * 64, 93.6}}),
        line(kNormals3, "clustered_deferred", Durations{{3, 171}, {2, 141}}),
        line(kBloom1, "clustered_deferred", Rates{{0, 58}, {121, 35}}),
        line(kAlan, "forward_plus", Ratios{{5000, "92.6 % less time than naive"}}),
        line(kAlan, "clustered_deferred",
             Ratios{{5000, "98.5 % less time than naive, 5.03 times as fast as forward_plus"}}),
    });
}

} // namespace froxel::bench
