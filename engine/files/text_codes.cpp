#include "engine/files/text_codes.hpp"

#include <charconv>

namespace clay::files {

std::string HashCode::encode(std::uint64_t hash) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[hash >> shift & 0xf];
  return text;
}

std::optional<std::uint64_t> HashCode::decode(std::string_view text) {
  std::uint64_t hash = 0;
  std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (encode(hash) != text) return std::nullopt;
  return hash;
}

std::optional<WideQuanta> DecimalCode::decode(std::string_view text) {
  constexpr std::size_t kMaxDigits = 30;
  if (text.size() > kMaxDigits) return std::nullopt;
  WideQuanta count = 0;
  for (const char digit : text) {
    if (digit < '0' || digit > '9') return std::nullopt;
    count = count * 10 + (digit - '0');
  }
  // One count has one text: not empty, no leading zeros.
  if (encode(count) != text) return std::nullopt;
  return count;
}

std::optional<WideQuanta> SignedDecimalCode::decode(std::string_view text) {
  if (!text.starts_with('-')) return DecimalCode::decode(text);
  const auto count = DecimalCode::decode(text.substr(1));
  return count && *count != 0 ? std::optional(-*count) : std::nullopt;
}

}  // namespace clay::files
