// Singular values, and eigenvalues of symmetric matrices.
#define REX_SVD_INSTANCE template
#include "base/eigen_instances.h"
