#pragma once
// Reads XML by events, piece by piece, by libxml2: no document in memory, no network, no document
// types and so no entities defined by the file, and a limit on the attributes of a tag.

#include "claystack/core/result.hpp"
#include "core/xml_attributes.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

struct XmlAttribute {
  std::string_view space, name, value;  ///< `space` is a namespace URI; empty: none
};

struct XmlElement {
  std::string_view space, name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlAttribute> namespaces;  ///< declared here: `name` is the prefix, `value` the URI

  /// Of an attribute without a namespace.
  [[nodiscard]] std::optional<std::string_view> value_of(std::string_view attribute) const;
};

class XmlReader {
 public:
  /// Handlers of the events. `fail` of the reader ends the reading.
  class Events {
   public:
    virtual ~Events() = default;
    virtual void begin(XmlReader& reader, const XmlElement& element) = 0;
    virtual void end(XmlReader& reader) = 0;
    virtual void text(XmlReader& reader, std::string_view piece) = 0;
  };

  /// Both outlive it.
  XmlReader(Events& events, std::string_view name);
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;
  ~XmlReader();

  /// The next bytes of the file.
  Result<void> read(std::string_view piece);
  /// After the last byte.
  Result<void> finish();
  /// An error "NAME:LINE: WHAT", with the line that is read; the first one counts. Events stop at
  /// once. The parser stops at the end of the piece: to stop it earlier frees the text that the
  /// caller may still use.
  void fail(std::string_view what);

 private:
  struct Parser;
  Result<void> parse(std::string_view piece, bool last);
  void fail_at(std::size_t line, std::string_view what);

  Events& events_;
  std::string_view name_;
  XmlAttributeLimit limit_;
  std::unique_ptr<Parser> parser_;
  std::optional<Error> fault_;
};

}  // namespace clay::solid::inline formats
