#include "base/toml_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::toml_table_test {

class TomlTableTest : public ::testing::Test {
 protected:
  TomlTable table(const std::string& text) const {
    writeTextFile(file_, text);
    return TomlTable::read(file_, "the file", "a table");
  }
  std::string at(const std::string& rest) const { return file_.string() + rest; }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.toml";
};

TEST_F(TomlTableTest, GivesWhatIsThere) {
  const TomlTable top = table(
      "name = 'x'\ncount = 3\nshare = 0.5\nwords = ['a', 'b']\nkind = 'two'\n"
      "due = 1970-01-01T01:00:10+01:00\nlater = 1970-01-01T01:00:11.75+01:00\nday = 2026-11-20\n[inner]\nkey "
      "= 1\n[[row]]\nn = "
      "1\n[[row]]\nn = 2\n");
  EXPECT_EQ(top.text("name"), "x");
  EXPECT_EQ(top.integer("count", 0, 5), 3);
  EXPECT_EQ(top.number("share", 0, 1), 0.5);
  EXPECT_THAT(top.texts("words"), testing::ElementsAre("a", "b"));
  EXPECT_EQ((top.choice<int>("kind", {{"one", 1}, {"two", 2}})), 2);
  EXPECT_EQ(top.instant("due"), 10);
  EXPECT_EQ(top.instant("later"), 11);
  EXPECT_EQ(top.day("day"), "2026-11-20");
  EXPECT_EQ(top.table("inner", "[inner]", "a table")->integer("key", 0, 9), 1);
  EXPECT_FALSE(top.table("none", "[none]", "a table"));
  EXPECT_EQ(top.tables("row").at(1).integer("n", 0, 9), 2);
  EXPECT_TRUE(top.tables("none").empty());
  EXPECT_THAT(top.keys(), testing::Contains("share"));
}

// A table outlives what it was read from.
TEST_F(TomlTableTest, KeepsTheFileAlive) {
  const TomlTable inner = *table("[inner]\nkey = 7\n").table("inner", "[inner]", "a table");
  EXPECT_EQ(inner.integer("key", 0, 9), 7);
}

TEST_F(TomlTableTest, NamesThePlaceOfWhatIsWrong) {
  const TomlTable top = table("name = ''\ncount = 9\n");
  EXPECT_REX_ERROR((void)top.text("name"), at(":1:8: the file: 'name'"));
  EXPECT_REX_ERROR((void)top.integer("count", 0, 5), at(":2:9: the file: 'count'"));
  EXPECT_REX_ERROR((void)top.text("title"), "the file: no 'title'");
  EXPECT_REX_ERROR((void)top.day("count"), "wanted a date without a time, such as 2026-11-20");
  EXPECT_REX_ERROR((void)top.table("count", "[count]", "a table headed [count]"), at(":2:9: 'count'"));
  EXPECT_REX_ERROR((void)top.tables("count"), "tables headed [[count]]");
  EXPECT_REX_ERROR(top.refuseKeysBut({"name", "counts"}), "unknown key 'count' in the file");
  EXPECT_REX_ERROR((void)table("x = \n"), at(":1:"));
  EXPECT_REX_ERROR((void)TomlTable::read(folder_.path() / "none.toml", "x", "deadlines"), "no such file");
}

}  // namespace rex::toml_table_test
