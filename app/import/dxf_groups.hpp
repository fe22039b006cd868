#pragma once
// The text of a DXF file as groups: a code on one line, its value on the next.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

struct DxfGroup {
  int code = 0;
  std::string_view value;  ///< without blanks at its ends
  std::size_t line = 0;    ///< of the code
};

/// Reads groups in order. A copy continues from the same place. Lines may have any length; in a
/// file without LF they end with CR.
class DxfGroups {
 public:
  /// Refuses binary DXF files and files with NUL bytes.
  static Result<DxfGroups> open(std::string_view bytes, const std::string& name);

  /// The next group that is not a comment. Refuses the end of the file: group 0 EOF comes first.
  Result<DxfGroup> next();
  /// The same without taking it.
  [[nodiscard]] Result<DxfGroup> peek() const { return DxfGroups(*this).next(); }

 private:
  std::optional<std::string_view> next_line();

  std::string_view rest_;
  std::string_view name_;
  std::size_t line_ = 0;
  char end_of_line_ = '\n';
};

/// An entity, a table entry or a block: its name, and all groups up to the next code 0.
struct DxfEntity {
  std::string_view type;
  std::size_t line = 0;
  std::vector<DxfGroup> groups;

  /// The value of the first group with this code; empty if there is none.
  [[nodiscard]] std::string_view text(int code) const;
};

/// Groups that one entity may have. A spline of a drawing has some thousands.
inline constexpr std::size_t kMostDxfGroups = 2'000'000;

/// Takes an entity and its groups: the next group must have the code 0.
Result<DxfEntity> take_dxf_entity(DxfGroups& groups, const std::string& name);

/// A value in UTF-8. Programs before AutoCAD 2007 write the characters of a country, mostly those
/// of Western Europe: a value that is not UTF-8 is read as Latin-1.
[[nodiscard]] std::string dxf_text(std::string_view value);

/// A finite number, or an integer. Errors read "NAME:LINE: expected a number, found ...".
Result<double> dxf_number(const DxfGroup& group, const std::string& name);
Result<long> dxf_integer(const DxfGroup& group, const std::string& name);

}  // namespace clay::importing
