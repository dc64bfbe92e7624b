#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/text.h"

namespace rex::join_test {

TEST(Join, PutsTextBetweenNeighboursOnly) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(join(Texts{}, ", "), "");
  EXPECT_EQ(join(Texts{"a"}, ", "), "a");
  EXPECT_EQ(join(Texts{"a", "", "c"}, ", "), "a, , c");
}

TEST(Join, TakesAllKindsOfTexts) {
  const std::vector<std::string> texts{"one", "two", "three"};
  EXPECT_EQ(join(std::span(texts).first(2), " and "), "one and two");
  EXPECT_EQ(join(std::set<std::string>{"b", "a"}, ""), "ab");
  EXPECT_EQ(join(std::array{"x", "y"}, "; "), "x; y");
  EXPECT_EQ(join(std::vector<std::string_view>{"x", "y"}, "\n"), "x\ny");
}

}  // namespace rex::join_test
