#include "core/json/json_builder.hpp"

#include "core/text.hpp"

#include <cmath>
#include <string_view>
#include <utility>

namespace clay::inline json {
namespace {

/// The library's message without its number and position; the caller adds the line.
std::string bare_message(std::string_view what) {
  if (const auto tag = what.find("] "); tag != std::string_view::npos) what.remove_prefix(tag + 2);
  if (what.starts_with("parse error"))
    if (const auto position = what.find(": "); position != std::string_view::npos)
      what.remove_prefix(position + 2);
  return printable(what);
}

}  // namespace

bool JsonBuilder::number_float(double value, const std::string& text) {
  if (!std::isfinite(value)) return refuse("expected a finite number, found " + printable(text));
  return add(value);
}

bool JsonBuilder::binary(Json::binary_t&) { return refuse("expected no byte string, found one"); }

bool JsonBuilder::key(std::string& name) {
  const Json& object = *open_.back();
  if (object.contains(name)) return refuse("duplicate field \"" + printable(name) + "\"");
  if (object.size() == kMaxMembers)
    return refuse("expected at most " + std::to_string(kMaxMembers) + " fields, found more");
  key_ = std::move(name);
  return true;
}

bool JsonBuilder::parse_error(std::size_t, const std::string&, const Json::exception& error) {
  return refuse(bare_message(error.what()));
}

bool JsonBuilder::refuse(std::string why) {
  refusal_ = std::move(why);
  return false;
}

bool JsonBuilder::add(Json value) {
  if (values_left_ == 0) return refuse("expected a file of this kind, found far too many values");
  --values_left_;
  if (open_.empty())
    root_ = std::move(value);
  else if (open_.back()->is_array())
    open_.back()->push_back(std::move(value));
  else
    open_.back()->emplace(key_, std::move(value));
  return true;
}

bool JsonBuilder::open(Json container) {
  if (open_.size() == kMaxDepth)
    return refuse("expected at most " + std::to_string(kMaxDepth) + " levels, found more");
  if (!add(std::move(container))) return false;
  if (open_.empty())
    open_.push_back(&root_);
  else
    open_.push_back(&open_.back()->back());
  return true;
}

bool JsonBuilder::close() {
  open_.pop_back();
  return true;
}

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 160;
  return shown(text, kLongest);
}

}  // namespace clay::inline json
