#include <gtest/gtest.h>

#include "base/rng.h"
#include "geometry/rotation.h"
#include "scene/ors_graph_internal.h"
#include "support/expect_error.h"

namespace rex::ors {
namespace {

using ::testing::ElementsAre;

Graph parse(std::string_view text) { return parseGraph(text, "f"); }

std::vector<std::string> texts(const std::vector<Word>& words) {
  std::vector<std::string> result;
  for (const Word& word : words) result.push_back(word.text);
  return result;
}

template <class T>
T valueOf(std::string_view text) {
  const Graph graph = parse(text);
  EXPECT_EQ(graph.size(), 1u) << text;
  return std::get<T>(graph.at(0).value);
}

TEST(OrsGraph, ReadsKeysParentsAndValues) {
  const Graph graph = parse("body a {x=1, y=2; flag}\n# comment (\njoint j (a b) { type=3 } shape (a){s}");
  ASSERT_EQ(graph.size(), 3u);
  EXPECT_THAT(texts(graph[0].keys), ElementsAre("body", "a"));
  EXPECT_EQ(std::get<Graph>(graph[0].value).size(), 3u);
  EXPECT_THAT(texts(graph[1].parents), ElementsAre("a", "b"));
  EXPECT_EQ(graph[1].where.line, 3);
  EXPECT_EQ(graph[1].where.column, 1);
  EXPECT_EQ(graph[1].parents[1].where.column, 12);
  EXPECT_EQ(graph[1].valueWhere.column, 15);
  EXPECT_THAT(texts(graph[2].keys), ElementsAre("shape"));
}

TEST(OrsGraph, GivesSeveralKeysOneValue) {
  const Graph graph = parse("{contact color=[1 0 0]}");
  const Node& attribute = std::get<Graph>(graph[0].value).at(0);
  EXPECT_THAT(texts(attribute.keys), ElementsAre("contact", "color"));
  EXPECT_EQ(std::get<Eigen::MatrixXd>(attribute.value), Eigen::RowVector3d(1, 0, 0));
}

TEST(OrsGraph, EndsTheKeysAtTheLine) {
  const Graph graph = parse("contact\ncolor=2");
  ASSERT_EQ(graph.size(), 2u);
  EXPECT_EQ(std::get<bool>(graph[0].value), true);
  EXPECT_EQ(std::get<double>(graph[1].value), 2);
}

TEST(OrsGraph, ReadsScalars) {
  EXPECT_EQ(valueOf<bool>("a"), true);
  EXPECT_EQ(valueOf<bool>("a!"), false);
  EXPECT_EQ(valueOf<bool>("a=!"), false);
  EXPECT_EQ(valueOf<bool>("a=false"), false);
  EXPECT_EQ(valueOf<bool>("a = true # yes"), true);
  EXPECT_EQ(valueOf<double>("a=-.5e1"), -5);
  EXPECT_EQ(valueOf<double>("a = +3."), 3);
  EXPECT_EQ(valueOf<std::string>("a=word.x, "), "word.x");
  EXPECT_EQ(valueOf<std::string>("a=\"two # words\""), "two # words");
  EXPECT_EQ(valueOf<FileName>("a='m e.stl'").path, "m e.stl");
  EXPECT_EQ(valueOf<std::string>("a=<Q 1 2>"), "Q 1 2");
}

TEST(OrsGraph, ReadsArrays) {
  EXPECT_EQ(valueOf<Eigen::MatrixXd>("a=[1, 2 3]"), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(valueOf<Eigen::MatrixXd>("a[ ]").size(), 0);
  const Eigen::MatrixXd wanted = (Eigen::MatrixXd(2, 2) << 1, 2, 3, 4).finished();
  EXPECT_EQ(valueOf<Eigen::MatrixXd>("a=[1 2; 3 4]"), wanted);
  EXPECT_EQ(valueOf<Eigen::MatrixXd>("a=[\n1 2\n3 4\n]"), wanted);
  EXPECT_EQ(valueOf<Eigen::MatrixXd>("a=[<2 2> 1 2 3 4]"), wanted);
}

TEST(OrsGraph, ComposesPosesLeftToRight) {
  const Pose X = valueOf<Pose>("a=<T t(1 2 3) d(90 0 0 2) t(1 0 0)>");
  EXPECT_TRUE(isApprox(X, translation(1, 3, 3) * rotation(std::acos(-1) / 2, {0, 0, 1}), 1e-15));
  EXPECT_TRUE(isApprox(valueOf<Pose>("a=<T r(.5 1 0 0)>"), rotation(.5, {1, 0, 0}), 1e-15));
  EXPECT_TRUE(isApprox(valueOf<Pose>("a=<T d(0 0 0 0)>"), Pose{}, 0));
  EXPECT_TRUE(isApprox(valueOf<Pose>("a=<T E(.1 .2 .3)>"),
                       {rotationFromRollPitchYaw({.1, .2, .3}), {0, 0, 0}}, 1e-15));
  const Pose turned{rotationFromQuaternion({2, 0, 0, 2}), {0, 0, 0}};
  EXPECT_TRUE(isApprox(valueOf<Pose>("a=<T|q(1 0 0 1)|>"), turned, 1e-15));
  EXPECT_TRUE(isApprox(valueOf<Pose>("a=<T 1 2 3  1 0 0 1>"), translation(1, 2, 3) * turned, 1e-15));
  EXPECT_TRUE(isApprox(valueOf<Pose>("a <T>"), Pose{}, 0));
}

// QQQ marks the place of the typo in an otherwise right snippet.
TEST(OrsGraph, SaysWhereTheGrammarBreaks) {
  EXPECT_REX_ERROR(parse("body a {\n  x=1\n"), "f:1:8: '{' is never closed: wanted a matching '}'");
  EXPECT_REX_ERROR(parse("body a {x=1}\n}"), "f:2:1: unmatched '}'");
  EXPECT_REX_ERROR(parse("joint (a b {x}"), "f:1:7: '(' is never closed: wanted a ')' before '{x'");
  EXPECT_REX_ERROR(parse("a=1.2QQQ"), "f:1:3: not a number: found '1.2QQQ', wanted a number");
  EXPECT_REX_ERROR(parse("a=1e999"), "f:1:3: not a number: found '1e999'");
  EXPECT_REX_ERROR(parse("a=-inf"), "not a number: found '-inf'");
  EXPECT_REX_ERROR(parse("a=[1 2; 3]"),
                   "f:1:10: row of an array: found 1 numbers, wanted 2 as in the first row");
  EXPECT_REX_ERROR(parse("a=[1 QQQ]"), "f:1:6: not a number: found 'QQQ', wanted a number or ']'");
  EXPECT_REX_ERROR(parse("a=[1 2"), "f:1:3: '[' is never closed");
  EXPECT_REX_ERROR(parse("a=[<2 2> 1 2 3]"), "array with explicit dimensions: found 3 numbers, wanted 2 x 2");
  EXPECT_REX_ERROR(parse("a=[<1 2 3> 1]"), "array dimensions: found 3 of them, wanted one or two");
  EXPECT_REX_ERROR(parse("a=[<1.5> 1]"), "array dimension: found 1.5, wanted a count");
  EXPECT_REX_ERROR(parse("a=\"text"), "f:1:3: text is never closed: wanted a second \"");
  EXPECT_REX_ERROR(parse("a=<Q 1"), "f:1:3: '<' is never closed");
  EXPECT_REX_ERROR(parse("a=<T t(1 2 3)"), "f:1:3: '<T' is never closed");
  EXPECT_REX_ERROR(parse("a=<T t(1 2)>"),
                   "f:1:11: too few numbers in a pose: found ')', wanted three numbers");
  EXPECT_REX_ERROR(parse("a=<T t(1 2 3 4)>"), "pose element 't': found '4', wanted ')' after 3 numbers");
  EXPECT_REX_ERROR(parse("a=<T t 1 2 3>"), "pose element 't': found ' 1', wanted '('");
  EXPECT_REX_ERROR(parse("a=<T s(2)>"), "f:1:6: unknown element of a pose: found 's', wanted t(..)");
  EXPECT_REX_ERROR(parse("a=<T 1 2 3 1 0 0>"),
                   "too few numbers in a pose: found '>', wanted x y z qw qx qy qz");
  EXPECT_REX_ERROR(parse("a=<T q(0 0 0 0)>"), "quaternion: found (0, 0, 0, 0)");
  EXPECT_REX_ERROR(parse("a=)"), "f:1:3: syntax error: found ')', wanted a value");
  EXPECT_REX_ERROR(parse("a b ) c"), "f:1:5: syntax error: found ')', wanted a name");
  EXPECT_REX_ERROR(parse("a=\x01"), "found '\\x01'");
  EXPECT_REX_ERROR(parse(";"), "f:1:1: syntax error: found ';', wanted a name such as 'body'");
  EXPECT_REX_ERROR(parse("a="), "found the end of the file, wanted a value");
  EXPECT_REX_ERROR(parse(std::string(300, 'x')), "name too long: found 300 bytes, wanted at most 256");
  std::string deep;
  for (int i = 0; i < 200; ++i) deep += "a{";
  EXPECT_REX_ERROR(parse(deep), "braces nested too deep: found level 101, wanted at most 100");
  std::string many;
  for (int i = 0; i < 200001; ++i) many += "a\n";
  EXPECT_REX_ERROR(parse(many), "too many nodes: wanted at most 200000");
}

TEST(OrsGraph, SurvivesDamagedText) {
  const std::string good =
      "body a { X=<T t(0 0 1) d(90 1 0 0)> size=[1 2; 3 4] name=\"x\" f='y' contact! }\njoint (a a) {q=1}\n";
  Rng rng(1);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good.substr(0, static_cast<std::size_t>(rng.index(static_cast<int>(good.size())) + 1));
    for (int k = rng.index(4); k > 0; --k)
      text[static_cast<std::size_t>(rng.index(static_cast<int>(text.size())))] =
          static_cast<char>(rng.index(256));
    try {
      static_cast<void>(parse(text));
    } catch (const Error& error) {
      ++refused;
      ASSERT_TRUE(std::string_view(error.what()).starts_with("f:")) << error.what();
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace rex::ors
