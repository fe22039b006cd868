#pragma once
#include "claystack/core/result.hpp"
#include "core/json/located_json.hpp"
#include "core/range.hpp"

#include <concepts>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace clay::inline json {

/// Distinguishes the overloads of `describe`; each serves values and constants alike.
template <class T, class Described>
concept Is = std::same_as<std::remove_const_t<T>, Described>;

using Names = std::span<const std::string_view>;

/// "sphere, ellipse, rib"
std::string listed(Names names);

/// Reads the members of an object strictly by a table. Each part of a file has one function
/// `describe(io, part)` that names its members in order; ObjectWriter uses the same table, so
/// reader and writer cannot differ.
///
/// An absent member leaves its value unchanged. The first error is kept and stops all further
/// reading, so a table needs no `if`. Names must outlive the reader.
class ObjectReader {
 public:
  /// Reads the document as a T; `value` holds the defaults.
  template <class T>
  static Result<T> read(const LocatedJson& document, T value);

  void require(std::initializer_list<std::string_view> names);
  void constant(std::string_view name, std::string_view value);
  /// The program that wrote the file: any text.
  void written_by();
  void text(std::string_view name, std::string& value);
  void texts(std::string_view name, std::vector<std::string>& values, std::size_t most);
  void flag(std::string_view name, bool& value);
  /// An object of flags with any names; those that are absent stay unchanged.
  void flags(std::string_view name, std::map<std::string, bool>& values);
  void number(std::string_view name, double& value, const Range& range);
  void number(std::string_view name, std::optional<double>& value, const Range& range);
  void numbers(std::string_view name, std::vector<double>& values, const Range& range);
  void numbers(std::string_view name, std::optional<std::vector<double>>& values,
               const Range& range);
  void vector(std::string_view name, glm::dvec2& value, const Range& range);
  void vector(std::string_view name, glm::dvec3& value, const Range& range);
  /// An array of `fewest` to `most` arrays of 2 numbers.
  void points(std::string_view name, std::vector<glm::dvec2>& values, const Range& range,
              std::size_t fewest, std::size_t most);
  /// Any integer that fits: from 0 to 2^64 - 1.
  void natural(std::string_view name, std::uint64_t& value);
  template <std::integral Integer>
  void integer(std::string_view name, Integer& value, std::int64_t low, std::int64_t high);
  void integers(std::string_view name, std::vector<std::int64_t>& values, std::int64_t low,
                std::int64_t high);
  /// A single integer is an array of one.
  void series(std::string_view name, std::vector<std::int64_t>& values, std::int64_t low,
              std::int64_t high);
  /// A single number is an array of one; an empty array is an error.
  void series(std::string_view name, std::vector<double>& values, const Range& range);
  /// A value stored as text, by `Code::encode`, `Code::decode` and `Code::kExpected`.
  template <class Code, class T>
  void coded(std::string_view name, T& value);
  /// One of `names`, in the order of the values of T.
  template <class T>
  void choice(std::string_view name, T& value, Names names);
  /// A choice that files contain only if it differs from the usual one.
  template <class T>
  void choice_unless(T usual, std::string_view name, T& value, Names names) {
    value = usual;
    choice(name, value, names);
  }
  template <class T>
  void part(std::string_view name, T& value);
  template <class T>
  void part(std::string_view name, std::optional<T>& value);
  template <class T>
  void part_or_null(std::string_view name, std::optional<T>& value);
  /// An array of objects.
  template <class T>
  void parts(std::string_view name, std::vector<T>& values);
  /// An object with exactly one member; its name selects the type, in the order of Ts.
  template <class... Ts>
  void one_of(std::string_view name, std::variant<Ts...>& value, Names names);

  /// Rules between members: calls `rules(*this)` if everything before was read without an error.
  template <class Rules>
  void check(Rules rules) {
    if (!context_.error) rules(*this);
  }
  void expect(bool holds, std::string_view name, std::string_view expected);
  /// The same for element `index` of an array.
  void expect_element(bool holds, std::string_view name, std::size_t index,
                      std::string_view expected);
  /// An error at element `index` of an array, with this message.
  void refuse_element(std::string_view name, std::size_t index, const std::string& message);

 private:
  struct Context {
    const LocatedJson& document;
    Path path;
    std::optional<Error> error;
  };

  ObjectReader(Context& context, const Json& object) : context_(context), object_(object) {}

