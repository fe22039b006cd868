#include "falcon/device/frame.hpp"

#include "claystack/falcon/falcon_device.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace clay::falcon {
namespace {

using Bytes = std::vector<std::uint8_t>;

static_assert(std::is_trivially_copyable_v<FrameReader>, "it owns no memory");
static_assert(noexcept(encode({})));

/// A frame as the format describes it: 'A' + 3 stands for 3.
std::string frame_text(const LegCounts& counts, int status = 0) {
  std::string text = "<";
  for (const std::int16_t count : counts) {
    unsigned rest = static_cast<std::uint16_t>(count);
    for (int digit = 0; digit < 4; ++digit, rest /= 16) text += static_cast<char>('A' + rest % 16);
  }
  text += static_cast<char>('A' + status);
  return text + "A>";
}

/// The bytes that the device would send.
Bytes bytes_of(const StateFrame& frame) {
  const auto& [top, right, left] = frame.homed;
  const std::string text = frame_text(
      frame.encoders, frame.buttons + (top ? 16 : 0) + (right ? 32 : 0) + (left ? 64 : 0));
  return {text.begin(), text.end()};
}

std::string text_of(const FrameBytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::vector<StateFrame> read_all(FrameReader& reader, std::span<const std::uint8_t> bytes) {
  std::vector<StateFrame> frames;
  while (const auto frame = reader.next(bytes)) frames.push_back(*frame);
  EXPECT_TRUE(bytes.empty());
  return frames;
}

std::vector<StateFrame> read_text(std::string_view text) {
  FrameReader reader;
  const Bytes bytes(text.begin(), text.end());
  return read_all(reader, bytes);
}

TEST(Encode, WritesTheLowestNibbleFirst) {
  EXPECT_EQ(text_of(encode({.motors = {-1447, 0, 1}})), "<JFKPAAAABAAAAA>");
}

TEST(Encode, StoresHomingAndLightsInTheStatusByte) {
  EXPECT_EQ(encode({.homing = true})[13], 'A' + 1);
  EXPECT_EQ(encode({.green = true})[13], 'A' + 2);
  EXPECT_EQ(encode({.red = true})[13], 'A' + 8);
  EXPECT_EQ(encode({.homing = true, .green = true, .red = true})[13], 'A' + 11);
}

TEST(Encode, SaturatesMotors) {
  for (const LegCounts& motors : {LegCounts{4095, -4095, 4095}, LegCounts{4096, -4095, 4095},
                                  LegCounts{4095, -4096, 4095}, LegCounts{4095, -32768, 32767}})
    EXPECT_EQ(text_of(encode({.motors = motors})), frame_text({4095, -4095, 4095}));
}

RC_GTEST_PROP(Encode, WritesEveryMotorAsHexadecimalDigits, ()) {
  const auto motor = [] { return *rc::gen::inRange<std::int16_t>(-4095, 4096); };
  const LegCounts motors = {motor(), motor(), motor()};
  RC_ASSERT(text_of(encode({.motors = motors})) == frame_text(motors));
}

TEST(FrameReader, ReadsAFrame) {
  const auto frames = read_text(
      "<JFKPAAAABAAA\xB1"
      "A>");
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].encoders, (LegCounts{-1447, 0, 1}));
  EXPECT_EQ(frames[0].buttons, 0);
  EXPECT_TRUE(frames[0].all_homed());
}

TEST(FrameReader, DecodesButtonsAndLegsSeparately) {
  for (const std::uint8_t button : {kButtonPlus, kButtonForward, kButtonCentre, kButtonMinus})
    for (std::size_t leg = 0; leg < 3; ++leg) {
      StateFrame sent{.buttons = button};
      sent.homed[leg] = true;
      FrameReader reader;
      EXPECT_EQ(read_all(reader, bytes_of(sent)), std::vector{sent});
      EXPECT_FALSE(sent.all_homed());
    }
}

TEST(FrameReader, RefusesInvalidFrames) {
  const std::string good = "<JFKPAAAABAAAAA>";
  ASSERT_EQ(read_text(good).size(), 1u);
  for (std::size_t at = 0; at < kFrameBytes; ++at) {
    for (int value = 0; value < 256; ++value) {
      const bool letter = value >= 'A' && value <= 'P', mark = value == '<' || value == '>';
      const bool status = value >= 'A' && value <= 'A' + 127;
      const bool fits = at == 0    ? value == '<'
                        : at == 13 ? status
                        : at == 14 ? !mark
                        : at == 15 ? value == '>'
                                   : letter;
      std::string text = good;
      text[at] = static_cast<char>(value);
      ASSERT_EQ(read_text(text).size(), fits ? 1u : 0u) << "byte " << at << " = " << value;
    }
  }
}

TEST(FrameReader, DoesNotReadTheEndOfAShortFrameAsStatus) {
  EXPECT_TRUE(read_text("<JFKPAAAABAAA><JFKPAAAABAAA>").empty());
  EXPECT_EQ(read_text("<JFKPAAAABAAA><JFKPAAAABAAAAA>").size(), 1u);
}

rc::Gen<StateFrame> any_frame() {
  const auto count = rc::gen::arbitrary<std::int16_t>();
  return rc::gen::build<StateFrame>(
      rc::gen::set(&StateFrame::encoders, rc::gen::container<LegCounts>(count)),
      rc::gen::set(&StateFrame::buttons, rc::gen::inRange<std::uint8_t>(0, 16)),
      rc::gen::set(&StateFrame::homed, rc::gen::arbitrary<std::array<bool, 3>>()));
}

