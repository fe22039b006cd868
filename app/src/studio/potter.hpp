#pragma once
// Who throws: the work so far, the hand, and the stroke that is under way.

#include "claystack/engine/pot.hpp"
#include "claystack/engine/scene.hpp"
#include "draw/picture.hpp"
#include "studio/mouse_hand.hpp"
#include "studio/sitting.hpp"

#include <memory>
#include <optional>
#include <string>

namespace clay::studio {

/// What befell since the window looked last; each is told once.
struct PotterNews {
  bool stroke_ended = false;
  live::Ending ending = live::Ending::none;
  std::size_t poses = 0;  ///< of that stroke
  std::optional<Error> error;
};

/// Of a stroke, as it begins.
struct Press {
  ToolSpec tool;
  double rate_per_s = 20.0;  ///< of removal
  glm::dvec3 place_mm{0.0};  ///< on the wheel, free of the clay
  double gap_mm = 0.0;       ///< of a pinch: wide enough for the wall; it closes to the tool's own
};

class Potter {
 public:
  /// `clock` outlives it. Without `threads` the servo ticks within `advance`.
  Potter(live::Clock& clock, bool threads) : clock_(clock), threads_(threads), mouse_(clock) {}

  /// A fresh lump in place of what there was.
  Result<void> begin(const SceneSpec& scene);
  [[nodiscard]] bool has_work() const noexcept { return scene_.has_value(); }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  [[nodiscard]] const Pot& pot() const noexcept { return *pot_; }

  /// The mouse takes the tool to the clay. The scene is that of the work, with this tool and rate.
  Result<void> press(const Press& press);
  /// Of the contact [N/mm^2], from the next stroke on.
  void set_stiffness(double n_per_mm2);
  void aim(const MouseAim& aim) noexcept { mouse_.aim(aim); }
  void command(const live::Command& command) noexcept;
  /// Lets go; the stroke is part of the work.
  void release();
  [[nodiscard]] bool throwing() const noexcept { return sitting_ != nullptr; }

  /// Once a frame.
  void advance(std::int64_t now_ns);
  [[nodiscard]] PotterNews take_news() { return std::exchange(news_, {}); }

  /// As it is now, also in mid-stroke.
  [[nodiscard]] const draw::PotView& view() const noexcept { return view_; }
  /// Of the stroke under way, or the last one.
  [[nodiscard]] const live::LiveStatus& status() const noexcept { return status_; }

  /// Of the servo, as measured; 0 at rest.
  [[nodiscard]] double tick_rate_hz() const noexcept { return tick_rate_hz_; }
  [[nodiscard]] std::string device_name() const { return mouse_.info().name; }

  [[nodiscard]] bool can_undo() const noexcept;
  [[nodiscard]] bool can_redo() const noexcept;
  void undo();
  void redo();
  [[nodiscard]] bool unsaved() const noexcept;

 private:
  void look();
  void count_ticks(std::int64_t now_ns);
  void show_pot();

  live::Clock& clock_;
  bool threads_;
  MouseDevice mouse_;
  std::optional<SceneSpec> scene_;
  std::optional<Pot> pot_;
  std::unique_ptr<Sitting> sitting_;
  live::LiveStatus status_;
  draw::PotView view_;
  PotterNews news_;
  double gap_mm_ = 0.0, closed_gap_mm_ = 0.0;  // of a pinch that closes
  std::int64_t last_ns_ = 0;                   // of the frame before
  std::int64_t counted_ns_ = 0;
  std::uint64_t counted_ticks_ = 0;
  double tick_rate_hz_ = 0.0;
};

}  // namespace clay::studio
