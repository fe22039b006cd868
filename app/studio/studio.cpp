#include "app/studio/studio.hpp"

#include "app/studio/actions.hpp"
#include "app/studio/imgui_setup.hpp"
#include "app/studio/panels/panels.hpp"

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
constexpr double kSpinUpS = 0.6;  // of the wheel, to and from its speed
constexpr double kLongestFrameS = 0.1;

std::int64_t steady_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

}  // namespace

Studio::Studio(Host& host, Settings settings, std::function<void(std::string_view)> log_line)
    : shop_(host, std::move(settings), std::move(log_line)) {}

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
  shop_.potter.release();
  if (context_ == nullptr) return;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

bool Studio::wakeful() const noexcept {
  return moving() || coarse_ || awake_frames_ > 0 || shop_.readings.checking() ||
         shop_.exporter.busy() || shop_.dialog.open();
}

bool Studio::moving() const noexcept {
  return shop_.potter.throwing() || spin_ > 0.0 || shop_.view.turning() || shop_.fall.running() ||
         (shop_.potter.scrubbing() && ImGui::IsMouseDown(ImGuiMouseButton_Left));
}

void Studio::frame(bool paint_it) {
  const std::int64_t now_ns = shop_.host.frame_ns();
  const double now_s = seconds(now_ns);
  const double elapsed_s = std::clamp(now_s - last_s_, 1e-4, kLongestFrameS);
  last_s_ = now_s;
  if (shop_.restyle) {
    shop_.fonts = apply_style(shop_.settings.theme, shop_.scale());
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    shop_.restyle = false;
    awake_frames_ = kFramesAfterInput;
  }
  if (awake_frames_ > 0) --awake_frames_;
  shop_.readings.update(shop_.potter, wanted_of(shop_), now_ns, shop_.log);
  // One by one where ImGui has to see each; drawing, which may be slow, once for all.
  // What a click has closed is under the mouse for two more of ImGui's frames.
  do {
    const int passes = waiting_.empty() ? 1 : kFramesAfterInput;
    take_waiting();
    for (int pass = 0; pass < passes && !shop_.done; ++pass)
      shape_frame(elapsed_s / static_cast<double>(passes));
  } while (!waiting_.empty() && !shop_.done);
  look_at_devices(shop_);
  look_at_dialog(shop_);
  look_at_export(shop_);
  shop_.potter.advance(now_ns);
  shop_.host.clock().sleep_until_ns(now_ns);  // with no servo to move it
  tell_news();
  look_at_hand(shop_);
  show_fall(now_s);
  name_window();
  turn_wheel(elapsed_s);
  if (paint_it) paint();
}

void Studio::shape_frame(double elapsed_s) {
  ImGuiIO& io = ImGui::GetIO();
  const glm::ivec2 size = shop_.host.size_px();
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  io.DeltaTime = static_cast<float>(elapsed_s);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  lay_out();
  ImGui::Render();
}

void Studio::tell_news() {
  const PotterNews news = shop_.potter.take_news();
  if (news.device_lost)
    lose_arm(shop_, *news.error);
  else if (news.error)
    tell(shop_, *news.error);
  if (!news.stroke_ended) return;
  shop_.log(fmt::format("stroke ended: {} poses, {} ticks", news.poses, news.ticks));
  if (news.ending == servo::Ending::collapsed) {
    shop_.fall.begin(shop_.potter.shared_pot(), last_s_);
    shop_.notices.say(Grade::warning,
                      "The clay has fallen: it could no longer carry itself. Undo takes the stroke "
                      "back.");
  }
  if (news.ring_limit)
    shop_.notices.say(Grade::warning,
                      "The clay stands as high as this lump allows: what more rises waits above "
                      "the rim.");
}

/// Whatever else is on the wheel meanwhile ends it.
void Studio::show_fall(double now_s) {
  if (!shop_.fall.running()) return;
  const bool fallen = shop_.potter.has_work() && shop_.potter.pot().collapse &&
                      !shop_.potter.scrubbing() && !shop_.potter.throwing();
  if (!fallen) return shop_.fall.end();
  if (const auto place = shop_.fall.at(now_s, shop_.potter.view()))
    shop_.potter.show_fall(*place);
  else
    shop_.potter.go_to(shop_.potter.work().at());
}

