#pragma once
// A JSON object of plain fields, such as a file of settings, without a JSON type in this header:
// one table of fields serves reading and writing.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::inline json {

/// Reads fields into their targets. A field that is absent leaves its target unchanged; the first
/// wrong one becomes the problem.
class PlainReader {
 public:
  /// Errors: malformed JSON, more than `max_values` values, no object, another schema.
  static Result<PlainReader> parse(std::string_view text, std::string_view name,
                                   std::string_view schema, std::size_t max_values);
  PlainReader(PlainReader&&) noexcept;
  PlainReader& operator=(PlainReader&&) noexcept;
  ~PlainReader();

  void number(const char* name, double& target, double low, double high);
  void flag(const char* name, bool& target);
  void text(const char* name, std::string& target);
  void texts(const char* name, std::vector<std::string>& target, std::size_t most);
  /// One of `names`, by its index.
  void choice(const char* name, std::size_t& target, std::span<const char* const> names);
  void flags(const char* name, std::map<std::string, bool>& target);

  /// "NAME: FIELD: expected ..., found ..."; an unknown field is a problem too.
  [[nodiscard]] Result<void> finish() const;

 private:
  struct State;
  explicit PlainReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Writes the same fields in their order.
class PlainWriter {
 public:
  explicit PlainWriter(std::string_view schema);
  ~PlainWriter();
  PlainWriter(const PlainWriter&) = delete;
  PlainWriter& operator=(const PlainWriter&) = delete;

  void number(const char* name, double value, double, double);
  void flag(const char* name, bool value);
  void text(const char* name, const std::string& value);
  void texts(const char* name, const std::vector<std::string>& value, std::size_t);
  void choice(const char* name, std::size_t value, std::span<const char* const> names);
  void flags(const char* name, const std::map<std::string, bool>& value);

  [[nodiscard]] std::string finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clay::inline json
