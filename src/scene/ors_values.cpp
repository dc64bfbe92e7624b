#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "geometry/rotation.h"
#include "scene/ors_limits_internal.h"
#include "scene/ors_values_internal.h"

namespace rex::ors {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The numbers of an array, row after row.
struct Rows {
  std::vector<double> numbers{};
  std::size_t rowStart = 0, columns = 0;
  bool mayDiffer = false;

  void end(const Cursor& cursor) {
    const std::size_t length = numbers.size() - rowStart;
    if (length == 0) return;
    if (columns != 0 && length != columns && !mayDiffer) {
      cursor.fail("row of an array", fmt::format("{} numbers", length),
                  fmt::format("{}, as in the first row", columns));
    }
    columns = length;
    rowStart = numbers.size();
  }
};

std::pair<int, int> readDimensions(Cursor& cursor) {
  cursor.take();
  std::vector<int> sizes;
  for (cursor.skip(" \t"); cursor.peek() != '>'; cursor.skip(" \t")) {
    const double size = cursor.number("a dimension or '>'");
    if (size < 0 || size > static_cast<double>(kMostNumbers) || size != std::floor(size))
      cursor.fail("array dimension", fmt::format("{}", size), "a count");
    sizes.push_back(static_cast<int>(size));
  }
  cursor.take();
  if (sizes.empty() || sizes.size() > 2)
    cursor.fail("array dimensions", fmt::format("{} of them", sizes.size()), "one or two");
  return sizes.size() == 1 ? std::pair(1, sizes[0]) : std::pair(sizes[0], sizes[1]);
}

Eigen::VectorXd readNumbers(Cursor& cursor, int count, const char* wanted) {
  Eigen::VectorXd values(count);
  for (double& value : values) {
    cursor.skip(kSpace);
    if (cursor.peek() == ',')
      cursor.fail("a comma in a pose", cursor.found(), fmt::format("{} separated by blanks", wanted));
    if (cursor.atEnd() || contains(")>", cursor.peek()))
      cursor.fail("too few numbers in a pose", cursor.found(), wanted);
    value = cursor.number(wanted);
  }
  return values;
}

Eigen::Matrix3d rotationFromFile(const Place& where, const Eigen::Vector4d& quaternion) {
  if (quaternion.isZero(0))
    Cursor::failAt(where, "quaternion", "(0, 0, 0, 0)", "a quaternion w x y z that is not zero");
  return rotationFromQuaternion(quaternion);
}

Pose readPoseElement(Cursor& cursor) {
  const Place start = cursor.here();
  if (cursor.atNumber()) {
    const Eigen::VectorXd n = readNumbers(cursor, 7, "x y z qw qx qy qz");
    return {rotationFromFile(start, n.tail<4>()), n.head<3>()};
  }
  const char kind = cursor.peek();
  if (!contains("tdrqE", kind) || cursor.found() != fmt::format("'{}'", kind)) {
    cursor.fail("unknown element of a pose", cursor.found(),
                "t(..), d(..), r(..), q(..), E(..), seven numbers, or '>'");
  }
  cursor.take();
  const std::string name = fmt::format("pose element '{}'", kind);
  if (cursor.peek() != '(') cursor.fail(name, cursor.found(), "'('");
  cursor.take();
  const bool three = kind == 't' || kind == 'E';
  const Eigen::VectorXd n = readNumbers(cursor, three ? 3 : 4, three ? "three numbers" : "four numbers");
  cursor.skip(kSpace);
  if (cursor.peek() != ')') cursor.fail(name, cursor.found(), fmt::format("')' after {} numbers", n.size()));
  cursor.take();
  if ((kind == 'd' || kind == 'r') && n[0] != 0 && n.tail<3>().isZero(0))
    cursor.warn(start, name + " about a zero axis has no effect: give the axis x y z");
  switch (kind) {
    case 't':
      return translation(n[0], n[1], n[2]);
    case 'd':
      return rotation(n[0] * std::numbers::pi / 180, n.tail<3>());
    case 'r':
      return rotation(n[0], n.tail<3>());
    case 'q':
      return {rotationFromFile(start, n), Eigen::Vector3d::Zero()};
    default:
      return {rotationFromRollPitchYaw(n), Eigen::Vector3d::Zero()};
  }
}

// Elements apply left to right, each relative to the frame so far.
Pose readPose(Cursor& cursor, const Place& open) {
  Pose X;
  for (cursor.skip(" \t\r\n|<"); cursor.peek() != '>'; cursor.skip(" \t\r\n|")) {
    if (cursor.atEnd()) Cursor::failAt(open, "'<T' is never closed", "", "a '>'");
    X = X * readPoseElement(cursor);
  }
  if (!X.p.allFinite()) Cursor::failAt(open, "pose", "a position beyond the range of numbers", "metres");
  cursor.take();
  return X;
}

}  // namespace

Eigen::MatrixXd readArray(Cursor& cursor) {
  const Place open = cursor.here();
  cursor.take();
  cursor.skip(kSpace);
  std::optional<std::pair<int, int>> dimensions;
  if (cursor.peek() == '<') dimensions = readDimensions(cursor);
  Rows rows{.mayDiffer = dimensions.has_value()};
  for (cursor.skip(" \t\r,"); cursor.peek() != ']'; cursor.skip(" \t\r,")) {
    if (cursor.atEnd()) Cursor::failAt(open, "'[' is never closed", "", "a ']'");
    if (cursor.peek() == ';' || cursor.peek() == '\n') {
      rows.end(cursor);
      cursor.take();
    } else {
      rows.numbers.push_back(cursor.number("a number or ']'", true));
      if (rows.numbers.size() > kMostNumbers)
        Cursor::failAt(open, "array too long", "", fmt::format("at most {} numbers", kMostNumbers));
    }
  }
  rows.end(cursor);
  cursor.take();
  const auto count = static_cast<Eigen::Index>(rows.numbers.size());
  if (!dimensions) {
    const auto columns = static_cast<Eigen::Index>(rows.columns);
    return Eigen::Map<const RowMajor>(rows.numbers.data(), columns == 0 ? 0 : count / columns, columns);
  }
  const auto [height, width] = *dimensions;
  if (Eigen::Index{height} * width != count) {
    Cursor::failAt(open, "array with explicit dimensions", fmt::format("{} numbers", count),
                   fmt::format("{} x {}", height, width));
  }
  return Eigen::Map<const RowMajor>(rows.numbers.data(), height, width);
}

Value readTyped(Cursor& cursor) {
  const Place open = cursor.here();
  cursor.take();
  cursor.skip(kSpace);
  const std::string type = cursor.word(" \t\r\n>|");
  if (type == "T") return readPose(cursor, open);
  return type + cursor.upTo('>', open, "'<'");
}

}  // namespace rex::ors
