#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/ors_attributes_internal.h"
#include "formats/ors_graph_internal.h"
#include "formats/ors_node_list_internal.h"
#include "formats/ors_values_internal.h"

namespace rex::ors {
namespace {

// The folder in its shortest form, without a slash at the end; empty: the folder of the scene.
std::string shortest(const std::filesystem::path& folder) {
  const std::filesystem::path path = (folder / "").lexically_normal();
  const std::string text = (path.has_filename() ? path : path.parent_path()).generic_string();
  return text == "." ? "" : text;
}

// The text without its byte order mark. Throws Error if it cannot be an .ors file.
std::string_view requireOrs(std::string_view text, const std::string& file) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw Error({.what = "text in UTF-16", .where = {file, 1, 1}, .wanted = "UTF-8"});
  text = withoutByteOrderMark(text);
  const std::size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::string_view first = text.substr(start);
  if (first.starts_with("<?xml") || first.starts_with("<robot") || first.starts_with("<!--")) {
    throw Error({.what = "this is XML",
                 .where = {file, 1, 1},
                 .wanted = ".ors; if it is a robot in URDF, name it .urdf"});
  }
  return text;
}

// What all files of a scene share.
struct Scene {
  Files files;
  Budget budget{};
  Document document{};
};

// Parses one file. Names of files in it are relative to its folder, or to where ChDir leads.
class Parser {
 public:
  Parser(std::string_view text, const std::string& file, std::string folder, Scene& scene)
      : cursor_(requireOrs(text, file), file, scene.budget), folder_(std::move(folder)), scene_(scene) {}

  void readFile(NodeList& list, int depth) {
    readNodes(list, depth);
    if (!cursor_.atEnd()) cursor_.fail("unmatched '}'", "", "a body, shape or joint, or the end of the file");
  }

 private:
  void readNodes(NodeList& list, int depth) {
    if (depth > kDeepestBraces) {
      cursor_.fail("braces nested too deep", fmt::format("level {}", depth),
                   fmt::format("at most {}", kDeepestBraces));
    }
    for (cursor_.skipSpaceAndComments(); !cursor_.atEnd() && cursor_.peek() != '}';
         cursor_.skipSpaceAndComments()) {
      if (++scene_.budget.nodes > kMostNodes)
        cursor_.fail("too many nodes", "", fmt::format("at most {}", kMostNodes));
      if (depth > 0 && list.size() >= kMostAttributes) {
        cursor_.fail("too many attributes", "",
                     fmt::format("at most {} in one pair of braces", kMostAttributes));
      }
      Node node = readNode(list, depth);
      if (!obey(node, list, depth)) list.add(std::move(node));
    }
  }

  Node readNode(const NodeList& list, int depth) {
    Node node;
    node.id = scene_.budget.nodes;
    node.where = node.valueWhere = cursor_.here();
    for (cursor_.skip(" \t"); !cursor_.atEnd() && !contains("\r\n,;([{}=!<#", cursor_.peek());
         cursor_.skip(" \t")) {
      if (contains(")]>\"'", cursor_.peek())) cursor_.fail("syntax error", cursor_.found(), "a name");
      addWord(node.keys, " \t\r\n,;([{}=!");
      const Word& word = node.keys.back();
      if (word.text.starts_with("//") || word.text.starts_with("/*"))
        Cursor::failAt(word.where, "a comment in the syntax of another language",
                       fmt::format("'{}'", word.text), "'#', which starts a comment");
    }
    if (cursor_.peek() == '(') {
      readParents(node, list);
      cursor_.skip(" \t\r\n");
    }
    if (contains("=[{<!", cursor_.peek())) {
      if (cursor_.peek() == '=') {
        cursor_.take();
        cursor_.skip(" \t\r\n");
      }
      node.valueWhere = cursor_.here();
      node.value = readValue(depth);
    } else if (node.keys.empty() && node.parents.empty()) {
      cursor_.fail("syntax error", cursor_.found(), "a name such as 'body', 'shape' or 'joint'");
    }
    cursor_.skip(" \t");
    if (cursor_.peek() == ',' || cursor_.peek() == ';') cursor_.take();
    return node;
  }

  void addWord(std::vector<Word>& words, std::string_view terminators) {
    const Place where = cursor_.here();
    if (words.size() == kMostKeys)
      cursor_.fail("too many words in a row", "", fmt::format("at most {}", kMostKeys));
    words.push_back({cursor_.word(terminators), where});
  }

  void readParents(Node& node, const NodeList& list) {
    const Place open = cursor_.here();
    cursor_.take();
    for (cursor_.skip(" \t\r\n,"); cursor_.peek() != ')'; cursor_.skip(" \t\r\n,")) {
      if (cursor_.atEnd() || contains("({}[]=", cursor_.peek()))
        Cursor::failAt(open, "'(' is never closed", "", fmt::format("a ')' before {}", cursor_.found()));
      addWord(node.parents, " \t\r\n,)({}[]=");
      resolve(node.parents.back(), list);
    }
    cursor_.take();
  }

