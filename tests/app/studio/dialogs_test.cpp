// Dialogs in an ImGui context without a window: their controls and their layout.

#include "tests/app/studio/panels.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

using Dialogs = Panels;

TEST_F(Dialogs, EnterSavesUnderTheTypedName) {
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
  // It could not be saved: the dialog stays, and the name can be typed at once.
  io.KeysDown[257] = false;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame(dialog).empty());
  io.AddInputCharacter('y');
  const Actions again = frame(dialog);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<EditPath>(again[0]));
}

/// An error such as that of a save; a banner from before the dialog stays behind the veil.
TEST_F(Dialogs, TheErrorOfADialogIsOverItsVeil) {
  const auto draw = [this](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
    draw_banners(model, actions, kView, 40.0f);
    update(state);
  };
  const auto in_front = [](const char* name) {
    return ImGui::GetCurrentContext()->Windows.back() == ImGui::FindWindowByName(name);
  };
  report(state, {ErrorKind::io, "before"});
  (void)frame(draw);
  state.ui.dialog = SaveDialog{"a.work", {}};
  for (int i = 0; i < 3; ++i) (void)frame(draw);
  EXPECT_TRUE(in_front("##save"));
  report(state, {ErrorKind::io, "cannot save"});
  for (int i = 0; i < 3; ++i) (void)frame(draw);
  EXPECT_TRUE(in_front("##answer"));
}

/// The same text may answer another dialog later.
TEST_F(Dialogs, TheSameErrorIsOverTheVeilOfAnyDialog) {
  const auto draw = [this](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
    draw_banners(model, actions, kView, 40.0f);
    update(state);
  };
  for (const Dialog& dialog : {Dialog(OpenDialog{"a.work"}), Dialog(SaveDialog{"a.work", {}})}) {
    state.ui.dialog = dialog;
    for (int i = 0; i < 3; ++i) (void)frame(draw);
    report(state, {ErrorKind::io, "no room"});
    for (int i = 0; i < 3; ++i) (void)frame(draw);
    EXPECT_EQ(ImGui::GetCurrentContext()->Windows.back(), ImGui::FindWindowByName("##answer"));
    apply(state, CloseNotice{});
  }
}

/// The arrow keys reach the controls of the list of choices without a stop at the list.
TEST_F(Dialogs, TheKeyboardStartsInTheFirstControlOfTheExport) {
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.KeyMap[ImGuiKey_Space] = 32;
  io.KeyMap[ImGuiKey_RightArrow] = 262;
  apply(state, ShowDialog{DialogKind::export_files});
  const std::vector<solid::MeshFormat> first = state.ui.exporting.choices.meshes;
  const auto dialog = [](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
  };
  const auto press = [&](int key) {
    Actions all;
    for (const bool down : {true, false, false}) {
      io.KeysDown[key] = down;
      for (Action& action : frame(dialog)) all.push_back(std::move(action));
    }
    return all;
  };
  for (int i = 0; i < 3; ++i) (void)frame(dialog);
  EXPECT_TRUE(press(262).empty());
  Actions toggled = press(32);
  ASSERT_EQ(toggled.size(), 1u);
  ASSERT_TRUE(std::holds_alternative<EditExport>(toggled[0]));
  EXPECT_NE(std::get<EditExport>(toggled[0]).choices.meshes, first);
}

TEST_F(Dialogs, OnlyTheOpenDialogIsDrawn) {
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

TEST_F(Dialogs, ADialogThatFitsHasNoScrollbar) {
  constexpr ViewRect kLarge{{0.0f, 0.0f}, {1280.0f, 744.0f}};
  ImGui::GetIO().DisplaySize = {1280.0f, 800.0f};
  const auto dialog = [&](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kLarge);
  };
  apply(state, ShowDialog{DialogKind::shortcuts});
  for (int i = 0; i < 4; ++i) (void)frame(dialog);
  const ImVector<ImGuiWindow*>& windows = GImGui->Windows;
  const auto body = std::find_if(windows.begin(), windows.end(), [](const ImGuiWindow* window) {
    return std::string_view(window->Name).starts_with("##shortcuts/##body");
  });
  ASSERT_NE(body, windows.end());
  EXPECT_LT((*body)->Size.y, kLarge.size_px.y) << "it fits";
  EXPECT_FALSE((*body)->ScrollbarY);
  EXPECT_EQ((*body)->ScrollMax.y, 0.0f);
}

