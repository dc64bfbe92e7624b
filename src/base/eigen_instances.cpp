#define REX_INSTANCE template
#include "base/eigen_instances.h"
