#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "formats/mjcf_parts_internal.h"
#include "formats/scaled_mesh.h"
#include "formats/texture_reader_internal.h"
#include "geometry/convex_hull.h"
#include "geometry/welded_mesh.h"

namespace rex::mjcf {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHeightFields = 16;
constexpr const char* kMeshInertias[] = {"convex", "exact", "legacy", "shell"};

template <class Thing>
void add(const Tag& tag, const std::string& name, const char* attribute, Thing thing,
         std::unordered_map<std::string, Thing>& things) {
  if (!things.emplace(name, std::move(thing)).second)
    tag.fail(tag.where(attribute), fmt::format("a second {} of this name", tag.name()), xml::quoted(name),
             "a name of its own");
}

void readMesh(const Styled& styled, const Compiler& compiler, MjcfAssets& assets) {
  const Tag& tag = styled.own();
  MeshAsset mesh;
  mesh.where = tag.where("file");
  if (tag.has("file")) {
    const std::string& file = tag.nameIn("file");
    const fs::path path = compiler.stripsPaths ? fs::path(file).filename() : fs::path(file);
    mesh.file = (fs::path(compiler.meshFolder) / path).generic_string();
  }
  if (const Tag& giver = styled.giver("scale"); giver.has("scale")) {
    mesh.scale = giver.numbers("scale", 3);
    if ((mesh.scale.array() == 0).any())
      giver.failAt("scale", xml::quoted(giver.text("scale")), "3 numbers that are not 0");
  }
  mesh.X_SM = placeOfMesh(tag, mesh.scale);
  if (TriangleMesh own = mesh.file.empty() ? meshInTag(tag) : TriangleMesh(); !own.isEmpty()) {
    mesh.mesh = scaledMesh(own, mesh.scale, tag.nameIn("name"));
    mesh.hull = convexHull(mesh.mesh);
  }
  const Tag& giver = styled.giver("inertia");
  mesh.inertia = giver.has("inertia")
                     ? static_cast<MeshInertia>(
                           choice(giver, "inertia", {std::begin(kMeshInertias), std::end(kMeshInertias)}))
                     : compiler.meshInertia;
  // Without a name it is named after its file.
  const bool isNamed = tag.has("name") || !tag.has("file");
  const std::string name = isNamed ? tag.nameIn("name") : fs::path(tag.text("file")).stem().string();
  add(tag, name, isNamed ? "name" : "file", std::move(mesh), assets.meshes);
}

void readMaterial(const Styled& styled, MjcfAssets& assets) {
  const Eigen::Vector4d color = colorOf(styled).value_or(Eigen::Vector4d::Ones());
  add(styled.own(), styled.own().nameIn("name"), "name", color, assets.colors);
}

}  // namespace

const char* wordOf(MeshInertia inertia) { return kMeshInertias[static_cast<std::size_t>(inertia)]; }

std::optional<Eigen::Vector4d> colorOf(const Styled& styled) {
  const Tag* const giver = styled.giverOfText("rgba");
  if (!giver) return {};
  const Eigen::Vector4d color = giver->numbers("rgba", 4);
  if (color.minCoeff() < 0 || color.maxCoeff() > 1)
    giver->forgiveAt("rgba", xml::quoted(giver->text("rgba")), "4 numbers from 0 to 1",
                     "the nearest such numbers are used");
  return color.cwiseMax(0).cwiseMin(1);
}

void readAssets(const Tag& section, Files& files, const Defaults& defaults, const Compiler& compiler,
                MjcfAssets& assets) {
  for (const Tag& tag : files.children(section, knownOf("asset"))) {
    if (tag.name() == "hfield") {
      if (assets.heightFields.size() == kMostHeightFields)
        tag.fail(tag.where(), "too many", "", fmt::format("at most {}", kMostHeightFields));
      HeightField field = readHeightField(tag, files, compiler);
      const bool isNamed = tag.has("name") || !tag.has("file");
      const std::string name = isNamed ? tag.nameIn("name") : fs::path(tag.text("file")).stem().string();
      add(tag, name, isNamed ? "name" : "file", std::move(field), assets.heightFields);
    }
    if (tag.name() == "model") {
      tag.expect(knownOf("model"));
      const bool isNamed = tag.has("name");
      const std::string name = isNamed ? tag.nameIn("name") : fs::path(tag.nameIn("file")).stem().string();
      add(tag, name, isNamed ? "name" : "file", MjcfAssets::Other{tag}, assets.models);
    }
    const bool isMesh = tag.name() == "mesh";
    if (!isMesh && tag.name() != "material") continue;
    tag.expect(knownOf(tag.name()));
    const Styled styled(tag, defaults.named(tag, "class", defaults.main()),
                        isMesh ? Kind::kMesh : Kind::kMaterial);
    if (isMesh) {
      readMesh(styled, compiler, assets);
    } else {
      readMaterial(styled, assets);
    }
  }
}

namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::Vector3f;

constexpr int kMostSamples = 1 << 18, kMostTouched = 1024;
static_assert(std::endian::native == std::endian::little);

void requireCounts(const Tag& tag, double rows, double columns) {
  if (rows >= 2 && columns >= 2 && rows * columns <= kMostSamples) return;
  tag.fail(tag.where(), "size of the grid", fmt::format("{:g} x {:g}", rows, columns),
           fmt::format("at least 2 x 2 and at most {} heights", kMostSamples));
}

// 8 bytes of counts, then rows of floats from the smallest y on.
Eigen::MatrixXd binaryHeights(const Tag& tag, const std::string& bytes) {
  std::int32_t counts[2] = {};
  if (bytes.size() >= sizeof counts) std::memcpy(counts, bytes.data(), sizeof counts);
  requireCounts(tag, counts[0], counts[1]);
  const std::size_t wanted = sizeof counts + sizeof(float) * static_cast<std::size_t>(counts[0] * counts[1]);
  if (bytes.size() != wanted)
    tag.failAt("file", fmt::format("{} bytes", bytes.size()), fmt::format("{}, for its heights", wanted));
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> heights(counts[0], counts[1]);
  std::memcpy(heights.data(), bytes.data() + sizeof counts, wanted - sizeof counts);
  if (!heights.allFinite()) tag.failAt("file", "a height that is not finite", "finite numbers");
  return heights.cast<double>();
}

Eigen::MatrixXd pictureHeights(const Tag& tag, const std::string& bytes) {
  const Texture picture = mesh::readTexture(bytes, fmt::format("<hfield> '{}'", tag.text("file")));
  requireCounts(tag, picture.height, picture.width);
  Eigen::MatrixXd heights(picture.height, picture.width);
  for (Index r = 0; r < heights.rows(); ++r)
    for (Index c = 0; c < heights.cols(); ++c)
      heights(r, c) = picture.rgb[3 * static_cast<std::size_t>(r * heights.cols() + c)];
  return heights;
}

Eigen::MatrixXd heightsInFile(const Tag& tag, const Files& files, const Compiler& compiler) {
  const std::string& given = tag.nameIn("file");
  const fs::path name = compiler.stripsPaths ? fs::path(given).filename() : fs::path(given);
  const fs::path file = files.find((fs::path(compiler.meshFolder) / name).generic_string(), tag);
  constexpr std::uintmax_t kLargest = 16u << 20;
  std::error_code problem;
  if (const std::uintmax_t size = fs::file_size(file, problem); problem || size > kLargest)
    tag.failAt("file", problem ? problem.message() : fmt::format("{} bytes", size),
               "a file of at most 16 MiB");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return endingOf(file) == ".png" ? pictureHeights(tag, bytes.str()) : binaryHeights(tag, bytes.str());
}

// Rows from the largest y on, as one sees them.
Eigen::MatrixXd heightsInTag(const Tag& tag) {
  const double rows = tag.number("nrow"), columns = tag.number("ncol");
  requireCounts(tag, rows, columns);
  const auto height = static_cast<Index>(rows), width = static_cast<Index>(columns);
  if (!tag.has("elevation")) return Eigen::MatrixXd::Zero(height, width);
  const Eigen::VectorXd all = tag.numbers("elevation", static_cast<int>(height * width));
  return all.reshaped<Eigen::RowMajor>(height, width).colwise().reverse();
}

Eigen::MatrixXd normalized(Eigen::MatrixXd heights) {
  heights.array() -= heights.minCoeff();
  if (const double most = heights.maxCoeff(); most > 0) heights /= most;
  return heights;
}

// Points of the surface over |x| <= size[0], |y| <= size[1], from z = 0 to size[2], and of the underside at
// -size[3]. There is a row of heights, 0 to 1, for each y, and a column for each x.
class Grid {
 public:
  Grid(Eigen::Vector4d size, Eigen::MatrixXd heights)
      : size_(std::move(size)), heights_(std::move(heights)) {}
  Index rows() const { return heights_.rows(); }
  Index columns() const { return heights_.cols(); }
  Vector3f at(Index row, Index column, bool isTop) const {
    const auto along = [](Index i, Index count, double half) {
      return half * (2 * static_cast<double>(i) / static_cast<double>(count - 1) - 1);
    };
    const double z = isTop ? size_[2] * heights_(row, column) : -size_[3];
    return Eigen::Vector3d(along(column, columns(), size_[0]), along(row, rows(), size_[1]), z).cast<float>();
  }

