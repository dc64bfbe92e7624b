#include <gtest/gtest.h>

#include "base/rng.h"
#include "formats/ors_graph_internal.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"

namespace rex::ors::ors_graph_test {

using ::testing::ElementsAre;

Document parse(std::string_view text) { return parseGraph(text, "f"); }

std::vector<std::string> texts(const std::vector<Word>& words) {
  std::vector<std::string> result;
  for (const Word& word : words) result.push_back(word.text);
  return result;
}

template <class T>
T valueOf(std::string_view text) {
  const Graph graph = parse(text).nodes;
  EXPECT_EQ(graph.size(), 1u) << text;
  return std::get<T>(graph.at(0).value);
}

TEST(OrsGraph, ReadsKeysParentsAndValues) {
  const Graph graph =
      parse("body a {x=1, y=2; flag}\n# comment (\njoint j (a b) { type=3 } shape (a){s}").nodes;
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
  const Graph graph = parse("{contact color=[1 0 0]}").nodes;
  const Node& attribute = std::get<Graph>(graph[0].value).at(0);
  EXPECT_THAT(texts(attribute.keys), ElementsAre("contact", "color"));
  EXPECT_EQ(std::get<Eigen::MatrixXd>(attribute.value), Eigen::RowVector3d(1, 0, 0));
}

TEST(OrsGraph, EndsTheKeysAtTheLine) {
  const Graph graph = parse("contact\ncolor=2").nodes;
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

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// What is typed wrongly in a text is tested in ors_messages_test.cpp.
TEST(OrsGraph, KeepsItsLimits) {
  EXPECT_REX_ERROR(parse(std::string(257, 'x')), "f:1:1: word too long: found 257 bytes, wanted at most 256");
  EXPECT_REX_ERROR(parse("a=\"" + std::string(257, 'x') + "\""),
                   "f:1:3: text is too long: found 257 bytes, wanted at most 256");
  EXPECT_EQ(parse(repeated("a{", 100) + repeated("}", 100)).nodes.size(), 1u);
  EXPECT_REX_ERROR(parse(repeated("a{", 200)),
                   "f:1:203: braces nested too deep: found level 101, wanted at most 100");
  EXPECT_EQ(parse(repeated("a\n", 200'000)).nodes.size(), 200'000u);
  EXPECT_REX_ERROR(parse(repeated("a\n", 200'001)), "f:200001:1: too many nodes: wanted at most 200000");
  EXPECT_EQ(std::get<Graph>(parse("a{" + repeated("b,", 256) + "}").nodes[0].value).size(), 256u);
  EXPECT_REX_ERROR(parse("a{" + repeated("b,", 257) + "}"),
                   "f:1:515: too many attributes: wanted at most 256 in one pair of braces");
  EXPECT_EQ(parse(repeated("k ", 64)).nodes[0].keys.size(), 64u);
  EXPECT_REX_ERROR(parse(repeated("k ", 65)), "f:1:129: too many words in a row: wanted at most 64");
  EXPECT_EQ(parse("a (" + repeated("p ", 64) + ")").nodes[0].parents.size(), 64u);
  EXPECT_REX_ERROR(parse("a (" + repeated("p ", 65) + ")"), "f:1:132: too many words in a row");
  EXPECT_EQ(valueOf<Eigen::MatrixXd>("a=[" + repeated("1 ", 10'000) + "]").size(), 10'000);
  EXPECT_REX_ERROR(parse("a=[" + repeated("1 ", 10'001) + "]"),
                   "f:1:3: array too long: wanted at most 10000 numbers");
  EXPECT_REX_ERROR(parse(repeated("a=[" + repeated("1 ", 9'999) + "]\n", 101)),
                   "too many names and numbers: wanted at most 1000000");
  EXPECT_REX_ERROR(parse(repeated("a\nDelete a\n", 257)),
                   "f:514:1: too many statements 'Include', 'ChDir' and 'Delete': wanted at most 256");
  EXPECT_REX_ERROR(parse("a{" + repeated("b,", 256) + "}\nEdit a {c}"),
                   "f:2:9: too many attributes: wanted at most 256 in one pair of braces");
  EXPECT_REX_ERROR(parse("ChDir='" + std::string(200, 'x') + "'\nChDir='" + std::string(200, 'x') + "'"),
                   "f:2:7: ChDir: path too long: found 401 bytes, wanted at most 256");
  EXPECT_REX_ERROR(parse(std::string((32u << 20) + 1, ' ')),
                   "f: scene too large: found 33554433 bytes, wanted at most 32 MiB");
}

// The keys of all nodes, and those of their attributes in braces.
std::string outline(const Graph& graph) {
  std::string text;
  for (const Node& node : graph) {
    if (!text.empty()) text += " | ";
    for (std::size_t i = 0; i < node.keys.size(); ++i) text += (i > 0 ? " " : "") + node.keys[i].text;
    if (const Graph* inner = std::get_if<Graph>(&node.value)) text += "{" + outline(*inner) + "}";
    if (const double* number = std::get_if<double>(&node.value)) text += "=" + std::to_string(int(*number));
  }
  return text;
}

TEST(OrsGraph, DeletesWhatHasAllWords) {
  EXPECT_EQ(outline(parse("body a\nbody b\nshape b\nDelete b\nbody b").nodes), "body a | body b");
  EXPECT_EQ(outline(parse("body a\nbody b\nshape b\nDelete body b").nodes), "body a | shape b");
  EXPECT_EQ(outline(parse("body a { x, y, Delete x, z }").nodes), "body a{y | z}");
  const Document document = parse("body a\nDelete a\nDelete a");
  EXPECT_TRUE(document.nodes.empty());
  ASSERT_EQ(document.notes.size(), 1u);
  EXPECT_EQ(document.notes[0].where.line, 3);
}

TEST(OrsGraph, MergesEditsAtTheEnd) {
  EXPECT_EQ(outline(parse("a {x=1 y=2}\nEdit a {y=3 z=4}\na {}").nodes), "a{x=1 | y=3 | z=4} | a{}");
  EXPECT_EQ(outline(parse("a=1\nMerge a=2\nEdit a=3").nodes), "a=3");
  EXPECT_EQ(outline(parse("a b=1\na=1\nEdit a=2").nodes), "a b=1 | a=2");
  EXPECT_EQ(outline(parse("a {b {x=1} c=1}\nEdit a {b {x=2 y=3}}").nodes), "a{b{x=2 | y=3} | c=1}");
  EXPECT_EQ(outline(parse("a\nEdit a {x=1}").nodes), "a{x=1}");
  // An attribute is found by any of its keys, so the edit must be the only one that has its own.
  EXPECT_EQ(outline(parse("a {contact color=1}\nEdit a {color=2}").nodes), "a{contact=1 | color=2}");
  EXPECT_EQ(outline(parse("a {b c=1 b=2}\nEdit a {b=3}").nodes), "a{c=1 | b=3}");
  const Graph graph = parse("joint j (a b) {}\nEdit joint j (a c) {x}").nodes;
  EXPECT_THAT(texts(graph.at(0).parents), ElementsAre("a", "c"));
}

TEST(OrsGraph, TellsStatementsWithoutANameByTheirParents) {
  const std::string arm = "body a\nbody b\nbody c\njoint (a b) {}\njoint (-3 -2) {}\n";  // b>c
  const auto joints = [&](const std::string& text) {
    return outline(parse(arm + text + "\nDelete body").nodes);
  };
  EXPECT_EQ(joints("Edit joint (b c) {x}"), "joint{} | joint{x}");
  EXPECT_EQ(joints("Edit joint (a b) {x}"), "joint{x} | joint{}");
  EXPECT_EQ(joints("Edit joint (-4 -3) {x}"), "joint{} | joint{x}");
  EXPECT_EQ(joints("Edit joint b>c {x}"), "joint{} | joint{x}");
  EXPECT_EQ(joints("Delete joint (b c)"), "joint{}");
  EXPECT_EQ(joints("Delete joint b>c"), "joint{}");
  EXPECT_EQ(joints("Delete joint"), "");
  const Graph graph = parse(
                          "shape (a) {}\nshape (b) {}\nshape s (a) {}\nshape s (b) {}\n"
                          "Edit shape (b) {x}\nEdit shape s (b) {y}\nEdit shape s (c) {z}")
                          .nodes;
  EXPECT_EQ(outline(graph), "shape{} | shape{x} | shape s{z} | shape s{y}");
  EXPECT_THAT(texts(graph[0].parents), ElementsAre("a"));
  EXPECT_THAT(texts(graph[2].parents), ElementsAre("c"));
  EXPECT_REX_ERROR(parse("joint (arm hand) {}\nEdit joint (arm hnad) {x}"),
                   "f:2:1: nothing to edit: found 'joint (arm hnad)', wanted the words and parents of an "
                   "earlier statement (did you mean 'joint (arm hand)'?)");
  EXPECT_REX_ERROR(parse("joint (arm hand) {}\nEdit joint arm>hnad {x}"),
                   "f:2:1: nothing to edit: found 'joint arm>hnad', wanted the words of an earlier statement "
                   "(did you mean 'joint arm>hand'?)");
  const Diagnostics notes = parse("joint (a b)\nDelete joint (a c)").notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].message, "nothing to delete: no earlier statement has the words 'joint (a c)'");
}

TEST(OrsGraph, CountsParentsBack) {
  const Graph graph = parse("a\nb\nc\nDelete b\nd (-1 -2 -x)").nodes;
  ASSERT_EQ(graph.size(), 3u);
  EXPECT_EQ(graph[2].parents[0].node, graph[1].id);
  EXPECT_EQ(graph[2].parents[1].node, graph[0].id);
  EXPECT_FALSE(graph[2].parents[2].node.has_value());
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

}  // namespace rex::ors::ors_graph_test
