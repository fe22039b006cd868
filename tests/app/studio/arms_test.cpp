// Arms in the window: connecting, throwing, faults, disconnecting and reconnecting. On the studio's
// clock, with a scripted arm.

#include "app/studio/commands.hpp"
#include "app/studio/script_runner.hpp"
#include "claystack/engine/files.hpp"
#include "tests/app/servo/live_bench.hpp"
#include "tests/app/studio/clocked_arm.hpp"
#include "tests/app/studio/socket.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace clay::studio {
namespace {

/// The lump of the sample bowl; its clay yields so slowly that the contact force lasts.
SceneSpec slow_clay() {
  SceneSpec scene = servo::sample_scene("bowl");
  scene.removal.rate_per_s = 0.1;
  return scene;
}

/// A window without a screen, and a socket for an arm.
class Arms : public testing::Test {
 protected:
  Arms() {
    auto made = OffscreenHost::create({960, 640}, 1.0f);
    if (!made) throw std::runtime_error(made.error().message);
    host_ = std::move(*made);
    Settings settings;
    settings.hints = false;
    studio_ = std::move(*Studio::create(
        *host_, settings, [this](std::string_view line) { log_.append(line).append("\n"); }));
    runner_.emplace(*host_, *studio_);
    apply(state(), BeginWork{slow_clay(), nullptr, {}});
    state().devices = std::make_unique<DeviceWatch>(socket_.look(), std::chrono::milliseconds(1));
  }
  AppState& state() { return studio_->state(); }
  void play(const std::string& text) {
    const auto done = runner_->run(parse_script(text, "s").value(), "s");
    ASSERT_TRUE(done) << done.error().message << "\n" << log_;
  }
  /// Plugs an arm in and waits until it is open. The window decides when to use it.
  void plug(ArmScript& script) {
    socket_.plug(std::make_unique<ClockedArm>(host_->clock(), script));
    socket_.wait_until_opened();
  }
  void wait_until_in_use() {
    while (!state().stroke.has_device()) play("wait 0.02");
  }
  void plug_and_engage(ArmScript& script) {
    plug(script);
    wait_until_in_use();
    play("wait 3\nexpect force engaged\n");
  }
  [[nodiscard]] std::string banner() const {
    const auto& notice = studio_->state().ui.notices.shown();
    return notice ? notice->text : "";
  }

