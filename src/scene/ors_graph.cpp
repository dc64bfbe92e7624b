#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "geometry/rotation.h"
#include "scene/ors_graph_internal.h"

namespace rex::ors {
namespace {

constexpr int kDeepest = 100;
constexpr int kMostNodes = 200'000;
constexpr std::size_t kLongestWord = 256;

bool contains(std::string_view set, char c) { return set.find(c) != std::string_view::npos; }

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Graph file() {
    Graph nodes = graph(0);
    if (!atEnd()) fail("unmatched '}'", "", "a body, shape or joint, or the end of the file");
    return nodes;
  }

 private:
  bool atEnd() const { return at_ >= text_.size(); }
  char peek() const { return atEnd() ? '\0' : text_[at_]; }
  SourceLocation here() const { return {file_, line_, static_cast<int>(at_ - lineStart_) + 1}; }

  char take() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++line_;
      lineStart_ = at_;
    }
    return c;
  }

  void skip(std::string_view set) {
    while (!atEnd() && contains(set, peek())) take();
  }

  void skipSpaceAndComments() {
    for (;;) {
      skip(" \t\r\n,");
      if (peek() != '#') return;
      while (!atEnd() && peek() != '\n') take();
    }
  }

  // What stands here, short enough for a message.
  std::string found() const {
    if (atEnd()) return "the end of the file";
    if (peek() == '\n' || peek() == '\r') return "the end of the line";
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n,;(){}[]<>=", at_ + 1), at_ + 40);
    std::string shown;
    for (const char c : text_.substr(at_, std::min(end, text_.size()) - at_)) {
      const auto byte = static_cast<unsigned char>(c);
      shown += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    }
    return "'" + shown + "'";
  }

  [[noreturn]] void fail(std::string what, std::string found, std::string wanted) const {
    throw Error(
        {.what = std::move(what), .where = here(), .found = std::move(found), .wanted = std::move(wanted)});
  }
  [[noreturn]] void failAt(const SourceLocation& where, std::string what, std::string wanted) const {
    throw Error({.what = std::move(what), .where = where, .wanted = std::move(wanted)});
  }

  Graph graph(int depth) {
    if (depth > kDeepest)
      fail("braces nested too deep", fmt::format("level {}", depth), fmt::format("at most {}", kDeepest));
    Graph nodes;
    for (skipSpaceAndComments(); !atEnd() && peek() != '}'; skipSpaceAndComments()) {
      if (++count_ > kMostNodes) fail("too many nodes", "", fmt::format("at most {}", kMostNodes));
      nodes.push_back(node(depth));
    }
    return nodes;
  }

  Node node(int depth) {
    Node node;
    node.where = node.valueWhere = here();
    for (skip(" \t"); !atEnd() && !contains("\r\n,;([{}=!<#", peek()); skip(" \t"))
      node.keys.push_back(key());
    if (peek() == '(') {
      node.parents = parents();
      skip(" \t\r\n");
    }
    if (contains("=[{<!", peek()) && !atEnd()) {
      if (peek() == '=') {
        take();
        skip(" \t\r\n");
      }
      node.valueWhere = here();
      node.value = value(depth);
    } else if (node.keys.empty() && node.parents.empty()) {
      fail("syntax error", found(), "a name such as 'body', 'shape' or 'joint'");
    }
    skip(" \t");
    if (peek() == ',' || peek() == ';') take();
    return node;
  }

  Word key() {
    const SourceLocation where = here();
    if (contains(")]>\"'", peek())) fail("syntax error", found(), "a name");
    return {word(" \t\r\n,;([{}=!"), where};
  }

  std::string word(std::string_view terminators) {
    const std::size_t start = at_;
    while (!atEnd() && !contains(terminators, peek())) take();
    if (at_ - start > kLongestWord)
      fail("name too long", fmt::format("{} bytes", at_ - start), fmt::format("at most {}", kLongestWord));
    return std::string(text_.substr(start, at_ - start));
  }

  std::vector<Word> parents() {
    const SourceLocation open = here();
    take();
    std::vector<Word> names;
    for (skip(" \t\r\n,"); peek() != ')'; skip(" \t\r\n,")) {
      if (atEnd() || contains("({}[]=", peek()))
        failAt(open, "'(' is never closed", fmt::format("a ')' before {}", found()));
      const SourceLocation where = here();
      names.push_back({word(" \t\r\n,)({}[]="), where});
    }
    take();
    return names;
  }

  Value value(int depth) {
    const char c = peek();
    if (c == '{') return braces(depth);
    if (c == '[') return array();
    if (c == '<') return typed();
    if (c == '"') return quoted('"');
    if (c == '\'') return FileName{quoted('\'')};
    if (c == '!') {
      take();
      return false;
    }
    if (contains("+-.0123456789", c) && !atEnd()) return number("a number");
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      std::string text = word(" \t\r\n,;}");
      if (text == "true") return true;
      if (text == "false") return false;
      return text;
    }
    fail("syntax error", found(), "a value: a number, word, \"text\", [array], <T pose> or {attributes}");
  }

  Graph braces(int depth) {
    const SourceLocation open = here();
    take();
    Graph nodes = graph(depth + 1);
    if (atEnd()) failAt(open, "'{' is never closed", "a matching '}' before the end of the file");
    take();
    return nodes;
  }

  std::string quoted(char quote) {
    const SourceLocation open = here();
    take();
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos)
      failAt(open, "text is never closed", fmt::format("a second {}", quote));
    const std::string text(text_.substr(at_, end - at_));
    while (at_ <= end) take();
    return text;
  }

  double number(const char* wanted) {
    const std::string shown = found();
    const std::size_t start = peek() == '+' ? at_ + 1 : at_;
    double parsed = 0;
    const auto [end, error] = std::from_chars(text_.data() + start, text_.data() + text_.size(), parsed);
    const bool followed = end == text_.data() + text_.size() || contains(" \t\r\n,;})]>", *end);
    if (error != std::errc() || !followed || !std::isfinite(parsed)) fail("not a number", shown, wanted);
    at_ = static_cast<std::size_t>(end - text_.data());
    return parsed;
  }

  // [1 2 3], [1 2; 3 4], rows also by line ends, or [<2 2> 1 2 3 4] with explicit dimensions.
  Eigen::MatrixXd array() {
    const SourceLocation open = here();
    take();
    skip(" \t\r\n");
    std::optional<std::pair<int, int>> dimensions;
    if (peek() == '<') dimensions = arrayDimensions();
    std::vector<double> numbers;
    std::size_t rowStart = 0, columns = 0;
    const auto endRow = [&] {
      const std::size_t length = numbers.size() - rowStart;
      if (length == 0) return;
      if (columns != 0 && length != columns && !dimensions) {
        fail("row of an array", fmt::format("{} numbers", length),
             fmt::format("{} as in the first row", columns));
      }
      columns = length;
      rowStart = numbers.size();
    };
    for (skip(" \t\r,"); peek() != ']'; skip(" \t\r,")) {
      if (atEnd()) failAt(open, "'[' is never closed", "a ']'");
      if (peek() == ';' || peek() == '\n') {
        endRow();
        take();
      } else {
        numbers.push_back(number("a number or ']'"));
      }
    }
    endRow();
    take();
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (dimensions) {
      if (static_cast<std::size_t>(dimensions->first) * static_cast<std::size_t>(dimensions->second) !=
          numbers.size()) {
        throw Error({.what = "array with explicit dimensions",
                     .where = open,
                     .found = fmt::format("{} numbers", numbers.size()),
                     .wanted = fmt::format("{} x {}", dimensions->first, dimensions->second)});
      }
      return Eigen::Map<const RowMajor>(numbers.data(), dimensions->first, dimensions->second);
    }
    if (columns == 0) return Eigen::MatrixXd(0, 0);
    return Eigen::Map<const RowMajor>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / columns),
                                      static_cast<Eigen::Index>(columns));
  }

  std::pair<int, int> arrayDimensions() {
    take();
    std::vector<int> sizes;
    for (skip(" \t"); peek() != '>'; skip(" \t")) {
      const double size = number("a dimension or '>'");
      if (size < 0 || size > 1e6 || size != std::floor(size))
        fail("array dimension", fmt::format("{}", size), "a count");
      sizes.push_back(static_cast<int>(size));
    }
    take();
    if (sizes.empty() || sizes.size() > 2)
      fail("array dimensions", fmt::format("{} of them", sizes.size()), "one or two");
    return sizes.size() == 1 ? std::pair(1, sizes[0]) : std::pair(sizes[0], sizes[1]);
  }

  // <T ...> is a pose; the text of any other type is kept as it stands.
  Value typed() {
    const SourceLocation open = here();
    take();
    skip(" \t\r\n");
    const std::string type = word(" \t\r\n>|");
    if (type == "T") return pose(open);
    const std::size_t end = text_.find('>', at_);
    if (end == std::string_view::npos) failAt(open, "'<' is never closed", "a '>'");
    std::string text = type + std::string(text_.substr(at_, end - at_));
    while (at_ <= end) take();
    return text;
  }

  // Elements apply left to right, each relative to the frame so far.
  Pose pose(const SourceLocation& open) {
    Pose X;
    for (skip(" \t\r\n|<"); peek() != '>'; skip(" \t\r\n|")) {
      if (atEnd()) failAt(open, "'<T' is never closed", "a '>'");
      X = X * poseElement();
    }
    take();
    return X;
  }

  Pose poseElement() {
    if (contains("+-.0123456789", peek())) {
      const Eigen::VectorXd n = numbers(7, "x y z qw qx qy qz");
      return {rotationFromFile(n.tail<4>()), n.head<3>()};
    }
    const char kind = peek();
    if (!contains("tdrqE", kind))
      fail("unknown element of a pose", found(), "t(..), d(..), r(..), q(..), E(..), seven numbers, or '>'");
    take();
    if (peek() != '(') fail(fmt::format("pose element '{}'", kind), found(), "'('");
    take();
    const bool three = kind == 't' || kind == 'E';
    const Eigen::VectorXd n = numbers(three ? 3 : 4, three ? "three numbers" : "four numbers");
    skip(" \t\r\n");
    if (peek() != ')')
      fail(fmt::format("pose element '{}'", kind), found(), fmt::format("')' after {} numbers", n.size()));
    take();
    switch (kind) {
      case 't':
        return translation(n[0], n[1], n[2]);
      case 'd':
        return rotation(n[0] * std::numbers::pi / 180, n.tail<3>());
      case 'r':
        return rotation(n[0], n.tail<3>());
      case 'q':
        return {rotationFromFile(n), Eigen::Vector3d::Zero()};
      default:
        return {rotationFromRollPitchYaw(n), Eigen::Vector3d::Zero()};
    }
  }

  Eigen::Matrix3d rotationFromFile(const Eigen::Vector4d& quaternion) const {
    if (quaternion.isZero(0)) fail("quaternion", "(0, 0, 0, 0)", "a quaternion w x y z that is not zero");
    return rotationFromQuaternion(quaternion);
  }

  Eigen::VectorXd numbers(int count, const char* wanted) {
    Eigen::VectorXd values(count);
    for (double& value : values) {
      skip(" \t\r\n");
      if (atEnd() || contains(")>", peek())) fail("too few numbers in a pose", found(), wanted);
      value = number(wanted);
    }
    return values;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, lineStart_ = 0;
  int line_ = 1, count_ = 0;
};

}  // namespace

std::string describe(const Value& value) {
  struct Describer {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(double number) const { return fmt::format("the number {}", number); }
    std::string operator()(const std::string& word) const { return fmt::format("'{}'", word); }
    std::string operator()(const FileName& file) const { return fmt::format("the file '{}'", file.path); }
    std::string operator()(const Eigen::MatrixXd& m) const {
      return m.rows() <= 1 ? fmt::format("an array of {}", m.size())
                           : fmt::format("an array of {} x {}", m.rows(), m.cols());
    }
    std::string operator()(const Pose&) const { return "a pose <T ...>"; }
    std::string operator()(const Graph&) const { return "{...}"; }
  };
  return std::visit(Describer{}, value);
}

Graph parseGraph(std::string_view text, const std::string& fileName) { return Parser(text, fileName).file(); }

}  // namespace rex::ors
