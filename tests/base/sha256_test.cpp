#include "base/sha256.h"

#include <gtest/gtest.h>

#include "base/process.h"

namespace rex::sha256_test {

TEST(Sha256, GivesThePublishedHashes) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, AgreesWithTheProgramOfCoreutils) {
  std::string bytes;
  for (int i = 0; i < 100000; ++i) bytes += static_cast<char>(i % 251 * (i % 97) % 256);
  EXPECT_EQ(sha256(bytes), runProcess({"sha256sum"}, {.input = bytes}).output.substr(0, 64));
}

}  // namespace rex::sha256_test
