#include <algorithm>

#include <fmt/format.h>

#include "scene/ors_limits_internal.h"
#include "scene/ors_merger_internal.h"

namespace rex::ors {
namespace {

bool haveSameKeys(const Node& a, const Node& b) {
  return std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(),
                    [](const Word& x, const Word& y) { return x.text == y.text; });
}

}  // namespace

void Merger::merge(Node& node, Node edit) {
  if (!edit.parents.empty()) node.parents = std::move(edit.parents);
  Graph* old = std::get_if<Graph>(&node.value);
  Graph* changes = std::get_if<Graph>(&edit.value);
  if (old && changes) {
    for (Node& change : *changes) mergeAttribute(*old, std::move(change));
    return;
  }
  if (old) {
    throw Error({.what = fmt::format("Edit of '{}'", joinedKeys(node)),
                 .where = edit.where,
                 .found = describe(edit.value),
                 .wanted = "{attributes}"});
  }
  node.value = std::move(edit.value);
  node.valueWhere = edit.valueWhere;
}

void Merger::mergeAttribute(Graph& attributes, Node edit) {
  for (; indexed_ < attributes.size(); ++indexed_)
    for (const Word& key : attributes[indexed_].keys) havingKey_[key.text].push_back(indexed_);
  const auto same = findSame(attributes, edit);
  takeKeys(attributes, edit, same);
  if (same) {
    std::unique_ptr<Merger>& inner = inner_[*same];
    if (!inner) inner = std::make_unique<Merger>();
    inner->merge(attributes[*same], std::move(edit));
    return;
  }
  if (attributes.size() >= kMostAttributes) {
    throw Error({.what = "too many attributes",
                 .where = edit.where,
                 .wanted = fmt::format("at most {} in one pair of braces", kMostAttributes)});
  }
  attributes.push_back(std::move(edit));
}

std::optional<std::size_t> Merger::findSame(const Graph& attributes, const Node& edit) {
  if (edit.keys.empty()) return std::nullopt;
  const std::vector<std::size_t>& having = havingKey_[edit.keys[0].text];
  const auto same = std::find_if(having.begin(), having.end(),
                                 [&](std::size_t i) { return haveSameKeys(attributes[i], edit); });
  return same == having.end() ? std::nullopt : std::optional(*same);
}

// Attributes are found by any of their keys, so an edited one takes its keys away from all others.
void Merger::takeKeys(Graph& attributes, const Node& edit, std::optional<std::size_t> same) {
  for (const Word& key : edit.keys) {
    std::vector<std::size_t>& having = havingKey_[key.text];
    for (const std::size_t i : having) {
      if (i != same) std::erase_if(attributes[i].keys, [&](const Word& k) { return k.text == key.text; });
    }
    having.clear();
    if (same) having.push_back(*same);
  }
}

void dropNameless(Node& node) {
  Graph* attributes = std::get_if<Graph>(&node.value);
  if (!attributes) return;
  std::erase_if(*attributes, [](const Node& attribute) { return attribute.keys.empty(); });
  for (Node& attribute : *attributes) dropNameless(attribute);
}

std::string joinedKeys(const Node& node) {
  std::string text;
  for (const Word& key : node.keys) text += (text.empty() ? "" : " ") + key.text;
  return text;
}

}  // namespace rex::ors
