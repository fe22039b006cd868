#include "falcon/device/firmware.hpp"

#include "falcon/sim/falcon_model.hpp"
#include "falcon/sim/loopback_transport.hpp"
#include "tests/falcon/device/dummy_firmware.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <utility>

namespace clay::falcon {
namespace {

Grip still() {
  return [](const glm::dvec3&, double) { return kFalconCentreMm; };
}

DeviceFault fault_of(const std::vector<std::uint8_t>& bytes) {
  const auto parsed = parse_firmware(bytes, "f");
  return parsed ? DeviceFault::not_found : parsed.error().fault;
}

TEST(Firmware, ReadsTheWholeFile) {
  const auto parsed = parse_firmware(dummy_firmware(300, 3), "f");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->bytes.size(), 2u * (1 + 8 + 2 + 3 * (3 + 300) + 1));
}

TEST(Firmware, RefusesEveryTruncation) {
  const auto whole = dummy_firmware(20, 2);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(fault_of({whole.begin(), whole.begin() + static_cast<long>(size)}),
              DeviceFault::bad_firmware)
        << size;
  auto longer = whole;
  longer.push_back(0);
  EXPECT_EQ(fault_of(longer), DeviceFault::bad_firmware);
}

TEST(Firmware, RefusesAWrongHeader) {
  for (std::size_t at = 0; at < 2 * (1 + 8); ++at) {
    auto bytes = dummy_firmware();
    bytes[at] ^= 1;
    EXPECT_EQ(fault_of(bytes), DeviceFault::bad_firmware) << at;
  }
  for (const std::size_t at : {18u, 24u}) {  // high words of the entry point and of the first block
    auto bytes = dummy_firmware();
    bytes[at] = 0x40;
    EXPECT_EQ(fault_of(bytes), DeviceFault::bad_firmware) << at;
  }
  auto outside = dummy_firmware(10, 1);
  outside[20] = 0x0A;  // entry point 003F:800A, one word past the block
  EXPECT_EQ(fault_of(outside), DeviceFault::bad_firmware);
  outside[20] = 0x09;
  EXPECT_TRUE(parse_firmware(outside, "f"));
}

TEST(Firmware, ErrorsNameTheByteAndWhatIsThere) {
  const auto refusal = [](const std::vector<std::uint8_t>& bytes) {
    const std::string expected = "f: expected a TI C28x boot stream; ";
    const std::string what = parse_firmware(bytes, "f").error().what;
    return what.starts_with(expected) ? what.substr(expected.size()) : what;
  };
  const auto with = [](std::size_t at, std::uint8_t byte) {
    auto bytes = dummy_firmware(10, 1);
    bytes[at] = byte;
    return bytes;
  };
  const auto first = [whole = dummy_firmware(10, 1)](std::size_t size) {
    return std::vector(whole.begin(), whole.begin() + static_cast<long>(size));
  };
  auto longer = first(50);
  longer.push_back(0x4D);
  for (const auto& [bytes, text] : {
           std::pair{std::vector<std::uint8_t>(64, 0x4D),
                     "at byte 0 of 64: expected the key AA 08, found 4D 4D"},
           {with(4, 0x07), "at byte 4 of 50: expected eight reserved words of 0, found 07 00"},
           {with(18, 0x40),
            "at byte 18 of 50: expected an entry point below 400000, found 40 00 02 80"},
           {with(20, 0x0A),
            "at byte 48 of 50: expected a block that holds the entry point 3F800A, found none"},
           {{}, "at byte 0 of 0: expected the key AA 08, found the end of the file"},
           {first(27),
            "at byte 24 of 27: expected a block's address, found 3F 00 00 and the end of "
            "the file"},
           {first(47),
            "at byte 28 of 47: expected 10 words from 3F8000, found the end of the file"},
           {first(48),
            "at byte 48 of 48: expected a block's size, or 0 for the end, found the end "
            "of the file"},
           {longer, "at byte 50 of 51: expected the end of the file, found 4D"},
       })
    EXPECT_EQ(refusal(bytes), text);
}

/// The error for the dummy with `address` in block `block`, of 20 words; empty if it is accepted.
std::string refusal_at(std::size_t block, std::uint32_t address) {
  auto bytes = dummy_firmware(20, 3);
  const std::size_t at = 2 * (1 + 8 + 2) + block * 2 * (3 + 20) + 2;
  for (const std::size_t byte : {0u, 1u, 2u, 3u})  // high word first, low bytes first
    bytes[at + byte] =
        static_cast<std::uint8_t>(address >> (byte < 2 ? 16 + 8 * byte : 8 * byte - 16));
  const auto parsed = parse_firmware(bytes, "f");
  return parsed ? "" : parsed.error().what;
}

TEST(Firmware, RefusesBlocksOutsideTheMemory) {
  EXPECT_EQ(refusal_at(2, 0x3FFFECu), "");  // its last word has the highest address
  const std::string place = "f: expected a TI C28x boot stream; at byte 116 of 162: ";
  for (const auto& [address, text] :
       {std::pair{0x3FFFEDu, "3FFFED"}, {0x400000u, "400000"}, {0xFFFFFFF0u, "FFFFFFF0"}})
    EXPECT_EQ(refusal_at(2, address),
              place +
                  "expected a block within the addresses 000000 to 3FFFFF, found 20 words from " +
                  text);
}

TEST(Firmware, RefusesOverlappingBlocks) {
  // The first block fills 3F8000 to 3F8013, the second 3F8014 to 3F8027.
  for (const auto& [address, other] : {std::pair{0x3F8014u, "3F8014"},
                                       {0x3F8027u, "3F8014"},
                                       {0x3F7FEDu, "3F8000"},
                                       {0x3F8013u, "3F8014"}})
    EXPECT_TRUE(refusal_at(2, address).ends_with(std::string("over the block at ") + other))
        << refusal_at(2, address);
  EXPECT_EQ(refusal_at(2, 0x3F8028u), "");
  EXPECT_EQ(refusal_at(2, 0x3F7FECu), "");
}

RC_GTEST_PROP(Firmware, ReadsOrRefusesAnyBytes, (std::vector<std::uint8_t> bytes)) {
  auto damaged = dummy_firmware(4, 2);
  const auto at = *rc::gen::inRange<std::size_t>(0, damaged.size());
  damaged.insert(damaged.begin() + static_cast<long>(at), bytes.begin(), bytes.end());
  const auto parsed = parse_firmware(damaged, "name of the file");
  if (!parsed) RC_ASSERT(parsed.error().what.starts_with("name of the file: expected"));
}

TEST(Firmware, ErrorsNameTheFile) {
  for (const char* path : {"/nonexistent/firmware.bin", "/"}) {
    const auto read = read_firmware(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().fault, DeviceFault::unreadable_firmware);
    EXPECT_EQ(read.error().kind, ErrorKind::io);
    EXPECT_TRUE(read.error().what.starts_with(path));
  }
  EXPECT_FALSE(read_firmware("/dev/zero"));  // endless
  EXPECT_FALSE(read_firmware("/dev/null"));
}

TEST(LoadFirmware, SendsTheFileUnchanged) {
  const auto model = std::make_shared<FalconModel>(FalconModelSettings{}, still());
  LoopbackTransport line(model, SimClock::stepped);
  ASSERT_TRUE(line.open());
  const Firmware firmware = parse_firmware(dummy_firmware(), "f").value();
  ASSERT_TRUE(load_firmware(line, firmware, 1));
  EXPECT_TRUE(model->runs());
  EXPECT_EQ(model->firmware(), firmware.bytes);
}

TEST(LoadFirmware, RestartsOnAWrongEchoThenReportsIt) {
  const Firmware firmware = parse_firmware(dummy_firmware(), "f").value();
  for (const int attempts : {2, 3}) {
    FalconModelSettings settings;
    // Each piece of 62 bytes is compared: one fault in the first, one in the last.
    settings.faults = {{WireFault::echo_error, 3},
                       {WireFault::echo_error, firmware.bytes.size() - 2}};
    const auto model = std::make_shared<FalconModel>(settings, still());
    LoopbackTransport line(model, SimClock::stepped);
    ASSERT_TRUE(line.open());
    const auto loaded = load_firmware(line, firmware, attempts);
    EXPECT_EQ(loaded.has_value(), attempts == 3);
    if (loaded) continue;
    EXPECT_EQ(loaded.error().fault, DeviceFault::echo_error);
    EXPECT_NE(loaded.error().message.find("(tried 2 times); plug"), std::string::npos)
        << loaded.error().message;
  }
}

TEST(LoadFirmware, NamesThePowerSupplyWithoutAnAnswer) {
  FalconModelSettings settings;
  settings.power = false;
  LoopbackTransport line(std::make_shared<FalconModel>(settings, still()), SimClock::stepped);
  ASSERT_TRUE(line.open());
  const auto loaded = load_firmware(line, parse_firmware(dummy_firmware(), "f").value(), 2);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().fault, DeviceFault::no_answer);
  EXPECT_NE(loaded.error().remedy.find("power supply"), std::string::npos);
}

