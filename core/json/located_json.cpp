#include "core/json/located_json.hpp"

#include "core/json/cbor_reader.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <new>
#include <utility>

namespace clay::inline json {
namespace {

/// Records how far the lexer has read, because its events carry no positions.
class TracedIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  TracedIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  TracedIterator& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  TracedIterator operator++(int) {
    const TracedIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const TracedIterator& a, const TracedIterator& b) {
    return a.at_ == b.at_;
  }

 private:
  const char* at_;
  const char** reached_;
};

/// Feeds the events of `text` to `handler`; returns where the parse stopped.
template <class Handler>
const char* parse(std::string_view text, Handler& handler) {
  const char* reached = text.data();
  const TracedIterator first(text.data(), &reached);
  const TracedIterator last(text.data() + text.size(), &reached);
  Json::sax_parse(first, last, &handler);
  return reached;
}

/// Number of lines that end before the last token. The last character read may be one too many,
/// because the end of a number is only visible after it; no token ends with a newline.
std::size_t lines_before(std::string_view text, const char* reached) {
  const auto read = static_cast<std::size_t>(reached - text.data());
  const auto before = text.substr(0, read == 0 ? 0 : read - 1);
  return static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

/// Follows a path through the events of a parse and stops at its value.
class Locator {
 public:
  explicit Locator(const Path& path) : path_(path) {}

  bool null() { return value(); }
  bool boolean(bool) { return value(); }
  bool number_integer(std::int64_t) { return value(); }
  bool number_unsigned(std::uint64_t) { return value(); }
  bool number_float(double, const std::string&) { return value(); }
  bool string(std::string&) { return value(); }
  bool binary(Json::binary_t&) { return value(); }
  bool start_object(std::size_t) { return open(); }
  bool key(std::string& name) {
    key_ = std::move(name);
    return true;
  }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) { return false; }

 private:
  struct Level {
    bool on_path;
    std::size_t next_index;
  };

  bool is_next_on_path() {
    if (levels_.empty()) return true;
    const std::size_t index = levels_.back().next_index++;
    if (!levels_.back().on_path || levels_.size() > path_.size()) return false;
    const auto& step = path_[levels_.size() - 1];
    if (const auto* name = std::get_if<std::string_view>(&step)) return *name == key_;
    return std::get<std::size_t>(step) == index;
  }

  bool value() { return !is_next_on_path() || levels_.size() != path_.size(); }

  bool open() {
    const bool on_path = is_next_on_path();
    if (on_path && levels_.size() == path_.size()) return false;
    levels_.push_back({on_path, 0});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  const Path& path_;
  std::vector<Level> levels_;
  std::string key_;
};

tl::unexpected<Error> input_failure(const std::string& place, const std::string& message) {
  return failure(ErrorKind::bad_input, place + ": " + message);
}

}  // namespace

std::string to_string(const Path& path) {
  std::string text;
  for (const auto& step : path) {
    if (const auto* index = std::get_if<std::size_t>(&step)) {
      text.append("[").append(std::to_string(*index)).append("]");
    } else {
      if (!text.empty()) text += '.';
      text += std::get<std::string_view>(step);
    }
  }
  return text;
}

LocatedJson::LocatedJson(Json root, std::string_view text, std::string_view name,
                         std::size_t first_line)
    : root_(std::move(root)), text_(text), name_(name), first_line_(first_line) {}

Result<LocatedJson> LocatedJson::from_json(std::string_view text, std::string_view name,
                                           std::size_t max_values, std::size_t first_line) {
  const auto place = [&](const char* at) {
    return std::string(name) + ":" + std::to_string(first_line + lines_before(text, at));
  };
  // The library treats a NUL as the end of the text and would ignore the rest.
  if (const auto nul = text.find('\0'); nul != std::string_view::npos)
    return input_failure(place(text.data() + nul + 1), "expected JSON, found a zero byte");
  // The library's message for an empty text differs between its versions.
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    return input_failure(place(text.data() + text.size()), "expected JSON, found no text");
  try {
    JsonBuilder builder(max_values);
    const char* reached = parse(text, builder);
    if (!builder.refusal().empty()) return input_failure(place(reached), builder.refusal());
    return LocatedJson(builder.take(), text, name, first_line);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::io, std::string(name) + ": not enough memory to read it");
  } catch (const std::exception& error) {
    return input_failure(std::string(name), error.what());
  }
}

Result<LocatedJson> LocatedJson::from_cbor(std::string_view bytes, std::string_view name,
                                           std::size_t max_values) {
  try {
    JsonBuilder builder(max_values);
    if (!read_cbor(bytes, builder)) return input_failure(std::string(name), builder.refusal());
    return LocatedJson(builder.take(), {}, name, 0);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::io, std::string(name) + ": not enough memory to read it");
  } catch (const std::exception& error) {
    return input_failure(std::string(name), error.what());
  }
}

Error LocatedJson::error_at(const Path& path, const std::string& message) const {
  std::string place = name_;
  if (!text_.empty()) {
    Locator locator(path);
    const std::size_t line = first_line_ + lines_before(text_, parse(text_, locator));
    place.append(":").append(std::to_string(line));
  }
  return Error{ErrorKind::bad_input, place + ": " + message};
}

Error LocatedJson::field_error(const Path& path, const std::string& message) const {
  return error_at(path, path.empty() ? message : to_string(path) + ": " + message);
}

bool is_unfinished_json(std::string_view text) {
  // Distinguished by position: a premature end is reported after the last character.
  struct EndFinder : JsonBuilder {
    using JsonBuilder::JsonBuilder;
    bool parse_error(std::size_t position, const std::string&, const Json::exception&) {
      error_position = position;
      return false;
    }
    std::size_t error_position = 0;
  };
  EndFinder finder(text.size());
  parse(text, finder);
  return finder.error_position > text.size();
}

}  // namespace clay::inline json
