// The mechanism behind the options of all commands; what each accepts is said by its table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/option_table_internal.h"
#include "support/expect_error.h"

namespace rex::cli::option_table_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

enum class Way { kShort, kLong };

struct Options {
  double width = 0.3;
  int count = 7;
  std::optional<double> margin{};
  Way way = Way::kLong;
  bool quiet = false;
  std::string name{};
  std::filesystem::path out{};
  std::vector<std::string> bodies{};
  std::uint64_t seed = 4;
};

class Table : public ::testing::Test {
 protected:
  Table() {
    added_ = addOptions(&command_,
                        {{"--width", options_.width, {0.1, 2}, "METRES", "how wide"},
                         {"--count",
                          options_.count,
                          {1, 9},
                          "N",
                          "how many, in a help text that is longer than one line has room for"},
                         {"--margin", options_.margin, {0, 1}, "METRES", "how far"},
                         {"--way", options_.way, {{"short", Way::kShort}, {"long", Way::kLong}}, "which way"},
                         {"--quiet", options_.quiet, "print nothing"},
                         {"--name", options_.name, "TEXT", "a name"},
                         OptionRow("-o,--out", options_.out, "DIR", "folder").required(),
                         {"--body", options_.bodies, "NAME", "may be repeated"},
                         seedRow(options_.seed)},
                        "Shape");
  }
  void parse(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "out"});
    command_.parse(std::vector(words.rbegin(), words.rend()));
  }

  CLI::App command_;
  Options options_;
  std::vector<CLI::Option*> added_;
};

TEST_F(Table, SetsItsVariables) {
  parse({"--width", "2", "--count=1", "--margin", "0.5", "--way", "short", "--quiet", "--name", "x", "--body",
         "a", "--body", "b", "--seed", "9"});
  EXPECT_EQ(options_.width, 2);
  EXPECT_EQ(options_.count, 1);
  EXPECT_EQ(options_.margin, 0.5);
  EXPECT_EQ(options_.way, Way::kShort);
  EXPECT_TRUE(options_.quiet);
  EXPECT_EQ(options_.name, "x");
  EXPECT_EQ(options_.out, "out");
  EXPECT_THAT(options_.bodies, ElementsAre("a", "b"));
  EXPECT_EQ(options_.seed, 9u);
  EXPECT_EQ(added_.size(), 9u);
}

TEST_F(Table, LeavesDefaultsAndPrintsThem) {
  parse({});
  EXPECT_EQ(options_.width, 0.3);
  EXPECT_FALSE(options_.margin);
  EXPECT_EQ(options_.way, Way::kLong);
  const std::string help = command_.help();
  for (const char* text :
       {"--width METRES", "how wide (default: 0.3)", "(default: 7)", "which way: short, long (default: long)",
        "seed of the random numbers (default: 4)", "Shape:", "REQUIRED"})
    EXPECT_THAT(help, HasSubstr(text));
  for (std::size_t start = 0; start < help.size(); start = std::min(help.find('\n', start), help.size()) + 1)
    EXPECT_LE(std::min(help.find('\n', start), help.size()) - start, 90u) << help;
}

TEST_F(Table, RefusesWhatIsOutOfRangeWithBothEnds) {
  EXPECT_REX_ERROR(parse({"--width", "0"}), "--width: found 0, wanted 0.1 to 2");
  EXPECT_REX_ERROR(parse({"--width", "nan"}), "--width: found nan, wanted 0.1 to 2");
  EXPECT_REX_ERROR(parse({"--count", "10"}), "--count: found 10, wanted 1 to 9");
  EXPECT_REX_ERROR(parse({"--margin", "-1"}), "--margin: found -1, wanted 0 to 1");
  EXPECT_REX_ERROR(parse({"--way", "shrt"}),
                   "--way: found 'shrt', wanted short, long (did you mean 'short'?)");
  EXPECT_THROW(parse({"--count", "1.5"}), CLI::ConversionError);
  EXPECT_THROW(parse({"--width", "wide"}), CLI::ConversionError);
  EXPECT_THROW(parse({"--seed", "-1"}), CLI::ValidationError);
  EXPECT_THROW(command_.parse(std::vector<std::string>{}), CLI::RequiredError);
}

}  // namespace rex::cli::option_table_test
