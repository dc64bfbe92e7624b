#include "grading/sha256.h"

#include <gtest/gtest.h>

#include "base/process.h"

namespace rex::grading {
namespace {

TEST(Sha256, GivesThePublishedHashes) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, AgreesWithCoreutilsAroundTheBlockSizes) {
  for (const std::size_t size : {1u, 54u, 55u, 56u, 57u, 63u, 64u, 65u, 119u, 120u, 128u, 5000u}) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(i * 151 + size);
    EXPECT_EQ(sha256(bytes), runProcess({"sha256sum"}, {.input = bytes}).output.substr(0, 64)) << size;
  }
}

}  // namespace
}  // namespace rex::grading
