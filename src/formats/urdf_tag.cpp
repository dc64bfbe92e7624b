#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/urdf_tag_internal.h"
#include "geometry/rotation.h"

namespace rex::urdf {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool belongsToXml(const std::string& attribute) {
  return attribute == "xmlns" || attribute.starts_with("xmlns:") || attribute.starts_with("xml:");
}

std::string guess(const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string> nearest = nearestNames(name, known);
  return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest.front());
}

// The numbers in a text, and where the first word that is not a number begins.
struct Numbers {
  std::vector<double> values;
  std::optional<std::size_t> faultAt{};
  std::string fault{};
  bool isNumber = false;  // the faulty word is a number, but not finite
};

Numbers parseNumbers(std::string_view text, std::size_t most) {
  Numbers numbers;
  for (const std::string_view word : splitWords(text)) {
    const std::optional<double> value = parseNumber<double>(word);
    if (!value) {
      numbers.faultAt = static_cast<std::size_t>(word.data() - text.data());
      numbers.fault = word;
      numbers.isNumber = isNumeral(word);
      return numbers;
    }
    numbers.values.push_back(*value);
    if (numbers.values.size() > most) return numbers;
  }
  return numbers;
}

}  // namespace

void Notes::warn(const SourceLocation& where, const std::string& message, Difference difference) {
  if (isFull()) {
    ++unlisted_;
  } else {
    const char* const comma = difference == Difference::kNone ? "" : "; ";
    found_.push_back(
        {where, fmt::format("{}{}{}", message, comma, toString(difference)), Severity::kWarning});
  }
}

void Notes::ignore(const SourceLocation& where, const std::string& kind, Difference difference) {
  remark(where, kind + " is ignored", difference);
}

void Notes::remark(const SourceLocation& where, const std::string& message, Difference difference) {
  Remark& remark = remarks_[message];
  if (remark.count++ == 0) remark.first = where;
  remark.difference = difference;
}

void Notes::leaveOut(const SourceLocation& where, const std::string& tag, const std::string& attribute,
                     Difference difference) {
  LeftOut& leftOut = leftOut_[{tag, difference}];
  if (leftOut.counts.empty()) leftOut.first = where;
  ++leftOut.counts[attribute];
}

void Notes::add(Notes other) {
  for (Diagnostic& one : other.found_) warn(one.where, one.message);
  unlisted_ += other.unlisted_;
  for (const auto& [message, more] : other.remarks_) {
    Remark& remark = remarks_[message];
    if (remark.count == 0) remark.first = more.first;
    remark.count += more.count;
    remark.difference = more.difference;
  }
  for (const auto& [tag, more] : other.leftOut_) {
    LeftOut& leftOut = leftOut_[tag];
    if (leftOut.counts.empty()) leftOut.first = more.first;
    for (const auto& [attribute, count] : more.counts) leftOut.counts[attribute] += count;
  }
}

Diagnostics Notes::take() {
  if (unlisted_ > 0)
    found_.push_back({{found_.back().where.file},
                      fmt::format("{} more warnings are not listed", unlisted_),
                      Severity::kWarning});
  const auto firstGrouped = static_cast<std::ptrdiff_t>(found_.size());
  const auto add = [&](const SourceLocation& where, const std::string& message, Difference difference) {
    found_.push_back({where, message, isGrave(difference) ? Severity::kWarning : Severity::kNote});
  };
  for (const auto& [message, remark] : remarks_) {
    const std::string_view differs = toString(remark.difference);
    add(remark.first,
        fmt::format("{}{}{}{}", message, differs.empty() ? "" : ": ", differs,
                    remark.count > 1 ? fmt::format(" ({} times)", remark.count) : ""),
        remark.difference);
  }
  for (const auto& [key, leftOut] : leftOut_) {
    std::vector<std::string> attributes;
    for (const auto& [name, count] : leftOut.counts)
      attributes.push_back(count > 1 ? fmt::format("{} ({} times)", name, count) : name);
    add(leftOut.first,
        fmt::format("{}: {}: attributes that are not read: {}", key.first, toString(key.second),
                    join(attributes, ", ")),
        key.second);
  }
  std::stable_partition(found_.begin() + firstGrouped, found_.end(),
                        [](const Diagnostic& one) { return one.severity == Severity::kWarning; });
  return std::move(found_);
}

void Reading::forgive(ErrorParts fault, const std::string& instead, Difference difference) {
  if (strict) throw Error(std::move(fault));
  const SourceLocation where = std::exchange(fault.where, {});
  notes.warn(where, notes.isFull() ? "" : fmt::format("{}; {}", Error(std::move(fault)).what(), instead),
             difference);
}

Tag::Tag(Reading& reading, const xml::Element& element, std::string thing)
    : reading_(&reading), element_(&element), owner_(thing), thing_(std::move(thing)) {}

