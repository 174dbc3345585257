// A session's state, and commands applied to it.
#pragma once

#include "session/session_state.h"
#include "unit/session/context.h"

#include <gtest/gtest.h>

#include <utility>

namespace froxel::session {

inline constexpr TimePoint kStart{std::chrono::seconds(50)};

class State : public ::testing::Test {
  protected:
    SessionState applied(const SessionState& state, Command body, TimePoint now = kStart) {
        const auto result = apply(state, {{++seq_, seq_ * 10}, std::move(body)}, context, now);
        if (!result) {
            ADD_FAILURE() << result.error().message;
            return state;
        }
        return *result;
    }
    static SetGrid gridOf(const settings::GridSize& size) {
        SetGrid command;
        command.size = size;
        return command;
    }

    SessionContext context = makeContext();
    SessionState initial = initialState(context, kStart);

  private:
    uint64_t seq_ = 0;
};

} // namespace froxel::session
