#include "falcon/device/firmware.hpp"

#include "claystack/core/atomic_file.hpp"

#include <algorithm>
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

std::string hex(std::uint32_t value, int digits = 6) {
  char text[16];
  return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%0*X", digits, value))};
}

class WordReader {
 public:
  explicit WordReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  std::optional<std::uint32_t> word() {
    if (!skip_words(1)) return std::nullopt;
    return word_at(begun_);
  }

  /// High word first.
  std::optional<std::uint32_t> address() {
    if (!skip_words(2)) return std::nullopt;
    return word_at(begun_) << 16 | word_at(begun_ + 2);
  }

  bool skip_words(std::size_t count) {
    begun_ = at_;
    if (bytes_.size() - at_ < 2 * count) return false;
    at_ += 2 * count;
    return true;
  }

  /// True if all bytes were read; otherwise the next two are the last item.
  bool ended() {
    begun_ = at_;
    at_ = std::min(at_ + 2, bytes_.size());
    return begun_ == bytes_.size();
  }

  /// Offset of the last item [bytes], whether or not it was read.
  [[nodiscard]] std::size_t begun() const { return begun_; }

  /// ", found ...": the bytes of the last item, which is a word or an address.
  [[nodiscard]] std::string found() const {
    if (begun_ == bytes_.size()) return ", found the end of the file";
    const bool whole = at_ > begun_;
    std::string text = ", found";
    for (std::size_t at = begun_; at < (whole ? at_ : bytes_.size()); ++at)
      text.append(" ").append(hex(bytes_[at], 2));
    return whole ? text : text + " and the end of the file";
  }

 private:
  [[nodiscard]] std::uint32_t word_at(std::size_t at) const {
    return bytes_[at] | std::uint32_t{bytes_[at + 1]} << 8;
  }

  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0, begun_ = 0;
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

/// Reads one block of `size` words; empty, or "expected ..., found ...".
std::string parse_block(WordReader& words, std::uint32_t size, Filled& filled, bool& holds,
                        std::uint32_t address) {
  const auto start = words.address();
  if (!start) return "expected a block's address" + words.found();
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
std::string parse(WordReader& words) {
  if (words.word() != kKeyOfBytes) return "expected the key AA 08" + words.found();
  for (int i = 0; i < kReservedWords; ++i)
    if (words.word() != 0u) return "expected eight reserved words of 0" + words.found();
  const auto entry = words.address();
  if (!entry || *entry >= kAddresses) return "expected an entry point below 400000" + words.found();
  bool holds_entry = false;
  Filled filled;
  while (true) {
    const auto size = words.word();
    if (!size) return "expected a block's size, or 0 for the end" + words.found();
    if (*size == 0) break;
    if (auto problem = parse_block(words, *size, filled, holds_entry, *entry); !problem.empty())
      return problem;
  }
  if (!holds_entry)
    return "expected a block that holds the entry point " + hex(*entry) + ", found none";
  if (!words.ended()) return "expected the end of the file" + words.found();
  return {};
}

}  // namespace

DeviceResult<Firmware> parse_firmware(std::vector<std::uint8_t> bytes, const std::string& name) {
  Firmware firmware;
  firmware.bytes = std::move(bytes);
  WordReader words(firmware.bytes);
  const std::string problem = parse(words);
  if (problem.empty()) return firmware;
  return device_failure(DeviceFault::bad_firmware,
                        name + ": expected a TI C28x boot stream; at byte " +
                            std::to_string(words.begun()) + " of " +
                            std::to_string(firmware.bytes.size()) + ": " + problem,
                        "name the firmware file that came with the Falcon's driver");
}

DeviceResult<Firmware> read_firmware(const std::string& path) {
  const auto bytes = read_file(path, kMostBytes);
  if (!bytes) return device_failure(DeviceFault::unreadable_firmware, bytes.error().message);
  return parse_firmware({bytes->begin(), bytes->end()}, path);
}

}  // namespace clay::falcon::inline device
