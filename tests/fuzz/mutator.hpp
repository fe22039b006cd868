#pragma once
// Damaged files for tests of readers.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::test {

/// Damages a file like disks, editors and attackers. The standard's distributions differ between
/// libraries, so numbers are drawn by remainder.
class Mutator {
 public:
  /// `words`: of the format, or hostile to it; they replace the text between two `delimiters`.
  Mutator(unsigned seed, std::span<const std::string_view> words,
          std::string_view delimiters = " \n")
      : words_(words.begin(), words.end()), delimiters_(delimiters), random_(seed) {}

  std::string mutate(std::string bytes) {
    for (std::size_t left = 1 + below(3); left > 0; --left) mutate_once(bytes);
    return bytes;
  }

  std::size_t below(std::size_t bound) { return random_() % bound; }

 private:
  void mutate_once(std::string& bytes) {
    if (bytes.empty()) bytes = words_.back();
    const std::size_t at = below(bytes.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(bytes.size() - at, 64));
    switch (below(10)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random_());
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 5:
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\xFF');
        break;
      case 6:
        bytes.insert(at, words_[below(words_.size())]);
        break;
      case 7:
        replace_count(bytes, at);
        break;
      default:
        replace_word(bytes, at, words_[below(words_.size())]);
        break;
    }
  }

  /// As binary formats store counts and offsets: 4 bytes, the lowest first, on a boundary.
  void replace_count(std::string& bytes, std::size_t at) {
    constexpr std::array<std::uint32_t, 8> kCounts{0,       1,          3,          0x7FFF,
                                                   0x10000, 20'000'001, 0x7FFFFFFF, 0xFFFFFFFF};
    const std::uint32_t count = kCounts[below(kCounts.size())];
    at -= at % 4;
    for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<char>(count >> (8 * i) & 0xFFU);
  }

  /// The whole word around `at`.
  void replace_word(std::string& bytes, std::size_t at, std::string_view word) const {
    const std::size_t before = bytes.find_last_of(delimiters_, at);
    const std::size_t begin = before == std::string::npos ? 0 : std::min(before + 1, at);
    const std::size_t end = std::min(bytes.find_first_of(delimiters_, at), bytes.size());
    bytes.replace(begin, end - begin, word);
  }

  std::vector<std::string_view> words_;
  std::string_view delimiters_;
  std::mt19937 random_;
};

}  // namespace clay::test
