// The works in the folder of saved files: open one, or delete one.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

namespace clay::studio {
namespace {

constexpr const char *kOpen = "Open", *kDelete = "Delete...";

/// Rounded: enough to compare files.
std::string size_text(std::uintmax_t bytes) {
  return bytes < 1000        ? fmt::format("{} bytes", bytes)
         : bytes < 1'000'000 ? fmt::format("{:.0f} kB", 1e-3 * static_cast<double>(bytes))
                             : fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

/// Name and buttons of a work, and below them the time at which it was saved.
void draw_row(const StoredWork& work, const ViewModel& model, Actions& actions) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float buttons = ImGui::CalcTextSize(kOpen).x + ImGui::CalcTextSize(kDelete).x +
                        4.0f * style.FramePadding.x + style.ItemSpacing.x;
  const float name_px = ImGui::GetContentRegionAvail().x - buttons - style.ItemSpacing.x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(shortened(work.path.stem().string(), name_px).c_str());
  ImGui::SameLine(ImGui::GetContentRegionMax().x - buttons);
  if (ImGui::Button(kOpen)) actions.emplace_back(OpenFile{work.path});
  ImGui::SameLine();
  const bool own = model.document.has_file(work.path);
  ImGui::BeginDisabled(own);
  if (ImGui::Button(kDelete)) actions.emplace_back(DeleteWork{work.path});
  ImGui::EndDisabled();
  if (own && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("This work is open");
  faint_text(model.colours(), fmt::format("{}, {}", time_text(work.when), size_text(work.bytes)));
}

}  // namespace

void draw(const WorksDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect) {
  begin_dialog("##works", rect, 42.0f);
  dialog_title(model, "Works");
  faint_text(model.colours(), kInPage ? "Kept by this browser, newest first"
                                      : "In " + dialog.folder.string() + ", newest first");
  begin_body(rect);
  if (dialog.works.empty()) wrapped_text("No work has been saved here yet.");
  for (const StoredWork& work : dialog.works) {
    ImGui::Spacing();
    ImGui::PushID(work.path.c_str());
    draw_row(work, model, actions);
    ImGui::PopID();
  }
  ImGui::Spacing();
  end_body();
  if (main_button("Close (Esc)", model.colours())) actions.emplace_back(CloseDialog{});
  ImGui::End();
}

}  // namespace clay::studio
