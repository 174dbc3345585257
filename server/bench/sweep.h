// What `froxel bench` measures: a sweep is a list of rows, a row one set of settings.
#pragma once

#include "settings/settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::bench {

// A stop of the camera path.
struct View {
    std::string name;        // what --camera takes; empty: the scene's first
    settings::Camera camera; // what that is in the scene
    double time_s = 0;       // the lights' clock of its first frame
};

// What R2 is: shaded on the host in double; or drawn by the device, with 16 peeled layers, as the
// mean of many samples a pixel, or without a geometry error.
enum class Against : uint8_t { kReference, kPeeled, kSamples, kFullModel };

struct Row {
    std::string label;
    std::string series;
    double value = 0;
    settings::ViewSettings settings; // its camera is that of the stop timed at
    std::optional<size_t> only_view; // a stop of the path; none: timed at the first, errors at all
    std::optional<settings::Size> scaled_to;
    std::optional<settings::Encoding> stream; // JPEG whose error is taken too
    // Where settings.lights.placed would be; empty: where the base's are.
    std::filesystem::path light_set = {};
    bool keep_surfaces = false; // FrameInputs::keep_surfaces
    // In whose form pictures come to the host; none: as pixels.
    std::optional<settings::Encoding> form = {};
    Against against = Against::kReference;

    [[nodiscard]] size_t timedView() const { return only_view.value_or(0); }
};

enum class Axis : uint8_t { kLog, kLinear, kCategory };
inline constexpr std::array kAxisNames = {std::string_view("log"), std::string_view("linear"),
                                          std::string_view("category")};

// Rows of one series are in ascending order of work, so that one predicts the next.
struct Sweep {
    std::string name;
    std::string title;
    std::string variable;
    std::string unit;
    Axis axis = Axis::kCategory;
    std::string about;
    std::vector<Row> rows;
};

// What the sweeps start from.
struct Base {
    settings::ViewSettings settings;
    std::vector<View> views;                      // at least one
    std::vector<std::string> material_variants{}; // the scene's
};

} // namespace froxel::bench
