#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/error.h"
#include "formats/ors_graph_internal.h"

namespace rex::ors {

/// nearestNames() of the first thousand names: a file may hold so many that comparing all takes long.
[[nodiscard]] inline std::vector<std::string> nearestOfMany(std::string_view wanted,
                                                            std::vector<std::string> names) {
  names.resize(std::min<std::size_t>(names.size(), 1000));
  return nearestNames(wanted, names);
}

/// The files of a scene: finds the ones it includes, within the limits, and keeps those that are open.
class Files {
 public:
  /// For the scene in `file`, whose own text has `bytes`; `assets` as in parseGraph(). Throws Error if it is
  /// too large.
  Files(const Assets* assets, const std::string& file, std::size_t bytes);

  /// The name and the text of a file to include, and its folder as seen from that of the scene. It counts as
  /// open until close(). Throws Error at `where`: no files may be read, none found, a file within itself,
  /// files nested too deep or too large in all.
  struct Opened {
    std::string name;
    std::string text;
    std::filesystem::path folder;
  };
  [[nodiscard]] Opened open(const FileName& file, const Place& where);
  void close() { open_.pop_back(); }
  /// Whether a folder that ChDir names is there; always so of a scene that was given as text.
  [[nodiscard]] bool hasFolder(const std::string& folder) const;

 private:
  const Assets* assets_;
  std::size_t bytes_;
  std::vector<std::filesystem::path> open_;
};

/// Whether it is package://PACKAGE/PATH or alike, no path.
[[nodiscard]] bool isAddress(const std::string& name);

/// `name` as seen from the folder of the scene when it is meant from `folder`; an address or an absolute path
/// stays as it is.
[[nodiscard]] std::string inFolder(const std::string& folder, const std::string& name);

/// Merges edits into one node. It keeps an index of the attributes, so that many edits of many attributes
/// take no longer than reading them.
class Merger {
 public:
  /// Attributes are merged one by one, in braces within braces too; any other value is replaced. Throws
  /// Error for a value in place of attributes, and for too many attributes.
  void merge(Node& node, Node edit);

 private:
  void mergeAttribute(Graph& attributes, Node edit);
  std::optional<std::size_t> findSame(const Graph& attributes, const Node& edit);
  void takeKeys(Graph& attributes, const Node& edit, std::optional<std::size_t> same);

  std::unordered_map<std::string, std::vector<std::size_t>> havingKey_;  // of the first indexed_ attributes
  std::size_t indexed_ = 0;
  std::unordered_map<std::size_t, std::unique_ptr<Merger>> inner_;  // for braces within braces
};

/// Removes the attributes that edits left without any key.
void dropNameless(Node& node);

/// The keys, with blanks between them.
[[nodiscard]] std::string joinedKeys(const Node& node);

/// The nodes between two braces, or of the whole scene, while they are read: nodes come and are deleted, and
/// edits wait for the end.
class NodeList {
 public:
  std::size_t size() const { return live_.size(); }
  void add(Node node);
  /// The id of the k-th node before the next one; none if there are fewer.
  std::optional<int> previous(std::size_t k) const;
  /// Deletes the nodes that have all keys of `named`, and its parents if it has some; how many. A joint
  /// without a name has the key FROM>TO.
  std::size_t erase(const Node& named);
  /// All nodes, with each Edit merged into the first earlier node of the same keys and parents; if there is
  /// none, into the first of the same keys, unless those are no name. Throws Error naming the nearest.
  Graph finish();
  /// The keys and parents, as messages show them: "joint (arm hand)".
  std::string textOf(const Node& node) const;

 private:
  using Index = std::unordered_map<std::string, std::size_t>;

  std::string nameOf(const Word& parent) const;
  std::string nameOfJoint(const Node& node) const;
  std::string parentsOf(const Node& node) const;
  void indexKeys();
  void mergeEdits();
  void addTexts(std::size_t i, Index& firstOf) const;
  std::optional<std::size_t> partnerOf(const Node& edit, const Index& firstOf) const;
  [[noreturn]] void failWithoutPartner(const Node& edit, const std::vector<std::size_t>& earlier) const;

  std::vector<Node> nodes_;                                              // also the deleted ones; ids ascend
  std::vector<std::size_t> live_;                                        // indices of the others, ascending
  std::unordered_map<std::string, std::vector<std::size_t>> havingKey_;  // of the first indexed_ nodes
  std::size_t indexed_ = 0;
};

/// Whether the node is an Edit, or Merge, as it was called once.
[[nodiscard]] bool isEdit(const Node& node);

}  // namespace rex::ors
