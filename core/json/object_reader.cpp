#include "core/json/object_reader.hpp"

#include "core/json/json_text.hpp"
#include "core/nearest_word.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cstdint>

namespace clay::inline json {
namespace {

std::string in_quotes(std::string_view name) {
  return std::string("\"").append(printable(name)).append("\"");
}

std::string found_text(const Json& value) {
  if (value.is_object()) return "an object with " + std::to_string(value.size()) + " fields";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  return printable(json_line(value));
}

}  // namespace

std::string listed(Names names) {
  std::string list;
  for (const auto name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

void ObjectReader::require(std::initializer_list<std::string_view> names) {
  for (const auto name : names) {
    if (context_.error || object_.contains(std::string(name))) continue;
    std::vector<std::string_view> strangers;
    for (const auto& [key, member] : object_.items())
      if (std::ranges::find(names, key) == names.end() && !is_known(key))
        strangers.emplace_back(key);
    const std::string_view near = nearest_word(name, strangers);
    keep(context_.document.field_error(context_.path,
                                       "expected a field " + in_quotes(name) + ", found " +
                                           (near.empty() ? "none" : in_quotes(near))));
  }
}

void ObjectReader::constant(std::string_view name, std::string_view value) {
  at(name, [&](const Json& found) {
    if (found != value) expected(in_quotes(value), found);
  });
}

void ObjectReader::written_by() {
  std::string ignored;
  text("written_by", ignored);
}

void ObjectReader::text(std::string_view name, std::string& value) {
  at(name, [&](const Json& found) {
    if (const auto* read = found.get_ptr<const std::string*>())
      value = *read;
    else
      expected("a text", found);
  });
}

void ObjectReader::texts(std::string_view name, std::vector<std::string>& values,
                         std::size_t most) {
  at(name, [&](const Json& found) {
    if (!found.is_array() || found.size() > most)
      return expected("an array of at most " + std::to_string(most) + " texts", found);
    std::vector<std::string> read;
    each_element(found, [&](const Json& element) {
      if (const auto* text = element.get_ptr<const std::string*>())
        read.push_back(*text);
      else
        expected("a text", element);
    });
    values = std::move(read);
  });
}

void ObjectReader::flag(std::string_view name, bool& value) {
  at(name, [&](const Json& found) { value = flag_in(found).value_or(value); });
}

void ObjectReader::flags(std::string_view name, std::map<std::string, bool>& values) {
  at(name, [&](const Json& found) {
    if (!is_object(found)) return;
    for (const auto& [key, member] : found.items()) {
      context_.path.emplace_back(std::string_view(key));
      if (const auto read = flag_in(member)) values[key] = *read;
      context_.path.pop_back();
    }
  });
}

void ObjectReader::number(std::string_view name, double& value, const Range& range) {
  at(name, [&](const Json& found) { value = number_from(found, range).value_or(value); });
}

void ObjectReader::number(std::string_view name, std::optional<double>& value, const Range& range) {
  at(name, [&](const Json& found) { value = number_from(found, range); });
}

void ObjectReader::numbers(std::string_view name, std::vector<double>& values, const Range& range) {
  at(name, [&](const Json& found) { values = numbers_in(found, range); });
}

void ObjectReader::numbers(std::string_view name, std::optional<std::vector<double>>& values,
                           const Range& range) {
  at(name, [&](const Json& found) { values = numbers_in(found, range); });
}

void ObjectReader::vector(std::string_view name, glm::dvec2& value, const Range& range) {
  at(name, [&](const Json& found) { value = point_in(found, range).value_or(value); });
}

void ObjectReader::vector(std::string_view name, glm::dvec3& value, const Range& range) {
  at(name, [&](const Json& found) {
    const auto read = numbers_in(found, range);
    if (read.size() == 3)
      value = {read[0], read[1], read[2]};
    else
      expected("an array of 3 numbers", found);
  });
}

void ObjectReader::points(std::string_view name, std::vector<glm::dvec2>& values,
                          const Range& range, std::size_t fewest, std::size_t most) {
  at(name, [&](const Json& found) {
    if (!found.is_array() || found.size() < fewest || found.size() > most)
      return expected(
          "an array of " + std::to_string(fewest) + " to " + std::to_string(most) + " points",
          found);
    std::vector<glm::dvec2> read;
    each_element(found, [&](const Json& element) {
      if (const auto point = point_in(element, range)) read.push_back(*point);
    });
    values = std::move(read);
  });
}

void ObjectReader::natural(std::string_view name, std::uint64_t& value) {
  at(name, [&](const Json& found) {
    // Only negative integers are not unsigned.
    if (found.is_number_unsigned())
      value = found.get<std::uint64_t>();
    else
      expected("an integer from 0 to " + std::to_string(UINT64_MAX), found);
  });
}

void ObjectReader::integers(std::string_view name, std::vector<std::int64_t>& values,
                            std::int64_t low, std::int64_t high) {
  at(name, [&](const Json& found) { values = integers_in(found, low, high); });
}

void ObjectReader::series(std::string_view name, std::vector<std::int64_t>& values,
                          std::int64_t low, std::int64_t high) {
  at(name, [&](const Json& found) {
    if (found.is_array())
      values = integers_in(found, low, high);
    else if (const auto read = integer_in(found, low, high))
      values = {*read};
  });
}

void ObjectReader::series(std::string_view name, std::vector<double>& values, const Range& range) {
  at(name, [&](const Json& found) {
    if (found.is_array() && !found.empty())
      values = numbers_in(found, range);
    else if (found.is_array())
      expected("a number, or an array of one at least", found);
    else if (const auto read = number_from(found, range))
      values = {*read};
  });
}

void ObjectReader::expect(bool holds, std::string_view name, std::string_view what) {
  if (!holds) at(name, [&](const Json& found) { expected(what, found); });
}

void ObjectReader::expect_element(bool holds, std::string_view name, std::size_t index,
                                  std::string_view what) {
  if (holds) return;
  at(name, [&](const Json& found) {
    context_.path.emplace_back(index);
    expected(what, found.at(index));
    context_.path.pop_back();
  });
}

void ObjectReader::refuse_element(std::string_view name, std::size_t index,
                                  const std::string& message) {
  at(name, [&](const Json&) {
    context_.path.emplace_back(index);
    keep(context_.document.field_error(context_.path, message));
    context_.path.pop_back();
  });
}

std::optional<bool> ObjectReader::flag_in(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  expected("true or false", value);
  return std::nullopt;
}

std::optional<double> ObjectReader::number_from(const Json& value, const Range& range) {
  if (value.is_number() && range.holds(value.get<double>())) return value.get<double>();
  expected("a number " + range.text(), value);
  return std::nullopt;
}

std::optional<std::int64_t> ObjectReader::integer_in(const Json& value, std::int64_t low,
                                                     std::int64_t high) {
  // An unsigned number of 2^63 or more would be converted to a negative one.
  const bool fits =
      value.is_number_integer() &&
      (!value.is_number_unsigned() || std::in_range<std::int64_t>(value.get<std::uint64_t>()));
  if (fits) {
    const auto read = value.get<std::int64_t>();
    if (read >= low && read <= high) return read;
  }
  expected("an integer from " + std::to_string(low) + " to " + std::to_string(high), value);
  return std::nullopt;
}

std::vector<double> ObjectReader::numbers_in(const Json& value, const Range& range) {
  std::vector<double> numbers;
  each_element(value, [&](const Json& element) {
    if (const auto read = number_from(element, range)) numbers.push_back(*read);
  });
  return numbers;
}

std::optional<glm::dvec2> ObjectReader::point_in(const Json& value, const Range& range) {
  const auto read = numbers_in(value, range);
  if (read.size() == 2) return glm::dvec2(read[0], read[1]);
  expected("an array of 2 numbers", value);
  return std::nullopt;
}

std::vector<std::int64_t> ObjectReader::integers_in(const Json& value, std::int64_t low,
                                                    std::int64_t high) {
  std::vector<std::int64_t> integers;
  each_element(value, [&](const Json& element) {
    if (const auto read = integer_in(element, low, high)) integers.push_back(*read);
  });
  return integers;
}

std::optional<std::size_t> ObjectReader::choice_in(const Json& value, Names names) {
  const auto chosen =
      std::ranges::find_if(names, [&](std::string_view name) { return value == name; });
  if (chosen != names.end()) return static_cast<std::size_t>(chosen - names.begin());
  expected("one of " + listed(names), value);
  return std::nullopt;
}

bool ObjectReader::is_object(const Json& value) {
  if (!value.is_object()) expected("an object", value);
  return value.is_object();
}

void ObjectReader::expected(std::string_view what, const Json& found) {
  keep(context_.document.field_error(
      context_.path, "expected " + std::string(what) + ", found " + found_text(found)));
}

void ObjectReader::keep(Error error) {
  if (!context_.error) context_.error = std::move(error);
}

bool ObjectReader::is_known(std::string_view name) const {
  return std::ranges::find(known_, name) != known_.end();
}

void ObjectReader::refuse_unknown_members() {
  for (const auto& [name, member] : object_.items()) {
    if (context_.error) return;
    if (is_known(name)) continue;
    const std::string owner = to_string(context_.path);
    const std::string_view near = nearest_word(name, known_);
    context_.path.emplace_back(name);
    keep(context_.document.error_at(
        context_.path, "unknown field " + in_quotes(name) + (owner.empty() ? "" : " in " + owner) +
                           "; expected one of " + listed(known_) +
                           (near.empty() ? "" : "; did you mean " + in_quotes(near) + "?")));
    context_.path.pop_back();
  }
}

}  // namespace clay::inline json
