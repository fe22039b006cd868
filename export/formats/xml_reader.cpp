#include "export/formats/xml_reader.hpp"

#include "export/formats/mesh_limits.hpp"

#include <libxml/SAX2.h>
#include <libxml/parser.h>

#include <cstring>
#include <exception>
#include <new>

namespace clay::solid::inline formats {
namespace {

std::string_view view(const xmlChar* text) {
  return text == nullptr ? std::string_view() : reinterpret_cast<const char*>(text);
}

/// The message of the parser on one line, without control characters.
std::string first_line(const char* message) {
  std::string line;
  for (const char* c = message; c != nullptr && *c != '\0' && *c != '\n' && line.size() < 200; ++c)
    line += *c >= ' ' && *c <= '~' ? *c : '?';
  return line;
}

}  // namespace

std::optional<std::string_view> XmlElement::value_of(std::string_view attribute) const {
  for (const XmlAttribute& a : attributes)
    if (a.space.empty() && a.name == attribute) return a.value;
  return std::nullopt;
}

struct XmlReader::Parser {
  explicit Parser(XmlReader& owner) : reader(owner) {
    // Two threads read parts of a 3MF: one of them initialises libxml2, the other waits for it.
    static const bool initialised = (xmlInitParser(), true);
    (void)initialised;
    xmlSAXHandler events{};
    events.initialized = XML_SAX2_MAGIC;
    events.startElementNs = &begin;
    events.endElementNs = [](void* self, const xmlChar*, const xmlChar*, const xmlChar*) {
      guarded_call(self, [](XmlReader& r) { r.events_.end(r); });
    };
    events.characters = events.cdataBlock = [](void* self, const xmlChar* text, int length) {
      guarded_call(self, [&](XmlReader& r) {
        r.events_.text(r, {reinterpret_cast<const char*>(text), static_cast<std::size_t>(length)});
      });
    };
    events.internalSubset = [](void* self, const xmlChar*, const xmlChar*, const xmlChar*) {
      guarded_call(self, [](XmlReader& r) { r.fail("expected no document type, found one"); });
      xmlStopParser(static_cast<Parser*>(self)->context);  // before it reads the entities
    };
    context = xmlCreatePushParserCtxt(&events, this, nullptr, 0, nullptr);
    if (context == nullptr) throw std::bad_alloc();
    // Entities are those of XML itself, since there is no document type.
    xmlCtxtUseOptions(context,
                      XML_PARSE_NONET | XML_PARSE_NOENT | XML_PARSE_NOERROR | XML_PARSE_NOWARNING);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
  ~Parser() {
    if (context->myDoc != nullptr) xmlFreeDoc(context->myDoc);
    xmlFreeParserCtxt(context);
  }

  /// Calls work(reader) unless there is a fault. No exception may pass through the frames of the
  /// library, which is C: it waits until the library has returned.
  template <class Work>
  static void guarded_call(void* self, const Work& work) noexcept {
    auto& parser = *static_cast<Parser*>(self);
    if (parser.reader.fault_ || parser.thrown) return;
    try {
      work(parser.reader);
    } catch (...) {
      parser.thrown = std::current_exception();
      xmlStopParser(parser.context);
    }
  }

  static void begin(void* self, const xmlChar* name, const xmlChar*, const xmlChar* space,
                    int namespaces, const xmlChar** namespace_list, int attributes, int,
                    const xmlChar** list) {
    guarded_call(self, [&](XmlReader& r) {
      XmlElement& begun = r.parser_->element;
      begun.space = view(space);
      begun.name = view(name);
      begun.namespaces.clear();
      for (int i = 0; i < namespaces; ++i)
        begun.namespaces.push_back(
            {{}, view(namespace_list[2 * i]), view(namespace_list[2 * i + 1])});
      begun.attributes.clear();
      for (int i = 0; i < attributes; ++i) {
        const xmlChar** const a = list + 5 * i;
        begun.attributes.push_back(
            {view(a[2]),
             view(a[0]),
             {reinterpret_cast<const char*>(a[3]), static_cast<std::size_t>(a[4] - a[3])}});
      }
      r.events_.begin(r, begun);
    });
  }

  XmlReader& reader;
  xmlParserCtxtPtr context = nullptr;
  XmlElement element;
  std::exception_ptr thrown;  ///< by an event
};

XmlReader::XmlReader(Events& events, std::string_view name)
    : events_(events), name_(name), parser_(std::make_unique<Parser>(*this)) {}

XmlReader::~XmlReader() = default;

Result<void> XmlReader::read(std::string_view piece) { return parse(piece, false); }
Result<void> XmlReader::finish() { return parse({}, true); }

Result<void> XmlReader::parse(std::string_view piece, bool last) {
  if (const auto fault = limit_.take(piece)) fail_at(fault->line, fault->what);
  if (!fault_) {
    xmlParserCtxtPtr const context = parser_->context;
    (void)xmlParseChunk(context, piece.data(), static_cast<int>(piece.size()), last ? 1 : 0);
    if (parser_->thrown) std::rethrow_exception(parser_->thrown);
    const bool good = context->wellFormed != 0 && context->nsWellFormed != 0;
    if (!fault_ && !good) {
      const xmlError* const error = xmlCtxtGetLastError(context);
      fail("expected XML, found: " + first_line(error == nullptr ? nullptr : error->message));
    }
  }
  if (fault_) return tl::make_unexpected(*fault_);
  return {};
}

void XmlReader::fail(std::string_view what) {
  xmlParserCtxtPtr const context = parser_->context;
  const int line = context->input == nullptr ? 0 : context->input->line;
  fail_at(static_cast<std::size_t>(line), what);
}

void XmlReader::fail_at(std::size_t line, std::string_view what) {
  if (fault_) return;
  fault_ =
      Error{ErrorKind::bad_input,
            std::string(name_).append(":").append(std::to_string(line)).append(": ").append(what)};
}

}  // namespace clay::solid::inline formats
