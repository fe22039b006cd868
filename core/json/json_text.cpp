#include "core/json/json_text.hpp"

#include "core/text.hpp"

namespace clay::inline json {
namespace {

constexpr std::size_t kNumbersPerRow = 10;

void append(std::string& text, const Json& value, std::size_t indent);

void break_line(std::string& text, std::size_t indent) {
  text += '\n';
  text.append(indent, ' ');
}

void append_object(std::string& text, const Json& object, std::size_t indent) {
  const char* separator = "{";
  for (const auto& [name, member] : object.items()) {
    text += separator;
    break_line(text, indent + 2);
    text += json_line(name) + ": ";
    append(text, member, indent + 2);
    separator = ",";
  }
  break_line(text, indent);
  text += "}";
}

void append_array(std::string& text, const Json& array, std::size_t indent) {
  const bool one_row = array.size() <= kNumbersPerRow;
  text += "[";
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (i > 0) text += ",";
    if (!one_row && i % kNumbersPerRow == 0)
      break_line(text, indent + 2);
    else if (i > 0)
      text += " ";
    append(text, array[i], indent + 2);
  }
  if (!one_row) break_line(text, indent);
  text += "]";
}

void append(std::string& text, const Json& value, std::size_t indent) {
  if (value.is_object() && !value.empty())
    append_object(text, value, indent);
  else if (value.is_array())
    append_array(text, value, indent);
  else if (value.is_number_float())
    text += number_text(value.get<double>());
  else if (value.is_number_integer() && !value.is_number_unsigned())
    text += std::to_string(value.get<std::int64_t>());  // most values of a pot; many times faster
  else
    text += json_line(value);
}

}  // namespace

std::string json_text(const Json& value) {
  std::string text;
  append(text, value, 0);
  return text + "\n";
}

std::string json_document(const Json& value) {
  return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_line(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace clay::inline json
