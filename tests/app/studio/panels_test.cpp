// Panels in an ImGui context without a window: a click emits its action, and drawing emits none.

#include "tests/app/studio/panels.hpp"
#include "app/studio/panels/at_tool.hpp"
#include "app/studio/panels/timeline.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {
namespace {

using test::small_scene;

TEST_F(Panels, DrawingEmitsNoAction) {
  const auto all = [](const ViewModel& model, Actions& actions) {
    draw_menu(model, actions);
    draw_strip(model, actions, {0.0f, 20.0f}, {60.0f, 660.0f});
    draw_column(model, actions, Column::diagnostics, {60.0f, 20.0f}, {240.0f, 660.0f});
    draw_column(model, actions, Column::context, {760.0f, 20.0f}, {240.0f, 660.0f});
    draw_hint(model, actions, kView);
    draw_dialog(model, actions, kView);
    draw_banners(model, actions, kView, 40.0f);
  };
  const Dialog dialogs[] = {NoDialog{},       GalleryDialog{}, ShortcutsDialog{}, UnsavedDialog{},
                            OpenDialog{},     SaveDialog{},    ExportDialog{},    ImportDialog{},
                            SettingsDialog{}, ReplaceDialog{}, DiscardDialog{},   WorksDialog{}};
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
  EXPECT_FALSE(panel_open(state.settings, state.ui, "tool"));
}

/// After hours of throwing.
TEST_F(Panels, CardsOutOfSightAreNotDrawn) {
  const auto row = [](const ViewModel& model, Actions& actions) {
    draw_timeline(model, actions, {0.0f, 600.0f}, {1000.0f, 80.0f});
  };
  const auto corners = [&](std::size_t strokes) {
    while (state.document.work().size() <= strokes) {
      auto begun = state.document.begin_stroke(small_scene());
      test::record(test::press_stroke(state.document.work().size()), *begun->sink);
      EXPECT_TRUE(state.document.end_stroke(std::nullopt, history::Recording::one_stroke));
    }
    for (std::size_t i = 0; i <= strokes; ++i) update(state);  // makes one outline each
    for (int i = 0; i < 3; ++i) (void)frame(row);              // scrolled to the present
    return ImGui::GetDrawData()->TotalVtxCount;
  };
  const int of_a_row = corners(20);  // wider than the view
  EXPECT_LT(corners(100), 2 * of_a_row);
}

/// The middle of a logarithmic slider is the geometric mean of its ends, in any unit.
TEST_F(Panels, ALengthSliderIsTheSameInEveryUnit) {
  for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::cm, LengthUnit::in}) {
    double mm = 0.02;
    ImVec2 low, high;
    const auto slider = in_window([&](const ViewModel&, Actions&) {
      (void)form_length("Tolerance", mm, 0.001, 1.0, unit);
      low = ImGui::GetItemRectMin();
      high = ImGui::GetItemRectMax();
    });
    ImGui::GetIO().MousePos = {500.0f, 650.0f};
    for (int i = 0; i < 2; ++i) (void)frame(slider);
    EXPECT_EQ(mm, 0.02) << "nothing was touched";
    (void)click(slider, {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)});
    EXPECT_NEAR(mm, std::sqrt(0.001 * 1.0), 0.004);
  }
}

/// A length slider in which texts are typed.
class TypedLength : public Panels {
 protected:
  /// The length after a click on the shown value, this text and Enter.
  double typed(const char* text, LengthUnit unit) {
    double mm = 5.0;
    ImVec2 low, high;
    const auto slider = in_window([&](const ViewModel&, Actions&) {
      (void)length_slider("Radius", mm, 1.0, 50.0, unit);
      low = ImGui::GetItemRectMin();
      high = ImGui::GetItemRectMax();
    });
    (void)frame(slider);
    const float em = ImGui::GetFontSize();
    (void)click(slider, {high.x - 0.3f * em, low.y - 0.7f * em});
    for (int i = 0; i < 2; ++i) (void)frame(slider);
    ImGuiIO& io = ImGui::GetIO();
    constexpr int kEnter = 257;
    io.KeyMap[ImGuiKey_Enter] = kEnter;
    io.AddInputCharactersUTF8(text);
    (void)frame(slider);
    for (const bool down : {true, false}) {
      io.KeysDown[kEnter] = down;
      (void)frame(slider);
    }
    (void)frame(slider);
    EXPECT_FALSE(ImGui::IsAnyItemActive());
    return mm;
  }
};

TEST_F(TypedLength, HasTheShownUnitOrItsOwn) {
  EXPECT_NEAR(typed("12.5", LengthUnit::mm), 12.5, 1e-5);
  EXPECT_NEAR(typed("1.25", LengthUnit::cm), 12.5, 1e-5);
  EXPECT_NEAR(typed("0.5", LengthUnit::in), 12.7, 1e-5);
  EXPECT_NEAR(typed("0.5in", LengthUnit::mm), 12.7, 1e-5);
  EXPECT_NEAR(typed("8 MM", LengthUnit::in), 8.0, 1e-5);
}

