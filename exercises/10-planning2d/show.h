#pragma once

#include "exercise.h"

/// bug.png, bug.mp4, bug.html, bug_sheet.png: your bug's trail lies under the library's, into the hook, out
/// again, and round its tail.
void showBug(const CellMap& map, MapCell start, MapCell goal);

/// wavefront.png, distances.png: numbers and metres from the goal, and the way down to it. Prints how far the
/// distances are from the library's.
void showDistances(const CellMap& map, MapCell start, MapCell goal);

/// field.png: the potential and its force. Black trails reach the goal, red ones end at a cross.
void showField(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains);

/// roadmaps.png: 80 nodes of three strategies, and the way if there is one; bridges lie in the slot.
/// passage.png: how often a way is found, with more and more nodes. `width` is that of the slot [m].
void showRoadmaps(double width);

/// uninformed.png, astar.png: which cells a search looks at, and when; with an estimate they are fewer.
void showSearches(const CellMap& map, MapCell start, MapCell goal);
