#include "app/studio/imgui_setup.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>
#include <string>
#include <utility>

namespace clay::studio {
namespace {

/// GLFW's codes are ImGui's own indices here.
void map_keys(ImGuiIO& io) {
  constexpr std::array kKeys = {std::pair{ImGuiKey_Tab, GLFW_KEY_TAB},
                                std::pair{ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                std::pair{ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                std::pair{ImGuiKey_UpArrow, GLFW_KEY_UP},
                                std::pair{ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                std::pair{ImGuiKey_Home, GLFW_KEY_HOME},
                                std::pair{ImGuiKey_End, GLFW_KEY_END},
                                std::pair{ImGuiKey_Delete, GLFW_KEY_DELETE},
                                std::pair{ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                std::pair{ImGuiKey_Enter, GLFW_KEY_ENTER},
                                std::pair{ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                std::pair{ImGuiKey_A, GLFW_KEY_A},
                                std::pair{ImGuiKey_C, GLFW_KEY_C},
                                std::pair{ImGuiKey_V, GLFW_KEY_V},
                                std::pair{ImGuiKey_X, GLFW_KEY_X},
                                std::pair{ImGuiKey_Y, GLFW_KEY_Y},
                                std::pair{ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [ours, theirs] : kKeys) io.KeyMap[ours] = theirs;
}

void connect_clipboard(ImGuiIO& io, Host& host) {
  io.ClipboardUserData = &host;
  io.SetClipboardTextFn = [](void* user, const char* text) {
    static_cast<Host*>(user)->set_clipboard(text);
  };
  io.GetClipboardTextFn = [](void* user) -> const char* {
    static std::string held;  // until ImGui has copied it
    held = static_cast<Host*>(user)->clipboard();
    return held.c_str();
  };
}

}  // namespace

void connect_imgui(Host& host) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  map_keys(io);
  connect_clipboard(io, host);
}

}  // namespace clay::studio
