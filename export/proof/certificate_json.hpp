#pragma once
// Strict reading of certificates by the events of the parser: a profile of millions of points must
// not become a document, which takes six times their memory. All other files use ObjectReader.

#include "claystack/core/result.hpp"

#include "core/range.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

using Json = nlohmann::ordered_json;

/// Thrown by the readers below; `parsed_with` turns it into an error.
struct BadField : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A value for a message: a number in full, anything else by its type. Nested or long contents of
/// untrusted files are neither traversed nor repeated.
inline std::string shown(const Json& value) {
  return value.is_number() ? value.dump() : value.type_name();
}

/// Shortens quoted text, to keep messages short.
inline std::string shown(const std::string& text, std::size_t longest = 60) {
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

inline const Json& field_of(const Json& json, const char* name) {
  if (!json.is_object())
    throw BadField(std::string("expected an object, found ") + json.type_name());
  const auto found = json.find(name);
  if (found == json.end()) throw BadField(std::string(name) + ": expected this field, found none");
  return *found;
}

inline tl::unexpected<Error> bad_json(std::string_view name, std::string_view what) {
  return failure(ErrorKind::bad_input, std::string(name).append(": ").append(what));
}

inline double number_in(const Json& json, const char* name, const Range& limits) {
  const Json& value = field_of(json, name);
  if (value.is_number() && limits.holds(value.get<double>())) return value.get<double>();
  throw BadField(std::string(name) + ": expected a number " + limits.text() + ", found " +
                 shown(value));
}

inline std::uint64_t count_in(const Json& json, const char* name) {
  const Json& value = field_of(json, name);
  if (!value.is_number_unsigned())
    throw BadField(std::string(name) + ": expected a whole number, found " + shown(value));
  return value.get<std::uint64_t>();
}

inline std::string text_in(const Json& json, const char* name) {
  const Json& value = field_of(json, name);
  if (!value.is_string())
    throw BadField(std::string(name) + ": expected text, found " + shown(value));
  constexpr std::size_t kLongest = 1000;  // for a message to people
  auto text = value.get<std::string>();
  if (text.size() > kLongest)
    throw BadField(std::string(name) + ": expected text of at most " + std::to_string(kLongest) +
                   " bytes, found " + std::to_string(text.size()));
  return text;
}

inline const Json& array_in(const Json& json, const char* name) {
  const Json& value = field_of(json, name);
  if (!value.is_array())
    throw BadField(std::string(name) + ": expected an array, found " + shown(value));
  return value;
}

inline void expect_only(const Json& json, std::initializer_list<std::string_view> known) {
  if (!json.is_object())
    throw BadField(std::string("expected an object, found ") + json.type_name());
  for (const auto& [name, value] : json.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw BadField(shown(name) + ": unknown field");
}

/// Kind and version of the file, such as "claystack-process-1".
inline void expect_schema(const Json& json, const std::string& schema) {
  const std::string found = text_in(json, "schema");
  if (found != schema) throw BadField("schema: expected " + schema + ", found " + shown(found));
}

/// Follows the parser and stops it when the file's `schema`, its first field, is of another kind. A
/// complete parse takes many times the memory of the text, and time quadratic in an object's keys.
class JsonLimits {
 public:
  JsonLimits(int deepest, std::string schema) : deepest_(deepest), schema_(std::move(schema)) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& value) {
    using Event = Json::parse_event_t;
    if (depth == 0 && event == Event::array_start)
      throw BadField("expected an object, found an array");
    if (depth > deepest_)
      throw BadField("expected values nested " + std::to_string(deepest_) +
                     " deep at most, found deeper ones");
    if (event == Event::object_start) keys_.emplace_back();
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key) add_key(value.get_ref<const std::string&>());
    if (event == Event::value && depth == 1 && keys_.back().back() == "schema") check_schema(value);
    return true;
  }

 private:
  void check_schema(const Json& value) const {
    const auto* found = value.get_ptr<const std::string*>();
    if (found != nullptr && *found != schema_ && found->size() <= kLongestKey)
      throw BadField("schema: expected " + schema_ + ", found " + *found);
  }

  void add_key(const std::string& key) {
    if (key.size() > kLongestKey) throw BadField(shown(key) + ": unknown field");
    std::vector<std::string>& keys = keys_.back();
    if (std::find(keys.begin(), keys.end(), key) != keys.end())
      throw BadField(shown(key) + ": expected this field once, found it twice");
    if (keys.size() == kMostKeys)
      throw BadField("expected at most " + std::to_string(kMostKeys) +
                     " fields in an object, found more");
    keys.push_back(key);
  }

  static constexpr std::size_t kMostKeys = 64, kLongestKey = 64;
  int deepest_;
  std::string schema_;
  std::vector<std::vector<std::string>> keys_;  ///< of the objects that are open
};

/// The parser's message without its number: "[json.exception.parse_error.101] parse error".
inline std::string_view bare_message(std::string_view what) {
  const auto tag = what.find("] ");
  return what.starts_with('[') && tag != what.npos ? what.substr(tag + 2) : what;
}

/// Checks the first bytes for the kind of file, before the parser reports a syntax error.
inline void expect_object_text(std::string_view bytes) {
  bytes = without_byte_order_mark(bytes);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (bytes.starts_with('{') || bytes.starts_with('[')) return;
  throw BadField("expected a JSON object, found " + kind_of_file(bytes));
}

/// Returns read(root) of a JSON text; errors begin with `name`. `follow` sees every event of the
/// parser, as `Json::parse` describes, and may throw.
template <class Read, class Follow>
auto parsed_with(std::string_view bytes, std::string_view name, Follow follow, Read read)
    -> Result<decltype(read(Json()))> try {
  expect_object_text(bytes);
  return read(Json::parse(bytes, std::ref(follow)));
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, std::string(name) + ": not enough memory to read it");
} catch (const std::exception& error) {
  constexpr std::size_t kLongest = 300;  // the parser quotes the last text it read
  return bad_json(name, shown(std::string(bare_message(error.what())), kLongest));
}

}  // namespace clay::solid::inline proof
