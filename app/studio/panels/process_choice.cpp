// By what a pot is to be made: the processes that are known, and files of the user's own.

#include "app/studio/panels/panels.hpp"

#include <filesystem>

namespace clay::studio {
namespace {

/// A file by its own name: "workshop.process.json" is workshop.
std::string title_of(const std::string& process) {
  if (!process.ends_with(".json")) return process;
  const std::filesystem::path stem = std::filesystem::path(process).stem();
  return (stem.extension() == ".process" ? stem.stem() : stem).string();
}

}  // namespace

void choose_process(AppState& shop, const char* none, std::string& process) {
  if (!ImGui::BeginCombo("##process", process.empty() ? none : title_of(process).c_str())) return;
  if (ImGui::Selectable(none, process.empty())) process.clear();
  for (const std::string& name : process_names())
    if (ImGui::Selectable(name.c_str(), name == process)) process = name;
  for (const std::string& path : shop.settings.processes) {
    ImGui::PushID(path.c_str());
    if (ImGui::Selectable(title_of(path).c_str(), path == process)) process = path;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
    ImGui::PopID();
  }
  if (ImGui::Selectable("From a file...")) ask_for_process(shop);
  ImGui::EndCombo();
}

}  // namespace clay::studio
