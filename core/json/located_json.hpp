#pragma once
#include "claystack/core/result.hpp"
#include "core/json/json_builder.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::inline json {

/// From the root inward: member names and element indices.
using Path = std::vector<std::variant<std::string_view, std::size_t>>;

/// "tool.shape.sphere", "rings.outer2[17]"; empty for the root.
std::string to_string(const Path& path);

/// A document that can name the line of each value. Lines are not stored; an error reads the text a
/// second time to find its line.
class LocatedJson {
 public:
  /// Keeps a reference to `text`. Refuses duplicate keys, more than 64 levels, numbers beyond a
  /// double, malformed UTF-8, and anything after the value. `first_line` is the line of its start.
  static Result<LocatedJson> from_json(std::string_view text, std::string_view name,
                                       std::size_t max_values, std::size_t first_line = 1);
  static Result<LocatedJson> from_cbor(std::string_view bytes, std::string_view name,
                                       std::size_t max_values);

  [[nodiscard]] const Json& root() const noexcept { return root_; }

  /// "NAME:LINE: message"; in CBOR, which has no lines, "NAME: message".
  [[nodiscard]] Error error_at(const Path& path, const std::string& message) const;
  /// "NAME:LINE: FIELD: message"
  [[nodiscard]] Error field_error(const Path& path, const std::string& message) const;

 private:
  LocatedJson(Json root, std::string_view text, std::string_view name, std::size_t first_line);

  Json root_;
  std::string_view text_;  ///< empty for CBOR
  std::string name_;
  std::size_t first_line_;
};

/// Whether `text` is a valid but incomplete beginning of a JSON value.
bool is_unfinished_json(std::string_view text);

}  // namespace clay::inline json
