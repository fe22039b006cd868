#pragma once
// Strict reading of small JSON files: every field is there, of its kind, and known.

#include "claystack/engine/result.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace clay::solid {

using Json = nlohmann::ordered_json;

/// Thrown by the readers below, and turned into an error by `parsed_with`.
struct BadField : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

inline double number_in(const Json& json, const char* name) {
  const Json& value = field_of(json, name);
  if (!value.is_number())
    throw BadField(std::string(name) + ": expected a number, found " + value.type_name());
  return value.get<double>();
}

inline std::uint64_t count_in(const Json& json, const char* name) {
  const Json& value = field_of(json, name);
  if (!value.is_number_unsigned())
    throw BadField(std::string(name) + ": expected a whole number, found " + value.dump());
  return value.get<std::uint64_t>();
}

inline std::string text_in(const Json& json, const char* name) {
  const Json& value = field_of(json, name);
  if (!value.is_string())
    throw BadField(std::string(name) + ": expected text, found " + value.type_name());
  return value.get<std::string>();
}

inline void expect_only(const Json& json, std::initializer_list<std::string_view> known) {
  if (!json.is_object())
    throw BadField(std::string("expected an object, found ") + json.type_name());
  for (const auto& [name, value] : json.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw BadField(name + ": unknown field");
}

/// Kind and version of the file, such as "claystack-process-1".
inline void expect_schema(const Json& json, const std::string& schema) {
  const std::string found = text_in(json, "schema");
  if (found != schema) throw BadField("schema: expected " + schema + ", found " + found);
}

/// read(root) of a JSON text; what goes wrong becomes an error that begins with `name`.
template <class Read>
auto parsed_with(std::string_view bytes, std::string_view name, Read read)
    -> Result<decltype(read(Json()))> try {
  return read(Json::parse(bytes));
} catch (const std::exception& error) {
  return bad_json(name, error.what());
}

}  // namespace clay::solid
