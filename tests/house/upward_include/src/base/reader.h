#pragma once
#include "scene/model.h"
