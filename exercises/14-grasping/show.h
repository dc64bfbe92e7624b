#pragma once

#include <vector>

#include "exercise.h"

/// pyramid.png: the forces in the friction cone with 1 N along the normal are a disc; the edges of the
/// pyramid lie on its border.
void showCone(double friction, int edges);

/// contacts.png: three fingers at these distances [m] along the outline of a plate; wrenches.png: the hull
/// of their wrenches.
void showWrenches(double friction, const std::vector<double>& ways);

/// Prints your verdicts on a cube with a finger in the middle of each face, and the proofs.
void showVerdicts(const std::vector<double>& frictions);

/// map.png: epsilon of two fingers anywhere on the outline of the plate. It is dark unless each is in the
/// other's cone.
void showMap(double friction);

/// friction.png: known values of epsilon, dashed, on yours.
void showFriction();

/// Prints how many fingers on a stone you keep. deletion.mp4, deletion_sheet.png: those for the last
/// friction.
void showDeletion(const std::vector<double>& frictions);

/// cones.png, hull.png: fingers on the plate by your search, and the hull of their wrenches with the largest
/// ball around zero.
void showGrasp(double friction, int count);
