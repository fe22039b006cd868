#include "core/json/cbor_reader.hpp"

#include "core/text.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace clay::inline json {
namespace {

/// The first byte of an item (RFC 8949, section 3): major type and additional information.
enum class Major : unsigned { natural, negative, bytes, text, array, map, tag, simple };

/// Half precision, RFC 8949, appendix D.
double from_half(std::uint64_t bits) {
  const auto exponent = static_cast<int>(bits >> 10 & 0x1f);
  const auto mantissa = static_cast<double>(bits & 0x3ff);
  double magnitude = std::numeric_limits<double>::infinity();
  if (exponent == 0)
    magnitude = std::ldexp(mantissa, -24);
  else if (exponent != 31)
    magnitude = std::ldexp(mantissa + 1024.0, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

bool is_utf8(const std::string& text) {
  try {
    (void)Json(text).dump();
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

class CborReader {
 public:
  CborReader(std::string_view bytes, JsonBuilder& builder) : rest_(bytes), builder_(builder) {}

  bool document() {
    if (!item()) return false;
    return rest_.empty() || builder_.refuse("expected the end of the file, found " +
                                            counted(rest_.size(), "more byte"));
  }

 private:
  struct Head {
    Major major;
    unsigned info;
    std::uint64_t argument;
  };

  std::optional<Head> head() {
    if (rest_.empty()) return cut_off();
    const auto first = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    Head head{static_cast<Major>(first >> 5), first & 0x1fU, first & 0x1fU};
    if (head.info < 24) return head;
    if (head.info > 27) {
      builder_.refuse("expected a definite length, found an indefinite or reserved one");
      return std::nullopt;
    }
    const std::size_t width = std::size_t{1} << (head.info - 24);
    if (rest_.size() < width) return cut_off();
    head.argument = 0;
    for (const char byte : rest_.substr(0, width))
      head.argument = head.argument << 8 | static_cast<unsigned char>(byte);
    rest_.remove_prefix(width);
    return head;
  }

  std::nullopt_t cut_off() {
    builder_.refuse("expected more bytes, found the end of the file");
    return std::nullopt;
  }

  /// Every announced item takes at least one byte, so false lengths are found before allocation.
  bool fits(std::uint64_t count, std::uint64_t bytes_each) {
    return count <= rest_.size() / bytes_each ||
           builder_.refuse("expected a length the file can hold, found " + std::to_string(count));
  }

  bool item() {
    const auto first = head();
    if (!first) return false;
    switch (first->major) {
      case Major::natural:
        return builder_.number_unsigned(first->argument);
      case Major::negative:
        return negative(first->argument);
      case Major::text: {
        auto value = text(first->argument);
        return value && builder_.string(*value);
      }
      case Major::array:
        return array(first->argument);
      case Major::map:
        return map(first->argument);
      case Major::simple:
        return simple(*first);
      case Major::bytes:
      case Major::tag:
        break;
    }
    return builder_.refuse("expected no byte strings and no tags, found one");
  }

  bool negative(std::uint64_t argument) {
    if (argument > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      return builder_.refuse("expected an integer of 64 bits, found a smaller one");
    return builder_.number_integer(-1 - static_cast<std::int64_t>(argument));
  }

  std::optional<std::string> text(std::uint64_t length) {
    if (!fits(length, 1)) return std::nullopt;
    std::string value(rest_.substr(0, length));
    rest_.remove_prefix(length);
    if (is_utf8(value)) return value;
    builder_.refuse("expected UTF-8, found " + printable(value));
    return std::nullopt;
  }

  bool array(std::uint64_t count) {
    if (!fits(count, 1) || !builder_.start_array(count)) return false;
    for (std::uint64_t i = 0; i < count; ++i)
      if (!item()) return false;
    return builder_.end_array();
  }

  bool map(std::uint64_t count) {
    if (!fits(count, 2) || !builder_.start_object(count)) return false;
    for (std::uint64_t i = 0; i < count; ++i)
      if (!key() || !item()) return false;
    return builder_.end_object();
  }

  bool key() {
    const auto first = head();
    if (!first) return false;
    if (first->major != Major::text) return builder_.refuse("expected a text key, found another");
    auto name = text(first->argument);
    return name && builder_.key(*name);
  }

  bool simple(const Head& head) {
    switch (head.info) {
      case 20:
      case 21:
        return builder_.boolean(head.info == 21);
      case 22:
        return builder_.null();
      case 25:
        return builder_.number_float(from_half(head.argument), "a half float");
      case 26:
        return builder_.number_float(
            std::bit_cast<float>(static_cast<std::uint32_t>(head.argument)), "a float");
      case 27:
        return builder_.number_float(std::bit_cast<double>(head.argument), "a double");
      default:
        return builder_.refuse("expected a known simple value, found " +
                               std::to_string(head.argument));
    }
  }

  std::string_view rest_;
  JsonBuilder& builder_;
};

}  // namespace

bool read_cbor(std::string_view bytes, JsonBuilder& builder) {
  return CborReader(bytes, builder).document();
}

}  // namespace clay::inline json
