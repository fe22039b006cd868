#include "export/formats/three_mf_volumes.hpp"

#include "core/text.hpp"

#include <charconv>
#include <optional>

namespace clay::solid::inline formats::three_mf {
namespace {

std::optional<std::uint32_t> number_of(const XmlElement& element, std::string_view name) {
  const std::string_view text = element.value_of(name).value_or("");
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string SlicerVolumes::Count::text() const {
  std::string text;
  if (other > 0) text = counted(other, "modifier or support volume");
  if (other > 0 && negative > 0) text += " and ";
  if (negative > 0) text += counted(negative, "negative volume");
  return text;
}

void SlicerVolumes::visit(XmlReader& reader, const XmlElement& element) {
  if (element.name == "object") {
    object_ = number_of(element, "id").value_or(0);
    in_volume_ = false;
  } else if (element.name == "volume") {
    begin_volume(reader, element);
  } else if (element.name == "part") {
    begin_part(reader, element);
  } else if (element.name == "metadata" && in_volume_) {
    const std::string_view key = element.value_of("key").value_or("");
    const std::string_view value = element.value_of("value").value_or("");
    // PrusaSlicer 2.5 writes both for a modifier; files of older versions may have the first alone.
    const bool modifier = key == "modifier" && value == "1";
    if (!modifier && (key != "volume_type" || value == "ModelPart")) return;
    volume_.negative = value == "NegativeVolume";
    ranges_[object_][volume_.first] = volume_;
    in_volume_ = false;
  }
}

void SlicerVolumes::begin_volume(XmlReader& reader, const XmlElement& element) {
  const auto first = number_of(element, "firstid"), last = number_of(element, "lastid");
  if (!first || !last || *last < *first)
    return reader.fail("expected the first and the last triangle of a volume, found others");
  volume_ = {*first, *last};
  in_volume_ = true;
}

void SlicerVolumes::begin_part(XmlReader& reader, const XmlElement& element) {
  const std::string_view kind = element.value_of("subtype").value_or("normal_part");
  if (kind == "normal_part") return;
  const auto id = number_of(element, "id");
  if (!id) return reader.fail("expected the id of a part, found none");
  components_[{object_, *id}] = kind == "negative_part";
}

const SlicerVolumes::Ranges* SlicerVolumes::ranges_of(std::uint32_t object) const {
  const auto found = ranges_.find(object);
  return found == ranges_.end() ? nullptr : &found->second;
}

const bool* SlicerVolumes::component(std::uint32_t object, std::uint32_t id) const {
  const auto found = components_.find({object, id});
  return found == components_.end() ? nullptr : &found->second;
}

}  // namespace clay::solid::inline formats::three_mf
