#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "scene/ors_limits_internal.h"
#include "scene/ors_names_internal.h"
#include "scene/ors_node_list_internal.h"

namespace rex::ors {
namespace {

std::string joined(std::span<const Word> keys) {
  std::string text;
  for (const Word& key : keys) text += (text.empty() ? "" : " ") + key.text;
  return text;
}

bool haveSameKeys(const Node& a, const Node& b) {
  return std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(),
                    [](const Word& x, const Word& y) { return x.text == y.text; });
}

// Attributes are found by any of their keys, so a new one takes its keys from all others.
void takeKeys(Graph& attributes, const Node& from, const Node* except) {
  const auto isTaken = [&](const Word& key) {
    return std::any_of(from.keys.begin(), from.keys.end(), [&](const Word& k) { return k.text == key.text; });
  };
  for (Node& other : attributes)
    if (&other != except) std::erase_if(other.keys, isTaken);
}

void merge(Node& node, Node edit);

void mergeAttribute(Graph& attributes, Node edit) {
  const auto same = std::find_if(attributes.begin(), attributes.end(),
                                 [&](const Node& attribute) { return haveSameKeys(attribute, edit); });
  takeKeys(attributes, edit, same == attributes.end() ? nullptr : &*same);
  if (same != attributes.end()) {
    merge(*same, std::move(edit));
  } else {
    attributes.push_back(std::move(edit));
  }
  std::erase_if(attributes, [](const Node& attribute) { return attribute.keys.empty(); });
}

void merge(Node& node, Node edit) {
  if (!edit.parents.empty()) node.parents = std::move(edit.parents);
  Graph* old = std::get_if<Graph>(&node.value);
  Graph* changes = std::get_if<Graph>(&edit.value);
  if (old && changes) {
    for (Node& change : *changes) {
      if (old->size() >= kMostAttributes) {
        throw Error({.what = "too many attributes",
                     .where = change.where,
                     .wanted = fmt::format("at most {} in one pair of braces", kMostAttributes)});
      }
      mergeAttribute(*old, std::move(change));
    }
    return;
  }
  if (old) {
    throw Error({.what = fmt::format("Edit of '{}'", joined(node.keys)),
                 .where = edit.where,
                 .found = describe(edit.value),
                 .wanted = "{attributes}"});
  }
  node.value = std::move(edit.value);
  node.valueWhere = edit.valueWhere;
}

[[noreturn]] void failWithoutPartner(const Node& edit, const Graph& earlier) {
  std::vector<std::string> known;
  for (const Node& node : earlier) known.push_back(joined(node.keys));
  throw Error({.what = "nothing to edit",
               .where = edit.where,
               .found = fmt::format("'{}'", joined(edit.keys)),
               .wanted = "the words of an earlier statement",
               .nearest = nearestOfMany(joined(edit.keys), std::move(known))});
}

}  // namespace

bool isEdit(const Node& node) {
  return !node.keys.empty() && (node.keys[0].text == "Edit" || node.keys[0].text == "Merge");
}

void NodeList::add(Node node) {
  live_.push_back(nodes_.size());
  nodes_.push_back(std::move(node));
}

std::optional<int> NodeList::previous(std::size_t k) const {
  if (k == 0 || k > live_.size()) return std::nullopt;
  return nodes_[live_[live_.size() - k]].id;
}

void NodeList::indexKeys() {
  for (; indexed_ < nodes_.size(); ++indexed_) {
    for (const Word& key : nodes_[indexed_].keys) {
      std::vector<std::size_t>& having = havingKey_[key.text];
      if (having.empty() || having.back() != indexed_) having.push_back(indexed_);
    }
  }
}

std::size_t NodeList::erase(std::span<const Word> keys) {
  indexKeys();
  std::vector<std::size_t> matching = live_, some;
  for (const Word& key : keys) {
    const std::vector<std::size_t>& having = havingKey_[key.text];
    some.clear();
    std::set_intersection(matching.begin(), matching.end(), having.begin(), having.end(),
                          std::back_inserter(some));
    std::swap(matching, some);
  }
  some.clear();
  std::set_difference(live_.begin(), live_.end(), matching.begin(), matching.end(), std::back_inserter(some));
  std::swap(live_, some);
  return matching.size();
}

Graph NodeList::finish() {
  const bool hasEdits =
      std::any_of(live_.begin(), live_.end(), [&](std::size_t i) { return isEdit(nodes_[i]); });
  std::unordered_map<std::string, std::size_t> firstOf;  // places in the graph
  Graph graph;
  graph.reserve(live_.size());
  for (const std::size_t i : live_) {
    Node& node = nodes_[i];
    if (isEdit(node)) {
      node.keys.erase(node.keys.begin());
      const auto found = firstOf.find(joined(node.keys));
      if (found == firstOf.end()) failWithoutPartner(node, graph);
      merge(graph[found->second], std::move(node));
    } else {
      if (hasEdits) firstOf.emplace(joined(node.keys), graph.size());
      graph.push_back(std::move(node));
    }
  }
  return graph;
}

}  // namespace rex::ors
