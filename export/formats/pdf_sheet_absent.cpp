// Replaces pdf_sheet.cpp in builds without cairo: in a web page.

#include "export/formats/sheet.hpp"

namespace clay::solid::inline formats {

Result<std::string> pdf_of(const Sheet&) {
  return failure(ErrorKind::bad_input,
                 "cannot write .pdf: this build has no cairo; .svg and .dxf "
                 "hold the same drawing");
}

}  // namespace clay::solid::inline formats
