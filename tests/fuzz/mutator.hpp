#pragma once
// Damaged files for tests of readers.

#include <algorithm>
#include <cstddef>
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
  /// `words`: of the format, or hostile to it.
  Mutator(unsigned seed, std::span<const std::string_view> words)
      : words_(words.begin(), words.end()), random_(seed) {}

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
    switch (below(8)) {
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
      default:
        replace_word(bytes, at, words_[below(words_.size())]);
        break;
    }
  }

  static void replace_word(std::string& bytes, std::size_t at, std::string_view word) {
    const std::size_t end = std::min(bytes.find_first_of(" \n", at), bytes.size());
    bytes.replace(at, end - at, word);
  }

  std::vector<std::string_view> words_;
  std::mt19937 random_;
};

}  // namespace clay::test
