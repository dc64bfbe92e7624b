#pragma once

#include "collision/contact_model.h"
#include "kinematics/pose_batch.h"

namespace rex {

/// Distances of all pairs in many configurations, metres, as proximity() gives them, negative in overlap.
/// Column k of `distances` belongs to configuration k, the rows to contacts.pairs(). Resizes `distances`.
void contactDistancesBatch(const ContactModel& contacts, const PoseBatch& poses, Eigen::MatrixXd& distances);

/// Whether each configuration keeps all pairs at least `margin` metres apart, in agreement with
/// contactDistancesBatch(), except that touching cylinders and meshes are not free at margin 0. Distances
/// that are not a number are not free. Resizes `free`.
void contactFreeBatch(const ContactModel& contacts, const PoseBatch& poses, double margin,
                      Eigen::Array<bool, Eigen::Dynamic, 1>& free);

/// Whether all configurations are free. Stops at the first that is not.
[[nodiscard]] bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin);

}  // namespace rex
