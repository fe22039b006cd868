#include "core/json/plain_object.hpp"

#include "core/json/located_json.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <utility>

namespace clay::inline json {

struct PlainReader::State {
  LocatedJson document;
  std::string name;
  std::vector<std::string> known = {"schema"};
  std::string problem;

  /// Null where the field is absent.
  const Json* take(const char* field) {
    known.emplace_back(field);
    const auto found = document.root().find(field);
    return found == document.root().end() ? nullptr : &*found;
  }
  void refuse(const std::string& field, const std::string& expected, const Json& found) {
    if (problem.empty())
      problem = field + ": expected " + expected + ", found " + printable(found.dump());
  }
};

PlainReader::PlainReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlainReader::PlainReader(PlainReader&&) noexcept = default;
PlainReader& PlainReader::operator=(PlainReader&&) noexcept = default;
PlainReader::~PlainReader() = default;

Result<PlainReader> PlainReader::parse(std::string_view text, std::string_view name,
                                       std::string_view schema, std::size_t max_values) {
  auto document = LocatedJson::from_json(text, name, max_values);
  if (!document) return tl::make_unexpected(document.error());
  const std::string begin = std::string(name) + ": ";
  if (!document->root().is_object())
    return failure(ErrorKind::bad_input, begin + "expected a JSON object");
  if (document->root().value("schema", Json()) != schema)
    return failure(ErrorKind::bad_input, (begin + "schema: expected ").append(schema));
  return PlainReader(
      std::make_unique<State>(State{std::move(*document), std::string(name), {"schema"}, {}}));
}

void PlainReader::number(const char* name, double& target, double low, double high) {
  const Json* field = state_->take(name);
  if (field == nullptr) return;
  if (field->is_number() && field->get<double>() >= low && field->get<double>() <= high)
    target = field->get<double>();
  else
    state_->refuse(
        name, "a number from " + short_number_text(low) + " to " + short_number_text(high), *field);
}

void PlainReader::flag(const char* name, bool& target) {
  const Json* field = state_->take(name);
  if (field == nullptr) return;
  if (field->is_boolean())
    target = field->get<bool>();
  else
    state_->refuse(name, "true or false", *field);
}

void PlainReader::text(const char* name, std::string& target) {
  const Json* field = state_->take(name);
  if (field == nullptr) return;
  if (field->is_string())
    target = field->get<std::string>();
  else
    state_->refuse(name, "a text", *field);
}

void PlainReader::texts(const char* name, std::vector<std::string>& target, std::size_t most) {
  const Json* field = state_->take(name);
  if (field == nullptr) return;
  if (!field->is_array() || field->size() > most ||
      !std::ranges::all_of(*field, [](const Json& text) { return text.is_string(); }))
    return state_->refuse(name, "at most " + std::to_string(most) + " texts", *field);
  target = field->get<std::vector<std::string>>();
}

void PlainReader::choice(const char* name, std::size_t& target,
                         std::span<const char* const> names) {
  const Json* field = state_->take(name);
  if (field == nullptr) return;
  std::string expected = "one of";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (field->is_string() && field->get<std::string>() == names[i]) {
      target = i;
      return;
    }
    expected.append(" ").append(names[i]);
  }
  state_->refuse(name, expected, *field);
}

void PlainReader::flags(const char* name, std::map<std::string, bool>& target) {
  const Json* field = state_->take(name);
  if (field == nullptr) return;
  if (!field->is_object()) return state_->refuse(name, "an object", *field);
  for (const auto& [key, value] : field->items()) {
    if (!value.is_boolean())
      return state_->refuse(std::string(name) + "." + printable(key), "true or false", value);
    target[key] = value.get<bool>();
  }
}

Result<void> PlainReader::finish() const {
  std::string problem = state_->problem;
  for (const auto& [key, value] : state_->document.root().items())
    if (problem.empty() && std::ranges::find(state_->known, key) == state_->known.end())
      problem = printable(key) + ": expected no such field";
  if (problem.empty()) return {};
  return failure(ErrorKind::bad_input, state_->name + ": " + problem);
}

struct PlainWriter::State {
  Json object;
};

PlainWriter::PlainWriter(std::string_view schema)
    : state_(std::make_unique<State>(State{Json{{"schema", schema}}})) {}
PlainWriter::~PlainWriter() = default;

void PlainWriter::number(const char* name, double value, double, double) {
  state_->object[name] = value;
}
void PlainWriter::flag(const char* name, bool value) { state_->object[name] = value; }
void PlainWriter::text(const char* name, const std::string& value) { state_->object[name] = value; }
void PlainWriter::texts(const char* name, const std::vector<std::string>& value, std::size_t) {
  state_->object[name] = value;
}
void PlainWriter::choice(const char* name, std::size_t value, std::span<const char* const> names) {
  state_->object[name] = names[std::min(value, names.size() - 1)];
}
void PlainWriter::flags(const char* name, const std::map<std::string, bool>& value) {
  state_->object[name] = value;
}

std::string PlainWriter::finish() const {
  return state_->object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace clay::inline json
