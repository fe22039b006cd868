#pragma once
// Panels and dialogs in an ImGui context without a window, and clicks on them.

#include "app/studio/app_state.hpp"
#include "app/studio/panels/panels.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/app/studio/still_host.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <string>
#include <string_view>
#include <utility>

namespace clay::studio {

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
    apply(state, BeginWork{test::small_scene(), nullptr, {}});
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
  /// The text that a panel shows.
  template <class Panel>
  std::string text_of(Panel panel) {
    std::string text;
    (void)frame(in_window([&](const ViewModel& model, Actions& actions) {
      ImGui::LogToBuffer();
      panel(model, actions);
      text = ImGui::GetCurrentContext()->LogBuffer.c_str();
      ImGui::LogFinish();
    }));
    return text;
  }
  static constexpr ViewRect kView{{100.0f, 50.0f}, {800.0f, 600.0f}};

  StillHost host;
  AppState state{host, Settings{}, [](std::string_view) {}};

 private:
  ImGuiContext* context_;
};

}  // namespace clay::studio
