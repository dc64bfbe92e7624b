// QR decompositions.
#define REX_QR_INSTANCE template
#include "base/eigen_instances.h"
