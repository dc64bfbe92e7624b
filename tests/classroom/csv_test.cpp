#include "classroom/csv.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/process.h"
#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::classroom::csv_test {

std::vector<std::string> onlyRow(const std::string& text) {
  const std::vector<CsvRow> rows = parseCsv(text, "table.csv");
  EXPECT_EQ(rows.size(), 1u);
  return rows.empty() ? std::vector<std::string>{} : rows.front().fields;
}

TEST(Csv, QuotesWhatNeedsIt) {
  EXPECT_EQ(csvLine({"a", "b c", "", "1.5"}), "a,b c,,1.5\n");
  EXPECT_EQ(csvLine({"a,b", "say \"x\"", "two\nlines"}), "\"a,b\",\"say \"\"x\"\"\",\"two\nlines\"\n");
}

TEST(Csv, KeepsSpreadsheetsFromComputing) {
  EXPECT_EQ(csvLine({"=1+2", "+cmd", "-x", "@sum", "-3", "\t="}), "'=1+2,'+cmd,'-x,'@sum,-3,\"\t'=\"\n");
}

// A file with commas is also opened by programs that split at semicolons or tabs, and wide signs count.
TEST(Csv, KeepsSpreadsheetsFromComputingWhereverTheySplit) {
  EXPECT_EQ(csvLine({"zoe;=1+2"}), "\"zoe;'=1+2\"\n");
  EXPECT_EQ(csvLine({"zoe\t@x"}), "\"zoe\t'@x\"\n");
  EXPECT_EQ(csvLine({"zoe; =1"}), "\"zoe; '=1\"\n");
  EXPECT_EQ(csvLine({"a\n-x"}), "\"a\n'-x\"\n");
  EXPECT_EQ(csvLine({"\uFF1D1", "\uFF0B1", "\uFF0D1", "\uFF20x", "\uFE661", "\u22121"}),
            "'\uFF1D1,'\uFF0B1,'\uFF0D1,'\uFF20x,'\uFE661,'\u22121\n");
  EXPECT_EQ(csvLine({"a-b", "x=1", "zoe@tu.de"}), "a-b,x=1,zoe@tu.de\n");
}

TEST(Csv, ShowsWhatWouldDeceive) {
  EXPECT_EQ(csvLine({"a\u202Eb", "\u2066", "\u2028", "\u200B=1", "\r"}),
            "a\uFFFDb,\uFFFD,\uFFFD,\uFFFD'=1,\uFFFD\n");
}

TEST(Csv, ReadsRowsWithTheirLines) {
  const std::vector<CsvRow> rows =
      parseCsv("\xef\xbb\xbfstudent,submitted\r\n\r\n\"a\nb\",1\r\nc,2", "table.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].fields, (std::vector<std::string>{"student", "submitted"}));
  EXPECT_EQ(rows[1].fields, (std::vector<std::string>{"a\nb", "1"}));
  EXPECT_EQ(rows[1].line, 3);
  EXPECT_EQ(rows[2].fields, (std::vector<std::string>{"c", "2"}));
  EXPECT_EQ(rows[2].line, 5);
}

TEST(Csv, RefusesAQuoteWithoutEnd) {
  EXPECT_REX_ERROR((parseCsv("a\n\"b\n", "table.csv")),
                   "table.csv:2: a quote does not end: wanted a CSV file");
}

std::vector<std::string> randomFields(Rng& rng) {
  constexpr std::string_view kSigns = "ab1,\"\n =+-@\t;'";
  std::vector<std::string> fields(static_cast<std::size_t>(1 + rng.index(4)));
  for (std::string& field : fields)
    for (int size = rng.index(6); size > 0; --size)
      field += kSigns[static_cast<std::size_t>(rng.index(static_cast<int>(kSigns.size())))];
  fields.push_back("end");
  return fields;
}

// Without the ' before signs of formulas.
std::string unguarded(const std::string& text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text[k] != '\'' || text.find_first_of("=+-@", k) != k + 1) plain += text[k];
  return plain;
}

TEST(Csv, ReadsWhatItWrote) {
  Rng rng(11);
  for (int k = 0; k < 20000; ++k) {
    std::vector<std::string> fields = randomFields(rng), read = onlyRow(csvLine(fields));
    ASSERT_EQ(read.size(), fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) EXPECT_EQ(unguarded(read[i]), unguarded(fields[i]));
  }
}

// Python's reader is another opinion on the format.
TEST(Csv, IsReadByOthersAlike) {
  Rng rng(12);
  std::string text;
  for (int k = 0; k < 3000; ++k) text += csvLine(randomFields(rng));
  const ProcessResult python = runProcess({"python3", "-c",
                                           "import csv, io, json, sys\n"
                                           "text = io.TextIOWrapper(sys.stdin.buffer, 'utf-8', newline='')\n"
                                           "print(json.dumps([row for row in csv.reader(text)]))"},
                                          {.input = text});
  if (!python.started) GTEST_SKIP() << "python3 is not installed";
  const nlohmann::json theirs = nlohmann::json::parse(python.output);
  const std::vector<CsvRow> ours = parseCsv(text, "table.csv");
  ASSERT_EQ(theirs.size(), ours.size());
  for (std::size_t k = 0; k < ours.size(); ++k) EXPECT_EQ(theirs[k], nlohmann::json(ours[k].fields));
}

}  // namespace rex::classroom::csv_test
