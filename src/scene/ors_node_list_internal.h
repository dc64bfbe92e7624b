#pragma once

#include <unordered_map>

#include "scene/ors_graph_internal.h"

namespace rex::ors {

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
