#include "base/sha256.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::grading::sha256_test {

TEST(Sha256, GivesThePublishedHashes) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, SaysWhenTheProgramIsMissing) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_REX_ERROR(sha256("abc"),
                   "cannot run sha256sum: found No such file or directory, wanted the package coreutils");
  ::setenv("PATH", path.c_str(), 1);
}

}  // namespace rex::grading::sha256_test
