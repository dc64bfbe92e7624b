#pragma once
#include "base/graph_internal.h"
