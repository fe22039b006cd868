#pragma once
// The entities of a STEP file, for its verification: each access checks the entity.

#include "export/formats/step_text.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace clay::solid::inline formats {

/// A fault of an entity; never leaves `verify_step`.
struct BadStep {
  std::string what;
};
/// Throws `BadStep`: "#12: expected ...".
[[noreturn]] void bad_entity(std::string_view ref, std::string_view expected);

/// References are words, "#12". Every function throws `BadStep`.
class StepEntities {
 public:
  explicit StepEntities(const StepFile& file) noexcept : file_(file) {}

  [[nodiscard]] std::span<const StepValue> all() const noexcept { return file_.entities; }
  /// The place of an entity in `all()`.
  [[nodiscard]] std::size_t place(std::string_view ref) const;
  [[nodiscard]] const StepValue& entity(std::string_view ref) const { return all()[place(ref)]; }
  /// The same. Fails unless the entity has this keyword and `size` items.
  [[nodiscard]] const StepValue& entity(std::string_view ref, std::string_view keyword,
                                        std::size_t size) const;
  /// A typed value of a complex entity.
  [[nodiscard]] const StepValue& part(std::string_view ref, std::string_view keyword) const;

  [[nodiscard]] std::span<const StepValue> items(const StepValue& value) const noexcept {
    return file_.items(value);
  }
  [[nodiscard]] const StepValue& item(const StepValue& value, std::size_t index) const;
  [[nodiscard]] std::span<const StepValue> list(const StepValue& value, std::size_t index) const {
    return items(item(value, index));
  }
  [[nodiscard]] std::string_view word(const StepValue& value, std::size_t index) const {
    return item(value, index).word;
  }
  [[nodiscard]] double number(const StepValue& value, std::size_t index) const;
  [[nodiscard]] bool flag(const StepValue& value, std::size_t index) const;

 private:
  const StepFile& file_;
};

}  // namespace clay::solid::inline formats
