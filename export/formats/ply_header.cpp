#include "export/formats/ply_header.hpp"

#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace clay::solid::inline formats::ply {
namespace {

constexpr std::size_t kMaxHeaderBytes = 64 * 1024;
constexpr std::size_t kMostElements = 64, kMostProperties = 256;

struct TypeName {
  std::string_view name, alias;
  std::size_t bytes;
};
/// In the order of `Number`.
constexpr std::array<TypeName, 8> kTypes{{{"int8", "char", 1},
                                          {"uint8", "uchar", 1},
                                          {"int16", "short", 2},
                                          {"uint16", "ushort", 2},
                                          {"int32", "int", 4},
                                          {"uint32", "uint", 4},
                                          {"float32", "float", 4},
                                          {"float64", "double", 8}}};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (words.size() < 8) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) break;
    words.push_back(line.substr(0, line.find_first_of(" \t\r")));
    line.remove_prefix(words.back().size());
  }
  return words;
}

std::optional<Number> number_named(std::string_view name) {
  for (std::size_t i = 0; i < kTypes.size(); ++i)
    if (name == kTypes[i].name || name == kTypes[i].alias) return static_cast<Number>(i);
  return std::nullopt;
}

/// Reads the header, line by line.
class HeaderReader {
 public:
  HeaderReader(std::string_view file, std::string_view name) : file_(file), name_(name) {}

  Result<Header> read() {
    if (next_line() != "ply")
      return fail("expected ply, found " + kind_of_file(file_.substr(0, 100)));
    for (;;) {
      const auto line = next_line();
      if (!line)
        return fail("expected end_header within " + std::to_string(kMaxHeaderBytes) +
                    " bytes, found none");
      const std::vector<std::string_view> words = words_of(*line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (auto done = read_line(words, *line); !done) return tl::make_unexpected(done.error());
    }
    if (!known_encoding_) return fail("expected a line format, found none");
    header_.bytes = at_;
    return check_room().map([&] { return std::move(header_); });
  }

 private:
  /// Empty at the end of the header's limit.
  std::optional<std::string_view> next_line() {
    const std::string_view rest = file_.substr(at_, kMaxHeaderBytes);
    const std::size_t end = rest.find('\n');
    if (end == rest.npos || at_ > kMaxHeaderBytes) return std::nullopt;
    ++header_.lines;
    at_ += end + 1;
    const std::string_view line = rest.substr(0, end);
    return line.ends_with('\r') ? line.substr(0, end - 1) : line;
  }

  [[nodiscard]] tl::unexpected<Error> fail(const std::string& what) const {
    return failure(ErrorKind::bad_input,
                   std::string(name_) + ":" + std::to_string(header_.lines) + ": " + what);
  }

  Result<void> read_line(const std::vector<std::string_view>& words, std::string_view line) {
    if (words[0] == "format" && words.size() == 3) return read_format(words);
    if (words[0] == "element" && words.size() == 3) return read_element(words);
    if (words[0] == "property" && !header_.elements.empty()) return read_property(words, line);
    // Before the elements such a line cannot change the meaning of the numbers.
    const bool keyword = words[0] == "format" || words[0] == "element" || words[0] == "property";
    if (!keyword && header_.elements.empty()) {
      if (header_.stray_lines++ == 0) header_.stray_line = header_.lines;
      return {};
    }
    return fail("expected format, element, property, comment or end_header, found " + quoted(line));
  }

  Result<void> read_format(const std::vector<std::string_view>& words) {
    static constexpr std::array<std::pair<std::string_view, Encoding>, 3> kEncodings{
        {{"ascii", Encoding::text},
         {"binary_little_endian", Encoding::little_endian},
         {"binary_big_endian", Encoding::big_endian}}};
    for (const auto& [word, encoding] : kEncodings) {
      if (words[1] != word || words[2] != "1.0") continue;
      header_.encoding = encoding;
      known_encoding_ = true;
      return {};
    }
    return fail(
        "expected format ascii, binary_little_endian or binary_big_endian, version 1.0, found " +
        quoted(words[1]) + " " + quoted(words[2]));
  }

  Result<void> read_element(const std::vector<std::string_view>& words) {
    Element element{std::string(words[1]), 0, {}, header_.lines};
    const auto [end, error] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (error != std::errc() || end != words[2].data() + words[2].size())
      return fail("expected a count of elements, found " + quoted(words[2]));
    const bool known = std::ranges::any_of(
        header_.elements, [&](const Element& other) { return other.name == element.name; });
    if (known) return fail("expected element " + quoted(words[1]) + " once, found it twice");
    if (header_.elements.size() == kMostElements)
      return fail("expected at most " + std::to_string(kMostElements) + " elements, found more");
    header_.elements.push_back(std::move(element));
    return {};
  }

  /// "property TYPE NAME" or "property list COUNT_TYPE TYPE NAME".
  Result<void> read_property(const std::vector<std::string_view>& words, std::string_view line) {
    const bool list = words.size() == 5 && words[1] == "list";
    const auto type = words.size() == (list ? 5U : 3U) ? number_named(words[list ? 3 : 1])
                                                       : std::optional<Number>();
    const auto count_type = list ? number_named(words[2]) : std::optional<Number>();
    if (!type || (list && (!count_type || !is_whole(*count_type))))
      return fail("expected property TYPE NAME or property list TYPE TYPE NAME, found " +
                  quoted(line));
    std::vector<Property>& properties = header_.elements.back().properties;
    if (properties.size() == kMostProperties)
      return fail("expected at most " + std::to_string(kMostProperties) +
                  " properties, found more");
    properties.push_back({std::string(words.back()), *type, count_type});
    return {};
  }

  /// Every element takes at least the bytes of its numbers and of its lists' counts; in text, two
  /// bytes each.
  Result<void> check_room() const {
    for (const Element& element : header_.elements) {
      std::uint64_t least = 0;
      for (const Property& property : element.properties)
        least += header_.encoding == Encoding::text
                     ? 2
                     : bytes_of(property.count_type.value_or(property.type));
      // The last number of a text may have no byte after it.
      const std::uint64_t room = file_.size() - at_ + 1;
      if (element.count == 0 || (least > 0 && element.count <= room / least)) continue;
      return failure(ErrorKind::bad_input,
                     std::string(name_) + ":" + std::to_string(element.line) +
                         ": expected a count that the file's " + std::to_string(file_.size()) +
                         " bytes hold, found " + std::to_string(element.count));
    }
    return {};
  }

  std::string_view file_, name_;
  std::size_t at_ = 0;
  Header header_;
  bool known_encoding_ = false;
};

}  // namespace

std::size_t bytes_of(Number type) noexcept { return kTypes[static_cast<std::size_t>(type)].bytes; }

Result<Header> read_header(std::string_view file, std::string_view name) {
  return HeaderReader(file, name).read();
}

}  // namespace clay::solid::inline formats::ply
