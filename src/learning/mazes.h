#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "learning/mdp.h"

namespace rex {

/// The T-maze of exercise 12.10: junctions 0, 1, 2 with actions left and right. Junction 0 leads to 1 and
/// 2, and these to the terminal leaves 3 to 6, which pay 4, 0, 2, 3. The discount is .5. V in the junctions
/// is .5625, 1, 1.25 for the random policy and 1, 2, 1.5 for the optimal one.
[[nodiscard]] Mdp tMaze();

/// River-swim (Strehl and Littman 2008) with `states` from left to right, at least 3, and the actions left
/// and right. Left always succeeds. Right goes with .35 to the right and with .05 to the left, against the
/// current; from the first state with .6 to the right, from the last with .4 to the left. Left pays .005 in
/// the first state, right 1 in the last. The discount is .95. An agent that does not explore stays where
/// little is paid. Throws Error for fewer states.
[[nodiscard]] Mdp riverSwim(int states = 6);

/// The meaning of a letter on a map: acting there pays `reward`. With jumpTo the process continues from the
/// cell of that letter, whatever the action. Otherwise it ends there or, if not terminal, moves on as from
/// any cell.
struct GridMark {
  char letter = 'G';
  double reward = 1;
  bool isTerminal = true;
  std::optional<char> jumpTo{};
};

struct GridWorldOptions {
  double discount = .9;
  double stepReward = 0;  ///< in cells without a mark
  double bumpReward = 0;  ///< added when a wall or the border blocks the move
  double slip = 0;        ///< probability of moving sideways instead, half of it to each side
  std::vector<GridMark> marks{GridMark{}};
};

/// A Markov decision process on grid cells, with the actions north, east, south, west: (0, 1), (1, 0), (0,
/// -1), (-1, 0).
struct GridWorld {
  Mdp mdp{};
  int width = 0, height = 0;
  std::vector<std::array<int, 2>> cells{};  ///< column and row of each state, from the lower left
  /// The state of a cell; empty for walls and outside.
  [[nodiscard]] std::optional<int> state(int column, int row) const;
};

/// Reads a map of '#' (wall), '.' (free) and the letters of `marks`, one row per line, top row first.
/// States are numbered along the rows, from the lowest. Throws Error with line and column for other
/// characters and rows of different lengths. Also throws Error for a map without cells, jump targets that
/// are missing or not unique, two marks with one letter, '#' or '.' as a mark, and a slip outside [0, 1].
[[nodiscard]] GridWorld gridWorld(std::string_view map, const GridWorldOptions& options = {});

}  // namespace rex
