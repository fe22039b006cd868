#include "app/import/dxf_groups.hpp"

#include "app/import/readers.hpp"

#include "core/number_parsing.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <libxml/encoding.h>

#include <algorithm>
#include <cmath>

namespace clay::importing {
namespace {

constexpr int kLowestCode = -5, kHighestCode = 1071, kComment = 999;

std::string_view without_plus(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return text;
}

tl::unexpected<Error> wrong(const std::string_view name, std::size_t line, std::string_view wanted,
                            std::string_view found) {
  return failure(ErrorKind::bad_input,
                 fmt::format("{}:{}: expected {}, found \"{}\"", name, line, wanted, shown(found)));
}

}  // namespace

Result<DxfGroups> DxfGroups::open(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("AutoCAD Binary DXF"))
    return failure(ErrorKind::bad_input,
                   name +
                       ": expected a DXF drawing as text, found a binary one; save it as "
                       "ASCII DXF");
  if (bytes.find('\0') != std::string_view::npos)
    return failure(ErrorKind::bad_input, name + ": expected a DXF drawing, found binary data");
  bytes = without_byte_order_mark(bytes);
  DxfGroups groups;
  groups.rest_ = bytes;
  groups.end_of_line_ = bytes.find('\n') == std::string_view::npos ? '\r' : '\n';
  groups.name_ = name;
  return groups;
}

std::optional<std::string_view> DxfGroups::next_line() {
  if (rest_.empty()) return std::nullopt;
  ++line_;
  const std::size_t end = std::min(rest_.find(end_of_line_), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  return trimmed(line);
}

Result<DxfGroup> DxfGroups::next() {
  while (true) {
    const auto code_text = next_line();
    const std::size_t line = line_;
    const auto code = code_text ? parse_number<int>(without_plus(*code_text)) : std::nullopt;
    if (code_text && !(code && *code >= kLowestCode && *code <= kHighestCode))
      return wrong(name_, line, "a DXF group code", *code_text);
    const auto value = code_text ? next_line() : std::nullopt;
    if (!value)
      return failure(ErrorKind::bad_input,
                     fmt::format("{}:{}: expected a DXF drawing up to its group 0 EOF, found the "
                                 "end of the file",
                                 name_, line_));
    if (*code != kComment) return DxfGroup{*code, *value, line};
  }
}

std::string_view DxfEntity::text(int code) const {
  const auto group =
      std::find_if(groups.begin(), groups.end(), [&](const DxfGroup& g) { return g.code == code; });
  return group == groups.end() ? std::string_view() : group->value;
}

Result<DxfEntity> take_dxf_entity(DxfGroups& groups, const std::string& name) {
  const auto first = groups.next();
  if (!first) return tl::make_unexpected(first.error());
  if (first->code != 0)
    return wrong(name, first->line, "a DXF group of code 0",
                 fmt::format("{} {}", first->code, first->value));
  DxfEntity entity{first->value, first->line, {}};
  if (first->value == "EOF") return entity;
  while (true) {
    DxfGroups ahead = groups;
    const auto group = ahead.next();
    if (!group) return tl::make_unexpected(group.error());
    if (group->code == 0) return entity;
    if (entity.groups.size() == kMostDxfGroups)
      return failure(ErrorKind::bad_input,
                     fmt::format("{}:{}: expected at most {} groups in a {}, found more", name,
                                 entity.line, kMostDxfGroups, entity.type));
    entity.groups.push_back(*group);
    groups = ahead;
  }
}

std::string dxf_text(std::string_view value) {
  const std::string bytes(value);
  if (xmlCheckUTF8(reinterpret_cast<const unsigned char*>(bytes.c_str())) != 0) return bytes;
  std::string utf8(2 * bytes.size(), '\0');
  int size = static_cast<int>(utf8.size()), taken = static_cast<int>(bytes.size());
  isolat1ToUTF8(reinterpret_cast<unsigned char*>(utf8.data()), &size,
                reinterpret_cast<const unsigned char*>(bytes.data()), &taken);
  utf8.resize(static_cast<std::size_t>(size));
  return utf8;
}

Result<double> dxf_number(const DxfGroup& group, const std::string& name) {
  const auto value = parse_number<double>(without_plus(group.value));
  if (!value || !std::isfinite(*value)) return wrong(name, group.line + 1, "a number", group.value);
  return *value;
}

Result<long> dxf_integer(const DxfGroup& group, const std::string& name) {
  const auto value = parse_number<long>(without_plus(group.value));
  if (!value) return wrong(name, group.line + 1, "an integer", group.value);
  return *value;
}

}  // namespace clay::importing