TEST_F(TypedLength, StaysWithinTheSlider) {
  EXPECT_EQ(typed("900", LengthUnit::mm), 50.0);
  EXPECT_EQ(typed("0", LengthUnit::mm), 1.0);
}

TEST_F(Panels, ATextThatIsNoNumberMayBeTypedAgain) {
  float percent = 30.0f;
  const auto field = in_window([&](const ViewModel&, Actions&) {
    (void)panel_slider("Share", percent, 0.0f, 100.0f, "30 % of the wall", kPercent);
  });
  (void)frame(field);
  ImVec2 value;
  (void)frame(in_window([&](const ViewModel&, Actions&) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    value = {at.x + ImGui::GetContentRegionAvail().x - 4.0f, at.y + 0.5f * ImGui::GetFontSize()};
  }));
  (void)click(field, value);
  for (int i = 0; i < 2; ++i) (void)frame(field);
  ImGuiIO& io = ImGui::GetIO();
  constexpr int kEnter = 257;
  io.KeyMap[ImGuiKey_Enter] = kEnter;
  for (const char* text : {"much", "45 %"}) {
    io.AddInputCharactersUTF8(text);
    (void)frame(field);
    for (const bool down : {true, false}) {
      io.KeysDown[kEnter] = down;
      (void)frame(field);
    }
    for (int i = 0; i < 2; ++i) (void)frame(field);
  }
  EXPECT_EQ(percent, 45.0f);
}

TEST_F(Panels, ChoicesWithoutRoomStandInSeveralRows) {
  constexpr std::array kTitles = {"As thrown", "Capacity", "Weight", "Height", "Diameter"};
  float width = 0.0f, frame_px = 0.0f;
  int chosen = -1;
  ImVec2 low, high;
  const auto row = [&](const ViewModel&, Actions&) {
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({width, 600.0f});
    ImGui::Begin("test", nullptr, ImGuiWindowFlags_NoTitleBar);
    if (const int clicked = choice_row("row", kTitles, 0); clicked >= 0) chosen = clicked;
    low = ImGui::GetItemRectMin();
    high = ImGui::GetItemRectMax();
    frame_px = ImGui::GetFrameHeight();
    ImGui::End();
  };
  width = 900.0f;
  for (int i = 0; i < 2; ++i) (void)frame(row);
  EXPECT_NEAR(high.y - low.y, frame_px, 1.0f) << "one row";
  width = 300.0f;
  for (int i = 0; i < 2; ++i) (void)frame(row);
  EXPECT_GT(high.y - low.y, 1.8f * frame_px);
  EXPECT_LE(high.x, 300.0f);
  (void)click(row, {low.x + 10.0f, high.y - 0.5f * frame_px});
  EXPECT_GE(chosen, 2) << "the first of the last row";
}

TEST_F(Panels, ALongNameLeavesRoomInTheStatusBar) {
  SceneSpec scene = small_scene();
  scene.name.clear();
  for (int i = 0; i < 40; ++i) scene.name += "gro\xc3\x9f ";
  apply(state, BeginWork{scene, nullptr, {}});
  const auto bar = [](const ViewModel& model, Actions&) {
    draw_status_bar(model, {0.0f, 600.0f}, {800.0f, status_height()});
  };
  for (int i = 0; i < 3; ++i) (void)frame(bar);
  const ImGuiWindow* window = ImGui::FindWindowByName("##status");
  EXPECT_LE(window->ContentSize.x + 2.0f * window->WindowPadding.x, 800.0f);
  EXPECT_GT(window->ContentSize.x, 600.0f) << "no shorter than it must be";
}

TEST_F(Panels, ANarrowStatusBarCutsNothingOff) {
  state.settings.open[kDiagnostics] = true;
  const auto bar = [](const ViewModel& model, Actions&) {
    draw_status_bar(model, {0.0f, 600.0f}, {320.0f, status_height()});
  };
  for (int i = 0; i < 3; ++i) (void)frame(bar);
  const ImGuiWindow* window = ImGui::FindWindowByName("##status");
  EXPECT_LE(window->ContentSize.x + 2.0f * window->WindowPadding.x, 320.0f);
}

TEST_F(Panels, NamesTheDeviceThatMovesTheTool) {
  EXPECT_EQ(view_model(state).device_name(), "Mouse");
  host.touched = true;
  EXPECT_EQ(view_model(state).device_name(), "Touch screen");
}

