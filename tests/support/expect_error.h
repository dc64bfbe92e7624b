#pragma once

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace rex {

/// The message of the Error that the action throws, or "no error".
template <class Action>
std::string messageOf(const Action& action) {
  try {
    static_cast<void>(action());
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace rex

/// Expects that the statement throws rex::Error with `text` in its message.
#define EXPECT_REX_ERROR(statement, text)                    \
  do {                                                       \
    try {                                                    \
      static_cast<void>(statement);                          \
      ADD_FAILURE() << "no error from " #statement;          \
    } catch (const ::rex::Error& error) {                    \
      EXPECT_THAT(error.what(), ::testing::HasSubstr(text)); \
    }                                                        \
  } while (false)
