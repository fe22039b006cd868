#include "tests/support/schema_check.hpp"

#include <regex.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>

namespace clay::test {
namespace {

using Rule = std::function<bool(const Json& argument, const Json& value)>;

bool has_type(const std::string& type, const Json& value) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return type == value.type_name();
}

/// POSIX, because std::regex of GCC 12 does not compile cleanly under its sanitizers.
bool matches(const std::string& pattern, const std::string& text) {
  regex_t compiled;
  if (::regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0) return false;
  const bool found = ::regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
  ::regfree(&compiled);
  return found;
}

const std::map<std::string, Rule>& simple_rules() {
  const auto numeric = [](auto holds) {
    return [=](const Json& limit, const Json& value) {
      return !value.is_number() || holds(value.get<long double>(), limit.get<long double>());
    };
  };
  static const std::map<std::string, Rule> rules = {
      {"type", [](const Json& type, const Json& value) { return has_type(type, value); }},
      {"const", [](const Json& only, const Json& value) { return only == value; }},
      {"enum",
       [](const Json& all, const Json& value) {
         return std::find(all.begin(), all.end(), value) != all.end();
       }},
      {"minimum", numeric(std::greater_equal<>{})},
      {"maximum", numeric(std::less_equal<>{})},
      {"exclusiveMinimum", numeric(std::greater<>{})},
      {"exclusiveMaximum", numeric(std::less<>{})},
      {"minItems",
       [](const Json& n, const Json& value) { return !value.is_array() || value.size() >= n; }},
      {"maxItems",
       [](const Json& n, const Json& value) { return !value.is_array() || value.size() <= n; }},
      {"minProperties",
       [](const Json& n, const Json& value) { return !value.is_object() || value.size() >= n; }},
      {"maxProperties",
       [](const Json& n, const Json& value) { return !value.is_object() || value.size() <= n; }},
      {"pattern",
       [](const Json& pattern, const Json& value) {
         return !value.is_string() || matches(pattern.get<std::string>(), value.get<std::string>());
       }},
      {"required",
       [](const Json& names, const Json& value) {
         return std::ranges::all_of(
             names, [&](const Json& name) { return value.contains(name.get<std::string>()); });
       }},
  };
  return rules;
}

bool is_annotation(const std::string& keyword) {
  static const std::vector<std::string> names = {"$schema", "$id",         "$defs",
                                                 "title",   "description", "default"};
  return std::find(names.begin(), names.end(), keyword) != names.end();
}

class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}

  std::string operator()(const Json& schema, const Json& value, const std::string& path) const {
    for (const auto& [keyword, argument] : schema.items()) {
      const std::string found = apply(schema, keyword, argument, value, path);
      if (!found.empty()) return found;
    }
    return {};
  }

  const Json& resolved(const Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    return root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
  }

 private:
  std::string apply(const Json& schema, const std::string& keyword, const Json& argument,
                    const Json& value, const std::string& path) const {
    if (is_annotation(keyword)) return {};
    if (keyword == "$ref") return (*this)(resolved(schema), value, path);
    if (keyword == "properties") return members(argument, value, path);
    if (keyword == "items") return elements(argument, value, path);
    bool holds = false;
    if (keyword == "additionalProperties")
      holds = argument == false && only_known(schema["properties"], value);
    else if (keyword == "oneOf")
      holds = std::ranges::count_if(argument, [&](const Json& branch) {
                return (*this)(branch, value, path).empty();
              }) == 1;
    else if (const auto rule = simple_rules().find(keyword); rule != simple_rules().end())
      holds = rule->second(argument, value);
    return holds ? std::string() : path + ": " + keyword;
  }

  std::string members(const Json& properties, const Json& value, const std::string& path) const {
    if (!value.is_object()) return {};
    for (const auto& [name, schema] : properties.items()) {
      if (!value.contains(name)) continue;
      const auto found = (*this)(schema, value[name], path + "/" + name);
      if (!found.empty()) return found;
    }
    return {};
  }

  std::string elements(const Json& schema, const Json& value, const std::string& path) const {
    if (!value.is_array()) return {};
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto found = (*this)(schema, value[i], path + "/" + std::to_string(i));
      if (!found.empty()) return found;
    }
    return {};
  }

  static bool only_known(const Json& properties, const Json& value) {
    if (!value.is_object()) return true;
    for (const auto& [name, member] : value.items())
      if (!properties.contains(name)) return false;
    return true;
  }

  const Json& root_;
};

