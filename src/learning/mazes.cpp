#include "learning/mazes.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr std::array<std::array<int, 2>, 4> kMoves{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};

std::vector<std::string_view> linesOf(std::string_view map) {
  std::vector<std::string_view> lines;
  while (!map.empty()) {
    const std::size_t end = std::min(map.find('\n'), map.size());
    lines.push_back(map.substr(0, end));
    map.remove_prefix(std::min(end + 1, map.size()));
  }
  return lines;
}

const GridMark* markOf(char letter, const GridWorldOptions& options) {
  const auto mark = std::find_if(options.marks.begin(), options.marks.end(),
                                 [&](const GridMark& m) { return m.letter == letter; });
  return mark == options.marks.end() ? nullptr : &*mark;
}

void requireMarks(const GridWorldOptions& options) {
  for (const GridMark& mark : options.marks) {
    const bool isCell = mark.letter != '#' && mark.letter != '.';
    if (isCell && markOf(mark.letter, options) == &mark) continue;
    throw Error({.what = "letter of a mark",
                 .found = fmt::format("{:?}", mark.letter),
                 .wanted = isCell ? "one mark of each letter" : "a letter other than '#' and '.'"});
  }
}

bool isJumpedTo(char letter, const GridWorldOptions& options) {
  return std::any_of(options.marks.begin(), options.marks.end(),
                     [&](const GridMark& m) { return m.jumpTo == letter; });
}

// Letters of all cells, from the lower left.
struct LetterMap {
  int width = 0, height = 0;
  std::string letters{};
  char at(int column, int row) const {
    const bool isInside = 0 <= column && column < width && 0 <= row && row < height;
    return isInside ? letters[static_cast<std::size_t>(row * width + column)] : '#';
  }
};

LetterMap readLetters(std::string_view map, const GridWorldOptions& options) {
  const std::vector<std::string_view> lines = linesOf(map);
  LetterMap result;
  result.height = static_cast<int>(lines.size());
  result.width = lines.empty() ? 0 : static_cast<int>(lines.front().size());
  for (std::size_t l = lines.size(); l-- > 0;) {
    const SourceLocation where{"map", static_cast<int>(l) + 1, 0};
    if (static_cast<int>(lines[l].size()) != result.width)
      throw Error({.what = "row of the map",
                   .where = where,
                   .found = fmt::format("{} cells", lines[l].size()),
                   .wanted = fmt::format("{}, as in the first", result.width)});
    for (std::size_t c = 0; c < lines[l].size(); ++c) {
      const char letter = lines[l][c];
      if (letter == '#' || letter == '.' || markOf(letter, options) || isJumpedTo(letter, options)) continue;
      throw Error({.what = "cell of the map",
                   .where = {"map", where.line, static_cast<int>(c) + 1},
                   .found = fmt::format("{:?}", letter),  // some are invisible
                   .wanted = "'#', '.' or the letter of a mark"});
    }
    result.letters += lines[l];
  }
  return result;
}

// The state of the cell with a letter that must occur exactly once.
int onlyState(const LetterMap& letters, const GridWorld& world, char letter) {
  std::vector<int> found;
  for (int s = 0; s < static_cast<int>(world.cells.size()); ++s) {
    const auto& [column, row] = world.cells[static_cast<std::size_t>(s)];
    if (letters.at(column, row) == letter) found.push_back(s);
  }
  if (found.size() == 1) return found.front();
  throw Error({.what = fmt::format("cell '{}', the target of a jump", letter),
               .found = fmt::format("{} of them", found.size()),
               .wanted = "one"});
}

class Builder {
 public:
  Builder(const LetterMap& letters, const GridWorldOptions& options) : letters_(letters), options_(options) {}

  GridWorld build() {
    world_.width = letters_.width;
    world_.height = letters_.height;
    for (int row = 0; row < letters_.height; ++row)
      for (int column = 0; column < letters_.width; ++column)
        if (letters_.at(column, row) != '#') world_.cells.push_back({column, row});
    if (world_.cells.empty()) throw Error({.what = "map", .found = "no free cell"});
    const auto states = static_cast<Eigen::Index>(world_.cells.size());
    world_.mdp.discount = options_.discount;
    world_.mdp.rewards.setZero(states, kMoves.size());
    world_.mdp.terminal.assign(world_.cells.size(), false);
    entries_.resize(kMoves.size());
    for (int s = 0; s < static_cast<int>(states); ++s) addState(s);
    for (const auto& entries : entries_) {
      world_.mdp.transitions.emplace_back(states, states);
      world_.mdp.transitions.back().setFromTriplets(entries.begin(), entries.end());
    }
    requireMdp(world_.mdp);
    return std::move(world_);
  }