 private:
  Eigen::Vector4d size_;
  Eigen::MatrixXd heights_;
};

// The surface, and the sides and underside of the base.
TriangleMesh drawnMesh(const Grid& grid) {
  const Index rows = grid.rows(), columns = grid.columns();
  std::vector<Vector3f> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto add = [&](const Vector3f& point) {
    points.push_back(point);
    return static_cast<std::uint32_t>(points.size() - 1);
  };
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < columns; ++c) add(grid.at(r, c, true));
  const auto top = [&](Index r, Index c) { return static_cast<std::uint32_t>(r * columns + c); };
  for (Index r = 0; r + 1 < rows; ++r)
    for (Index c = 0; c + 1 < columns; ++c) {
      triangles.push_back({top(r, c), top(r, c + 1), top(r + 1, c)});
      triangles.push_back({top(r + 1, c), top(r, c + 1), top(r + 1, c + 1)});
    }
  std::vector<std::pair<Index, Index>> rim;  // counter-clockwise from above
  for (Index c = 0; c + 1 < columns; ++c) rim.emplace_back(0, c);
  for (Index r = 0; r + 1 < rows; ++r) rim.emplace_back(r, columns - 1);
  for (Index c = columns - 1; c > 0; --c) rim.emplace_back(rows - 1, c);
  for (Index r = rows - 1; r > 0; --r) rim.emplace_back(r, 0);
  const std::uint32_t middle = add((grid.at(0, 0, false) + grid.at(rows - 1, columns - 1, false)) / 2);
  const auto first = static_cast<std::uint32_t>(points.size());
  for (const auto& [r, c] : rim) add(grid.at(r, c, false));
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t next = (i + 1) % rim.size();
    const std::uint32_t a = top(rim[i].first, rim[i].second), b = top(rim[next].first, rim[next].second),
                        below = first + static_cast<std::uint32_t>(i),
                        belowNext = first + static_cast<std::uint32_t>(next);
    triangles.insert(triangles.end(), {{below, belowNext, a}, {belowNext, b, a}, {middle, belowNext, below}});
  }
  return weldedMesh(points, triangles);
}

// The convex hull of grid points of the surface and those under them.
using Corners = std::vector<std::pair<Index, Index>>;
TriangleMesh pieceOf(const Grid& grid, const Corners& corners) {
  std::vector<Vector3f> points;
  for (const auto& [r, c] : corners) {
    points.push_back(grid.at(r, c, true));
    points.push_back(grid.at(r, c, false));
  }
  return convexHull(points);
}

// Two prisms for each cell, as MuJoCo has them, or pieces over blocks of cells if there were too many.
std::vector<TriangleMesh> touchedPieces(const Grid& grid, Index block) {
  std::vector<TriangleMesh> pieces;
  for (Index r = 0; r + 1 < grid.rows(); r += block)
    for (Index c = 0; c + 1 < grid.columns(); c += block) {
      if (block == 1) {
        pieces.push_back(pieceOf(grid, {{r, c}, {r, c + 1}, {r + 1, c}}));
        pieces.push_back(pieceOf(grid, {{r + 1, c}, {r, c + 1}, {r + 1, c + 1}}));
        continue;
      }
      Corners corners;
      for (Index i = r; i <= std::min(r + block, grid.rows() - 1); ++i)
        for (Index k = c; k <= std::min(c + block, grid.columns() - 1); ++k) corners.emplace_back(i, k);
      pieces.push_back(pieceOf(grid, corners));
    }
  return pieces;
}

Index blockOf(const Grid& grid) {
  const auto blocks = [](Index count, Index block) { return (count - 1 + block - 1) / block; };
  Index block = 1;
  while (blocks(grid.rows(), block) * blocks(grid.columns(), block) * (block == 1 ? 2 : 1) > kMostTouched)
    ++block;
  return block;
}

}  // namespace

HeightField readHeightField(const Tag& tag, const Files& files, const Compiler& compiler) {
  tag.expect(knownOf("hfield"));
  const Eigen::Vector4d size = tag.numbers("size", 4);
  if (!(size.minCoeff() > 0)) tag.failAt("size", xml::quoted(tag.text("size")), "4 lengths > 0");
  if (tag.has("file") && !files.areRead()) return {};
  const Grid grid(size,
                  normalized(tag.has("file") ? heightsInFile(tag, files, compiler) : heightsInTag(tag)));
  const Index block = blockOf(grid);
  if (block > 1)
    tag.warn(tag.where(), fmt::format("{} x {} heights are touched as convex pieces over {} x {} cells each, "
                                      "which fill its hollows",
                                      grid.rows(), grid.columns(), block, block));
  return {drawnMesh(grid), touchedPieces(grid, block)};
}

}  // namespace rex::mjcf
