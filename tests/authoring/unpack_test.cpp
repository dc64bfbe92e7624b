#include <gtest/gtest.h>

#include "authoring/leak_scan.h"
#include "base/process.h"
#include "base/rng.h"
#include "base/text_file.h"
#include "submission/zip_file.h"
#include "support/archive_samples.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::authoring::unpack_test {

// Programs that share no code with us pack them.
TEST(Unpack, ReadsWhatOthersPack) {
  const TemporaryFolder folder;
  writeTextFile(folder.path() / "a.txt", "the text\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> ways = {
      {{"tar", "cf", "p", "a.txt"}, "a.txt"},  {{"tar", "czf", "p", "a.txt"}, "a.txt"},
      {{"tar", "cJf", "p", "a.txt"}, "a.txt"}, {{"tar", "cjf", "p", "a.txt"}, "a.txt"},
      {{"sh", "-c", "gzip -c a.txt >p"}, ""},  {{"sh", "-c", "xz -c a.txt >p"}, ""},
      {{"sh", "-c", "bzip2 -c a.txt >p"}, ""}};
  int tried = 0;
  for (const auto& [command, name] : ways) {
    if (!runProcess(command, {.directory = folder.path()}).ok()) continue;
    const std::string bytes = readTextFile(folder.path() / "p");
    EXPECT_TRUE(isPacked(bytes)) << command.back();
    const auto files = unpack(bytes, "p");
    ASSERT_EQ(files.size(), 1u) << command.back();
    EXPECT_EQ(files[0].name, name) << command.back();
    EXPECT_EQ(files[0].bytes, "the text\n");
    ++tried;
  }
  EXPECT_GE(tried, 2) << "tar is always there";
}

TEST(Unpack, ReadsZipFiles) {
  const TemporaryFolder folder;
  submission::writeZip(folder.path() / "a.zip", {{"b/c.txt", "one"}, {"d", ""}});
  const std::string bytes = readTextFile(folder.path() / "a.zip");
  EXPECT_TRUE(isPacked(bytes));
  const auto files = unpack(bytes, "a.zip");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "b/c.txt");
  EXPECT_EQ(files[0].bytes, "one");
}

TEST(Unpack, LeavesOtherFilesAlone) {
  for (const char* text : {"", "text", "BZ", "PK and more",
                           "\x7f"
                           "ELF",
                           "\x89PNG\r\n\x1a\n"})
    EXPECT_FALSE(isPacked(text)) << text;
}

TEST(Unpack, RefusesWhatIsBroken) {
  std::string bytes = zipOf({{.name = "a", .text = std::string(3000, 'x')}});
  EXPECT_REX_ERROR(unpack(bytes.substr(0, 200), "a.zip"), "a.zip: cannot look into this archive: found ");
  EXPECT_REX_ERROR(unpack("BZh nothing of that kind", "b"), "b: cannot look into this archive: found ");
  Rng rng(3);
  for (int k = 0; k < 200; ++k) {
    std::string bad = bytes;
    for (int n = 0; n < 5; ++n)
      bad[static_cast<std::size_t>(rng.index(static_cast<int>(bad.size())))] =
          static_cast<char>(rng.index(256));
    try {
      static_cast<void>(unpack(bad, "c"));
    } catch (const Error&) {
    }
  }
}

}  // namespace rex::authoring::unpack_test
