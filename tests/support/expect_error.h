#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

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
