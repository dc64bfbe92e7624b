// Eigenvalues of any matrix, and Schur forms.
#define REX_SCHUR_INSTANCE template
#include "base/eigen_instances.h"
