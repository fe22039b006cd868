#include "core/json/plain_object.hpp"

#include "core/json/json_text.hpp"
#include "core/json/object_reader.hpp"
#include "core/json/object_writer.hpp"

namespace clay::inline json {
namespace {

/// ObjectReader or ObjectWriter.
template <class Io>
class FieldsOf final : public PlainFields {
 public:
  explicit FieldsOf(Io& io) : io_(io) {}
  void number(std::string_view name, double& value, double low, double high) override {
    io_.number(name, value, from(low).to(high));
  }
  void flag(std::string_view name, bool& value) override { io_.flag(name, value); }
  void text(std::string_view name, std::string& value) override { io_.text(name, value); }
  void texts(std::string_view name, std::vector<std::string>& values, std::size_t most) override {
    io_.texts(name, values, most);
  }
  void choice(std::string_view name, std::size_t& value, Names names) override {
    io_.choice(name, value, names);
  }
  void flags(std::string_view name, std::map<std::string, bool>& values) override {
    io_.flags(name, values);
  }

 private:
  Io& io_;
};

struct PlainObject {
  std::string_view schema;
  const DescribeFields* describe_fields;
};

template <class Io>
void describe(Io& io, const PlainObject& object) {
  io.require({"schema"});
  io.constant("schema", object.schema);
  FieldsOf<Io> fields(io);
  (*object.describe_fields)(fields);
}

/// `flags` is the only field that is an object itself.
void merge(Json& mine, const Json& before, const Json& theirs) {
  for (const auto& [name, value] : theirs.items()) {
    const Json own = mine.value(name, Json()), old = before.value(name, Json());
    if (own.is_object() && old.is_object() && value.is_object())
      merge(mine[name], old, value);
    else if (own == old)
      mine[name] = value;
  }
}

}  // namespace

Result<void> read_fields(std::string_view text, std::string_view name, std::string_view schema,
                         std::size_t max_values, const DescribeFields& describe_fields) {
  return LocatedJson::from_json(text, name, max_values).and_then([&](const LocatedJson& document) {
    return ObjectReader::read(document, PlainObject{schema, &describe_fields})
        .map([](const PlainObject&) {});
  });
}

std::string write_fields(std::string_view schema, const DescribeFields& describe_fields) {
  return json_document(ObjectWriter::write(PlainObject{schema, &describe_fields}));
}

std::string merged_fields(std::string_view before, std::string_view mine, std::string_view theirs) {
  Json merged = Json::parse(mine);
  merge(merged, Json::parse(before), Json::parse(theirs));
  return json_document(merged);
}

}  // namespace clay::inline json
