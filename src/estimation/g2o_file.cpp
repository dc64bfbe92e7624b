#include "estimation/g2o_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "estimation/covariance.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

constexpr const char* kFix = "FIX";
const std::vector<std::string> kTags = {"VERTEX_SE2", "EDGE_SE2", "VERTEX_SE3:QUAT", "EDGE_SE3:QUAT", kFix};

// A line of words.
struct Line {
  SourceLocation where;
  std::vector<std::pair<std::string_view, int>> words;  // with their columns

  SourceLocation at(std::size_t word) const {
    return {where.file, where.line, word < words.size() ? words[word].second : 0};
  }
};

Line wordsOf(std::string_view text, const std::string& file, int number) {
  Line line{{file, number, 0}, {}};
  if (const auto comment = text.find('#'); comment != std::string_view::npos) text = text.substr(0, comment);
  constexpr std::string_view kBlank = " \t\r\v\f";
  for (std::size_t at = text.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
    line.words.emplace_back(text.substr(at, end - at), static_cast<int>(at) + 1);
    at = text.find_first_not_of(kBlank, end);
  }
  return line;
}

template <class Number>
Number number(const Line& line, std::size_t word, const char* wanted) {
  std::string_view text = line.words[word].first;
  if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
  Number value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isWhole = problem == std::errc() && end == text.data() + text.size();
  if (isWhole && std::isfinite(static_cast<double>(value))) return value;
  throw Error({.what = std::string(line.words[0].first),
               .where = line.at(word),
               .found = fmt::format("'{}'", line.words[word].first),
               .wanted = wanted});
}

void requireCount(const Line& line, std::size_t wanted) {
  if (line.words.size() == wanted + 1) return;
  throw Error({.what = std::string(line.words[0].first),
               .where = line.at(std::min(wanted + 1, line.words.size() - 1)),
               .found = fmt::format("{} numbers", line.words.size() - 1),
               .wanted = fmt::format("{}", wanted)});
}

Eigen::VectorXd numbers(const Line& line, std::size_t first) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(line.words.size() - first));
  for (std::size_t i = first; i < line.words.size(); ++i)
    values[static_cast<Eigen::Index>(i - first)] = number<double>(line, i, "a finite number");
  return values;
}

// A symmetric matrix from its upper triangle, row by row.
template <int Size>
Eigen::Matrix<double, Size, Size> information(const Line& line, const Eigen::VectorXd& upper) {
  Eigen::Matrix<double, Size, Size> matrix;
  Eigen::Index k = 0;
  for (int i = 0; i < Size; ++i)
    for (int j = i; j < Size; ++j) matrix(i, j) = matrix(j, i) = upper[k++];
  try {
    requireCovariance(std::string(line.words[0].first) + ": information", matrix, Size);
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.where = line.where;
    throw Error(parts);
  }
  return matrix;
}

Pose poseFrom(const Line& line, std::size_t quaternionWord, const Eigen::VectorXd& values) {
  const Quaternion q(values[6], values[3], values[4], values[5]);  // the file has w last
  if (!(std::abs(q.norm() - 1) <= 1e-3))
    throw Error({.what = fmt::format("{}: quaternion", line.words[0].first),
                 .where = line.at(quaternionWord),
                 .found = fmt::format("length {:g}", q.norm()),
                 .wanted = "length 1"});
  return {rotationFromQuaternion(q), values.head<3>()};
}

struct Planar {
  using Graph = PlanarPoseGraph;
  using Edge = PlanarEdge;
  static constexpr int kSize = 3;
  static constexpr std::size_t kPoseNumbers = 3;
  static constexpr const char *kVertex = "VERTEX_SE2", *kEdge = "EDGE_SE2";
  static Eigen::Vector3d pose(const Line&, std::size_t, const Eigen::VectorXd& values) {
    return values.head<3>();
  }
  static void resize(Graph& graph, std::size_t count) {
    graph.poses.setZero(3, static_cast<Eigen::Index>(count));
  }
  static void set(Graph& graph, int i, const Eigen::Vector3d& pose) { graph.poses.col(i) = pose; }
};

struct Spatial {
  using Graph = SpatialPoseGraph;
  using Edge = SpatialEdge;
  static constexpr int kSize = 6;
  static constexpr std::size_t kPoseNumbers = 7;
  static constexpr const char *kVertex = "VERTEX_SE3:QUAT", *kEdge = "EDGE_SE3:QUAT";
  static Pose pose(const Line& line, std::size_t first, const Eigen::VectorXd& values) {
    return poseFrom(line, first + 3, values);
  }
  static void resize(Graph& graph, std::size_t count) { graph.poses.resize(count); }
  static void set(Graph& graph, int i, const Pose& pose) { graph.poses[static_cast<std::size_t>(i)] = pose; }
};

