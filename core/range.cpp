#include "core/range.hpp"

#include "core/text.hpp"

namespace clay {

std::string Range::text() const {
  return std::string(low_open ? "above " : "from ") + number_text(low) +
         (high_open ? " to below " : " to ") + number_text(high);
}

}  // namespace clay
