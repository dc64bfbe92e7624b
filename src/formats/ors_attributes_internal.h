#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "formats/ors_graph_internal.h"

// What an .ors scene may hold, counted over all its files. No text within these limits takes long or much
// memory; share/doc/scenes.md lists them.
namespace rex::ors {

inline constexpr std::size_t kMostBytes = 32u << 20;
inline constexpr int kDeepestBraces = 100;
inline constexpr int kMostNodes = 200'000;
inline constexpr int kMostWords = 1'000'000;  ///< names and numbers
inline constexpr std::size_t kMostKeys = 64;  ///< or parents, of one node
inline constexpr std::size_t kMostAttributes = 256;
inline constexpr std::size_t kMostNumbers = 10'000;  ///< of one array
inline constexpr std::size_t kLongestWord = 256;
inline constexpr int kMostDirectives = 256;  ///< Include, ChDir and Delete
inline constexpr std::size_t kDeepestIncludes = 16;
inline constexpr std::size_t kMostJoints = 1'000;
inline constexpr std::size_t kMostRobots = 64;  ///< statements 'urdf'
inline constexpr std::size_t kMostNotes = 1'000;

/// A value that is given by name, or by number unless that is -1. A name may be empty.
struct Choice {
  int number;
  const char* name;
};

/// What other formats call a choice, to guess what was meant.
struct Alias {
  const char* name;
  const char* meaning;
};

/// The attributes of one body, shape or joint, with typed access. Wrong kinds of values are Errors that name
/// the owner, the attribute and the place.
class Attributes {
 public:
  /// `owner` is what messages begin with: "body 'arm'".
  Attributes(const Node& node, std::string owner);

  /// The first attribute that has `name` among its keys.
  const Node* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }

  /// `contact`, `contact=true`, `contact=1` or a key that shares another's value: true. `contact!`,
  /// `contact=false`, `contact=no`, `contact=off`, `contact=0`: false. True is also a word between role and
  /// name: `body fixed post {...}`.
  bool flag(std::string_view name) const;
  /// Warns of a word between role and name that is none of these flags, the first if there are several.
  /// Throws Error for one that begins another statement.
  void noteWords(const std::vector<std::string>& flags, Diagnostics& notes) const;
  /// Warns of each flag whose value says neither yes nor no.
  void noteFlags(std::initializer_list<const char*> names, Diagnostics& notes) const;
  std::optional<double> number(std::string_view name) const;
  /// A number >= 0.
  std::optional<double> size(std::string_view name) const;
  std::optional<Pose> pose(std::string_view name) const;
  std::optional<std::string> text(std::string_view name, const char* wanted) const;
  std::optional<FileName> file(std::string_view name) const;
  /// One row of numbers, whose count must be one of `counts`, any if that is empty; a single number is a row
  /// of one.
  std::optional<Eigen::VectorXd> row(std::string_view name, std::initializer_list<int> counts,
                                     bool mayBeInfinite = false) const;
  /// The index of what was chosen.
  std::optional<std::size_t> choice(std::string_view name, std::span<const Choice> choices,
                                    std::span<const Alias> aliases = {}) const;

  /// Tells of each attribute that is not `known`, a warning if it looks like a misspelling, and of each that
  /// is there twice. Throws Error for one whose name is a number.
  void noteUnknown(const std::vector<std::string>& known, Diagnostics& notes) const;
  void note(std::string_view name, std::string_view text, Severity severity, Diagnostics& notes) const;

  const std::string& owner() const { return owner_; }
  /// The place of an attribute's value, or of its owner.
  Place where(std::string_view name) const;
  /// Throws Error about an attribute.
  [[noreturn]] void fail(std::string_view name, std::string found, std::string wanted) const;

 private:
  void requireOneStatement() const;
  [[noreturn]] void failAtNumber(const Node& attribute, const Word& key) const;
  template <class T>
  std::optional<T> get(std::string_view name, const char* wanted) const;

  const Node& node_;
  std::string owner_;
  const Graph* graph_;
};

}  // namespace rex::ors