TEST_F(Panels, FingersAreNotAskedToHoldKeys) {
  apply(state, SetToolMode{ToolMode::press});
  const auto tool = [](const ViewModel& model, Actions& actions) { draw_tool(model, actions); };
  EXPECT_NE(text_of(tool).find("Ctrl"), std::string::npos) << text_of(tool);
  host.touched = true;
  EXPECT_EQ(text_of(tool).find("Ctrl"), std::string::npos) << text_of(tool);
}

TEST_F(Panels, ALongTextIsShortenedInItsMiddle) {
  const std::string name = "a very long name of a pot with \xc3\x84\xc3\x96\xc3\x9c in it.work";
  (void)frame([&](const ViewModel&, Actions&) {
    EXPECT_EQ(shortened(name, 2000.0f), name);
    for (float width = 40.0f; width < 200.0f; width += 7.0f) {
      const std::string text = shortened(name, width);
      EXPECT_LE(ImGui::CalcTextSize(text.c_str()).x, width) << text;
      const std::size_t gap = text.find("\xe2\x80\xa6");
      ASSERT_NE(gap, std::string::npos) << text;
      EXPECT_TRUE(name.starts_with(text.substr(0, gap))) << text;
      EXPECT_TRUE(name.ends_with(text.substr(gap + 3))) << text;
      const auto after = static_cast<unsigned char>(text[gap + 3]);
      EXPECT_NE(after & 0xC0, 0x80) << "a whole character: " << text;
    }
  });
}

TEST_F(Panels, AnUnfoldedPanelComesIntoSight) {
  const auto column = [](const ViewModel& model, Actions& actions) {
    draw_column(model, actions, Column::context, {0.0f, 0.0f}, {240.0f, 500.0f});
  };
  for (int i = 0; i < 2; ++i) (void)frame(column);
  const ImGuiWindow* window = ImGui::FindWindowByName("##context");
  ASSERT_EQ(window->Scroll.y, 0.0f);
  apply(state, FoldPanel{"wheel", true});
  (void)frame(column);
  state.ui.reveal.clear();
  for (int i = 0; i < 2; ++i) (void)frame(column);
  EXPECT_GT(window->ScrollMax.y, 0.0f) << "the panels are higher than the column";
  EXPECT_NEAR(window->Scroll.y, window->ScrollMax.y, 12.0f) << "the last panel is in sight";
}

/// Floor 10 mm, bore 40 mm, leaning out by 45 degrees above it; level, its wall is 6 mm.
class FiguresAtTool : public Panels {
 protected:
  FiguresAtTool() {
    std::vector<Ring> rings(20, Ring{quanta_from_radius(30.0), 0});
    for (int i = 0; i < 100; ++i)
      rings.push_back({quanta_from_radius(30.0 + 0.5 * i), quanta_from_radius(24.0 + 0.5 * i)});
    put(std::move(rings));
  }
  void put(std::vector<Ring> rings) {
    Pot pot;
    pot.stack = ClayStack::from_rings(0.5, std::move(rings), 0).value();
    pot.ledger.initial = pot.stack.volume();
    apply(state, BeginWork{small_scene(), std::make_shared<const Pot>(pot), {}});
    state.readings.update(state.document, state.stroke, wanted_of(state.settings, state.ui), 0,
                          [](std::string_view) {});
  }
  std::vector<std::string> figures(glm::dvec3 place_mm, bool inside = false) {
    render::ToolView tool;
    tool.place_mm = place_mm;
    tool.inside = inside;
    return figures_at(view_model(state), tool);
  }
};

TEST_F(FiguresAtTool, TheWallIsThatOfTheCheck) {
  const double wall_mm = wall_mm_at(*state.readings.check(), 40.0).value();
  ASSERT_NEAR(wall_mm, 6.0 / std::sqrt(2.0), 0.1);
  EXPECT_EQ(figures({80.0, 40.0, 0.0}),
            (std::vector<std::string>{"wall " + thickness_text(wall_mm, LengthUnit::mm),
                                      "radius 80.0 mm", "height 40.0 mm"}));
}

TEST_F(FiguresAtTool, AtAFootAreThoseOfThePotUpsideDown) {
  apply(state, SetToolMode{ToolMode::trim_foot});
  // The pot is 60 mm high; its foot is on top.
  EXPECT_EQ(figures({12.0, 57.0, 0.0}),
            (std::vector<std::string>{"floor 10.0 mm", "radius 12.0 mm", "from the foot 3.0 mm"}));
  EXPECT_EQ(figures({12.0, 64.0, 0.0}).back(), "above the foot 4.0 mm");
  EXPECT_EQ(figures({100.0, 57.0, 0.0}).front(), "radius 100.0 mm") << "beside the foot";
}

