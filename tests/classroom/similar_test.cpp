#include "classroom/similar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/isolated_call.h"
#include "base/rng.h"
#include "base/text.h"
#include "support/slow_sources.h"

namespace rex::classroom::similar_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHandedOut = R"(#include "exercise.h"

// The mean of some numbers, which are at least one, computed without the library of the course at all.
double mean(const std::vector<double>& values) {
  return 0;
}

int main() {
  const std::vector<double> some = {1, 2, 3, 4, 5, 6, 7, 8};
  for (std::size_t k = 0; k < some.size(); ++k) std::printf("%g %g\n", some[k], mean({some[k], some[0]}));
  return some.empty() ? 1 : 0;
}
)";

// The handed-out text with another body of the function.
std::string with(const std::string& body) {
  std::string text = kHandedOut;
  return text.replace(text.find("  return 0;\n"), 12, body);
}

const std::string kLoop = R"(  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    sum = sum + values[k];
  }
  const double count = static_cast<double>(values.size());
  return sum / count;
)";
const std::string kRenamed = R"(  double total = 0;  // of all
  for (std::size_t number = 0; number < values.size(); ++number) { total = total + values[number]; }
  const double howMany = static_cast<double>(values.size());
  return total / howMany;
)";
const std::string kOwn =
    R"(  return std::accumulate(values.begin(), values.end(), 0.0, [](double a, double b) { return a + b; }) *
         std::pow(double(values.size()), -1);
)";

// Shapes that hold up a reader of lines.
TEST(SimilarTexts, AreReadInTime) {
  SimilarPair pair{.first = "a", .second = "b"};
  for (int k = 1; k < 20'000; ++k) pair.runs.push_back({{k, k + 9}, {k, k + 9}});
  for (const auto& [shape, text] : submission::slowSources()) {
    const auto read = [&] {
      const std::string page = similarPage("01", {{"a", text}, {"b", "int a;\n"}}, "", {pair});
      return std::to_string(page.size() + withoutHandedOut(text, kHandedOut).size());
    };
    EXPECT_EQ(callIsolated(read, {.cpuSeconds = 3}).end, IsolatedEnd::kReturned) << shape;
  }
}

std::vector<SimilarPair> pairsOf(const std::vector<ComparedText>& texts, int percent = 70) {
  return similarPairs(texts, kHandedOut, percent);
}

TEST(Similar, FindsARenamedCopyAndNothingElse) {
  const std::vector<ComparedText> texts = {
      {"anna", with(kLoop)}, {"bert", with(kOwn)}, {"carl", with(kRenamed)}};
  const std::vector<SimilarPair> pairs = pairsOf(texts);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, "anna");
  EXPECT_EQ(pairs[0].second, "carl");
  EXPECT_GE(std::min(pairs[0].firstPercent, pairs[0].secondPercent), 90);
  ASSERT_FALSE(pairs[0].runs.empty());
  EXPECT_EQ(pairs[0].runs[0].first.first, 5) << "where the function begins";
  EXPECT_GE(pairs[0].runs[0].first.second, 10);
  EXPECT_EQ(pairs[0].runs[0].second.first, 5);
  EXPECT_GE(pairs[0].runs[0].second.second, 8);
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + by.size()))
    text.replace(at, part.size(), by);
  return text;
}

// What a regular expression can put into a copy.
TEST(Similar, CountsNothingThatDoesNothing) {
  const std::string unlike = "#if 0\n" + kOwn + "don't\n#ifdef X\n" + kOwn + "#endif\n#endif\n";
  const std::string padded[] = {
      replaced(kLoop, ";\n", "; ;\n"),
      replaced(kLoop, ";\n", ";;;;\n"),
      replaced(kLoop, "  const", "  (void)0; const"),
      replaced(kLoop, ";\n", "; (void)sizeof(int); ; (void)[&] { f(1); g(2); }();\n"),
      replaced(kLoop, ";\n", ";\n" + unlike),
      replaced(kLoop, ";\n", ";\n#if false\nint a;\n#endif\n"),
      replaced(kLoop, "  return", "#if 0\n" + kOwn + "#else\n  return") + "#endif\n"};
  for (const std::string& copy : padded) {
    const auto pairs = pairsOf({{"anna", with(kLoop)}, {"bert", with(copy)}});
    ASSERT_EQ(pairs.size(), 1u) << copy;
    EXPECT_GE(std::min(pairs[0].firstPercent, pairs[0].secondPercent), 90) << copy;
  }
  EXPECT_TRUE(pairsOf({{"anna", with(kOwn)}, {"bert", with(replaced(kLoop, ";\n", ";\n" + unlike))}}).empty())
      << "is only alike in what is skipped";
  for (const std::string broken : {"#if 0", "#if", "#if 0\n#if 0\n#endif", "(void)", "(void)(", "{(void)}"})
    EXPECT_TRUE(pairsOf({{"anna", broken}, {"bert", broken}}).empty()) << broken;
}

