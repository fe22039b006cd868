#pragma once
#include "claystack/version.hpp"
#include "core/json/json_builder.hpp"
#include "core/json/object_reader.hpp"

#include <concepts>
#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::inline json {

inline constexpr std::string_view kWrittenBy = "claystack " CLAYSTACK_VERSION;

/// The reverse of ObjectReader on the same tables: writes the members of an object in the order of
/// the table. Absent values are omitted.
class ObjectWriter {
 public:
  template <class T>
  static Json write(const T& value) {
    Json object = Json::object();
    ObjectWriter writer(object);
    describe(writer, value);
    return object;
  }

  void require(std::initializer_list<std::string_view>) {}
  template <class Rules>
  void check(Rules) {}

  void constant(std::string_view name, std::string_view value) { member(name) = value; }
  void written_by() { member("written_by") = kWrittenBy; }
  void text(std::string_view name, const std::string& value) { member(name) = value; }
  void texts(std::string_view name, const std::vector<std::string>& values, std::size_t) {
    member(name) = values;
  }
  void flag(std::string_view name, bool value) { member(name) = value; }
  void flags(std::string_view name, const std::map<std::string, bool>& values) {
    member(name) = values;
  }
  void number(std::string_view name, double value, const Range&) { member(name) = value; }
  void number(std::string_view name, const std::optional<double>& value, const Range&) {
    if (value) member(name) = *value;
  }
  void numbers(std::string_view name, const std::vector<double>& values, const Range&) {
    member(name) = values;
  }
  void numbers(std::string_view name, const std::optional<std::vector<double>>& values,
               const Range&) {
    if (values) member(name) = *values;
  }
  void vector(std::string_view name, const glm::dvec3& value, const Range&) {
    member(name) = {value.x, value.y, value.z};
  }
  template <std::integral Integer>
  void integer(std::string_view name, Integer value, std::int64_t, std::int64_t) {
    member(name) = value;
  }
  void integers(std::string_view name, const std::vector<std::int64_t>& values, std::int64_t,
                std::int64_t) {
    member(name) = values;
  }
  void series(std::string_view name, const std::vector<std::int64_t>& values, std::int64_t,
              std::int64_t) {
    if (values.size() == 1)
      member(name) = values.front();
    else if (!values.empty())
      member(name) = values;
  }
  template <class Code, class T>
  void coded(std::string_view name, const T& value) {
    member(name) = Code::encode(value);
  }
  template <class T>
  void choice(std::string_view name, T value, Names names) {
    member(name) = names[static_cast<std::size_t>(value)];
  }
  template <class T>
  void choice_unless(T usual, std::string_view name, T value, Names names) {
    if (value != usual) choice(name, value, names);
  }
  template <class T>
  void part(std::string_view name, const T& value) {
    member(name) = write(value);
  }
  template <class T>
  void part(std::string_view name, const std::optional<T>& value) {
    if (value) part(name, *value);
  }
  template <class T>
  void part_or_null(std::string_view name, const std::optional<T>& value) {
    member(name) = value ? write(*value) : Json(nullptr);
  }
  template <class... Ts>
  void one_of(std::string_view name, const std::variant<Ts...>& value, Names names) {
    const std::string key(names[value.index()]);
    std::visit([&](const auto& one) { member(name)[key] = write(one); }, value);
  }

 private:
  explicit ObjectWriter(Json& object) : object_(object) {}
  Json& member(std::string_view name) { return object_[std::string(name)]; }

  Json& object_;
};

}  // namespace clay::inline json
