#include "base/text_file.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::text_file_test {

TEST(TextFile, KeepsEveryByteAndMakesFolders) {
  const TemporaryFolder temporary;
  const std::string text("a\r\nb\0c", 7);
  writeTextFile(temporary.path() / "new" / "file", text);
  EXPECT_EQ(readTextFile(temporary.path() / "new" / "file"), text);
}

TEST(TextFile, NamesTheFileInComplaints) {
  const TemporaryFolder temporary;
  EXPECT_REX_ERROR(readTextFile(temporary.path()), temporary.path().string() + ": cannot read this file");
  EXPECT_REX_ERROR(readTextFile("no/such/file"), "no/such/file: cannot read this file");
  EXPECT_REX_ERROR(writeTextFile(temporary.path(), ""),
                   temporary.path().string() + ": cannot write this file: found Is a directory");
}

TEST(TextFile, IsReplacedWithoutATrace) {
  const TemporaryFolder temporary;
  const std::filesystem::path file = temporary.path() / "file";
  for (const char* text : {"one", "another, longer one", ""}) {
    replaceTextFile(file, text, "the notes");
    EXPECT_EQ(readTextFile(file), text);
  }
  std::filesystem::create_directory(temporary.path() / "taken");
  EXPECT_REX_ERROR(replaceTextFile(temporary.path() / "taken", "x", "the notes"),
                   "taken: cannot write the notes: found Is a directory");
  EXPECT_REX_ERROR(replaceTextFile(temporary.path() / "no" / "file", "x", "the notes"),
                   "file: cannot write the notes: found No such file or directory");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(temporary.path()), {}), 2);
}

}  // namespace rex::text_file_test
