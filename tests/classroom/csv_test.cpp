#include "classroom/csv.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/process.h"
#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::grading::csv_test {

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
  EXPECT_EQ(csvLine({"=1+2", "+cmd", "-x", "@sum", "-3", "\t="}), "'=1+2,'+cmd,'-x,'@sum,-3,'\t=\n");
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

TEST(Csv, ReadsWhatItWrote) {
  Rng rng(11);
  for (int k = 0; k < 20000; ++k) {
    std::vector<std::string> fields = randomFields(rng), read = onlyRow(csvLine(fields));
    ASSERT_EQ(read.size(), fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i)
      EXPECT_TRUE(read[i] == fields[i] || read[i] == "'" + fields[i]) << read[i] << " of " << fields[i];
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

}  // namespace rex::grading::csv_test
