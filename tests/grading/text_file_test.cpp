#include "grading/text_file.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::grading {
namespace {

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
                   temporary.path().string() + ": cannot write this file");
}

}  // namespace
}  // namespace rex::grading
