#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "formats/difference.h"
#include "formats/xml_reader_internal.h"
#include "geometry/pose.h"

namespace rex::urdf {

/// What is noticed while reading: the first thousand findings, and how often what is known was ignored.
class Notes {
 public:
  void warn(const SourceLocation& where, const std::string& message,
            Difference difference = Difference::kNone);
  /// A tag of a kind that we know and do not use.
  void ignore(const SourceLocation& where, const std::string& kind,
              Difference difference = Difference::kNone);
  /// A finding that may come up often: listed once, with its first place and how often. A warning if contact
  /// or motion differs.
  void remark(const SourceLocation& where, const std::string& message,
              Difference difference = Difference::kNone);
  /// An attribute of a tag, neither of which is a mistake; those of a tag for which the same differs share a
  /// note or warning.
  void leaveOut(const SourceLocation& where, const std::string& tag, const std::string& attribute,
                Difference difference);
  /// Takes over what was noticed in a file that belongs to this one.
  void add(Notes other);
  bool isFull() const { return found_.size() >= kMost; }
  [[nodiscard]] Diagnostics take();

 private:
  static constexpr std::size_t kMost = 1000;
  struct Remark {
    SourceLocation first;
    int count = 0;
    Difference difference = Difference::kNone;
  };
  struct LeftOut {
    SourceLocation first;
    std::map<std::string, int> counts;  // of each attribute
  };
  Diagnostics found_;
  std::size_t unlisted_ = 0;
  std::map<std::string, Remark> remarks_;
  std::map<std::pair<std::string, Difference>, LeftOut> leftOut_;
};

/// Whether a strict reading refuses what makes such a difference.
[[nodiscard]] inline bool isGrave(Difference difference) {
  return difference == Difference::kContact || difference == Difference::kMotion;
}

/// A file that is being read, and what was noticed in it.
struct Reading {
  const xml::Document& document;
  bool strict = false;
  Notes notes{};

  /// For a fault that other readers of URDF live with: throws Error if this one is strict, else warns of it
  /// and of what is done instead.
  void forgive(ErrorParts fault, const std::string& instead, Difference difference = Difference::kNone);
};

/// What a tag may hold; everything else is worth a warning.
struct Known {
  std::vector<std::string> attributes, children, ignoredChildren{};
  /// What differs if other attributes, or children, "<child>", are left out. Nothing: not worth a note.
  std::map<std::string, Difference> leftOut{};
  std::vector<std::string> refused{};  ///< children that are known, but cannot be left out
  bool refusesOthers = false;          ///< children that are in no list
};

/// An element with typed access to what it holds. Throws Error with the place for what is wrong with it.
class Tag {
 public:
  /// The tag of a thing of its own, "link 'arm'", which begins all messages about it and its children.
  Tag(Reading& reading, const xml::Element& element, std::string thing);

  /// The same tag as part of another thing.
  Tag of(const std::string& thing) const { return Tag(*reading_, *element_, thing); }

  std::string_view name() const { return element_->name; }
  const xml::Element& element() const { return *element_; }
  /// What messages about its children begin with.
  const std::string& thing() const { return owner_; }
  /// What messages about itself begin with.
  const std::string& subject() const { return thing_; }
  Reading& reading() const { return *reading_; }
  SourceLocation where() const { return reading_->document.where(element_->at); }
  SourceLocation where(const char* attribute) const;

  /// Notes all attributes, children and texts that are not known; `known` must outlive the tag.
  void expect(const Known& known) const;

  bool has(std::string_view attribute) const { return find(attribute) != nullptr; }
  /// The text of an attribute that must be there.
  const std::string& text(const char* attribute) const;
  /// The same, neither empty nor longer than 256 bytes, and without the control character 0x7f.
  const std::string& nameIn(const char* attribute) const;
  double number(const char* attribute) const { return numbers(attribute, 1)[0]; }
  double number(const char* attribute, double otherwise) const {
    return has(attribute) ? number(attribute) : otherwise;
  }
  /// The same, not negative; positive() not zero either.
  double notNegative(const char* attribute) const;
  double notNegative(const char* attribute, double otherwise) const {
    return has(attribute) ? notNegative(attribute) : otherwise;
  }
  double positive(const char* attribute) const;
  Eigen::VectorXd numbers(const char* attribute, int count) const;
  /// At least and at most so many.
  Eigen::VectorXd numbers(const char* attribute, int least, int most) const;

  /// The child of that name, of which there may be only one: forgives more and returns the first, as urdfdom.
  std::optional<Tag> child(const char* name) const;
  /// The same, which must be there; `wanted` is for the message.
  Tag neededChild(const char* name, const std::string& wanted = "") const;
  std::vector<Tag> children(std::string_view name) const;
  std::vector<Tag> children() const;
  /// The pose that the child <origin> gives; without one the identity.
  Pose origin() const;

  void warn(const SourceLocation& where, const std::string& message) const;
  /// Warns that something differs or, if the reading is strict, throws Error.
  void warn(const SourceLocation& where, const std::string& message, Difference difference) const;
  /// The same for a message that costs time, and is only made while it is listed.
  template <class Message>
  requires std::is_invocable_v<Message>
  void warn(const SourceLocation& where, const Message& message) const {
    warn(where, reading_->notes.isFull() ? std::string() : message());
  }
  bool isStrict() const { return reading_->strict; }
  /// Reading::forgive() of a fault of this tag.
  void forgive(const SourceLocation& where, const std::string& what, std::string found, std::string wanted,
               const std::string& instead, Difference difference = Difference::kNone) const;
  /// The same for the value of an attribute.
  void forgiveAt(const char* attribute, std::string found, std::string wanted,
                 const std::string& instead) const;
  /// Throw Error if contact or motion differs and the reading is strict.
  void ignore(const std::string& kind, Difference difference = Difference::kNone) const;
  void remark(const std::string& message, Difference difference = Difference::kNone) const;
  void leaveOut(const char* attribute, Difference difference) const;
  [[noreturn]] void fail(const SourceLocation& where, const std::string& what, std::string found,
                         std::string wanted, std::vector<std::string> nearest = {}) const;
  [[noreturn]] void failAt(const char* attribute, std::string found, std::string wanted) const;

 private:
  Tag(const Tag& parent, const xml::Element& element);
  void expectAttribute(const xml::Attribute& attribute, const Known& known) const;
  void expectChild(const xml::Element& child, const Known& known) const;
  void refuseIfStrict(const SourceLocation& where, const std::string& message, Difference difference) const;
  const xml::Attribute* find(std::string_view attribute) const;
  const xml::Attribute& need(std::string_view attribute) const;

  Reading* reading_;
  const xml::Element* element_;
  std::string owner_, thing_;
  mutable const Known* known_ = nullptr;  // since expect(): tells what is misspelt from what is meant
};

}  // namespace rex::urdf
