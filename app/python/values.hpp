#pragma once
// Values for Python: errors, texts and warnings.

#include "claystack/core/result.hpp"

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace clay::python {

namespace py = pybind11;

/// Becomes claystack.Error, with its kind.
struct Failed {
  Error error;
};

template <class T>
T value_of(Result<T> result) {
  if (!result) throw Failed{std::move(result.error())};
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// Text with names of files in it, as Python has them: bytes that are not UTF-8 become surrogates.
inline py::str text_of(std::string_view text) {
  PyObject* const made =
      PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<py::ssize_t>(text.size()));
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

/// `value`, and the warnings about it.
template <class Value>
py::tuple with_warnings(Value value, const std::vector<std::string>& warnings) {
  py::list list;
  for (const std::string& warning : warnings) list.append(text_of(warning));
  return py::make_tuple(std::move(value), std::move(list));
}

}  // namespace clay::python