class Editor {
 public:
  Editor(const Json& root, const Json& file) : valid_(root), file_(file) {}

  void visit(const Json& written, const Json::json_pointer& at) {
    const Json& schema = valid_.resolved(written);
    const Json& value = file_.at(at);
    if (schema.contains("oneOf") && !schema.contains("properties"))
      return visit_branch(schema["oneOf"], at);
    put(at, "wrong type", Json::array({Json::object()}));
    if (value.is_number()) limits(schema, at);
    if (value.is_array() && !value.empty()) {
      visit(schema["items"], at / std::size_t{0});
      visit(schema["items"], at / (value.size() - 1));
    }
    if (value.is_object()) members(schema, at);
  }

  std::vector<Edit> take() { return std::move(edits_); }

 private:
  void put(const Json::json_pointer& at, const std::string& how, const Json& value) {
    Edit edit{at.to_string() + ": " + how, file_};
    edit.file[at] = value;
    edits_.push_back(std::move(edit));
  }

  void visit_branch(const Json& branches, const Json::json_pointer& at) {
    for (const Json& branch : branches)
      if (valid_(branch, file_.at(at), "").empty()) visit(branch, at);
  }

  void limits(const Json& schema, const Json::json_pointer& at) {
    for (const auto& [keyword, down] : {std::pair{"minimum", true},
                                        {"exclusiveMinimum", true},
                                        {"maximum", false},
                                        {"exclusiveMaximum", false}}) {
      if (!schema.contains(keyword)) continue;
      const Json& limit = schema[keyword];
      put(at, std::string("at ") + keyword, limit);
      put(at, std::string("below ") + keyword, stepped(schema, limit, true));
      put(at, std::string("above ") + keyword, stepped(schema, limit, false));
    }
  }

  static Json stepped(const Json& schema, const Json& limit, bool down) {
    if (schema["type"] == "integer" && !down && limit.get<std::int64_t>() >= 0)
      return limit.get<std::uint64_t>() + 1;  // the limit may be the largest std::int64_t
    if (schema["type"] == "integer") return limit.get<std::int64_t>() + (down ? -1 : 1);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return std::nextafter(limit.get<double>(), down ? -kInfinity : kInfinity);
  }

  void members(const Json& schema, const Json::json_pointer& at) {
    put(at / "unexpected", "added", 1);
    for (const auto& [name, member] : file_.at(at).items()) {
      Edit edit{(at / name).to_string() + ": removed", file_};
      edit.file.at(at).erase(name);
      edits_.push_back(std::move(edit));
      visit(schema["properties"][name], at / name);
    }
  }

  Validator valid_;
  const Json& file_;
  std::vector<Edit> edits_;
};

void collect_properties(const Json& schema, const std::string& path,
                        std::vector<std::string>& paths) {
  if (schema.contains("oneOf"))
    for (const Json& branch : schema["oneOf"]) collect_properties(branch, path, paths);
  if (!schema.contains("properties")) return;
  for (const auto& [name, member] : schema["properties"].items()) {
    paths.push_back(path + "/" + name);
    collect_properties(member, path + "/" + name, paths);
  }
}

void collect_members(const Json& value, const std::string& path, std::vector<std::string>& paths) {
  if (!value.is_object()) return;
  for (const auto& [name, member] : value.items()) {
    paths.push_back(path + "/" + name);
    collect_members(member, path + "/" + name, paths);
  }
}

}  // namespace

Json load_schema(const std::string& name) {
  std::ifstream file(std::string(CLAYSTACK_SAMPLES) + "/schema/" + name + ".schema.json");
  return Json::parse(file);
}

std::string violation(const Json& schema, const Json& value) {
  return Validator(schema)(schema, value, "");
}

std::vector<Edit> edits(const Json& schema, const Json& file) {
  Editor editor(schema, file);
  editor.visit(schema, Json::json_pointer());
  return editor.take();
}

std::vector<std::string> property_paths(const Json& schema) {
  std::vector<std::string> paths;
  collect_properties(schema, "", paths);
  return paths;
}

std::vector<std::string> member_paths(const Json& file) {
  std::vector<std::string> paths;
  collect_members(file, "", paths);
  return paths;
}

}  // namespace clay::test
