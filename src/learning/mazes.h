#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "learning/mdp.h"

namespace rex {

/// The T-maze of exercise 12.10: junctions 0, 1, 2 with actions left and right, 0 leads to 1 and 2, these to
/// the leaves 3 to 6, which pay 4, 0, 2, 3 and end. Discount .5. V of the random policy in the junctions is
/// .5625, 1, 1.25, the optimum 1, 2, 1.5.
[[nodiscard]] Mdp tMaze();

/// What a letter of a map means: acting there pays `reward`. With jumpTo the process goes on from the cell of
/// that letter, whatever the action; otherwise it ends there or, if not terminal, moves on as from any cell.
struct GridMark {
  char letter = 'G';
  double reward = 1;
  bool isTerminal = true;
  std::optional<char> jumpTo{};
};

struct GridWorldOptions {
  double discount = .9;
  double stepReward = 0;  ///< in cells without a mark
  double bumpReward = 0;  ///< besides, when a wall or the border keeps one in place
  double slip = 0;        ///< so often a move goes to one side instead, half of it to each
  std::vector<GridMark> marks{GridMark{}};
};

/// A decision process on cells, with the actions north, east, south, west: (0, 1), (1, 0), (0, -1), (-1, 0).
struct GridWorld {
  Mdp mdp{};
  int width = 0, height = 0;
  std::vector<std::array<int, 2>> cells{};  ///< column and row of each state, from the lower left
  /// The state of a cell; none for walls and outside.
  [[nodiscard]] std::optional<int> state(int column, int row) const;
};

/// Reads a map of '#' (wall), '.' (free) and the letters of `marks`, one row per line, the highest first.
/// States are numbered along the rows, from the lowest. Throws Error with line and column for other
/// characters and rows of different length; for a map without cells, cells that are jumped to and there twice
/// or not at all, two marks of one letter, '#' or '.' as a mark, and slips outside [0, 1].
[[nodiscard]] GridWorld gridWorld(std::string_view map, const GridWorldOptions& options = {});

}  // namespace rex
