#include "app/studio/studio.hpp"

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/timeline.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

namespace clay::studio {
namespace {

constexpr float kColumnEm = 16.0f, kNarrowestViewEm = 20.0f;
constexpr double kSpinUpS = 0.6;  // time of the wheel between rest and full speed
constexpr double kLongestFrameS = 0.1;

std::int64_t steady_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

}  // namespace

Studio::Studio(Host& host, Settings settings, std::function<void(std::string_view)> log_line)
    : state_(host, std::move(settings), std::move(log_line)) {}

Result<std::unique_ptr<Studio>> Studio::create(Host& host, Settings settings,
                                               std::function<void(std::string_view)> log_line) {
  std::unique_ptr<Studio> studio(new Studio(host, std::move(settings), std::move(log_line)));
  auto painter = render::Painter::create();
  if (!painter) return tl::make_unexpected(painter.error());
  studio->painter_.emplace(std::move(*painter));
  studio->context_ = ImGui::CreateContext();
  connect_imgui(host);
  if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
    return failure(ErrorKind::device, "the window's controls: expected OpenGL 3.3");
  studio->last_s_ = seconds(host.frame_ns());
  return studio;
}

Studio::~Studio() {
  state_.stroke.release();
  if (context_ == nullptr) return;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

bool Studio::wakeful() const noexcept {
  return moving() || coarse_ || awake_frames_ > 0 || state_.readings.checking() ||
         state_.exporter.busy() || state_.file_dialog.open();
}

bool Studio::moving() const noexcept {
  return state_.stroke.throwing() || spin_ > 0.0 || state_.scene.turning() ||
         state_.fall.running() ||
         (state_.document.scrubbing() && ImGui::IsMouseDown(ImGuiMouseButton_Left));
}

void Studio::frame(bool paint_it) {
  const std::int64_t now_ns = state_.host.frame_ns();
  const double now_s = seconds(now_ns);
  const double elapsed_s = std::clamp(now_s - last_s_, 1e-4, kLongestFrameS);
  last_s_ = now_s;
  if (state_.ui.restyle) restyle();
  if (awake_frames_ > 0) --awake_frames_;
  state_.ui.notices.expire(now_s);
  state_.readings.update(state_.document, state_.stroke, wanted_of(state_.settings), now_ns,
                         state_.log);
  // ImGui must process each input; the slow painting follows once for all of them. A closed window
  // remains under the mouse for two more ImGui frames.
  do {
    const int passes = input_.empty() ? 1 : kFramesAfterInput;
    handle_input();
    for (int pass = 0; pass < passes && !state_.done; ++pass)
      build_frame(elapsed_s / static_cast<double>(passes));
  } while (!input_.empty() && !state_.done);
  update(state_);
  name_window();
  turn_wheel(elapsed_s);
  if (paint_it) paint();
}

void Studio::restyle() {
  state_.ui.fonts = apply_style(state_.settings.theme, state_.scale());
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  state_.ui.restyle = false;
  awake_frames_ = kFramesAfterInput;
}

void Studio::build_frame(double elapsed_s) {
  ImGuiIO& io = ImGui::GetIO();
  const glm::ivec2 size = state_.host.size_px();
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  io.DeltaTime = static_cast<float>(elapsed_s);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  Actions actions;
  lay_out(view_model(state_), actions);
  ImGui::Render();
  state_.ui.reveal.clear();
  apply_all(state_, actions);
}

/// A star marks an unsaved work, as usual on desktops.
void Studio::name_window() {
  std::string title = "Claystack";
  if (state_.document.has_work())
    title = fmt::format("{}{} - Claystack", state_.document.unsaved() ? "*" : "",
                        state_.document.name());
  if (title == title_) return;
  state_.host.set_title(title);
  title_ = std::move(title);
}

/// The wheel turns during a stroke.
void Studio::turn_wheel(double elapsed_s) {
  const bool turns = state_.stroke.throwing() && !state_.stroke.paused();
  const double change = elapsed_s / kSpinUpS;
  spin_ = turns ? std::min(1.0, spin_ + change) : std::max(0.0, spin_ - change);
  const double rad_per_s = state_.settings.wheel_rpm * 2.0 * std::numbers::pi / 60.0;
  state_.scene.turn_wheel(state_.stroke.view(), spin_ * elapsed_s * rad_per_s);
}

void Studio::lay_out(const ViewModel& model, Actions& actions) {
  const float em = ImGui::GetFontSize();
  const glm::vec2 size(state_.host.size_px());
  const float top = draw_menu(model, actions);
  const float status = status_height();
  const float height = std::max(1.0f, size.y - top - status);
  // In a narrow window the view has priority, then the left column.
  const float column = std::round(kColumnEm * em);
  const float left = size.x - column >= kNarrowestViewEm * em ? column : 0.0f;
  const float right = size.x - 2.0f * column >= kNarrowestViewEm * em ? column : 0.0f;
  if (left > 0.0f) draw_column(model, actions, Column::left, {0.0f, top}, {left, height});
  if (right > 0.0f)
    draw_column(model, actions, Column::right, {size.x - right, top}, {right, height});
  draw_status_bar(model, {0.0f, size.y - status}, {size.x, status});
  const float wide = std::max(1.0f, size.x - left - right);
  const float strip = timeline_height(model, {wide, height});
  const ViewRect view{{left, top}, {wide, height - strip}};
  if (strip > 0.0f) draw_timeline(model, actions, {left, top + height - strip}, {wide, strip});
  const bool first = state_.scene.rect().size_px.x <= 1.0f;
  state_.scene.place(view);
  if (first && model.document.has_work()) state_.scene.look(model.stroke.view(), ViewFrom::home);
  draw_marks(model, view);
  draw_export_marks(model, view);
  draw_hint(model, actions, view);
  draw_dialog(model, actions, view);
  draw_banner(model, actions, view);
}

void Studio::paint() {
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  const std::int64_t begun_ns = steady_ns();
  draw_view(static_cast<unsigned>(target));
  const glm::ivec2 size = state_.host.size_px();
  glViewport(0, 0, size.x, size.y);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (!state_.host.real_time() || !moving()) return;
  glFinish();  // waits until the frame is drawn
  times_.last_ns = steady_ns();
  if (times_.drawing.count() == 0) times_.first_ns = times_.last_ns;
  times_.drawing.add(times_.last_ns - begun_ns);
  quality_.took(seconds(times_.last_ns - begun_ns));
}

/// Paints into a separate canvas, because the painter fills its whole target, and copies it to the
/// window.
void Studio::draw_view(unsigned target) {
  const glm::ivec2 size = state_.host.size_px();
  const ViewRect& rect = state_.scene.rect();
  const render::Viewport view = state_.scene.viewport();
  const Fineness fine = quality_.fineness(state_.host.real_time() && moving());
  coarse_ = fine.divisor > 1 || fine.samples < kFineness[0].samples;
  const int width = std::max(1, view.width_px / fine.divisor);
  const int height = std::max(1, view.height_px / fine.divisor);
  if (!canvas_ || !canvas_->is(width, height, 0)) {
    canvas_.reset();
    auto made = render::Canvas::create(width, height, 0);
    if (!made) return report(state_, made.error());
    canvas_.emplace(std::move(*made));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, canvas_->framebuffer());
  painter_->paint(state_.scene.picture(view_model(state_)), width, height, fine.samples);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  // OpenGL counts rows from the bottom.
  const int left = static_cast<int>(rect.corner_px.x);
  const int top = size.y - static_cast<int>(rect.corner_px.y);
  glBlitFramebuffer(0, 0, width, height, left, top - view.height_px, left + view.width_px, top,
                    GL_COLOR_BUFFER_BIT, fine.divisor > 1 ? GL_LINEAR : GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
}

}  // namespace clay::studio