  /// Calls use(member) if the member exists and there is no error; marks the name as known.
  template <class Use>
  void at(std::string_view name, Use use);
  template <class ReadElement>
  void each_element(const Json& array, ReadElement read_element);
  template <class T>
  void read_part(const Json& object, T& value);

  std::optional<double> number_from(const Json& value, const Range& range);
  std::optional<std::int64_t> integer_in(const Json& value, std::int64_t low, std::int64_t high);
  std::vector<double> numbers_in(const Json& value, const Range& range);
  std::optional<glm::dvec2> point_in(const Json& value, const Range& range);
  std::vector<std::int64_t> integers_in(const Json& value, std::int64_t low, std::int64_t high);
  std::optional<std::size_t> choice_in(const Json& value, Names names);
  std::optional<bool> flag_in(const Json& value);
  [[nodiscard]] bool is_object(const Json& value);

  void expected(std::string_view what, const Json& found);
  void keep(Error error);
  [[nodiscard]] bool is_known(std::string_view name) const;
  void refuse_unknown_members();

  Context& context_;
  const Json& object_;
  std::vector<std::string_view> known_;
};

template <class T>
Result<T> ObjectReader::read(const LocatedJson& document, T value) {
  Context context{document, {}, std::nullopt};
  ObjectReader root(context, document.root());
  root.read_part(document.root(), value);
  if (context.error) return tl::make_unexpected(std::move(*context.error));
  return value;
}

template <class Use>
void ObjectReader::at(std::string_view name, Use use) {
  known_.push_back(name);
  if (context_.error) return;
  const auto member = object_.find(std::string(name));
  if (member == object_.end()) return;
  context_.path.emplace_back(name);
  use(*member);
  context_.path.pop_back();
}

template <class T>
void ObjectReader::read_part(const Json& object, T& value) {
  if (!is_object(object)) return;
  ObjectReader reader(context_, object);
  describe(reader, value);
  reader.refuse_unknown_members();
}

template <class ReadElement>
void ObjectReader::each_element(const Json& array, ReadElement read_element) {
  if (!array.is_array()) return expected("an array", array);
  for (std::size_t i = 0; i < array.size() && !context_.error; ++i) {
    context_.path.emplace_back(i);
    read_element(array[i]);
    context_.path.pop_back();
  }
}

template <std::integral Integer>
void ObjectReader::integer(std::string_view name, Integer& value, std::int64_t low,
                           std::int64_t high) {
  at(name, [&](const Json& found) {
    if (const auto read = integer_in(found, low, high)) value = static_cast<Integer>(*read);
  });
}

template <class Code, class T>
void ObjectReader::coded(std::string_view name, T& value) {
  at(name, [&](const Json& found) {
    const auto* text = found.get_ptr<const std::string*>();
    const std::optional<T> read = text == nullptr ? std::nullopt : Code::decode(*text);
    if (read)
      value = *read;
    else
      expected(Code::kExpected, found);
  });
}

template <class T>
void ObjectReader::choice(std::string_view name, T& value, Names names) {
  at(name, [&](const Json& found) {
    if (const auto index = choice_in(found, names)) value = static_cast<T>(*index);
  });
}

template <class T>
void ObjectReader::part(std::string_view name, T& value) {
  at(name, [&](const Json& found) { read_part(found, value); });
}

template <class T>
void ObjectReader::part(std::string_view name, std::optional<T>& value) {
  at(name, [&](const Json& found) { read_part(found, value.emplace()); });
}

template <class T>
void ObjectReader::part_or_null(std::string_view name, std::optional<T>& value) {
  at(name, [&](const Json& found) {
    if (!found.is_null()) read_part(found, value.emplace());
  });
}

template <class T>
void ObjectReader::parts(std::string_view name, std::vector<T>& values) {
  at(name, [&](const Json& array) {
    each_element(array, [&](const Json& found) { read_part(found, values.emplace_back()); });
  });
}

template <class... Ts>
void ObjectReader::one_of(std::string_view name, std::variant<Ts...>& value, Names names) {
  at(name, [&](const Json& found) {
    if (!is_object(found)) return;
    ObjectReader reader(context_, found);
    std::size_t index = 0;
    const auto read = [&]<class T>(std::type_identity<T>) {
      reader.at(names[index++],
                [&](const Json& one) { reader.read_part(one, value.template emplace<T>()); });
    };
    (read(std::type_identity<Ts>{}), ...);
    reader.refuse_unknown_members();
    if (found.size() != 1) expected("exactly one of " + listed(names), found);
  });
}

}  // namespace clay::inline json
