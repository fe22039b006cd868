#include "falcon/device/firmware.hpp"

#include "claystack/core/atomic_file.hpp"

#include <cstdio>
#include <iterator>
#include <map>
#include <optional>

namespace clay::falcon::inline device {
namespace {

constexpr std::uint32_t kKeyOfBytes = 0x08AA;
constexpr int kReservedWords = 8;
// The C28x has 22 address lines.
constexpr std::uint32_t kAddresses = 1u << 22;
constexpr std::size_t kMostBytes = std::size_t{128} * 1024;

class WordReader {
 public:
  explicit WordReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  std::optional<std::uint32_t> word() {
    if (bytes_.size() - at_ < 2) return std::nullopt;
    const std::uint32_t value = bytes_[at_] | std::uint32_t{bytes_[at_ + 1]} << 8;
    at_ += 2;
    return value;
  }

  /// High word first.
  std::optional<std::uint32_t> address() {
    const auto high = word(), low = word();
    if (!high || !low) return std::nullopt;
    return *high << 16 | *low;
  }

  bool skip_words(std::size_t count) {
    if (bytes_.size() - at_ < 2 * count) return false;
    at_ += 2 * count;
    return true;
  }

  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

/// The addresses already used by blocks.
class Filled {
 public:
  /// The start of a block that overlaps the `size` words from `start`, if any.
  std::optional<std::uint32_t> add(std::uint32_t start, std::uint32_t size) {
    const auto after = starts_.upper_bound(start);
    if (after != starts_.end() && after->first - start < size) return after->first;
    if (after != starts_.begin()) {
      const auto& [before, words] = *std::prev(after);
      if (start - before < words) return before;
    }
    starts_.emplace(start, size);
    return std::nullopt;
  }

 private:
  std::map<std::uint32_t, std::uint32_t> starts_;  ///< start and size; no two overlap
};

std::string hex(std::uint32_t address) {
  char text[16];
  return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%06X", address))};
}

/// Reads one block of `size` words; empty, or "expected ..., found ...".
std::string parse_block(WordReader& words, std::uint32_t size, Filled& filled, bool& holds,
                        std::uint32_t address) {
  const auto start = words.address();
  if (!start) return "expected a block's address";
  const std::string found = std::to_string(size) + " words from " + hex(*start);
  if (*start >= kAddresses || size > kAddresses - *start)
    return "expected a block within the addresses 000000 to 3FFFFF, found " + found;
  if (const auto other = filled.add(*start, size))
    return "expected blocks that do not overlap, found " + found + " over the block at " +
           hex(*other);
  if (!words.skip_words(size)) return "expected " + found + ", found the end of the file";
  holds |= address >= *start && address - *start < size;
  return {};
}

/// Empty if the stream is complete, otherwise "expected ...".
std::string parse(WordReader& words, std::size_t size_of_file) {
  if (words.word() != kKeyOfBytes) return "expected the key AA 08";
  for (int i = 0; i < kReservedWords; ++i)
    if (words.word() != 0u) return "expected eight reserved words of 0";
  const auto entry = words.address();
  if (!entry || *entry >= kAddresses) return "expected an entry point below 400000";
  bool holds_entry = false;
  Filled filled;
  while (true) {
    const auto size = words.word();
    if (!size) return "expected a block's size, or 0 for the end";
    if (*size == 0) break;
    if (auto problem = parse_block(words, *size, filled, holds_entry, *entry); !problem.empty())
      return problem;
  }
  if (!holds_entry) return "expected a block that holds the entry point " + hex(*entry);
  if (words.at() != size_of_file) return "expected the end of the file";
  return {};
}

}  // namespace

DeviceResult<Firmware> parse_firmware(std::vector<std::uint8_t> bytes, const std::string& name) {
  Firmware firmware;
  firmware.bytes = std::move(bytes);
  WordReader words(firmware.bytes);
  const std::string problem = parse(words, firmware.bytes.size());
  if (problem.empty()) return firmware;
  return device_failure(DeviceFault::bad_firmware,
                        name + ": expected a TI C28x boot stream; at byte " +
                            std::to_string(words.at()) + " of " +
                            std::to_string(firmware.bytes.size()) + ": " + problem,
                        "name the firmware file that came with the Falcon's driver");
}

DeviceResult<Firmware> read_firmware(const std::string& path) {
  const auto bytes = read_file(path, kMostBytes);
  if (!bytes) return device_failure(DeviceFault::unreadable_firmware, bytes.error().message);
  return parse_firmware({bytes->begin(), bytes->end()}, path);
}

}  // namespace clay::falcon::inline device
