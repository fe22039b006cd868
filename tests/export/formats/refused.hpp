#pragma once
#include "claystack/core/result.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::solid::samples {

/// An error of this kind, for this reason.
template <class T>
::testing::AssertionResult refused(const Result<T>& result, ErrorKind kind,
                                   const std::string& because) {
  if (result) return ::testing::AssertionFailure() << "was accepted";
  if (result.error().kind != kind || result.error().message.find(because) == std::string::npos)
    return ::testing::AssertionFailure() << result.error().message;
  return ::testing::AssertionSuccess();
}

}  // namespace clay::solid::samples
