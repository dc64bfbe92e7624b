#pragma once

#include "exercise.h"

/// hand.png, hand_plane.png: the bars of 20000 random postures of an arm (links in metres) fill the curve of
/// radiusDensity; by handDensity, the hand is mostly where the arm is stretched out or folded up.
void showHand(double l1, double l2);

/// edges.png: where only nodes are tested, the tree walks through walls; where edges are, it takes the gaps.
void showEdges();

/// searches.png: the trees and paths of two searches between the thin walls.
void showSearches(const TreeSearch& backward, const TwoTreeSearch& both);

/// shortened.png: a path between the thin walls, and what remains of its detours.
void showShortened(const Path& path, const Path& better);

/// arm_backward.png, arm_both.png: where the peg is in your trees. path.mp4, shortened_path.mp4: the arm on
/// its way into the hole; beside each film lie a sheet and an .html. Prints nodes and lengths (rad).
void showArm();

/// effort.png: lines of equal distance from that state (m, m/s). Your motions lie under the library's dashed
/// lines.
void showDistances(const Eigen::Vector2d& from, double T);

/// phase_tree.png: a tree of 600 steps. Above the axis all branches go right, below it left.
void showPhaseTree(const Eigen::Vector2d& from, double T);

/// costs.png, star.png: each seed comes down to the shortest way, as the library does; RRT* has straight
/// branches where RRT has crooked ones.
void showStar();