// Reads the lines of one kind of poses.
template <class Kind>
class Reader {
 public:
  void read(const Line& line) {
    const std::string_view tag = line.words[0].first;
    if (tag == Kind::kVertex) return readVertex(line);
    if (tag == Kind::kEdge) return readEdge(line);
    if (tag == kFix) return fixes_.push_back(line);
    throw Error({.what = "pose graph",
                 .where = line.at(0),
                 .found = fmt::format("{} among {}", tag, Kind::kVertex),
                 .wanted = "planar or spatial poses only"});
  }

  G2oFile finish() {
    G2oFile result;
    result.hasPoses = !vertices_.empty();
    if (!result.hasPoses)
      for (const auto& [line, from, to, edge] : edges_)
        vertices_.try_emplace(from, line.at(1)), vertices_.try_emplace(to, line.at(2));
    typename Kind::Graph graph;
    Kind::resize(graph, vertices_.size());
    std::map<long, int> places;
    for (const auto& [id, vertex] : vertices_) {
      const int place = static_cast<int>(result.ids.size());
      places[id] = place;
      result.ids.push_back(id);
      if (vertex.pose) Kind::set(graph, place, *vertex.pose);
    }
    const auto placeOf = [&](const Line& line, std::size_t word, long id) {
      const auto place = places.find(id);
      if (place != places.end()) return place->second;
      throw Error({.what = fmt::format("{}", line.words[0].first),
                   .where = line.at(word),
                   .found = fmt::format("pose {}, which the file does not have", id)});
    };
    for (const auto& [line, from, to, read] : edges_) {
      typename Kind::Edge edge = read;
      edge.from = placeOf(line, 1, from);
      edge.to = placeOf(line, 2, to);
      graph.edges.push_back(edge);
    }
    noteFixes(placeOf, result);
    if (const auto loose = internal::loosePose(graph)) {
      const long id = result.ids[static_cast<std::size_t>(*loose)];
      throw Error({.what = "pose graph",
                   .where = vertices_.at(id).where,
                   .found = fmt::format("pose {}, which no edges join to pose {}", id, result.ids.front()),
                   .wanted = "a graph in one piece"});
    }
    if (!result.hasPoses) setOdometryPoses(graph);
    result.graph = std::move(graph);
    return result;
  }

 private:
  void readVertex(const Line& line) {
    requireCount(line, 1 + Kind::kPoseNumbers);
    const long id = number<long>(line, 1, "a whole number");
    if (!vertices_.try_emplace(id, line.at(1), Kind::pose(line, 2, numbers(line, 2))).second)
      throw Error({.what = fmt::format("{}", line.words[0].first),
                   .where = line.at(1),
                   .found = fmt::format("a second pose {}", id)});
  }
  void readEdge(const Line& line) {
    constexpr std::size_t kUpper = Kind::kSize * (Kind::kSize + 1) / 2;
    requireCount(line, 2 + Kind::kPoseNumbers + kUpper);
    const long from = number<long>(line, 1, "a whole number"), to = number<long>(line, 2, "a whole number");
    if (from == to)
      throw Error({.what = fmt::format("{}", line.words[0].first),
                   .where = line.at(2),
                   .found = fmt::format("pose {} again", to),
                   .wanted = "two different poses"});
    const Eigen::VectorXd values = numbers(line, 3);
    typename Kind::Edge edge;
    edge.motion = Kind::pose(line, 3, values.head(Kind::kPoseNumbers));
    edge.information = information<Kind::kSize>(line, values.tail(kUpper));
    edges_.push_back({line, from, to, edge});
  }
  template <class PlaceOf>
  void noteFixes(const PlaceOf& placeOf, G2oFile& result) const {
    std::optional<long> fixed;
    for (const Line& line : fixes_) {
      if (line.words.size() < 2) requireCount(line, 1);
      for (std::size_t word = 1; word < line.words.size(); ++word) {
        const long id = number<long>(line, word, "a whole number");
        const int place = placeOf(line, word, id);
        if (fixed && *fixed != id)
          throw Error({.what = kFix,
                       .where = line.at(word),
                       .found = fmt::format("pose {} besides pose {}", id, *fixed),
                       .wanted = "one pose that is fixed"});
        if (place != 0 && !fixed)
          result.notes.push_back(
              {line.at(word), fmt::format("FIX {} is not needed: pose {} stays where it is, and costs do "
                                          "not depend on which one stays",
                                          id, result.ids.front())});
        fixed = id;
      }
    }
  }

