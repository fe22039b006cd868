#include "export/formats/step_entities.hpp"

#include "core/number_parsing.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid::inline formats {

void bad_entity(std::string_view ref, std::string_view expected) {
  throw BadStep{std::string(ref).append(": expected ").append(expected)};
}

std::size_t StepEntities::place(std::string_view ref) const {
  const std::size_t number = step_number(ref);
  if (number == 0 || number > all().size()) bad_entity(ref, "an entity, found none");
  return number - 1;
}

const StepValue& StepEntities::entity(std::string_view ref, std::string_view keyword,
                                      std::size_t size) const {
  const StepValue& found = entity(ref);
  if (found.word != keyword || found.size != size)
    bad_entity(ref, std::string(keyword).append(", found ").append(found.word));
  return found;
}

const StepValue& StepEntities::part(std::string_view ref, std::string_view keyword) const {
  const auto parts = items(entity(ref));
  const auto found = std::ranges::find(parts, keyword, &StepValue::word);
  if (found == parts.end()) bad_entity(ref, keyword);
  return *found;
}

const StepValue& StepEntities::item(const StepValue& value, std::size_t index) const {
  if (index >= value.size) throw BadStep{"expected more values in an entity"};
  return items(value)[index];
}

double StepEntities::number(const StepValue& value, std::size_t index) const {
  const std::string_view found = word(value, index);
  const auto number = parse_number<double>(found);
  if (!number || !std::isfinite(*number))
    throw BadStep{std::string("expected a number, found ").append(found)};
  return *number;
}

bool StepEntities::flag(const StepValue& value, std::size_t index) const {
  const std::string_view found = word(value, index);
  if (found != ".T." && found != ".F.")
    throw BadStep{std::string("expected .T. or .F., found ").append(found)};
  return found == ".T.";
}

}  // namespace clay::solid::inline formats