Tag::Tag(const Tag& parent, const xml::Element& element)
    : reading_(parent.reading_),
      element_(&element),
      owner_(parent.owner_),
      thing_(fmt::format("{}: <{}>", owner_, element.name)) {}

SourceLocation Tag::where(const char* attribute) const {
  const xml::Attribute* found = find(attribute);
  return found ? reading_->document.where(found->valueAt) : where();
}

void Tag::expect(const Known& known) const {
  known_ = &known;
  for (const xml::Attribute& attribute : element_->attributes) expectAttribute(attribute, known);
  for (const xml::Element& child : element_->children) expectChild(child, known);
  if (element_->textAt) warn(reading_->document.where(*element_->textAt), "text is ignored");
}

void Tag::expectAttribute(const xml::Attribute& attribute, const Known& known) const {
  if (belongsToXml(attribute.name) || contains(known.attributes, attribute.name)) return;
  const SourceLocation where = reading_->document.where(attribute.at);
  const auto leftOut = known.leftOut.find(attribute.name);
  if (leftOut == known.leftOut.end())
    return warn(where, [&] {
      return fmt::format("unknown attribute '{}' is ignored{}", attribute.name,
                         guess(attribute.name, known.attributes));
    });
  if (leftOut->second != Difference::kNone) leaveOut(attribute.name.c_str(), leftOut->second);
}

void Tag::expectChild(const xml::Element& child, const Known& known) const {
  if (contains(known.children, child.name)) return;
  const SourceLocation where = reading_->document.where(child.at);
  const std::string tag = fmt::format("<{}>", child.name);
  if (contains(known.ignoredChildren, child.name)) return reading_->notes.ignore(where, tag);
  if (contains(known.refused, child.name))
    fail(where, tag + " is not read", "",
         "its bodies as <body>, as MuJoCo writes them when it saves a model");
  const auto leftOut = known.leftOut.find(tag);
  if (leftOut == known.leftOut.end()) {
    if (known.refusesOthers)
      fail(where, "unknown tag " + tag, "", "one of MuJoCo's", nearestNames(child.name, known.children));
    return warn(where, [&] {
      return fmt::format("unknown tag {} is ignored{}", tag, guess(child.name, known.children));
    });
  }
  refuseIfStrict(where, tag + " is not read", leftOut->second);
  if (leftOut->second != Difference::kNone) reading_->notes.ignore(where, tag, leftOut->second);
}

void Tag::refuseIfStrict(const SourceLocation& where, const std::string& message,
                         Difference difference) const {
  if (isStrict() && isGrave(difference))
    fail(where, fmt::format("{}: {}", message, toString(difference)), "", "");
}

void Tag::warn(const SourceLocation& where, const std::string& message, Difference difference) const {
  refuseIfStrict(where, message, difference);
  reading_->notes.warn(where, fmt::format("{}: {}", thing_, message), difference);
}

void Tag::ignore(const std::string& kind, Difference difference) const {
  refuseIfStrict(where(), kind + " is ignored", difference);
  reading_->notes.ignore(where(), kind, difference);
}

void Tag::leaveOut(const char* attribute, Difference difference) const {
  const SourceLocation at = reading_->document.where(need(attribute).at);
  refuseIfStrict(at, fmt::format("attribute '{}' is not read", attribute), difference);
  reading_->notes.leaveOut(at, fmt::format("<{}>", element_->name), attribute, difference);
}

void Tag::remark(const std::string& message, Difference difference) const {
  refuseIfStrict(where(), message, difference);
  reading_->notes.remark(where(), message, difference);
}

const xml::Attribute* Tag::find(std::string_view attribute) const {
  const auto found = std::find_if(element_->attributes.begin(), element_->attributes.end(),
                                  [&](const xml::Attribute& a) { return a.name == attribute; });
  return found == element_->attributes.end() ? nullptr : &*found;
}

const xml::Attribute& Tag::need(std::string_view attribute) const {
  if (const xml::Attribute* found = find(attribute)) return *found;
  std::vector<std::string> strange;
  for (const xml::Attribute& a : element_->attributes)
    if (!known_ || !contains(known_->attributes, a.name)) strange.push_back(a.name);
  std::vector<std::string> nearest = nearestNames(attribute, strange);
  if (nearest.empty() && known_ && strange.size() == 1) nearest = strange;
  fail(where(), fmt::format("attribute '{}' is missing", attribute),
       nearest.empty() ? "" : xml::quoted(nearest.front()), "");
}

const std::string& Tag::text(const char* attribute) const { return need(attribute).value; }

const std::string& Tag::nameIn(const char* attribute) const {
  constexpr std::size_t kLongest = 256;
  const std::string& name = text(attribute);
  if (name.empty()) failAt(attribute, "nothing", "a name");
  if (name.size() > kLongest)
    failAt(attribute, fmt::format("{} bytes", name.size()), fmt::format("at most {}", kLongest));
  // Other control characters, except blanks, are not allowed in XML.
  if (name.find('\x7f') != name.npos) failAt(attribute, "the control character \\x7f", "text");
  return name;
}