  // -k means the k-th node before this one.
  static void resolve(Word& parent, const NodeList& list) {
    if (!parent.text.starts_with('-')) return;
    std::size_t k = 0;
    const char* const last = parent.text.data() + parent.text.size();
    const auto [end, error] = std::from_chars(parent.text.data() + 1, last, k);
    if (end != last) return;
    parent.node = list.previous(error == std::errc() ? k : 0);
    if (!parent.node)
      Cursor::failAt(parent.where, "parent", parent.text,
                     fmt::format("-1 to -{}, the statements before this one", list.size()));
  }

  Value readValue(int depth) {
    const Place open = cursor_.here();
    const char c = cursor_.peek();
    if (c == '{') return readBraces(depth);
    if (c == '[') return readArray(cursor_);
    if (c == '<') return readTyped(cursor_);
    if (cursor_.atNumber()) return cursor_.number("a number");
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      std::string text = cursor_.word(" \t\r\n,;}");
      if (text == "true") return true;
      if (text == "false") return false;
      return text;
    }
    if (!contains("\"'!", c)) {
      cursor_.fail("syntax error", cursor_.found(),
                   "a value: a number, word, \"text\", [array], <T pose> or {attributes}");
    }
    cursor_.take();
    if (c == '!') return false;
    std::string text = cursor_.upTo(c, open, "text");
    if (c == '"') return text;
    return FileName{inFolder(folder_, text)};
  }

  Value readBraces(int depth) {
    const Place open = cursor_.here();
    cursor_.take();
    NodeList list;
    readNodes(list, depth + 1);
    if (cursor_.atEnd())
      Cursor::failAt(open, "'{' is never closed", "", "a matching '}' before the end of the file");
    cursor_.take();
    return list.finish();
  }

  // Whether the node is a directive for the reader, which does not become part of the scene.
  bool obey(const Node& node, NodeList& list, int depth) {
    if (node.keys.empty()) return false;
    const std::string& role = node.keys[0].text;
    if (isEdit(node)) requireMoreKeys(node);
    if (role != "Include" && role != "ChDir" && role != "Delete") return false;
    if (++scene_.budget.directives > kMostDirectives) {
      Cursor::failAt(node.where, "too many statements 'Include', 'ChDir' and 'Delete'", "",
                     fmt::format("at most {}", kMostDirectives));
    }
    if (role == "Include") {
      include(node, list, depth);
    } else if (role == "ChDir") {
      changeFolder(node);
    } else {
      erase(node, list);
    }
    return true;
  }

  static void requireMoreKeys(const Node& node) {
    if (node.keys.size() < 2) {
      Cursor::failAt(node.where, node.keys[0].text, "no names",
                     fmt::format("the words of a statement: {} body NAME", node.keys[0].text));
    }
  }

  static const FileName& fileOf(const Node& node, const char* wanted) {
    const FileName* file = std::get_if<FileName>(&node.value);
    if (!file) Cursor::failAt(node.valueWhere, node.keys[0].text, describe(node.value), wanted);
    return *file;
  }

  void include(const Node& node, NodeList& list, int depth) {
    const FileName& file = fileOf(node, "Include='FILE'");
    const Files::Opened opened = scene_.files.open(file, node.valueWhere);
    scene_.document.isOneFile = false;
    scene_.document.files.push_back(opened.name);
    Parser(opened.text, scene_.document.files.back(), shortest(opened.folder), scene_).readFile(list, depth);
    scene_.files.close();
  }

  void changeFolder(const Node& node) {
    const FileName& folder = fileOf(node, "ChDir='FOLDER'");
    folder_ = isAddress(folder.path) ? folder.path : shortest(folder.path);
    if (folder_.size() > kLongestWord) {
      Cursor::failAt(node.valueWhere, "ChDir: path too long", fmt::format("{} bytes", folder_.size()),
                     fmt::format("at most {}", kLongestWord));
    }
    if (!scene_.files.hasFolder(folder_))
      cursor_.warn(node.valueWhere, fmt::format("ChDir: no folder '{}' beside the scene", folder_));
  }

  void erase(const Node& node, NodeList& list) {
    requireMoreKeys(node);
    if (const bool* value = std::get_if<bool>(&node.value); !value || !*value)
      Cursor::failAt(node.valueWhere, "Delete", describe(node.value), "only the words of a statement");
    Node named = node;
    named.keys.erase(named.keys.begin());
    if (list.erase(named) > 0) return;
    cursor_.warn(node.where, fmt::format("nothing to delete: no earlier statement has the words '{}'",
                                         list.textOf(named)));
  }

  Cursor cursor_;
  std::string folder_;
  Scene& scene_;
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

Document parseGraph(std::string_view text, const std::string& fileName, const Assets* assets,
                    Diagnostics* notesOfFailure) {
  Scene scene{.files = Files(assets, fileName, text.size())};
  scene.document.files.push_back(fileName);
  NodeList list;
  try {
    Parser(text, scene.document.files.back(), "", scene).readFile(list, 0);
    scene.document.nodes = list.finish();
  } catch (const Error&) {
    if (notesOfFailure) *notesOfFailure = std::move(scene.budget.notes);
    throw;
  }
  scene.document.notes = std::move(scene.budget.notes);
  return std::move(scene.document);
}

}  // namespace rex::ors