/// As the desktop shows it; a star where the work is not saved.
void Studio::name_window() {
  std::string title = "Claystack";
  if (shop_.potter.has_work())
    title = fmt::format(
        "{}{} - Claystack", shop_.potter.unsaved() ? "*" : "",
        shop_.file.empty() ? shop_.potter.scene().name : shop_.file.filename().string());
  if (title == title_) return;
  shop_.host.set_title(title);
  title_ = std::move(title);
}

/// The wheel turns while there is a tool in the clay.
void Studio::turn_wheel(double elapsed_s) {
  const bool turns = shop_.potter.throwing() && !shop_.potter.paused();
  const double change = elapsed_s / kSpinUpS;
  spin_ = turns ? std::min(1.0, spin_ + change) : std::max(0.0, spin_ - change);
  shop_.view.turn_wheel(
      shop_, spin_ * elapsed_s * shop_.settings.wheel_rpm * 2.0 * std::numbers::pi / 60.0);
}

void Studio::lay_out() {
  const float em = ImGui::GetFontSize();
  const glm::vec2 size(shop_.host.size_px());
  const float top = draw_menu(shop_);
  const float status = status_height();
  const float height = std::max(1.0f, size.y - top - status);
  // Where there is little room the view has it, and then the tool.
  const float column = std::round(kColumnEm * em);
  const float left = size.x - column >= kNarrowestViewEm * em ? column : 0.0f;
  const float right = size.x - 2.0f * column >= kNarrowestViewEm * em ? column : 0.0f;
  if (left > 0.0f) draw_column(shop_, Column::left, {0.0f, top}, {left, height});
  if (right > 0.0f) draw_column(shop_, Column::right, {size.x - right, top}, {right, height});
  draw_status_bar(shop_, {0.0f, size.y - status}, {size.x, status});
  const float wide = std::max(1.0f, size.x - left - right);
  const float strip = timeline_height(shop_, {wide, height});
  const ViewRect view{{left, top}, {wide, height - strip}};
  if (strip > 0.0f) draw_timeline(shop_, {left, top + height - strip}, {wide, strip});
  const bool first = shop_.view.rect().size_px.x <= 1.0f;
  shop_.view.place(view);
  if (first && shop_.potter.has_work()) shop_.view.look(shop_, Seen::home);
  draw_marks(shop_, view);
  draw_export_marks(shop_, view);
  draw_hint(shop_, view);
  draw_overlay(shop_, view);
  draw_banner(shop_, view);
}

void Studio::paint() {
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  const std::int64_t begun_ns = steady_ns();
  draw_view(static_cast<unsigned>(target));
  const glm::ivec2 size = shop_.host.size_px();
  glViewport(0, 0, size.x, size.y);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (!shop_.host.real_time() || !moving()) return;
  glFinish();  // what is only asked for has cost nothing yet
  drawn_.last_ns = steady_ns();
  if (drawn_.took.count() == 0) drawn_.first_ns = drawn_.last_ns;
  drawn_.took.add(drawn_.last_ns - begun_ns);
  quality_.took(seconds(drawn_.last_ns - begun_ns));
}

/// Into a canvas of its own, as the painter fills all that it is given, and from there to its
/// place.
void Studio::draw_view(unsigned target) {
  const glm::ivec2 size = shop_.host.size_px();
  const ViewRect& rect = shop_.view.rect();
  const render::Viewport view = shop_.view.viewport();
  const Fineness fine = quality_.fineness(shop_.host.real_time() && moving());
  coarse_ = fine.divisor > 1 || fine.samples < kFineness[0].samples;
  const int width = std::max(1, view.width_px / fine.divisor);
  const int height = std::max(1, view.height_px / fine.divisor);
  if (!canvas_ || !canvas_->is(width, height, 0)) {
    canvas_.reset();
    auto made = render::Canvas::create(width, height, 0);
    if (!made) return tell(shop_, made.error());
    canvas_.emplace(std::move(*made));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, canvas_->framebuffer());
  painter_->paint(shop_.view.picture(shop_), width, height, fine.samples);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  // OpenGL counts rows from below.
  const int left = static_cast<int>(rect.corner_px.x);
  const int top = size.y - static_cast<int>(rect.corner_px.y);
  glBlitFramebuffer(0, 0, width, height, left, top - view.height_px, left + view.width_px, top,
                    GL_COLOR_BUFFER_BIT, fine.divisor > 1 ? GL_LINEAR : GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
}

}  // namespace clay::studio
