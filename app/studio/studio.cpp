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
#include <functional>
#include <numbers>
#include <string_view>
#include <utility>

namespace clay::studio {
namespace {

constexpr float kColumnEm = 16.0f, kNarrowestViewEm = 20.0f;
constexpr float kBelowPart = 0.42f;  // of the height: the context below the view of a narrow window
constexpr double kSpinUpS = 0.6;     // time of the wheel between rest and full speed
constexpr double kLongestFrameS = 0.1;

std::int64_t steady_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

std::size_t hash_of(const ImDrawData& panels) {
  std::size_t hash = 0;
  const auto add = [&](const void* bytes, int count) {
    const std::string_view text(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
    hash = 31 * hash + std::hash<std::string_view>()(text);
  };
  for (int i = 0; i < panels.CmdListsCount; ++i) {
    const ImDrawList& list = *panels.CmdLists[i];
    add(list.VtxBuffer.Data, list.VtxBuffer.size_in_bytes());
    add(list.IdxBuffer.Data, list.IdxBuffer.size_in_bytes());
    for (const ImDrawCmd& command : list.CmdBuffer) {
      add(&command.ClipRect, sizeof command.ClipRect);
      add(&command.ElemCount, sizeof command.ElemCount);
    }
  }
  return hash;
}

}  // namespace

Studio::Studio(Host& host, Settings settings, std::function<void(std::string_view)> log_line)
    : state_(host, std::move(settings), std::move(log_line)) {}

Result<std::unique_ptr<Studio>> Studio::create(Host& host, Settings settings,
                                               std::function<void(std::string_view)> log_line) {
  std::unique_ptr<Studio> studio(new Studio(host, std::move(settings), std::move(log_line)));
  auto canvas = ViewCanvas::create();
  if (!canvas) return tl::make_unexpected(canvas.error());
  studio->canvas_.emplace(std::move(*canvas));
  studio->warm_ = !host.real_time();
  studio->context_ = ImGui::CreateContext();
  connect_imgui(host);
  if (!ImGui_ImplOpenGL3_Init(render::glsl_version()))
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
  return !input_.empty() || moving() || canvas_->unfinished() || !warm_ || awake_frames_ > 0 ||
         state_.readings.checking() || state_.ui.thumbs_missing || state_.guide.busy() ||
         state_.exporter.busy() || state_.pictures.busy() || state_.file_dialog.open();
}

bool Studio::moving() const noexcept {
  return state_.stroke.throwing() || state_.guide.demonstration() != Demonstration::none ||
         spin_ > 0.0 || state_.scene.turning() || state_.gamepad.moving() ||
         state_.fall.running() ||
         (state_.document.scrubbing() && ImGui::IsMouseDown(ImGuiMouseButton_Left));
}

void Studio::take(Input input) {
  if (moved_ns_ == 0 && std::holds_alternative<PointerMoved>(input)) moved_ns_ = steady_ns();
  input_.push_back(std::move(input));
}

bool Studio::frame(Painting painting) {
  const std::int64_t now_ns = state_.host.frame_ns();
  const double now_s = seconds(now_ns);
  const double elapsed_s = std::clamp(now_s - last_s_, kShortestFrameS, kLongestFrameS);
  last_s_ = now_s;
  if (state_.ui.restyle) restyle();
  if (awake_frames_ > 0) --awake_frames_;
  if (!moving()) times_.last_ns = 0;
  state_.readings.update(state_.document, state_.stroke, wanted_of(state_.settings, state_.ui),
                         now_ns, state_.log);
  // ImGui must process each input; the slow painting follows once for all inputs. A closed window
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
  if (painting == Painting::none) return false;
  const std::int64_t moved_ns = std::exchange(moved_ns_, 0);
  if (!needs_paint() && painting == Painting::if_changed) {
    if (!warm_) warm_ = !canvas_->warm_up();
    return false;
  }
  paint();
  if (moved_ns == 0 || !state_.host.real_time()) return true;
  glFinish();  // waits until the frame is drawn
  (state_.stroke.throwing() ? times_.stroke : times_.hover).add(steady_ns() - moved_ns);
  return true;
}

void Studio::restyle() {
  state_.ui.fonts = apply_style(state_.settings.theme, state_.scale(), state_.host.fingers());
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
  let_keys_navigate();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  Actions actions;
  lay_out(view_model(state_), actions);
  ImGui::Render();
  state_.ui.reveal.clear();
  state_.ui.open_menu.reset();
  state_.ui.focus_column = false;
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

namespace {

constexpr ViewRect kAbsent{{0.0f, 0.0f}, {0.0f, 0.0f}};

/// The parts of the window. A part that is absent has no room, or is closed.
struct Layout {
  ViewRect strip = kAbsent, context = kAbsent, diagnostics = kAbsent, status = kAbsent,
           timeline = kAbsent, view = kAbsent;
  bool beside = false;  ///< the context is beside the view, not below it
};

/// In a narrow window the view has priority, then the tools, then the context; the diagnostics take
/// the place of the context while they are open. `top`: the height of the menu.
Layout layout_of(const ViewModel& model, glm::vec2 size, float top) {
  const float em = ImGui::GetFontSize(), status = status_height();
  const float foot = std::max(top + 1.0f, size.y - status), height = foot - top;
  const float column = std::round(kColumnEm * em);
  const bool diagnostics = diagnostics_open(model.settings);
  const auto has_room = [&](float beside) { return size.x - beside >= kNarrowestViewEm * em; };
  Layout parts;
  const float left = has_room(strip_width()) ? strip_width() : 0.0f;
  float right = size.x;
  parts.beside = has_room(left + column);
  parts.strip = {{0.0f, top}, {left, height}};
  parts.status = {{0.0f, size.y - status}, {size.x, status}};
  float below = 0.0f;
  const bool both = has_room(left + 2.0f * column);
  ViewRect& first = diagnostics && !both ? parts.diagnostics : parts.context;
  if (parts.beside) {
    right -= column;
    first = {{right, top}, {column, height}};
  } else if (diagnostics || below_open(model.settings)) {
    below = std::round(kBelowPart * height);
    first = {{left, foot - below}, {size.x - left, below}};
  }
  if (diagnostics && both) {
    right -= column;
    parts.diagnostics = {{right, top}, {column, height}};
  }
  const glm::vec2 view(std::max(1.0f, right - left), height - below);
  const float timeline = timeline_height(model, view);
  parts.view = {{left, top}, view};
  parts.timeline = {{left, top + view.y - timeline}, {view.x, timeline}};
  return parts;
}

bool has_size(const ViewRect& part) { return part.size_px.x > 0.0f && part.size_px.y > 0.0f; }

void draw_columns(const ViewModel& model, Actions& actions, const Layout& parts) {
  if (has_size(parts.strip))
    draw_strip(model, actions, parts.strip.corner_px, parts.strip.size_px, !parts.beside);
  if (has_size(parts.context))
    draw_column(model, actions, Column::context, parts.context.corner_px, parts.context.size_px);
  if (has_size(parts.diagnostics))
    draw_column(model, actions, Column::diagnostics, parts.diagnostics.corner_px,
                parts.diagnostics.size_px);
  draw_status_bar(model, parts.status.corner_px, parts.status.size_px);
  if (has_size(parts.timeline))
    draw_timeline(model, actions, parts.timeline.corner_px, parts.timeline.size_px);
}

/// Over the view, from the pot up to the dialogs. `card`: the guide's card has room.
void draw_overlays(const ViewModel& model, Actions& actions, const Layout& parts, bool card) {
  const ViewRect& view = parts.view;
  const ViewRect free{view.corner_px, {view.size_px.x, view.size_px.y - parts.timeline.size_px.y}};
  // A dialog covers the panels below the view too.
  const float height = parts.status.corner_px.y - view.corner_px.y;
  draw_target(model, view);
  const float verdict = draw_verdict(model, view);
  draw_marks(model, view, verdict);
  draw_export_marks(model, view, verdict);
  draw_path(model, view);
  const float card_px = card && model.guide.active() ? guide_height() : 0.0f;
  draw_at_tool(model, view, free.corner_px.y + free.size_px.y - card_px);
  draw_pause(model, view);
  draw_hint(model, actions, free);
  if (card) draw_guide(model, actions, free);
  draw_dialog(model, actions, {view.corner_px, {view.size_px.x, height}});
  draw_banners(model, actions, view, verdict);
}

}  // namespace

void Studio::lay_out(const ViewModel& model, Actions& actions) {
  const float top = draw_menu(model, actions);
  const Layout parts = layout_of(model, glm::vec2(state_.host.size_px()), top);
  state_.ui.context_shown = has_size(parts.context);
  draw_columns(model, actions, parts);
  const bool first = state_.scene.rect().size_px.x <= 1.0f;
  // Above the panels the card would cover the pot.
  const bool card = parts.beside || !(has_size(parts.context) || has_size(parts.diagnostics));
  place_view(model, parts.view, parts.timeline.size_px.y, card);
  if (first && model.document.has_work()) state_.scene.look(model.stroke.view(), ViewFrom::home);
  draw_overlays(model, actions, parts, card);
}

/// The pot stands above the card of the guide. The room for the card does not grow
/// during a stroke of the mouse, because the view stands still then.
void Studio::place_view(const ViewModel& model, const ViewRect& view, float timeline, bool card) {
  const bool guided = card && model.guide.active();
  const float before = std::exchange(guide_px_, guided ? guide_px_ : 0.0f);
  if (guided && !model.stroke.by_hand()) guide_px_ = std::max(before, guide_height());
  state_.scene.place(view, timeline + std::min(guide_px_, 0.5f * view.size_px.y));
  state_.scene.set_over_panel(ImGui::GetIO().WantCaptureMouse);
  if (before == 0.0f && guide_px_ > 0.0f) state_.scene.look(model.stroke.view(), ViewFrom::lesson);
}

/// Compares the view and the panels with those on the screen.
bool Studio::needs_paint() {
  const bool view = canvas_->show(state_.scene.picture(view_model(state_)), state_.scene.viewport(),
                                  last_s_, state_.host.real_time());
  const std::size_t panels = hash_of(*ImGui::GetDrawData());
  return std::exchange(panels_, panels) != panels || view;
}

void Studio::paint() {
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  const std::int64_t begun_ns = steady_ns();
  const bool drawn = update_canvas();
  const glm::ivec2 size = state_.host.size_px();
  const ViewRect& rect = state_.scene.rect();
  // OpenGL counts rows from the bottom.
  canvas_->copy_to(static_cast<unsigned>(target), {static_cast<int>(rect.corner_px.x),
                                                   size.y - static_cast<int>(rect.corner_px.y) -
                                                       state_.scene.viewport().height_px});
  glViewport(0, 0, size.x, size.y);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (!drawn || !canvas_->changing()) return;
  glFinish();  // waits until the frame is drawn
  const std::int64_t now_ns = steady_ns();
  canvas_->took(seconds(now_ns - begun_ns));
  if (!moving()) return;
  times_.drawing.add(now_ns - begun_ns);
  if (times_.last_ns > 0) {
    times_.between_ns += now_ns - times_.last_ns;
    ++times_.intervals;
  }
  times_.last_ns = now_ns;
}

/// Returns whether it was necessary. A driver that refuses the size is reported.
bool Studio::update_canvas() {
  const auto drawn = canvas_->draw();
  if (!drawn) report(state_, drawn.error());
  return drawn.value_or(false);
}

}  // namespace clay::studio
