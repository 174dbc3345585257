// Checks one command's fields and keeps the first fault, so that decoding reads straight down.
#pragma once

#include "core/math.h"
#include "core/text.h"
#include "session/rejection.h"
#include "settings/ranges.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace froxel::session {

class FieldValidator {
  public:
    // Each returns its value as it is; a fault is kept for rejection().
    template <class T>
    T number(const settings::Range<T>& range, T value) {
        return number(range.field, range, value);
    }
    // `field` names one of several fields that share a range. NaN is in no range.
    template <class T>
    T number(std::string_view field, const settings::Range<T>& range, T value) {
        if (!range.contains(value)) {
            fail(RejectCode::kOutOfRange, field,
                 "is " + numberText(value) + "; it must be from " + numberText(range.min) + " to " +
                     numberText(range.max));
        }
        return value;
    }
    glm::dvec3 position(const std::string& field, const glm::dvec3& value) {
        number(field + ".x", settings::kPositionRange, value.x);
        number(field + ".y", settings::kPositionRange, value.y);
        number(field + ".z", settings::kPositionRange, value.z);
        return value;
    }
    const std::string& text(std::string_view field, const std::string& value, size_t max_bytes) {
        if (value.size() > max_bytes) {
            fail(RejectCode::kOutOfRange, field,
                 "has " + numberText(value.size()) + " bytes; at most " + numberText(max_bytes) +
                     " are allowed");
        }
        return value;
    }
    void require(bool present, std::string_view field) {
        if (!present) {
            fail(RejectCode::kOutOfRange, field, "is missing");
        }
    }
    // The text goes on after the field's name.
    void fail(RejectCode code, std::string_view field, const std::string& text) {
        if (!rejection_) {
            rejection_ = Rejection{code, 0, std::string(field), std::string(field) + " " + text};
        }
    }

    void fail(Rejection rejection) {
        if (!rejection_) {
            rejection_ = std::move(rejection);
        }
    }

    [[nodiscard]] const std::optional<Rejection>& rejection() const { return rejection_; }

  private:
    std::optional<Rejection> rejection_;
};

} // namespace froxel::session
