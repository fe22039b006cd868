#pragma once
// The beginnings of the text formats. The readers and `mesh_format_of_bytes` use the same rules.

#include <string_view>

namespace clay::solid::inline formats {

/// The word solid in any case, after a byte order mark and blanks. A binary STL may begin so, too.
[[nodiscard]] bool begins_with_solid(std::string_view bytes);

/// Has no byte 0 where a binary STL has its count: fewer than 2^24 facets have one there.
[[nodiscard]] bool is_text(std::string_view head);

/// [ST][C][N]OFF. A 4 or an n before it adds dimensions.
[[nodiscard]] bool is_off_keyword(std::string_view word);
/// An OFF may begin with its counts, without a keyword.
[[nodiscard]] bool is_off_count(std::string_view word);

}  // namespace clay::solid::inline formats