TEST(Similar, ListsAFileThatIsContainedInAnother) {
  const std::string more =
      replaced(kOwn, "0.0", "1.5") + "  return std::sort(values) ? values[0] : -values[1];\n";
  const std::vector<ComparedText> texts = {{"anna", with(kLoop)}, {"bert", with(kLoop + more + more)}};
  const std::vector<SimilarPair> pairs = pairsOf(texts);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_GE(pairs[0].firstPercent, 90);
  EXPECT_LT(pairs[0].secondPercent, 70);
  EXPECT_TRUE(
      pairsOf(
          {texts[0], {"bert", with(replaced(kLoop, "(values.size())", "(1 + 2 * 3 - 4) + 5") + more + more)}})
          .empty())
      << "is contained in part";
}

// main() would be alike in all.
TEST(Similar, IgnoresWhatWasHandedOut) {
  EXPECT_TRUE(pairsOf({{"anna", kHandedOut}, {"bert", kHandedOut}}).empty());
  EXPECT_EQ(similarPairs({{"anna", kHandedOut}, {"bert", kHandedOut}}, "", 70).size(), 1u);
  EXPECT_EQ(withoutHandedOut("  a\nb\n\n c\n}\n", "a\nc\n}\n"), "\nb\n\n\n}\n");
}

TEST(Similar, ComparesNoneAndOne) {
  EXPECT_TRUE(pairsOf({}).empty());
  EXPECT_TRUE(pairsOf({{"anna", with(kLoop)}}).empty());
}

// Found by trying all pairs of positions.
std::size_t longestCommonRun(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) {
      std::size_t n = 0;
      while (i + n < a.size() && k + n < b.size() && a[i + n] == b[k + n]) ++n;
      longest = std::max(longest, n);
    }
  return longest;
}

TEST(Similar, MissesNoLongRunAndTakesNoShortOne) {
  Rng rng(1);
  const auto signs = [&](int count) {
    std::vector<std::string> all;
    for (int k = 0; k < count; ++k)
      all.push_back(std::string(1, "+-*/%&|^"[static_cast<std::size_t>(rng.uniform(0, 8))]));
    return all;
  };
  const auto textOf = [](const std::vector<std::string>& all) { return join(all, " "); };
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::string> a = signs(60), b = signs(50);
    const std::vector<std::string> common = signs(16 + trial % 16);
    a.insert(a.begin() + trial % 50, common.begin(), common.end());
    b.insert(b.begin() + trial % 37, common.begin(), common.end());
    const bool isLong = longestCommonRun(a, b) >= 24;
    const auto pairs = similarPairs({{"a", textOf(a)}, {"b", textOf(b)}}, "", 1);
    EXPECT_EQ(!pairs.empty(), isLong) << trial;
    found += isLong ? 1 : 0;
  }
  EXPECT_GT(found, 80);
  EXPECT_LT(found, 120);
}

// Files that repeat themselves hold up nobody.
TEST(Similar, TakesLittleTimeForAnyFile) {
  std::string numbers = "int a[] = {";
  for (int k = 0; k < 100'000; ++k) numbers += "1, ";
  const auto compare = [&] {
    return std::to_string(
        similarPairs({{"a", numbers}, {"b", numbers + "2"}, {"c", numbers}}, "", 70).size());
  };
  const IsolatedResult result = callIsolated(compare, {.cpuSeconds = 10});
  EXPECT_EQ(result.end, IsolatedEnd::kReturned);
}

TEST(Similar, JoinsPairsToGroups) {
  const std::vector<SimilarPair> pairs = {{.first = "b", .second = "c"},
                                          {.first = "x", .second = "y"},
                                          {.first = "a", .second = "c"},
                                          {.first = "a", .second = "b"}};
  EXPECT_THAT(similarGroups(pairs), ElementsAre(ElementsAre("a", "b", "c"), ElementsAre("x", "y")));
  EXPECT_TRUE(similarGroups({}).empty());
}

TEST(Similar, ShowsPairsSideBySideAsTextOnly) {
  const std::vector<ComparedText> texts = {{"<b>anna", with("  return \"<script>\";\n")},
                                           {"carl", with(kOwn)}};
  const SimilarPair pair{.first = "<b>anna",
                         .second = "carl",
                         .firstPercent = 81,
                         .secondPercent = 72,
                         .runs = {{.first = {5, 5}, .second = {5, 6}}}};
  const std::string page = similarPage("01-a", texts, kHandedOut, {pair});
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page,
              HasSubstr("81 % of &#60;b&#62;anna is also in carl, 72 % of carl is also in &#60;b&#62;anna."));
  EXPECT_THAT(page, HasSubstr("<span class=\"alike\">   5    return &#34;&#60;script&#62;&#34;;</span>"));
  EXPECT_THAT(page, HasSubstr("<span class=\"given\">   1  #include &#34;exercise.h&#34;</span>"));
  EXPECT_THAT(page, HasSubstr("<li><a href=\"#pair-1\">&#60;b&#62;anna and carl</a>: 81 %, 72 %</li>"));
  EXPECT_THAT(page, HasSubstr("this page decides nothing"));
}

}  // namespace rex::classroom::similar_test
