#pragma once
// The part of JSON Schema (draft 2020-12) that samples/schema uses, and edits of a file that reveal
// differences between a schema and a reader.

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace clay::test {

using Json = nlohmann::ordered_json;

/// samples/schema/NAME.schema.json
Json load_schema(const std::string& name);

/// The first violation, "/path: keyword"; empty if `value` conforms. An unknown keyword is a
/// violation, so that nothing is skipped.
std::string violation(const Json& schema, const Json& value);

struct Edit {
  std::string what;  ///< "/lump/rings: below minimum"
  Json file;
};

/// One edit each: numbers at and beyond their limits, wrong types, members removed and added.
std::vector<Edit> edits(const Json& schema, const Json& file);

/// "/lump/rings" for every property of the schema, choices of `oneOf` merged.
std::vector<std::string> property_paths(const Json& schema);
/// The same for every member of a file, without elements of arrays.
std::vector<std::string> member_paths(const Json& file);

}  // namespace clay::test
