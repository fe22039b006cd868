// Panels in an ImGui context without a window: a click emits its action, and drawing emits none.

#include "app/studio/panels/panels.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/panels/widgets.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/app/studio/still_host.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>

namespace clay::studio {
namespace {

using test::small_scene;

class Panels : public ::testing::Test {
 protected:
  Panels() : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1000.0f, 700.0f};
    io.DeltaTime = 1.0f / 60.0f;
    state.ui.fonts = apply_style(Theme::dark, 1.0f);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    apply(state, BeginWork{small_scene(), nullptr, {}});
  }
  ~Panels() override { ImGui::DestroyContext(context_); }
  Panels(const Panels&) = delete;
  Panels& operator=(const Panels&) = delete;

  /// One frame drawn by `draw`; its actions.
  template <class Draw>
  Actions frame(Draw draw) {
    Actions actions;
    ImGui::NewFrame();
    draw(view_model(state), actions);
    ImGui::Render();
    return actions;
  }
  /// The actions of a click at `at` [px]: the mouse moves there, is pressed and released.
  template <class Draw>
  Actions click(Draw draw, ImVec2 at) {
    Actions all;
    const auto collect = [&] {
      for (Action& action : frame(draw)) all.push_back(std::move(action));
    };
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    collect();
    collect();
    io.MouseDown[0] = true;
    collect();
    io.MouseDown[0] = false;
    collect();
    return all;
  }
  /// A panel in a separate window.
  template <class Panel>
  static auto in_window(Panel panel) {
    return [panel](const ViewModel& model, Actions& actions) {
      ImGui::SetNextWindowPos({0.0f, 0.0f});
      ImGui::SetNextWindowSize({300.0f, 600.0f});
      ImGui::Begin("test", nullptr, ImGuiWindowFlags_NoTitleBar);
      panel(model, actions);
      ImGui::End();
    };
  }
  static constexpr ViewRect kView{{100.0f, 50.0f}, {800.0f, 600.0f}};

  StillHost host;
  AppState state{host, Settings{}, [](std::string_view) {}};

 private:
  ImGuiContext* context_;
};

TEST_F(Panels, DrawingEmitsNoAction) {
  const auto all = [](const ViewModel& model, Actions& actions) {
    draw_menu(model, actions);
    draw_strip(model, actions, {0.0f, 20.0f}, {60.0f, 660.0f});
    draw_column(model, actions, Column::diagnostics, {60.0f, 20.0f}, {240.0f, 660.0f});
    draw_column(model, actions, Column::context, {760.0f, 20.0f}, {240.0f, 660.0f});
    draw_hint(model, actions, kView);
    draw_dialog(model, actions, kView);
    draw_banner(model, actions, kView, 40.0f);
  };
  const Dialog dialogs[] = {NoDialog{},       GalleryDialog{}, ShortcutsDialog{}, UnsavedDialog{},
                            OpenDialog{},     SaveDialog{},    ExportDialog{},    ImportDialog{},
                            SettingsDialog{}, ReplaceDialog{}};
  for (const Dialog& dialog : dialogs) {
    state.ui.dialog = dialog;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame(all).empty()) << dialog.index();
  }
}

TEST_F(Panels, AnIconSelectsItsTool) {
  const auto strip = [](const ViewModel& model, Actions& actions) {
    draw_strip(model, actions, {0.0f, 0.0f}, {60.0f, 660.0f});
  };
  const Actions actions = click(strip, {30.0f, 80.0f});  // the second icon, of 49 px each
  ASSERT_EQ(actions.size(), 1u);
  EXPECT_EQ(std::get<RunCommand>(actions[0]).id, "tool.pinch");
  EXPECT_EQ(state.settings.tool.mode, small_scene().tool.mode) << "only apply() changes the state";
}

TEST_F(Panels, AHeaderFoldsItsPanel) {
  const auto column = [](const ViewModel& model, Actions& actions) {
    draw_column(model, actions, Column::context, {0.0f, 0.0f}, {240.0f, 660.0f});
  };
  const Actions actions = click(column, {60.0f, 20.0f});
  ASSERT_EQ(actions.size(), 1u);
  const auto& fold = std::get<FoldPanel>(actions[0]);
  EXPECT_EQ(fold.id, "tool");
  EXPECT_FALSE(fold.open);
  apply(state, actions[0]);
  EXPECT_FALSE(panel_open(state.settings, "tool"));
}

TEST_F(Panels, EnterSavesUnderTheTypedName) {
  state.ui.dialog = SaveDialog{"a.work", {}};
  const auto dialog = [](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
  };
  for (int i = 0; i < 3; ++i) (void)frame(dialog);  // the field gets the keyboard focus
  ImGuiIO& io = ImGui::GetIO();
  io.KeyMap[ImGuiKey_Enter] = 257;
  io.KeyMap[ImGuiKey_End] = 269;
  io.KeysDown[269] = true;
  (void)frame(dialog);
  io.KeysDown[269] = false;
  io.AddInputCharacter('x');
  Actions typed = frame(dialog);
  ASSERT_EQ(typed.size(), 1u);
  EXPECT_EQ(std::get<EditPath>(typed[0]).path, "a.workx");
  apply_all(state, typed);
  io.KeysDown[257] = true;
  const Actions entered = frame(dialog);
  ASSERT_EQ(entered.size(), 1u);
  EXPECT_EQ(std::get<SaveFile>(entered[0]).path, "a.workx");
}

TEST_F(Panels, OnlyTheOpenDialogIsDrawn) {
  const auto dialog = [](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
  };
  state.ui.dialog = SettingsDialog{};
  (void)frame(dialog);
  state.ui.dialog = UnsavedDialog{};
  (void)frame(dialog);
  EXPECT_TRUE(ImGui::FindWindowByName("##unsaved")->Active);
  EXPECT_FALSE(ImGui::FindWindowByName("##settings")->Active);
}

TEST_F(Panels, LinesEndBetweenWordsButNotBeforeAUnit) {
  std::string lines;
  (void)frame([&](const ViewModel&, Actions&) {
    const std::string text = "23 % of the limit, at a height of 12.9 mm; N/mm\xc2\xb2 and 2 walls";
    const float all = ImGui::CalcTextSize(text.c_str()).x;
    EXPECT_EQ(wrapped(text, all + 1.0f), text);
    for (float width = 30.0f; width < all; width += 1.0f) {
      lines = wrapped(text, width);
      EXPECT_EQ(lines.find("12.\n"), std::string::npos) << lines;
      EXPECT_EQ(lines.find("9\nmm"), std::string::npos) << lines;
      EXPECT_EQ(lines.find("23\n%"), std::string::npos) << lines;
      for (std::size_t from = 0; from < lines.size();) {
        const std::size_t to = std::min(lines.find('\n', from), lines.size());
        const std::string line = lines.substr(from, to - from);
        // A line is longer only where it is one word, or a number with its unit.
        if (ImGui::CalcTextSize(line.c_str()).x > width) {
          EXPECT_LE(std::ranges::count(line, ' '), 1) << line;
        }
        from = to + 1;
      }
      std::ranges::replace(lines, '\n', ' ');
      EXPECT_EQ(lines, text);
    }
  });
}

}  // namespace
}  // namespace clay::studio
