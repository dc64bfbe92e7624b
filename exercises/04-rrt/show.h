#pragma once

#include "exercise.h"

/// hand.png, hand_plane.png: the histogram of 20000 random postures of an arm (links in metres) fills the
/// curve of radiusDensity; handDensity is highest where the arm is stretched out or folded up.
void showHand(double l1, double l2);

/// edges.png: if only nodes are tested, the tree grows through walls; if edges are tested, it uses the gaps.
void showEdges();

/// searches.png: the trees and paths of two searches between the thin walls.
void showSearches(const TreeSearch& backward, const TwoTreeSearch& both);

/// shortened.png: a path between the thin walls, and what remains of its detours.
void showShortened(const Path& path, const Path& better);

/// arm_backward.png, arm_both.png: the positions of the peg in your trees. path.mp4, shortened_path.mp4: the
/// arm on its way into the hole; each film comes with a contact sheet and an .html. Prints numbers of nodes
/// and lengths (rad).
void showArm();

/// effort.png: lines of equal distance from that state (m, m/s). The library's dashed lines are drawn on top
/// of your motions.
void showDistances(const Eigen::Vector2d& from, double T);

/// phase_tree.png: a tree of 600 steps. All branches go right above the axis, and left below it.
void showPhaseTree(const Eigen::Vector2d& from, double T);

/// costs.png, star.png: the cost falls towards the shortest path for each seed, as with the library; RRT* has
/// straight branches where RRT has crooked ones. exponents.png: the library's cost over the number of samples
/// with two exponents of the search radius.
void showStar();
