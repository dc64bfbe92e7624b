#include "estimation/g2o_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "estimation/gaussian.h"
#include "estimation/pose_edge_internal.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

constexpr const char *kFix = "FIX", *kLandmark = "VERTEX_XY", *kSighting = "EDGE_SE2_XY";
const std::vector<std::string> kTags = {"VERTEX_SE2",      "EDGE_SE2",      kLandmark, kSighting,
                                        "VERTEX_SE3:QUAT", "EDGE_SE3:QUAT", kFix};

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
  for (const std::string_view word : splitWords(text)) line.words.emplace_back(word, columnIn(text, word));
  return line;
}

template <class Number>
Number number(const Line& line, std::size_t word, const char* wanted) {
  if (const std::optional<Number> value = parseNumber<Number>(line.words[word].first)) return *value;
  throw Error({.what = std::string(line.words[0].first),
               .where = line.at(word),
               .found = fmt::format("'{}'", line.words[word].first),
               .wanted = wanted});
}

void requireWords(const Line& line, std::size_t wanted) {
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

// What is reported once for many lines, by their tags.
class Findings {
 public:
  void add(std::string_view tag, const SourceLocation& where, const std::string& fault) {
    Finding& finding = byTag_[std::string(tag)];
    if (finding.count++ == 0) finding = {where, fault, 1};
  }
  // `instead` says what is done about it.
  void noteAll(const char* instead, std::vector<Diagnostic>& notes) const {
    for (const auto& [tag, finding] : byTag_) {
      const std::string times =
          finding.count > 1 ? fmt::format(" ({} lines, this is the first)", finding.count) : "";
      notes.push_back({finding.first, fmt::format("{}: {}; {}{}", tag, finding.fault, instead, times),
                       Severity::kWarning});
    }
  }

 private:
  struct Finding {
    SourceLocation first{};
    std::string fault{};
    int count = 0;
  };
  std::map<std::string, Finding> byTag_;
};

// A symmetric matrix from its upper triangle, row by row; replaced by the nearest one that can be
// information.
template <int Size>
Eigen::Matrix<double, Size, Size> information(const Line& line, const Eigen::VectorXd& upper,
                                              Findings& indefinite) {
  Eigen::Matrix<double, Size, Size> matrix;
  Eigen::Index k = 0;
  for (int i = 0; i < Size; ++i)
    for (int j = i; j < Size; ++j) matrix(i, j) = matrix(j, i) = upper[k++];
  try {
    requireCovariance("information", matrix, Size);
  } catch (const Error& error) {
    indefinite.add(line.words[0].first, line.where, error.what());
    matrix = nearestSemidefinite(matrix);
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
  static constexpr bool kHasLandmarks = true;
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
  static constexpr bool kHasLandmarks = false;
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
    if (Kind::kHasLandmarks && tag == kLandmark) return readLandmark(line);
    if (Kind::kHasLandmarks && tag == kSighting) return readSighting(line);
    throw Error({.what = "pose graph",
                 .where = line.at(0),
                 .found = fmt::format("{} among {}", tag, Kind::kVertex),
                 .wanted = "planar or spatial poses only"});
  }

  G2oFile finish() {
    G2oFile result;
    result.hasPoses = !vertices_.empty();
    if (!result.hasPoses) addVerticesOfEdges();
    requireDifferent();
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
    if constexpr (Kind::kHasLandmarks) addLandmarks(placeOf, result, graph);
    noteFixes(placeOf, result);
    indefinite_.noteAll(
        "it is replaced by the nearest positive semidefinite matrix, whose negative "
        "eigenvalues are 0",
        result.notes);
    if (const auto loose = internal::loosePose(graph)) {
      const long id = result.ids[static_cast<std::size_t>(*loose)];
      throw Error({.what = "pose graph",
                   .where = vertices_.at(id).where,
                   .found = fmt::format("pose {}, which no edges join to pose {}", id, result.ids.front()),
                   .wanted = "a connected graph"});
    }
    if constexpr (Kind::kHasLandmarks) requireSeen(graph, result);
    if (!result.hasPoses) setOdometryPoses(graph);
    result.graph = std::move(graph);
    return result;
  }

 private:
  // For a file that has only edges.
  void addVerticesOfEdges() {
    for (const auto& [line, from, to, edge] : edges_)
      vertices_.try_emplace(from, line.at(1)), vertices_.try_emplace(to, line.at(2));
    for (const Sighting& sighting : sightings_) {
      vertices_.try_emplace(sighting.pose, sighting.line.at(1));
      landmarks_.try_emplace(sighting.landmark, Landmark{sighting.line.at(2)});
    }
  }
  void requireDifferent() const {
    for (const auto& [id, landmark] : landmarks_)
      if (vertices_.contains(id))
        throw Error({.what = "pose graph",
                     .where = landmark.where,
                     .found = fmt::format("landmark {}, which is a pose as well", id),
                     .wanted = "an id of its own"});
  }
  void readLandmark(const Line& line) {
    requireWords(line, 3);
    const long id = number<long>(line, 1, "a whole number");
    if (!landmarks_.try_emplace(id, Landmark{line.at(1), numbers(line, 2)}).second)
      throw Error({.what = kLandmark, .where = line.at(1), .found = fmt::format("a second landmark {}", id)});
  }
  void readSighting(const Line& line) {
    requireWords(line, 7);
    const long pose = number<long>(line, 1, "a whole number"), mark = number<long>(line, 2, "a whole number");
    const Eigen::VectorXd values = numbers(line, 3);
    LandmarkEdge edge;
    edge.position = values.head<2>();
    edge.information = information<2>(line, values.tail(3), indefinite_);
    sightings_.push_back({line, pose, mark, edge});
  }
  template <class PlaceOf>
  void addLandmarks(const PlaceOf& placeOf, G2oFile& result, typename Kind::Graph& graph) const {
    graph.landmarks.setZero(2, static_cast<Eigen::Index>(landmarks_.size()));
    std::map<long, int> places;
    for (const auto& [id, landmark] : landmarks_) {
      const auto place = static_cast<int>(places.size());
      places[id] = place;
      result.landmarkIds.push_back(id);
      if (landmark.position) graph.landmarks.col(place) = *landmark.position;
    }
    for (const Sighting& sighting : sightings_) {
      LandmarkEdge edge = sighting.edge;
      edge.pose = placeOf(sighting.line, 1, sighting.pose);
      const auto place = places.find(sighting.landmark);
      if (place == places.end())
        throw Error({.what = kSighting,
                     .where = sighting.line.at(2),
                     .found = fmt::format("landmark {}, which the file does not have", sighting.landmark)});
      edge.landmark = place->second;
      graph.sightings.push_back(edge);
    }
  }
  void requireSeen(const typename Kind::Graph& graph, const G2oFile& result) const {
    const auto unseen = internal::unseenLandmark(graph);
    if (!unseen) return;
    const long id = result.landmarkIds[static_cast<std::size_t>(*unseen)];
    throw Error({.what = "pose graph",
                 .where = landmarks_.at(id).where,
                 .found = fmt::format("landmark {}, which no pose sees", id),
                 .wanted = fmt::format("one or more {}", kSighting)});
  }
  void readVertex(const Line& line) {
    requireWords(line, 1 + Kind::kPoseNumbers);
    const long id = number<long>(line, 1, "a whole number");
    if (!vertices_.try_emplace(id, line.at(1), Kind::pose(line, 2, numbers(line, 2))).second)
      throw Error({.what = fmt::format("{}", line.words[0].first),
                   .where = line.at(1),
                   .found = fmt::format("a second pose {}", id)});
  }
  void readEdge(const Line& line) {
    constexpr std::size_t kUpper = Kind::kSize * (Kind::kSize + 1) / 2;
    requireWords(line, 2 + Kind::kPoseNumbers + kUpper);
    const long from = number<long>(line, 1, "a whole number"), to = number<long>(line, 2, "a whole number");
    if (from == to)
      throw Error({.what = fmt::format("{}", line.words[0].first),
                   .where = line.at(2),
                   .found = fmt::format("pose {} again", to),
                   .wanted = "two different poses"});
    const Eigen::VectorXd values = numbers(line, 3);
    typename Kind::Edge edge;
    edge.motion = Kind::pose(line, 3, values.head(Kind::kPoseNumbers));
    edge.information = information<Kind::kSize>(line, values.tail(kUpper), indefinite_);
    edges_.push_back({line, from, to, edge});
  }
  template <class PlaceOf>
  void noteFixes(const PlaceOf& placeOf, G2oFile& result) const {
    std::optional<long> fixed;
    for (const Line& line : fixes_) {
      if (line.words.size() < 2) requireWords(line, 1);
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
              {line.at(word), fmt::format("FIX {} has no effect: pose {} stays where it is, and costs do "
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
  struct Landmark {
    SourceLocation where;
    std::optional<Eigen::Vector2d> position{};
  };
  struct Sighting {
    Line line;
    long pose, landmark;
    LandmarkEdge edge;
  };
  std::map<long, Vertex> vertices_;
  std::map<long, Landmark> landmarks_;
  std::vector<ReadEdge> edges_;
  std::vector<Sighting> sightings_;
  Findings indefinite_;
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
  Findings unknown;
  int number = 0;
  bool isSpatial = false, isKnown = false, hasEdges = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Line line = wordsOf(text.substr(0, end), file, ++number);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.words.empty()) continue;
    const std::string tag(line.words[0].first);
    if (std::find(kTags.begin(), kTags.end(), tag) == kTags.end()) {
      const std::vector<std::string> nearest = nearestNames(tag, kTags);
      unknown.add(tag, line.at(0),
                  "not a tag that rex reads" +
                      (nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest.front())));
      continue;
    }
    if (!isKnown) isSpatial = tag.find("SE3") != std::string::npos;
    isKnown = isKnown || tag != kFix;
    hasEdges = hasEdges || tag.starts_with("EDGE");
    lines.push_back(std::move(line));
  }
  if (!hasEdges)
    throw Error({.what = "pose graph", .where = {file, 0, 0}, .found = "no edges", .wanted = "one or more"});
  G2oFile result = isSpatial ? readAll<Spatial>(lines) : readAll<Planar>(lines);
  unknown.noteAll("it is left out", result.notes);
  return result;
}

G2oFile readG2o(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!std::filesystem::is_regular_file(file) || !stream || !(text << stream.rdbuf()))
    throw Error(
        {.what = "pose graph", .where = {file.string(), 0, 0}, .found = "a file that cannot be read"});
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

// The landmarks, and where they were seen. Those without ids follow the poses.
template <class IdOfPose>
std::string landmarkLines(const G2oFile& file, const PlanarPoseGraph& graph, const IdOfPose& idOfPose) {
  const auto landmarks = static_cast<std::size_t>(graph.landmarks.cols());
  if (!file.landmarkIds.empty() && file.landmarkIds.size() != landmarks)
    throw Error({.what = "pose graph: ids of landmarks",
                 .found = fmt::format("{}", file.landmarkIds.size()),
                 .wanted = fmt::format("{}, one for each landmark, or none", landmarks)});
  const auto poses = static_cast<std::size_t>(graph.poses.cols());
  const long next = poses > 0 ? idOfPose(poses - 1) + 1 : 0;
  const auto idOf = [&](std::size_t i) {
    return file.landmarkIds.empty() ? next + static_cast<long>(i) : file.landmarkIds[i];
  };
  std::string text;
  for (std::size_t i = 0; i < landmarks; ++i) {
    const auto position = graph.landmarks.col(static_cast<Eigen::Index>(i));
    text += fmt::format("{} {} {} {}\n", kLandmark, idOf(i), position[0], position[1]);
  }
  for (const LandmarkEdge& edge : graph.sightings) {
    text += fmt::format("{} {} {} {} {}", kSighting, idOfPose(static_cast<std::size_t>(edge.pose)),
                        idOf(static_cast<std::size_t>(edge.landmark)), edge.position[0], edge.position[1]);
    appendUpper(text, edge.information);
  }
  return text;
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
  if constexpr (Kind::kHasLandmarks) text += landmarkLines(file, graph, idOf);
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