 private:
  void addState(int s) {
    const auto cell = static_cast<std::size_t>(s);
    const auto& [column, row] = world_.cells[cell];
    const GridMark* mark = markOf(letters_.at(column, row), options_);
    world_.mdp.rewards.row(s).setConstant(mark ? mark->reward : options_.stepReward);
    if (mark && mark->jumpTo) {
      const int next = onlyState(letters_, world_, *mark->jumpTo);
      for (auto& entries : entries_) entries.emplace_back(s, next, 1.);
    } else if (mark && mark->isTerminal) {
      world_.mdp.terminal[cell] = true;
    } else {
      for (int a = 0; a < 4; ++a) {
        addMove(s, a, a, 1 - options_.slip);
        addMove(s, a, (a + 1) % 4, options_.slip / 2);
        addMove(s, a, (a + 3) % 4, options_.slip / 2);
      }
    }
  }

  void addMove(int s, int action, int move, double probability) {
    if (probability == 0) return;
    const auto& [column, row] = world_.cells[static_cast<std::size_t>(s)];
    const auto& [dx, dy] = kMoves[static_cast<std::size_t>(move)];
    const std::optional<int> next = world_.state(column + dx, row + dy);
    if (!next) world_.mdp.rewards(s, action) += probability * options_.bumpReward;
    entries_[static_cast<std::size_t>(action)].emplace_back(s, next.value_or(s), probability);
  }

  const LetterMap& letters_;
  const GridWorldOptions& options_;
  GridWorld world_{};
  std::vector<std::vector<Eigen::Triplet<double>>> entries_{};
};

}  // namespace

Mdp tMaze() {
  Mdp maze;
  maze.discount = .5;
  for (int a = 0; a < 2; ++a) {
    maze.transitions.emplace_back(7, 7);
    for (int s = 0; s < 3; ++s) maze.transitions.back().insert(s, 2 * s + 1 + a) = 1;
    maze.transitions.back().makeCompressed();
  }
  maze.rewards.setZero(7, 2);
  maze.rewards.bottomRows(4).colwise() = Eigen::Vector4d(4, 0, 2, 3);
  maze.terminal = {false, false, false, true, true, true, true};
  return maze;
}

Mdp riverSwim(int states) {
  requireCount("states of a river", states, 3);
  const int last = states - 1;
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(states, states), right = left;
  for (int s = 0; s < states; ++s) {
    left(s, std::max(s - 1, 0)) = 1;
    const double up = s == 0 ? .6 : s < last ? .35 : 0, down = s == 0 ? 0 : s < last ? .05 : .4;
    right(s, s) = 1 - up - down;
    if (s < last) right(s, s + 1) = up;
    if (s > 0) right(s, s - 1) = down;
  }
  Mdp river{.rewards = Eigen::MatrixXd::Zero(states, 2), .discount = .95};
  river.transitions = {left.sparseView(), right.sparseView()};
  river.rewards(0, 0) = .005;
  river.rewards(last, 1) = 1;
  return river;
}

std::optional<int> GridWorld::state(int column, int row) const {
  const std::array<int, 2> cell{column, row};
  const auto found = std::lower_bound(cells.begin(), cells.end(), cell,
                                      [](const std::array<int, 2>& a, const std::array<int, 2>& b) {
                                        return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
                                      });
  if (found == cells.end() || *found != cell) return std::nullopt;
  return static_cast<int>(found - cells.begin());
}

GridWorld gridWorld(std::string_view map, const GridWorldOptions& options) {
  if (!(options.slip >= 0 && options.slip <= 1))
    throw Error({.what = "slip", .found = fmt::format("{:g}", options.slip), .wanted = "a number in [0, 1]"});
  requireMarks(options);
  const LetterMap letters = readLetters(map, options);
  return Builder(letters, options).build();
}

}  // namespace rex