RC_GTEST_PROP(FrameReader, ReadsFramesInChunksOfAnySize, ()) {
  const auto sent = *rc::gen::container<std::vector<StateFrame>>(any_frame());
  Bytes stream;
  for (const StateFrame& frame : sent) {
    const Bytes bytes = bytes_of(frame);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  FrameReader reader;
  std::vector<StateFrame> read;
  for (std::span<const std::uint8_t> rest = stream; !rest.empty();) {
    const auto size = std::min(*rc::gen::inRange<std::size_t>(1, 70), rest.size());
    std::ranges::copy(read_all(reader, rest.first(size)), std::back_inserter(read));
    rest = rest.subspan(size);
  }
  RC_ASSERT(read == sent);
  read_all(reader, Bytes{'<'});  // it would discard an incomplete frame
  RC_ASSERT(reader.discarded() == 0u);
}

RC_GTEST_PROP(FrameReader, CountsEveryByteOfNoise, ()) {
  // Mostly valid frame bytes, because otherwise no frame would ever be found.
  const auto byte =
      rc::gen::weightedOneOf<std::uint8_t>({{12, rc::gen::inRange<std::uint8_t>('A', 'P' + 1)},
                                            {2, rc::gen::element<std::uint8_t>('<', '>')},
                                            {1, rc::gen::arbitrary<std::uint8_t>()}});
  const auto noise = *rc::gen::container<Bytes>(byte);
  FrameReader reader;
  const std::size_t frames = read_all(reader, noise).size();
  RC_ASSERT(frames * kFrameBytes + reader.discarded() + kFrameBytes > noise.size());
  read_all(reader, Bytes{'<'});  // it discards an incomplete frame
  RC_ASSERT(frames * kFrameBytes + reader.discarded() == noise.size());
}

/// A fault in a sequence of four frames, and the frames that stay whole.
struct FaultySequence {
  Bytes bytes;
  std::array<bool, 4> whole = {true, true, true, true};
};

void lose(FaultySequence& sequence, std::size_t at, std::size_t count) {
  for (std::size_t lost = at; lost < at + count; ++lost) sequence.whole[lost / kFrameBytes] = false;
  const auto from = sequence.bytes.begin() + static_cast<std::ptrdiff_t>(at);
  sequence.bytes.erase(from, from + static_cast<std::ptrdiff_t>(count));
}

void insert(FaultySequence& sequence, std::size_t at, const Bytes& extra) {
  if (at % kFrameBytes != 0) sequence.whole[at / kFrameBytes] = false;
  sequence.bytes.insert(sequence.bytes.begin() + static_cast<std::ptrdiff_t>(at), extra.begin(),
                        extra.end());
}

void damage(FaultySequence& sequence, std::size_t at, std::uint8_t byte) {
  if (sequence.bytes[at] == byte) return;
  sequence.whole[at / kFrameBytes] = false;
  sequence.bytes[at] = byte;
}

void plant_fault(FaultySequence& sequence) {
  const auto size = sequence.bytes.size();
  const auto at = *rc::gen::inRange<std::size_t>(0, size);
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return lose(sequence, at, 1);
    case 1: {
      // Losing a multiple of 16 bytes within a frame joins two halves, which cannot be detected.
      auto count = *rc::gen::inRange<std::size_t>(1, 18);
      count = std::min(count, size - at);
      return lose(sequence, at, count % kFrameBytes == 0 ? count - 1 : count);
    }
    case 2:
      return insert(sequence, at, {*rc::gen::arbitrary<std::uint8_t>()});
    case 3: {
      const auto nibbles = rc::gen::inRange<std::uint8_t>('A', 'P' + 1);
      return insert(sequence, at, *rc::gen::container<Bytes>(nibbles));
    }
    default:
      return damage(sequence, at, *rc::gen::element<std::uint8_t>('<', '>', 0x00, 0xFF));
  }
}

// One fault in every four frames. A damaged frame may be accepted if its contents are intact. Every
// other frame must be accepted, and no frame that was never sent.
RC_GTEST_PROP(FrameReader, LosesOnlyDamagedFrames, ()) {
  FrameReader reader;
  std::int16_t number = 0;
  std::size_t lost = 0, faults = 0;
  std::vector<StateFrame> sent, read;
  std::vector<bool> whole;
  for (; faults < 25; ++faults) {
    FaultySequence sequence;
    for (std::size_t i = 0; i < sequence.whole.size(); ++i) {
      sent.push_back({.encoders = {number++, -1447, 4095}});
      const Bytes bytes = bytes_of(sent.back());
      sequence.bytes.insert(sequence.bytes.end(), bytes.begin(), bytes.end());
    }
    plant_fault(sequence);
    whole.insert(whole.end(), sequence.whole.begin(), sequence.whole.end());
    std::ranges::copy(read_all(reader, sequence.bytes), std::back_inserter(read));
  }
  auto next = read.begin();
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const bool found = next != read.end() && *next == sent[i];
    RC_ASSERT(found || !whole[i]);
    found ? void(++next) : void(++lost);
  }
  RC_ASSERT(next == read.end());
  RC_ASSERT(lost <= 2 * faults);
}

TEST(FrameReader, LosesOneFrameForALostOrDamagedByte) {
  std::string good;
  for (int i = 0; i < 4; ++i) good += "<JFKPAAAABAAAAA>";
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string shorter = good, damaged = good, longer = good;
    shorter.erase(at, 1);
    damaged[at] = '\0';
    longer.insert(at, 1, 'A');
    EXPECT_EQ(read_text(shorter).size(), 3u) << at;
    EXPECT_GE(read_text(damaged).size(), 3u) << at;
    EXPECT_GE(read_text(longer).size(), 3u) << at;
  }
}

}  // namespace
}  // namespace clay::falcon
