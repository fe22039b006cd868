#pragma once
// A JSON object of plain fields, such as a file of settings, without a JSON type in this header. It
// is read and written by ObjectReader and ObjectWriter, as strictly as any other file.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::inline json {

/// One table of fields serves reading and writing. An absent field leaves its value unchanged.
class PlainFields {
 public:
  virtual ~PlainFields() = default;
  virtual void number(std::string_view name, double& value, double low, double high) = 0;
  virtual void flag(std::string_view name, bool& value) = 0;
  virtual void text(std::string_view name, std::string& value) = 0;
  virtual void texts(std::string_view name, std::vector<std::string>& values, std::size_t most) = 0;
  /// One of `names`, by its index.
  virtual void choice(std::string_view name, std::size_t& value,
                      std::span<const std::string_view> names) = 0;
  virtual void flags(std::string_view name, std::map<std::string, bool>& values) = 0;
};
using DescribeFields = std::function<void(PlainFields&)>;

/// Errors as ObjectReader::read, and more than `max_values` values.
Result<void> read_fields(std::string_view text, std::string_view name, std::string_view schema,
                         std::size_t max_values, const DescribeFields& describe_fields);
[[nodiscard]] std::string write_fields(std::string_view schema,
                                       const DescribeFields& describe_fields);
/// `mine`, with `theirs` of each field that is the same in `mine` and `before`: the changes of two
/// programs to one file. All are texts of write_fields with the same fields.
[[nodiscard]] std::string merged_fields(std::string_view before, std::string_view mine,
                                        std::string_view theirs);

}  // namespace clay::inline json
