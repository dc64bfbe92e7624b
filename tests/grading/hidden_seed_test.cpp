#include "grading/hidden_seed.h"

#include <set>

#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/temporary_folder.h"

namespace rex::grading::hidden_seed_test {

// The test cases 1, 2, 3 and 6 of RFC 4231.
TEST(HiddenSeed, AgreesWithThePublishedExamples) {
  EXPECT_EQ(hmacSha256(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmacSha256("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmacSha256(std::string(20, '\xaa'), std::string(50, '\xdd')),
            "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe");
  EXPECT_EQ(hmacSha256(std::string(131, '\xaa'), "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
  EXPECT_EQ(hmacSha256(std::string(64, '\xaa'), "a key of one block"),
            "1ad77e19fcc989ac07ba50fafcf71659bdf56d14c6f44efc96e03afe7d1252c4")
      << "of Python's hmac; a key that fills the block is not hashed";
}

TEST(HiddenSeed, DependsOnAllItIsMadeOf) {
  const std::set<std::uint64_t> seeds = {
      hiddenSeed("s", "f", "01", "hidden"), hiddenSeed("t", "f", "01", "hidden"),
      hiddenSeed("s", "g", "01", "hidden"), hiddenSeed("s", "f", "02", "hidden"),
      hiddenSeed("s", "f", "01", "late")};
  EXPECT_EQ(seeds.size(), 5u);
  EXPECT_EQ(hiddenSeed("s", "f", "01", "hidden"), hiddenSeed("s", "f", "01", "hidden"));
}

TEST(CourseSecret, IsToldWhenOthersMayReadIt) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "secret";
  writeTextFile(file, "the secret of the course\n");
  const auto warning = [&](unsigned mode) {
    std::filesystem::permissions(file, static_cast<std::filesystem::perms>(mode));
    return openSecretWarning(file);
  };
  const std::string rest = " may read the secret of the course; `chmod 600` ends that";
  for (const unsigned mode : {0600u, 0400u, 0622u}) EXPECT_EQ(warning(mode), "");
  for (const unsigned mode : {0640u, 0660u})
    EXPECT_EQ(warning(mode), file.string() + ": members of its group" + rest);
  for (const unsigned mode : {0644u, 0604u, 0666u})
    EXPECT_EQ(warning(mode), file.string() + ": other users of this machine" + rest);
  EXPECT_EQ(openSecretWarning(""), "");
  EXPECT_EQ(openSecretWarning(folder.path() / "none"), "");
}

}  // namespace rex::grading::hidden_seed_test
