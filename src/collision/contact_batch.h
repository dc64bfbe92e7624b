#pragma once

#include "collision/contact_model.h"
#include "kinematics/pose_batch.h"

namespace rex {

/// Distances of all pairs in many configurations, metres: column k of `distances` belongs to configuration k,
/// its rows to contacts.pairs(). As proximity() says, negative in overlap. Resizes `distances`.
void contactDistancesBatch(const ContactModel& contacts, const PoseBatch& poses, Eigen::MatrixXd& distances);

/// Whether each configuration keeps all pairs at least `margin` metres apart: where contactDistancesBatch()
/// says so, but that cylinders and meshes which touch are not free at margin 0. What is not a number is not
/// free. Resizes `free`.
void contactFreeBatch(const ContactModel& contacts, const PoseBatch& poses, double margin,
                      Eigen::Array<bool, Eigen::Dynamic, 1>& free);

/// Whether all configurations do. Stops where one does not.
[[nodiscard]] bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin);

}  // namespace rex
