#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clay::inline json {

/// Members keep the order of the file; integers keep their 64 bits.
using Json = nlohmann::ordered_json;

inline constexpr std::size_t kMaxDepth = 64;
/// Far above the number in any object of the schemas; also bounds the search for duplicate keys.
inline constexpr std::size_t kMaxMembers = 64;

/// Turns the events of a JSON or CBOR parser into a document. An event that returns false ends the
/// parse, and `refusal` holds the reason.
class JsonBuilder {
 public:
  explicit JsonBuilder(std::size_t max_values) : values_left_(max_values) {}

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string& text);
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Json::binary_t& value);
  bool start_object(std::size_t) { return open(Json::object()); }
  bool key(std::string& name);
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error);

  /// Always false, for an event to return.
  bool refuse(std::string why);
  [[nodiscard]] const std::string& refusal() const noexcept { return refusal_; }
  [[nodiscard]] Json take() { return std::move(root_); }

 private:
  bool add(Json value);
  bool open(Json container);
  bool close();

  Json root_;
  std::vector<Json*> open_;  ///< from the root inward; none grows while a deeper one is open
  std::string key_;
  std::size_t values_left_;
  std::string refusal_;
};

/// `text` for one line of a message: as shown() makes it, and just long enough to recognise it.
std::string printable(std::string_view text);

}  // namespace clay::inline json
