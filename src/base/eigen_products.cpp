// Products, and solutions of triangular systems.
#define REX_PRODUCT_INSTANCE template
#include "base/eigen_instances.h"