/// A line that sends a zero byte before the answer to the greeting, as some devices do.
class ZeroFirst final : public Transport {
 public:
  explicit ZeroFirst(std::shared_ptr<FalconModel> model)
      : line_(std::move(model), SimClock::stepped) {}
  [[nodiscard]] std::string describe() const override { return "zero first"; }
  [[nodiscard]] bool loads_firmware() const noexcept override { return true; }
  DeviceResult<void> open() override { return line_.open(); }
  void close() noexcept override { line_.close(); }
  DeviceResult<void> set_mode(LineMode mode) override {
    zero_ = mode == LineMode::greeting;
    return line_.set_mode(mode);
  }
  WireStatus write(std::span<const std::uint8_t> bytes) noexcept override {
    return line_.write(bytes);
  }
  Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept override {
    if (!zero_) return line_.read(bytes, wait_us);
    zero_ = false;
    bytes[0] = 0;
    return {1, line_.now_us(), WireStatus::ok};
  }
  void write_last(std::span<const std::uint8_t> bytes) noexcept override {
    line_.write_last(bytes);
  }
  [[nodiscard]] std::int64_t now_us() const noexcept override { return line_.now_us(); }

 private:
  LoopbackTransport line_;
  bool zero_ = false;
};

TEST(LoadFirmware, SkipsAZeroBeforeTheGreeting) {
  ZeroFirst line(std::make_shared<FalconModel>(FalconModelSettings{}, still()));
  ASSERT_TRUE(line.open());
  EXPECT_TRUE(load_firmware(line, parse_firmware(dummy_firmware(), "f").value(), 1));
}

}  // namespace
}  // namespace clay::falcon
