// Devices that appear and disappear, with the threads of a window on screen.

#include "app/studio/stroke_controller.hpp"
#include "tests/app/servo/live_bench.hpp"
#include "tests/app/servo/scripted_device.hpp"
#include "tests/app/studio/socket.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace clay::studio {
namespace {

using namespace std::chrono_literals;

DevicePointer wait_for_device(DeviceWatch& watch) {
  DevicePointer device;
  const auto taken = [&] {
    device = watch.take();
    return device != nullptr;
  };
  test::wait_until(taken, test::kDeadline, "an open device");
  return device;
}

TEST(DeviceWatch, OpensADeviceConnectedLaterAndStopsSearching) {
  Socket socket;
  servo::WireLog wire;
  DeviceWatch watch(socket.look(), 1ms);
  socket.wait_for_searches(3);
  EXPECT_FALSE(watch.take());
  socket.plug(std::make_unique<servo::ScriptedDevice>(wire));
  EXPECT_EQ(wait_for_device(watch)->info().name, "scripted");
  const int searches = socket.searches;
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(socket.searches, searches);
  socket.plug(std::make_unique<servo::ScriptedDevice>(wire));
  watch.look_again();
  EXPECT_TRUE(wait_for_device(watch));
}

TEST(DeviceWatch, ReportsEachProblemOncePerDevice) {
  Socket socket;
  socket.report("no power");
  DeviceWatch watch(socket.look(), 1ms);
  const auto next_problem = [&] {
    socket.wait_for_searches(2);
    return watch.take_problem();
  };
  EXPECT_EQ(next_problem(), "no power");
  EXPECT_EQ(next_problem(), "");
  socket.report("no firmware");
  EXPECT_EQ(next_problem(), "no firmware");
  EXPECT_EQ(next_problem(), "");
  socket.report("");  // unplugged
  EXPECT_EQ(next_problem(), "");
  socket.report("no firmware");
  EXPECT_EQ(next_problem(), "no firmware");
}

TEST(StrokeController, LosingTheArmEndsTheStrokeAndTheForce) {
  servo::WireLog wire;
  servo::MonotonicClock clock;
  Document document;
  StrokeController stroke(document, clock, true);
  ASSERT_TRUE(document.begin(servo::rib_scene()));
  servo::LiveSettings settings = servo::one_to_one();
  settings.guard.ramp_s = 0.1;
  settings.guard.safe_rest_s = 0.01;  // late ticks of a busy machine should not matter here
  stroke.take(std::make_unique<servo::ScriptedDevice>(wire), settings);
  const auto frames_until = [&](auto condition, const std::string& what) {
    const auto frame = [&] {
      stroke.advance(clock.now_ns());
      return condition();
    };
    test::wait_until(frame, test::kDeadline, what);
  };
  frames_until([&] { return wire.last_force_n > 0.0 && stroke.status().contact; }, "a force");
  wire.gone = true;
  frames_until([&] { return !stroke.has_device(); }, "the loss of the device");
  const StrokeNews news = stroke.take_news();
  EXPECT_TRUE(news.device_lost && news.stroke_ended);
  EXPECT_EQ(news.ending, servo::Ending::device_lost);
  ASSERT_TRUE(news.error);
  EXPECT_EQ(news.error->message, "nowhere: unplugged; plug it in again");
  EXPECT_GT(news.poses, 0u);
  EXPECT_EQ(wire.last_force_n, 0.0);
  EXPECT_EQ(stroke.servo().timing.ticks, news.ticks);

  const std::uint64_t writes = wire.writes;
  const std::size_t strokes = document.work().size();
  ASSERT_TRUE(stroke.press({document.scene().tool, 20.0, {60.0, 30.0, 0.0}}));
  stroke.aim({{40.0, 30.0, 0.0}, kPressingMmPerS, 8.0});
  frames_until([&] { return stroke.status().contact; }, "the mouse to touch the clay");
  stroke.release();
  EXPECT_GT(document.work().size(), strokes);
  EXPECT_EQ(wire.writes, writes);
}

}  // namespace
}  // namespace clay::studio