  std::deque<ArmScript> arms_;
  Socket socket_;
  std::string log_;
  std::unique_ptr<OffscreenHost> host_;
  std::unique_ptr<Studio> studio_;
  std::optional<ScriptRunner> runner_;
};

constexpr const char* kMousePresses =
    "key 1\npoint 65 18\npress left\nexpect throwing yes\npoint 56 18 over 0.4\nwait 0.2\n"
    "expect contact yes\n";

TEST_F(Arms, ConnectedArmReplacesTheMouse) {
  ArmScript& arm = arms_.emplace_back();
  play("expect device Mouse\nexpect throwing no\n");
  plug_and_engage(arm);
  play("expect device \"Clocked arm\"\nexpect throwing yes\nexpect contact no\n");
  EXPECT_NE(log_.find("device: Clocked arm"), std::string::npos);
  EXPECT_EQ(arm.max_force_n, 0.0) << "off the clay";
  arm.goal_mm = 52.0;
  play("wait 0.5\nexpect contact yes\nexpect force engaged\n");
  EXPECT_GT(arm.last_force_n, 0.1);
  play("key Ctrl+Z\nexpect strokes 1\n");
}

/// The servo's wheel made the pots; no stroke was applied twice.
TEST_F(Arms, RecordedPosesReplayToEveryPot) {
  play(std::string(kMousePresses) + "release left\nexpect strokes 1\n");
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  for (int press = 0; press < 2; ++press) {
    arm.goal_mm = 52.0 - press;
    play("wait 0.6\nexpect contact yes\n");
    arm.goal_mm = 80.0;
    play("wait 0.6\nexpect contact no\n");
  }
  state().stroke.release();
  history::Work again = history::Work::open(state().document.work().record()).value();
  ASSERT_GT(again.at(), 1u);
  EXPECT_EQ(write_pot(state().document.pot(), PotEncoding::cbor),
            write_pot(*again.pot().value(), PotEncoding::cbor));
  EXPECT_NE(*again.pot().value(), *again.pot(1).value());
  EXPECT_NE(*again.pot(1).value(), *again.pot(0).value());
}

/// The accepted stiffness depends on the arm; the stiffness of the work is the choice of the user.
TEST_F(Arms, TheWorkKeepsItsStiffness) {
  constexpr double kTooStiff = 5.0;  // N/mm^2
  apply(state(), SetStiffness{kTooStiff});
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  arm.goal_mm = 47.9;
  play("wait 0.6\nexpect contact yes\n");
  EXPECT_GT(arm.last_force_n, 0.0);
  state().stroke.release();
  const auto& record = state().document.work().record();
  ASSERT_EQ(record.nodes.size(), 2u);
  EXPECT_EQ(record.scenes.at(record.nodes[1].scene).force->stiffness_n_per_mm2, kTooStiff);
  EXPECT_EQ(state().document.stiffness(), kTooStiff);
  history::Work again = history::Work::open(record).value();
  EXPECT_EQ(write_pot(state().document.pot(), PotEncoding::cbor),
            write_pot(*again.pot().value(), PotEncoding::cbor));
}

TEST_F(Arms, MouseReplacesALostArmUntilItReturns) {
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  arm.goal_mm = 52.0;
  play("wait 0.5\nexpect contact yes\n");
  ASSERT_GT(arm.last_force_n, 0.1);
  arm.state = falcon::DeviceState::fault;
  play("wait 0.1\nexpect device Mouse\nexpect throwing no\nexpect strokes 1\nexpect force none\n");
  EXPECT_EQ(arm.last_force_n, 0.0);
  const std::string message = "nowhere: unplugged; plug it in again; the mouse is in use now";
  EXPECT_EQ(banner(), message);
  const std::uint64_t writes = arm.writes;
  play(std::string(kMousePresses) + "release left\nexpect strokes 2\n");
  EXPECT_EQ(arm.writes, writes);
  EXPECT_EQ(banner(), message) << "shown until an arm is found";
  ArmScript& another = arms_.emplace_back();
  plug_and_engage(another);
  EXPECT_EQ(banner().find("unplugged"), std::string::npos);
  play("expect device \"Clocked arm\"\n");
}

TEST_F(Arms, MouseKeepsTheClayUntilReleased) {
  ArmScript& arm = arms_.emplace_back();
  play(kMousePresses);
  plug(arm);
  play("wait 0.5\nexpect device Mouse\nexpect throwing yes\nrelease left\n");
  wait_until_in_use();
  play("expect device \"Clocked arm\"\nexpect strokes 1\n");
}

TEST_F(Arms, ReportsAnArmLostBeforeItsFirstStrokeAndSearchesAgain) {
  ArmScript& arm = arms_.emplace_back();
  arm.opens = false;
  play(kMousePresses);
  plug(arm);
  play("release left\n");
  while (banner().find("unplugged") == std::string::npos) play("wait 0.02");
  play("expect device Mouse\n");
  arm.opens = true;
  plug_and_engage(arm);
}

TEST_F(Arms, ForceReturnsFromSafeOnlyOnRequestAndOffTheClay) {
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  const Command& rearm = *find_command("wheel.rearm");
  EXPECT_FALSE(rearm.enabled(view_model(state())));
  arm.goal_mm = 52.0;
  play("wait 0.5\nexpect contact yes\n");
  ASSERT_GT(arm.last_force_n, 0.1);
  arm.position_valid = false;
  play("wait 0.1\nexpect force safe\n");
  EXPECT_EQ(arm.last_force_n, 0.0);
  arm.position_valid = true;
  arm.max_force_n = 0.0;
  arm.goal_mm = 40.0;  // deep enough for more than the small force of the guard
  play(
      "wait 2\nexpect force safe\n"
      "expect banner \"no force: invalid force (NaN); press Shift+R or the clutch to continue\"\n");
  // In the clay, a rearm is not enough.
  play("key Shift+R\nwait 0.5\nexpect force waiting\nexpect banner \"\"\n");
  EXPECT_EQ(arm.max_force_n, 0.0);
  EXPECT_FALSE(rearm.enabled(view_model(state())));
  arm.goal_mm = 80.0;
  play("wait 0.3\nexpect force ramping\nwait 2\nexpect force engaged\n");
  arm.goal_mm = 38.0;
  play("wait 0.5\nexpect contact yes\n");
  EXPECT_GT(arm.last_force_n, 0.1);
}

TEST_F(Arms, EscZeroesTheForceInAnyDialogAndNeverRestoresIt) {
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  arm.goal_mm = 52.0;
  play("wait 0.5\nexpect contact yes\n");
  ASSERT_GT(arm.last_force_n, 0.1);
  play("do help.keys\nexpect overlay shortcuts\n");
  ASSERT_GT(arm.last_force_n, 0.1);
  play("key Esc\nexpect overlay none\nexpect paused yes\n");
  EXPECT_EQ(arm.last_force_n, 0.0);
  arm.max_force_n = 0.0;
  play("key Esc\nwait 0.5\nkey Esc\nwait 0.5\nexpect paused yes\n");
  EXPECT_EQ(arm.max_force_n, 0.0);
  arm.goal_mm = 80.0;
  play("key Space\nexpect paused no\nwait 3\nexpect force engaged\n");
}

TEST_F(Arms, PauseContinuesAfterTheStroke) {
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  arm.goal_mm = 52.0;
  play("wait 0.5\nexpect contact yes\n");
  ASSERT_GT(arm.last_force_n, 0.1);
  play("key Space\nexpect paused yes\n");
  arm.max_force_n = 0.0;
  // After each of these a new stroke begins as the force requires: off the clay for a while, then
  // in the clay.
  for (const char* what : {"key ]", "key T", "key Ctrl+Z", "do file.new_vase\nkey Ctrl+D"}) {
    arm.goal_mm = 80.0;
    play(std::string(what) + "\nwait 3\n");
    arm.goal_mm = 40.0;
    play("wait 1\nexpect paused yes\nexpect throwing yes\nexpect contact no\n");
    EXPECT_EQ(arm.max_force_n, 0.0) << what;
  }
  play("expect strokes 0\n");
  arm.goal_mm = 80.0;
  play("wait 0.3\nkey Space\nwait 3\nexpect force engaged\n");
}

TEST_F(Arms, BannerExplainsHomingUntilItIsDone) {
  ArmScript& arm = arms_.emplace_back();
  arm.state = falcon::DeviceState::needs_homing;
  plug(arm);
  wait_until_in_use();
  play("wait 0.5\nexpect throwing yes\n");
  EXPECT_EQ(banner(), "home it: pull the grip all the way out, then push it all the way in");
  EXPECT_EQ(arm.max_force_n, 0.0);
  arm.state = falcon::DeviceState::ready;
  play("wait 0.1\nexpect banner \"\"\n");
}

/// The first contact compresses the same clay by the same way.
TEST_F(Arms, AChangedStiffnessIsFelt) {
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  const auto touch = [&] {
    arm.max_force_n = 0.0;
    arm.goal_mm = 57.0;
    play("wait 0.1\nexpect contact yes\n");
    arm.goal_mm = 80.0;
    play("wait 3\nexpect contact no\nexpect force engaged\n");
    return arm.max_force_n;
  };
  const double before_n = touch();
  ASSERT_GT(before_n, 0.05);
  apply(state(), SetStiffness{0.25 * state().document.stiffness()});
  play("key Ctrl+Z\nwait 3\nexpect force engaged\n");
  const double undone_n = touch();
  EXPECT_NEAR(undone_n, 0.25 * before_n, 0.05 * before_n) << "after undo";
  apply(state(), SetStiffness{4.0 * state().document.stiffness()});
  play("wait 3\nexpect force engaged\n");
  EXPECT_GT(touch(), 2.0 * undone_n) << "at once";
}

/// The arm throws all the time.
TEST_F(Arms, TheTimelineShowsThePotAfterEveryStroke) {
  const test::ScratchFolder folder;
  for (int press = 0; press < 2; ++press) play(std::string(kMousePresses) + "release left\n");
  plug_and_engage(arms_.emplace_back());
  const std::string file = folder.file("two.work");
  play("save \"" + file + "\"\nopen \"" + file + "\"\nwait 0.5\nexpect throwing yes\n");
  for (const history::NodeId node : {0u, 1u, 2u}) {
    ASSERT_TRUE(state().ui.thumbs.contains(node)) << node;
    EXPECT_FALSE(state().ui.thumbs.at(node).rows.empty()) << node;
  }
}

constexpr std::size_t kLearned = 3;  // the cylinder

/// A stroke of an arm does not end by itself: in a lesson it ends when the tool leaves the clay.
TEST_F(Arms, LeadsThroughALesson) {
  ArmScript& arm = arms_.emplace_back();
  plug_and_engage(arm);
  state().settings.tool.mode = ToolMode::wire;
  apply(state(), BeginLesson{kLearned, false});
  play("wait 3\nexpect throwing yes\nexpect force engaged\nexpect step Open\n");
  ASSERT_NE(state().guide.plan(), nullptr);
  EXPECT_EQ(state().document.scene().tool.mode, ToolMode::press) << "the tool of the step";
  const std::size_t plans = state().guide.plan_number();
  arm.goal_mm = 38.0;
  play("wait 1\nexpect contact yes\nexpect strokes 0\n");
  arm.goal_mm = 80.0;
  play("wait 1\nexpect contact no\nexpect strokes 1\nexpect throwing yes\n");
  EXPECT_GT(state().guide.plan_number(), plans) << "for the new pot";
  play("key N\nwait 3\nexpect force engaged\n");
  EXPECT_EQ(state().guide.step(), 1u);
  EXPECT_NE(state().guide.plan(), nullptr);
}

TEST_F(Arms, TakesTheToolFromADemonstration) {
  state().scene.place({{0.0f, 0.0f}, {1000.0f, 700.0f}});
  apply(state(), BeginLesson{kLearned, true});
  play("wait 3\nexpect throwing yes\n");
  plug(arms_.emplace_back());
  wait_until_in_use();
  play("wait 0.1\n");
  EXPECT_EQ(state().guide.demonstration(), Demonstration::none);
  EXPECT_NE(banner().find("holds the tool"), std::string::npos) << banner();
  EXPECT_FALSE(find_command("help.show_step")->enabled(view_model(state())));
  apply(state(), BeginLesson{kLearned, true});
  play("key Ctrl+D\nwait 0.2\nexpect overlay none\n");
  EXPECT_TRUE(state().guide.active());
  EXPECT_EQ(state().guide.demonstration(), Demonstration::none);
  EXPECT_FALSE(state().guide.shown()) << "nothing was shown";
}

}  // namespace
}  // namespace clay::studio