  struct ReadEdge {
    Line line;
    long from, to;
    typename Kind::Edge edge;
  };
  using PoseOf = decltype(Kind::pose({}, 0, {}));
  struct Vertex {
    SourceLocation where;
    std::optional<PoseOf> pose{};
    Vertex(SourceLocation place, std::optional<PoseOf> read = {}) : where(std::move(place)), pose(read) {}
  };
  std::map<long, Vertex> vertices_;
  std::vector<ReadEdge> edges_;
  std::vector<Line> fixes_;
};

template <class Kind>
G2oFile readAll(const std::vector<Line>& lines) {
  Reader<Kind> reader;
  for (const Line& line : lines) reader.read(line);
  return reader.finish();
}

}  // namespace

G2oFile parseG2o(std::string_view text, const std::string& file) {
  std::vector<Line> lines;
  int number = 0;
  bool isSpatial = false, isKnown = false, hasEdges = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Line line = wordsOf(text.substr(0, end), file, ++number);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.words.empty()) continue;
    const std::string tag(line.words[0].first);
    if (std::find(kTags.begin(), kTags.end(), tag) == kTags.end())
      throw Error({.what = "pose graph",
                   .where = line.at(0),
                   .found = fmt::format("'{}'", tag),
                   .wanted = "VERTEX_SE2, EDGE_SE2, VERTEX_SE3:QUAT, EDGE_SE3:QUAT or FIX",
                   .nearest = nearestNames(tag, kTags)});
    if (!isKnown) isSpatial = tag.find("SE3") != std::string::npos;
    isKnown = isKnown || tag != kFix;
    hasEdges = hasEdges || tag.starts_with("EDGE");
    lines.push_back(std::move(line));
  }
  if (!hasEdges)
    throw Error({.what = "pose graph", .where = {file, 0, 0}, .found = "no edges", .wanted = "one or more"});
  return isSpatial ? readAll<Spatial>(lines) : readAll<Planar>(lines);
}

G2oFile readG2o(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!std::filesystem::is_regular_file(file) || !stream || !(text << stream.rdbuf()))
    throw Error({.what = "pose graph", .where = {file.string(), 0, 0}, .found = "no file that can be read"});
  return parseG2o(std::move(text).str(), file.string());
}

namespace {

template <class Matrix>
void appendUpper(std::string& text, const Matrix& information) {
  for (Eigen::Index i = 0; i < information.rows(); ++i)
    for (Eigen::Index j = i; j < information.cols(); ++j) text += fmt::format(" {}", information(i, j));
  text += '\n';
}

std::string numbersOf(const Eigen::Vector3d& pose) {
  return fmt::format(" {} {} {}", pose[0], pose[1], pose[2]);
}
std::string numbersOf(const Pose& pose) {
  const Quaternion q = quaternionFromRotation(pose.R);
  return fmt::format(" {} {} {} {} {} {} {}", pose.p[0], pose.p[1], pose.p[2], q[1], q[2], q[3], q[0]);
}

template <class Kind, class PoseAt>
std::string write(const G2oFile& file, const typename Kind::Graph& graph, std::size_t poses,
                  const PoseAt& poseAt) {
  internal::requireSound(graph);
  if (!file.ids.empty() && file.ids.size() != poses)
    throw Error({.what = "pose graph: ids",
                 .found = fmt::format("{}", file.ids.size()),
                 .wanted = fmt::format("{}, one for each pose, or none", poses)});
  const auto idOf = [&](std::size_t i) { return file.ids.empty() ? static_cast<long>(i) : file.ids[i]; };
  std::string text;
  for (std::size_t i = 0; i < poses; ++i)
    text += fmt::format("{} {}{}\n", Kind::kVertex, idOf(i), numbersOf(poseAt(i)));
  for (const auto& edge : graph.edges) {
    text += fmt::format("{} {} {}{}", Kind::kEdge, idOf(static_cast<std::size_t>(edge.from)),
                        idOf(static_cast<std::size_t>(edge.to)), numbersOf(edge.motion));
    appendUpper(text, edge.information);
  }
  return text;
}

}  // namespace

std::string writeG2o(const G2oFile& file) {
  if (const auto* planar = std::get_if<PlanarPoseGraph>(&file.graph))
    return write<Planar>(
        file, *planar, static_cast<std::size_t>(planar->poses.cols()),
        [&](std::size_t i) -> Eigen::Vector3d { return planar->poses.col(static_cast<Eigen::Index>(i)); });
  const auto& spatial = std::get<SpatialPoseGraph>(file.graph);
  return write<Spatial>(file, spatial, spatial.poses.size(), [&](std::size_t i) { return spatial.poses[i]; });
}

}  // namespace rex
