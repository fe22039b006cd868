#pragma once
// The names that differ between CGAL 5 (Debian 12) and CGAL 6 (Debian 13): boxes, the results of
// intersections, the arguments of algorithms. Requires CGAL's headers: do not include this in
// headers that do not.

#include <CGAL/version.h>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#include <optional>
#include <variant>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <boost/optional.hpp>
#include <boost/variant.hpp>
#endif

namespace clay::solid::cgal {

#if CGAL_VERSION_MAJOR >= 6
template <class Kernel, class Iterator>
using TrianglePrimitive = CGAL::AABB_triangle_primitive_3<Kernel, Iterator>;
template <class Kernel, class Primitive>
using BoxTraits = CGAL::AABB_traits_3<Kernel, Primitive>;
template <class T>
using Optional = std::optional<T>;
/// triangulate_hole takes the place for new faces as an option, not as an argument.
inline constexpr bool kHoleFacesAreAnOption = true;
#else
template <class Kernel, class Iterator>
using TrianglePrimitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
template <class Kernel, class Primitive>
using BoxTraits = CGAL::AABB_traits<Kernel, Primitive>;
template <class T>
using Optional = boost::optional<T>;
inline constexpr bool kHoleFacesAreAnOption = false;
#endif

/// The intersection as a T; null if it is of another type.
template <class T, class Variant>
[[nodiscard]] const T* get_if(const Variant& intersection) {
#if CGAL_VERSION_MAJOR >= 6
  return std::get_if<T>(&intersection);
#else
  return boost::get<T>(&intersection);
#endif
}

}  // namespace clay::solid::cgal