/// Some choices have further rows. No control moves from under the pointer when they appear.
TEST_F(Dialogs, TheTopOfTheExportStandsStill) {
  constexpr ViewRect kLarge{{0.0f, 0.0f}, {1280.0f, 744.0f}};
  ImGui::GetIO().DisplaySize = {1280.0f, 800.0f};
  const auto dialog = [&](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kLarge);
  };
  const auto shown = [&](solid::Smoothing smoothing) {
    ExportChoices choices = state.ui.exporting.choices;
    choices.smoothing = smoothing;
    apply(state, EditExport{choices});
    for (int i = 0; i < 4; ++i) (void)frame(dialog);
    const ImGuiWindow& window = *ImGui::FindWindowByName("##export");
    EXPECT_LE(window.Pos.y + window.Size.y, kLarge.size_px.y);
    return ImVec2(window.Pos.y, window.Size.y);
  };
  apply(state, ShowDialog{DialogKind::export_files});
  const ImVec2 fair = shown(solid::Smoothing::fair), exact = shown(solid::Smoothing::exact);
  EXPECT_LT(exact.y, fair.y) << "without the row of the smoothing length";
  EXPECT_EQ(exact.x, fair.x);
}

TEST_F(Dialogs, EachButtonChoosesTheAxisOfItsTitle) {
  ImportDialog import;
  import.path = "odd.csv";
  import.settings.axis = ImportAxis::middle;
  state.ui.dialog = import;
  const auto dialog = [](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
  };
  for (int i = 0; i < 3; ++i) (void)frame(dialog);
  const ImGuiWindow* window = ImGui::FindWindowByName("##import");
  std::map<ImGuiID, ImportAxis> chosen;  // by the button that was clicked
  for (float y = window->Pos.y; y < window->Pos.y + 0.5f * window->Size.y; y += 12.0f)
    for (float x = window->Pos.x; x < window->Pos.x + window->Size.x; x += 24.0f)
      for (const Action& action : click(dialog, {x, y}))
        if (const auto* edit = std::get_if<EditImport>(&action);
            edit != nullptr && edit->settings.axis != ImportAxis::middle)
          chosen[GImGui->HoveredId] = edit->settings.axis;
  const ImGuiID row = ImHashStr("##axis", 0, window->ID);
  const auto button = [&](const char* title) { return ImHashStr(title, 0, row); };
  EXPECT_EQ(chosen, (std::map<ImGuiID, ImportAxis>{{button("Automatic"), ImportAxis::by_itself},
                                                   {button("Left end"), ImportAxis::left},
                                                   {button("Right end"), ImportAxis::right},
                                                   {button("At"), ImportAxis::at}}));
}

TEST_F(Dialogs, ALongRecentNameHidesNoOtherFile) {
  state.settings.recent = {"/pots/" + std::string(120, 'n') + ".work", "/pots/a.work"};
  state.ui.dialog = GalleryDialog{};
  const auto gallery = [](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
  };
  for (int i = 0; i < 3; ++i) (void)frame(gallery);
  const ImGuiWindow* window = ImGui::FindWindowByName("##gallery");
  const float y =
      window->InnerClipRect.Max.y - window->WindowPadding.y - 0.5f * window->CalcFontSize();
  std::set<std::string> opened;
  for (float x = window->Pos.x; x < window->Pos.x + window->Size.x; x += 12.0f)
    for (const Action& action : click(gallery, {x, y}))
      if (const auto* open = std::get_if<OpenFile>(&action)) opened.insert(open->path.string());
  EXPECT_EQ(opened, std::set(state.settings.recent.begin(), state.settings.recent.end()));
}

TEST_F(Dialogs, EachWorkOfTheListCanBeOpenedOrDeletedButNotTheOpenOne) {
  test::ScratchFolder folder;
  const std::filesystem::path own = folder.file("own.work"), other = folder.file("other.work");
  test::write_text(other, "x");
  ASSERT_TRUE(state.document.save(own));
  state.ui.dialog = WorksDialog{folder.path(), stored_works(folder.path())};
  const auto list = [](const ViewModel& model, Actions& actions) {
    draw_dialog(model, actions, kView);
  };
  for (int i = 0; i < 3; ++i) (void)frame(list);
  const ImGuiWindow* window = ImGui::FindWindowByName("##works");
  std::set<std::filesystem::path> opened, deleted;
  for (float y = window->Pos.y; y < window->Pos.y + window->Size.y; y += 10.0f)
    for (float x = window->Pos.x; x < window->Pos.x + window->Size.x; x += 20.0f)
      for (const Action& action : click(list, {x, y})) {
        if (const auto* open = std::get_if<OpenFile>(&action)) opened.insert(open->path);
        if (const auto* remove = std::get_if<DeleteWork>(&action)) deleted.insert(remove->path);
      }
  EXPECT_EQ(opened, (std::set{own, other}));
  EXPECT_EQ(deleted, std::set{other});
}

}  // namespace
}  // namespace clay::studio
