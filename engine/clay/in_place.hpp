#pragma once
#include <new>
#include <type_traits>

namespace clay {

/// place = make(), without a copy. A copy of data that was just written member by member would wait
/// until all of it has reached the memory.
template <class Value, class Make>
void make_in_place(Value& place, Make make) noexcept {
  static_assert(std::is_trivially_destructible_v<Value>);
  ::new (static_cast<void*>(&place)) Value(make());
}

}  // namespace clay
