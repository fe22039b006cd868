#pragma once
// The state of a window with a work, without a window.

#include "app/studio/app_state.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/app/studio/still_host.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace clay::studio {

class ActionsTest : public ::testing::Test {
 protected:
  ActionsTest() { apply(state, BeginWork{test::small_scene(), nullptr, {}}); }
  /// A stroke, as an unsaved change.
  void change() {
    auto begun = state.document.begin_stroke(test::small_scene());
    ASSERT_TRUE(begun);
    test::record(test::press_stroke(1), *begun->sink);
    ASSERT_TRUE(state.document.end_stroke(std::nullopt, history::Recording::one_stroke));
  }
  [[nodiscard]] std::size_t strokes() const { return state.document.work().size() - 1; }

  StillHost host;
  std::string log;
  AppState state{host, Settings{},
                 [this](std::string_view line) { log.append(line).append("\n"); }};
  test::ScratchFolder folder;
};

}  // namespace clay::studio
