#include "base/text.h"

const int kFirst = 1;
