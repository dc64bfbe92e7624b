// Cholesky and LU decompositions.
#define REX_LU_INSTANCE template
#include "base/eigen_instances.h"