TEST_F(FiguresAtTool, TheFloorIsTheClayBelowTheBore) {
  EXPECT_EQ(figures({5.0, 20.0, 0.0}, true).at(1), "floor 10.0 mm");
  // A hollow of 3 mm is cut into the foot.
  std::vector<Ring> rings(6, Ring{quanta_from_radius(30.0), quanta_from_radius(15.0)});
  rings.resize(20, Ring{quanta_from_radius(30.0), 0});
  rings.resize(120, Ring{quanta_from_radius(30.0), quanta_from_radius(24.0)});
  put(std::move(rings));
  EXPECT_EQ(figures({5.0, 20.0, 0.0}, true).at(1), "floor 7.0 mm");
}

TEST_F(Panels, TheFootOfAFallenPotIsNotTrimmed) {
  apply(state, SetToolMode{ToolMode::trim_foot});
  const auto tool = [](const ViewModel& model, Actions& actions) { draw_tool(model, actions); };
  EXPECT_NE(text_of(tool).find("stands upside down"), std::string::npos) << text_of(tool);
  Pot pot = state.document.pot();
  pot.collapse = Collapse{.failed_ring = 10};
  apply(state, BeginWork{small_scene(), std::make_shared<const Pot>(pot), {}});
  apply(state, SetToolMode{ToolMode::trim_foot});
  ASSERT_TRUE(state.document.fallen());
  EXPECT_EQ(text_of(tool).find("stands upside down"), std::string::npos) << text_of(tool);
  EXPECT_NE(text_of(tool).find("fallen"), std::string::npos) << text_of(tool);
}

TEST_F(FiguresAtTool, DiameterAndCapacityAreThoseOfTheExport) {
  // Smoothing evens out ridges a millimetre apart, between which the rings are narrower.
  std::vector<Ring> rings(20, Ring{quanta_from_radius(40.0), 0});
  rings.resize(120, Ring{quanta_from_radius(40.0), quanta_from_radius(34.0)});
  for (std::size_t i = 20; i < rings.size(); ++i)
    rings[i].outer2 = quanta_from_radius(i % 4 < 2 ? 40.0 : 40.3);
  put(std::move(rings));
  const auto& check = state.readings.check();
  ASSERT_TRUE(check && check->maker);
  EXPECT_EQ(state.readings.diameter_mm(), check->maker->thrown.size.diameter_mm);
  EXPECT_NEAR(2.0 * state.readings.widest_mm(), 80.6, 1e-3);
  EXPECT_NE(state.readings.diameter_mm(), 2.0 * state.readings.widest_mm());
  EXPECT_EQ(state.readings.capacity_mm3(), 1e3 * check->maker->thrown.capacity_ml);
  // A bore below the floor's edge, which the rings count and the section rounds.
  rings = std::vector<Ring>(20, Ring{quanta_from_radius(40.0), 0});
  for (int i = 0; i < 100; ++i)
    rings.push_back({quanta_from_radius(40.0), quanta_from_radius(i < 2 ? 20.0 + i : 34.0)});
  put(std::move(rings));
  ASSERT_TRUE(check && check->maker);
  EXPECT_EQ(state.readings.capacity_mm3(), 1e3 * check->maker->thrown.capacity_ml);
  EXPECT_NE(state.readings.capacity_mm3(), state.readings.account().capacity_mm3);
}

TEST(PlaceBeside, CoversNeitherToolNorPotWhereThereIsRoom) {
  const Span view{0.0f, 800.0f}, pot{300.0f, 500.0f};
  constexpr float kWidth = 100.0f, kGap = 10.0f;
  const auto apart = [](float left, const Span& other) {
    return left + kWidth <= other.low || left >= other.high;
  };
  for (const float reach : {10.0f, 60.0f, 120.0f})
    for (float at = reach; at <= 800.0f - reach; at += 5.0f) {
      const Span tool{at - reach, at + reach};
      const float left = place_beside(tool, pot, view, kWidth, kGap);
      EXPECT_TRUE(apart(left, tool)) << at;
      EXPECT_TRUE(left >= view.low && left + kWidth <= view.high) << at;
      // Between 180 and 620 px a side of both has room.
      if (at >= 180.0f + reach && at <= 620.0f - reach) {
        EXPECT_TRUE(apart(left, pot)) << at;
      }
    }
}

TEST(PlaceWithin, LeavesABoxAsWantedOrMovesItIntoTheView) {
  const Span view{50.0f, 350.0f};
  EXPECT_EQ(place_within(100.0f, view, 120.0f, 10.0f), 100.0f);
  EXPECT_EQ(place_within(20.0f, view, 120.0f, 10.0f), 60.0f);
  EXPECT_EQ(place_within(300.0f, view, 120.0f, 10.0f), 220.0f) << "ends above the lower edge";
  EXPECT_EQ(place_within(300.0f, view, 400.0f, 10.0f), 60.0f) << "begins at the top";
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