Eigen::VectorXd Tag::numbers(const char* attribute, int count) const {
  return numbers(attribute, count, count);
}

Eigen::VectorXd Tag::numbers(const char* attribute, int least, int most) const {
  const xml::Attribute& given = need(attribute);
  const std::string wanted = least < most ? fmt::format("{} to {} numbers", least, most)
                             : most == 1  ? "a number"
                                          : fmt::format("{} numbers", most);
  const Numbers numbers = parseNumbers(given.value, static_cast<std::size_t>(most));
  if (numbers.faultAt) {
    fail(reading_->document.where(given, *numbers.faultAt), fmt::format("attribute '{}'", attribute),
         xml::quoted(numbers.fault), numbers.isNumber ? "finite numbers that fit into 64 bits" : wanted);
  }
  const auto count = static_cast<int>(numbers.values.size());
  if (count < least || count > most) failAt(attribute, xml::quoted(given.value), wanted);
  return Eigen::Map<const Eigen::VectorXd>(numbers.values.data(), count);
}

double Tag::notNegative(const char* attribute) const {
  const double value = number(attribute);
  if (value < 0) failAt(attribute, fmt::format("{}", value), "a number >= 0");
  return value;
}

double Tag::positive(const char* attribute) const {
  const double value = number(attribute);
  if (!(value > 0)) failAt(attribute, fmt::format("{}", value), "a number > 0");
  return value;
}

std::optional<Tag> Tag::child(const char* name) const {
  const xml::Element* only = nullptr;
  for (const xml::Element& element : element_->children) {
    if (element.name != name) continue;
    if (only)
      forgive(reading_->document.where(element.at), fmt::format("a second <{}>", name), "",
              fmt::format("one: the first is at {}", toString(reading_->document.where(only->at))),
              "it is ignored");
    else
      only = &element;
  }
  return only ? std::optional(Tag(*this, *only)) : std::nullopt;
}

Tag Tag::neededChild(const char* name, const std::string& wanted) const {
  if (std::optional<Tag> found = child(name)) return *std::move(found);
  std::vector<std::string> present;
  for (const xml::Element& element : element_->children)
    if (present.size() < 100) present.push_back(element.name);
  const std::vector<std::string> nearest = nearestNames(name, present);
  fail(where(), fmt::format("<{}> is missing", name),
       nearest.empty() ? "" : fmt::format("<{}>", nearest.front()), wanted);
}

std::vector<Tag> Tag::children(std::string_view name) const {
  std::vector<Tag> found;
  for (const xml::Element& element : element_->children)
    if (element.name == name) found.push_back(Tag(*this, element));
  return found;
}

std::vector<Tag> Tag::children() const {
  std::vector<Tag> found;
  for (const xml::Element& element : element_->children) found.push_back(Tag(*this, element));
  return found;
}

Pose Tag::origin() const {
  const std::optional<Tag> tag = child("origin");
  if (!tag) return {};
  static const Known kKnown = {{"xyz", "rpy"}, {}};
  tag->expect(kKnown);
  Pose X;
  if (tag->has("xyz")) X.p = tag->numbers("xyz", 3);
  if (tag->has("rpy")) {
    const Eigen::Vector3d angles = tag->numbers("rpy", 3);
    if (angles.cwiseAbs().maxCoeff() > 2 * std::numbers::pi)
      tag->warn(tag->where("rpy"), fmt::format("attribute 'rpy' is {}: degrees? angles are radians",
                                               xml::quoted(tag->text("rpy"))));
    X.R = rotationFromRollPitchYaw(angles);
  }
  return X;
}

void Tag::warn(const SourceLocation& where, const std::string& message) const {
  reading_->notes.warn(where, fmt::format("{}: {}", thing_, message));
}

void Tag::forgive(const SourceLocation& where, const std::string& what, std::string found, std::string wanted,
                  const std::string& instead, Difference difference) const {
  reading_->forgive({fmt::format("{}: {}", thing_, what), where, std::move(found), std::move(wanted)},
                    instead, difference);
}

void Tag::forgiveAt(const char* attribute, std::string found, std::string wanted,
                    const std::string& instead) const {
  forgive(where(attribute), fmt::format("attribute '{}'", attribute), std::move(found), std::move(wanted),
          instead);
}

void Tag::fail(const SourceLocation& where, const std::string& what, std::string found, std::string wanted,
               std::vector<std::string> nearest) const {
  throw Error(
      {fmt::format("{}: {}", thing_, what), where, std::move(found), std::move(wanted), std::move(nearest)});
}

void Tag::failAt(const char* attribute, std::string found, std::string wanted) const {
  fail(where(attribute), fmt::format("attribute '{}'", attribute), std::move(found), std::move(wanted));
}

}  // namespace rex::urdf
